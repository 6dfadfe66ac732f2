// Search for cells that overlap without sharing a side, if one contains the other's centre. A grid with about one box
// per cell finds the candidates.
#include <plastron/mesh/cell_map.hpp>
#include <plastron/mesh/coarse_mesh.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::mesh {

namespace {

struct Box {
  Vector2d low = Vector2d::Constant(HUGE_VAL), high = Vector2d::Constant(-HUGE_VAL);

  void add(const Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  bool holds(const Vector2d& p) const { return (p.array() >= low.array()).all() && (p.array() <= high.array()).all(); }
};

/// Bounding box of the nodes. The polynomial of a cell with curved sides may leave it a little; a centre there is
/// missed.
Box box_of(const CoarseCell& cell) {
  Box box;
  const auto add_all = [&](const std::vector<Vector2d>& nodes) {
    for (const Vector2d& p : nodes) box.add(p);
  };
  if (const auto* square = std::get_if<LagrangeMap>(&cell.map.map))
    add_all(square->nodes);
  else if (const auto* triangle = std::get_if<TriangleLagrangeMap>(&cell.map.map))
    add_all(triangle->nodes);
  else
    for (const double s : {0.0, 0.5, 1.0})
      for (const double t : {0.0, 0.5, 1.0}) box.add(cell.map({s, t}).value);
  return box;
}

/// The centres of cells, sorted into the squares of a grid.
class Grid {
 public:
  Grid(const Box& whole, std::size_t cells) : low_(whole.low) {
    const Vector2d size = whole.high - whole.low;
    step_ = std::max(std::sqrt(size[0] * size[1] / static_cast<double>(cells)), size.maxCoeff() / 1e6);
    columns_ = column(whole.high)[0] + 1;
    centres_.resize(static_cast<std::size_t>(columns_ * (column(whole.high)[1] + 1)));
  }

  void add(std::size_t cell, const Vector2d& centre) { centres_[at(column(centre))].push_back(cell); }

  template <class Visit>
  void visit(const Box& box, const Visit& visit) const {
    const auto from = column(box.low), to = column(box.high);
    for (std::int64_t j = from[1]; j <= to[1]; ++j)
      for (std::int64_t i = from[0]; i <= to[0]; ++i)
        for (const std::size_t cell : centres_[at({i, j})]) visit(cell);
  }

 private:
  std::array<std::int64_t, 2> column(const Vector2d& p) const {
    const Vector2d place = (p - low_) / step_;
    return {static_cast<std::int64_t>(place[0]), static_cast<std::int64_t>(place[1])};
  }
  std::size_t at(const std::array<std::int64_t, 2>& square) const {
    return static_cast<std::size_t>(square[1] * columns_ + square[0]);
  }

  Vector2d low_;
  double step_ = 1;
  std::int64_t columns_ = 1;
  std::vector<std::vector<std::size_t>> centres_;
};

}  // namespace

std::optional<std::array<std::size_t, 2>> find_overlap(const CoarseMesh& mesh) {
  std::vector<Box> boxes;
  std::vector<Vector2d> centres;
  Box whole;
  for (const CoarseCell& cell : mesh.cells) {
    boxes.push_back(box_of(cell));
    centres.push_back(cell.map(centre(shape_of(cell))).value);
    for (const Vector2d& p : {boxes.back().low, boxes.back().high, centres.back()}) whole.add(p);
  }
  Grid grid(whole, mesh.cells.size());
  for (std::size_t c = 0; c < centres.size(); ++c) grid.add(c, centres[c]);
  for (std::size_t c = 0; c < boxes.size(); ++c) {
    std::optional<std::size_t> inside;
    grid.visit(boxes[c], [&](std::size_t other) {
      if (other != c && !inside && boxes[c].holds(centres[other]) &&
          invert_map(shape_of(mesh.cells[c]), mesh.cells[c].map, centres[other]))
        inside = other;
    });
    if (inside) return std::array{std::min(c, *inside), std::max(c, *inside)};
  }
  return {};
}

}  // namespace plastron::mesh
