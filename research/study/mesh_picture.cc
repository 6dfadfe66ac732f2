#include <research/study/report.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/mesh/reference_cell.hpp>
#include <plastron/zones/sub_cells.hpp>
#include <plastron/zones/touching_nodes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

namespace plastron::study {

namespace {

constexpr int parts_of_side = 8;  // even: one of the points is the middle

/// The sides of a cell anticlockwise, each without its end.
Outline cell_outline(const fem::Surface& surface, mesh::Shape shape, const fem::Cell& cell) {
  std::vector<Eigen::Vector2d> xi;
  Eigen::Vector2d from = mesh::corner(shape, 0);
  const std::vector<int> round = shape == mesh::Shape::quadrilateral ? std::vector{1, 3, 2, 0} : std::vector{1, 2, 0};
  for (const int k : round) {
    const Eigen::Vector2d to = mesh::corner(shape, k);
    for (int i = 0; i < parts_of_side; ++i) xi.emplace_back(from + i * (to - from) / parts_of_side);
    from = to;
  }
  std::vector<double> x(xi.size()), y(xi.size());
  surface.positions(cell, xi, x, y);
  Outline outline;
  for (std::size_t i = 0; i < xi.size(); ++i) outline.emplace_back(x[i], y[i]);
  return outline;
}

/// Outlines of `points` points each, of all ranks.
std::vector<Outline> gathered(const std::vector<Outline>& mine, std::size_t points, MPI_Comm comm) {
  Outline values;
  for (const Outline& outline : mine) values.insert(values.end(), outline.begin(), outline.end());
  const Outline all = algebra::gathered(values, comm);
  std::vector<Outline> outlines;
  for (auto at = all.begin(); at != all.end(); at += static_cast<std::ptrdiff_t>(points))
    outlines.emplace_back(at, at + static_cast<std::ptrdiff_t>(points));
  return outlines;
}

/// Sub-cells all of whose nodes touch one obstacle (collective).
std::vector<Outline> touching_here(const computation::Solution& solution) {
  const assembly::DiscreteShell& discrete = *solution.discrete;
  const fem::Space& space = discrete.space();
  const auto subs = zones::sub_cells(space.shape(), space.degree);
  std::vector<Outline> outlines;
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k) {
    const zones::TouchingNodes touching(discrete, solution.nodal, k);
    for (std::size_t c = 0; c < space.owned_cells; ++c) {
      const auto nodes = space.nodes(c);
      for (const zones::SubCell& sub : subs) {
        if (!std::ranges::all_of(sub, [&](int i) { return touching[nodes[static_cast<std::size_t>(i)]]; })) continue;
        Outline& outline = outlines.emplace_back();
        for (const int i : sub)
          outline.push_back(discrete.points[static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)])].x);
      }
    }
  }
  return outlines;
}

/// Points of the plane that are equal up to rounding have one place.
class Places {
 public:
  explicit Places(const std::vector<Outline>& cells) {
    const Eigen::AlignedBox2d all = box(cells);
    origin_ = all.min() - 0.1234567 * all.sizes();  // no vertex of a regular mesh lies between two places
    size_ = 1e-8 * all.sizes().maxCoeff();
  }
  std::pair<std::int64_t, std::int64_t> of(const Eigen::Vector2d& p) const {
    return {std::llround((p[0] - origin_[0]) / size_), std::llround((p[1] - origin_[1]) / size_)};
  }

 private:
  Eigen::Vector2d origin_;
  double size_;
};

/// Middles of sides that are vertices of other cells.
std::vector<Eigen::Vector2d> hanging_vertices(const std::vector<Outline>& cells) {
  if (cells.empty()) return {};
  const Places places(cells);
  std::set<std::pair<std::int64_t, std::int64_t>> vertices;
  for (const Outline& cell : cells)
    for (std::size_t k = 0; k < cell.size(); k += parts_of_side) vertices.insert(places.of(cell[k]));
  std::vector<Eigen::Vector2d> hanging;
  for (const Outline& cell : cells)
    for (std::size_t k = parts_of_side / 2; k < cell.size(); k += parts_of_side)
      if (vertices.contains(places.of(cell[k]))) hanging.push_back(cell[k]);
  return hanging;
}

}  // namespace

Eigen::AlignedBox2d box(const std::vector<Outline>& outlines) {
  Eigen::AlignedBox2d all;
  for (const Outline& outline : outlines)
    for (const Eigen::Vector2d& p : outline) all.extend(p);
  return all;
}

MeshPicture mesh_picture(const computation::Solution& solution) {
  const energy::ShellOperator& shell = solution.discrete->shell;
  const fem::Space& space = shell.space();
  const auto corners = static_cast<std::size_t>(mesh::corner_count(space.shape()));
  std::vector<Outline> mine;
  for (std::size_t c = 0; c < space.owned_cells; ++c)
    mine.push_back(cell_outline(shell.surface(), space.shape(), space.cells[c]));
  MeshPicture picture{.cells = gathered(mine, corners * parts_of_side, space.layout->comm),
                      .touching = gathered(touching_here(solution), corners, space.layout->comm)};
  picture.hanging = hanging_vertices(picture.cells);
  return picture;
}

}  // namespace plastron::study
