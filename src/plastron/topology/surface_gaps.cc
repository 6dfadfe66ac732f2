// Search for borders that are near each other, or near a cell, without being joined. Two surfaces that lie one above
// the other are no gap: there the cells are on the same side of the two borders.
#include <plastron/topology/cell_facets.hpp>
#include <plastron/topology/surface_flaws.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace plastron::topology {

namespace {

constexpr double touching = 1e-3;  ///< distance of surfaces that touch, as part of an element's length
const double cosine_of_parallel = std::cos(20 * std::numbers::pi / 180);

/// A side that no other cell has.
struct Border {
  mesh::MeshEdge side;
  double length;
  Vector3d inward;  ///< unit vector into the cell, across the side
};

/// Cells that share a side with each other, and the cells at each node.
class Neighbourhood {
 public:
  Neighbourhood(const SpaceMesh& mesh, const std::vector<mesh::MeshEdge>& sides) : beside_(mesh.cells.size()) {
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
      for (end = i + 1; end < sides.size() && sides[end].ends == sides[i].ends;) ++end;
      for (std::size_t a = i; a < end; ++a)
        for (std::size_t b = i; b < end; ++b) beside_[sides[a].cell].push_back(sides[b].cell);
      if (end == i + 1) borders.push_back(sides[i]);
    }
  }
  /// Whether the cells share a side or are one cell.
  bool are_beside(std::size_t a, std::size_t b) const {
    return a == b || std::ranges::find(beside_[a], b) != beside_[a].end();
  }
  std::vector<mesh::MeshEdge> borders;

 private:
  std::vector<std::vector<std::size_t>> beside_;
};

class GapSearch {
 public:
  GapSearch(const SpaceMesh& mesh, double gap)
      : mesh_(mesh), gap_(gap), neighbours_(mesh, edges_of(mesh)), facets_(mesh), is_border_(mesh.nodes.size()) {
    for (const mesh::MeshEdge& side : neighbours_.borders) {
      const Vector3d from = node(side.ends[0]), along = node(side.ends[1]) - from;
      const Vector3d in = facets_.centre(side.cell) - from;
      const Vector3d across = in - along * (along.dot(in) / along.squaredNorm());
      borders_.push_back({side, along.norm(), across.normalized()});
      for (const int n : side.ends) is_border_[n] = true;
    }
    by_cell_.resize(borders_.size());
    std::iota(by_cell_.begin(), by_cell_.end(), std::size_t{0});
    std::ranges::stable_sort(by_cell_, {}, [&](std::size_t b) { return borders_[b].side.cell; });
  }

  void run(SurfaceFlaws& flaws) {
    find_parallel_borders();
    find_touching_nodes();
    report(flaws);
  }

 private:
  const Vector3d& node(int n) const { return mesh_.nodes[n]; }
  std::string name(std::size_t cell) const { return place_of(mesh_.cells[cell]); }

  /// Borders both ends of which are near each other.
  void find_parallel_borders() {
    std::vector<SpaceBox> boxes(borders_.size());
    for (std::size_t b = 0; b < boxes.size(); ++b)
      for (const int n : borders_[b].side.ends) boxes[b].add(node(n));
    const BoxTree tree(boxes);
    for (std::size_t b = 0; b < boxes.size(); ++b)
      tree.visit(boxes[b].widened(gap_ * borders_[b].length), [&](std::size_t other) {
        if (other > b) compare(borders_[b], borders_[other]);
      });
  }

  void compare(const Border& a, const Border& b) {
    if (neighbours_.are_beside(a.side.cell, b.side.cell) || a.inward.dot(b.inward) > cosine_of_parallel) return;
    const auto distance = [&](int i) {
      return std::max((node(a.side.ends[0]) - node(b.side.ends[i])).norm(),
                      (node(a.side.ends[1]) - node(b.side.ends[1 - i])).norm());
    };
    const double d = std::min(distance(0), distance(1));
    if (d > gap_ * std::min(a.length, b.length)) return;
    if (gaps_.number++ == 0) gaps_.cells = {a.side.cell, b.side.cell};
    gaps_.add(d, node(a.side.ends[0]));
  }

  /// Nodes of a border that are near a cell that does not have them.
  void find_touching_nodes() {
    std::vector<std::pair<int, const Border*>> ends;
    for (const Border& b : borders_)
      for (const int n : b.side.ends) ends.emplace_back(n, &b);
    std::ranges::stable_sort(ends, {}, &std::pair<int, const Border*>::first);
    for (std::size_t i = 0, end = 0; i < ends.size(); i = end) {
      std::vector<const Border*> at_node;
      for (end = i; end < ends.size() && ends[end].first == ends[i].first; ++end) at_node.push_back(ends[end].second);
      double reach = HUGE_VAL;
      for (const Border* b : at_node) reach = std::min(reach, gap_ * b->length);
      SpaceBox box;
      box.add(node(ends[i].first));
      facets_.tree().visit(box.widened(reach), [&](std::size_t cell) { touch(ends[i].first, at_node, reach, cell); });
    }
  }

  void touch(int n, const std::vector<const Border*>& at_node, double reach, std::size_t cell) {
    const auto corners = corner_nodes(mesh_.shape, mesh_.cells[cell]);
    if (std::ranges::find(corners, n) != corners.end()) return;
    for (const Border* b : at_node)
      if (neighbours_.are_beside(b->side.cell, cell)) return;
    const double size = facets_.size(cell);
    const Vector3d nearest = facets_.nearest(cell, node(n));
    const double d = (nearest - node(n)).norm();
    if (d > std::min(reach, gap_ * size)) return;
    for (int k = 0; k < mesh::corner_count(mesh_.shape); ++k)
      if ((node(corners[k]) - nearest).norm() <= std::max(2 * d, touching * size))
        return touch_corner(n, corners[k], at_node, cell, d);
    const bool is_above = std::ranges::all_of(at_node, [&](const Border* b) { return is_stacked(*b, cell, nearest); });
    if (is_above && d > touching * size) return;
    Count& count = is_on_side(cell, nearest, d) ? hanging_ : inside_;
    if (count.number++ == 0) count.cells = {at_node.front()->side.cell, cell};
    count.add(d, node(n));
  }

  /// A node near another one is a gap if a surface goes on there; borders are compared by their sides.
  void touch_corner(int n, int corner, const std::vector<const Border*>& at_node, std::size_t cell, double d) {
    if (is_border_[corner]) return;
    if (std::ranges::all_of(at_node, [&](const Border* b) { return is_stacked(*b, cell, node(corner)); })) return;
    if (gaps_.number++ == 0) gaps_.cells = {at_node.front()->side.cell, cell};
    gaps_.add(d, node(n));
  }

  /// Whether the border's cell runs along the other cell, one above the other.
  bool is_stacked(const Border& border, std::size_t cell, const Vector3d& point) const {
    if (const Border* other = border_side(cell, point)) return border.inward.dot(other->inward) > cosine_of_parallel;
    return std::abs(border.inward.dot(facets_.normal(cell))) < std::sqrt(1 - cosine_of_parallel * cosine_of_parallel);
  }

  /// The border of the cell that has the point, if any.
  const Border* border_side(std::size_t cell, const Vector3d& point) const {
    for (std::size_t i = first_border(cell); i < by_cell_.size() && borders_[by_cell_[i]].side.cell == cell; ++i) {
      const Border& b = borders_[by_cell_[i]];
      if (distance_to_side(b.side, point) <= touching * b.length) return &b;
    }
    return nullptr;
  }
  std::size_t first_border(std::size_t cell) const {
    const auto cell_of = [&](std::size_t b) { return borders_[b].side.cell; };
    return static_cast<std::size_t>(std::ranges::lower_bound(by_cell_, cell, {}, cell_of) - by_cell_.begin());
  }

  double distance_to_side(const mesh::MeshEdge& side, const Vector3d& point) const {
    const std::vector<int> places = ascending_places(mesh_, side);
    double least = HUGE_VAL;
    for (std::size_t i = 1; i < places.size(); ++i) {
      const Vector3d& a = node(mesh_.cells[side.cell].nodes[places[i - 1]]);
      const Vector3d& b = node(mesh_.cells[side.cell].nodes[places[i]]);
      least = std::min(least, (nearest_point({a, b, b}, point) - point).norm());
    }
    return least;
  }

  bool is_on_side(std::size_t cell, const Vector3d& point, double distance) const {
    for (int side = 0; side < mesh::corner_count(mesh_.shape); ++side)
      if (distance_to_side({{}, cell, side, true}, point) <= std::max(distance, touching * facets_.size(cell)))
        return true;
    return false;
  }

  struct Count {
    std::size_t number = 0;
    std::array<std::size_t, 2> cells{};  ///< of the first
    double least = HUGE_VAL, largest = 0;
    Vector3d where = Vector3d::Zero();  ///< of the largest distance

    void add(double distance, const Vector3d& place) {
      least = std::min(least, distance);
      if (distance >= largest) {
        largest = distance;
        where = place;
      }
    }
    std::string text() const {
      return number == 1 ? fmt::format("number 1, distance {:.3g}", largest)
                         : fmt::format("number {}, distances {:.3g} to {:.3g}", number, least, largest);
    }
  };

  /// A number of two digits above the distance.
  static double rounded_up(double distance) {
    const double unit = std::pow(10.0, std::floor(std::log10(distance)) - 1);
    return std::ceil(1.05 * distance / unit) * unit;
  }

  void report(SurfaceFlaws& flaws) const {
    if (gaps_.number > 0) {
      const std::string remedy = gaps_.largest > 0
                                     ? fmt::format("set the tolerance to {:.2g}, or ", rounded_up(gaps_.largest))
                                     : std::string();
      flaws.errors.push_back(
          {fmt::format(
               "the border runs beside other edges without being joined ({}), first {} and {}; the largest distance "
               "is at {}: {}merge the nodes in the meshing program (Gmsh: Coherence)",
               gaps_.text(), name(gaps_.cells[0]), name(gaps_.cells[1]), place_of(gaps_.where), remedy),
           gaps_.where, SurfaceError::About::border});
    }
    if (hanging_.number > 0)
      flaws.errors.push_back(
          {fmt::format(
               "nodes of the border lie inside of a side of another element ({}), first {} at the side of {}; the "
               "largest distance is at {}: the surface is not joined there; neighbours must share whole sides, so "
               "mesh both surfaces together (Gmsh: BooleanFragments)",
               hanging_.text(), name(hanging_.cells[0]), name(hanging_.cells[1]), place_of(hanging_.where)),
           hanging_.where, SurfaceError::About::border});
    if (inside_.number > 0)
      flaws.errors.push_back(
          {fmt::format(
               "nodes of the border lie inside of another element ({}), first {} on {}; the largest distance is at "
               "{}: a surface ends on another one that has no edge there; imprint the edge in the CAD program, or "
               "mesh both surfaces together (Gmsh: BooleanFragments)",
               inside_.text(), name(inside_.cells[0]), name(inside_.cells[1]), place_of(inside_.where)),
           inside_.where, SurfaceError::About::border});
  }

  const SpaceMesh& mesh_;
  double gap_;
  Neighbourhood neighbours_;
  CellFacets facets_;
  std::vector<Border> borders_;
  std::vector<std::size_t> by_cell_;  ///< borders in ascending order of their cells
  std::vector<bool> is_border_;       ///< for each node: an end of a border
  Count gaps_, hanging_, inside_;
};

}  // namespace

void find_gaps(const SpaceMesh& mesh, double gap, SurfaceFlaws& flaws) { GapSearch(mesh, gap).run(flaws); }

}  // namespace plastron::topology
