// Search for surfaces that pass through each other, and for cells that are nearer than their thickness.
#include <plastron/topology/cell_facets.hpp>
#include <plastron/topology/surface_flaws.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::topology {

namespace {

bool share_a_node(const std::array<int, 4>& a, const std::array<int, 4>& b) {
  for (const int n : a)
    if (n >= 0 && std::ranges::find(b, n) != b.end()) return true;
  return false;
}

class IntersectionSearch {
 public:
  IntersectionSearch(const SpaceMesh& mesh, const std::vector<double>& thickness)
      : mesh_(mesh), thickness_(thickness), facets_(mesh) {
    for (const SurfaceCell& cell : mesh.cells) corners_.push_back(corner_nodes(mesh.shape, cell));
  }

  /// Segments between neighbouring nodes of a side, against cells that do not share a node with the side's cell.
  void find_crossings(SurfaceFlaws& flaws) const {
    Found found;
    const std::vector<mesh::MeshEdge> sides = edges_of(mesh_);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (i > 0 && sides[i].ends == sides[i - 1].ends) continue;
      const auto& nodes = mesh_.cells[sides[i].cell].nodes;
      const std::vector<int> places = ascending_places(mesh_, sides[i]);
      for (std::size_t k = 1; k < places.size(); ++k) {
        const Vector3d &from = mesh_.nodes[nodes[places[k - 1]]], &to = mesh_.nodes[nodes[places[k]]];
        SpaceBox box;
        box.add(from);
        box.add(to);
        facets_.tree().visit(box, [&](std::size_t other) {
          if (share_a_node(corners_[sides[i].cell], corners_[other])) return;
          if (const auto p = facets_.crossing(other, from, to)) found.add(0, {sides[i].cell, other}, *p);
        });
      }
    }
    if (found.number > 0)
      flaws.warnings.push_back(
          {fmt::format(
               "the surface passes through itself: {} sides of elements cross other elements, first {} and {} at "
               "{}; the program does not see this contact, and the parts are not joined there",
               found.number, name(found.cells[0]), name(found.cells[1]), place_of(found.where)),
           found.where});
  }

  /// Centres and corners of cells, against cells above or below them.
  void find_near_cells(SurfaceFlaws& flaws) const {
    Found found;
    std::vector<bool> is_visited(mesh_.nodes.size());
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      find_above(c, facets_.centre(c), found);
      for (const int n : corners_[c]) {
        if (n < 0 || is_visited[n]) continue;
        is_visited[n] = true;
        find_above(c, mesh_.nodes[n], found);
      }
    }
    if (found.number > 0)
      flaws.warnings.push_back(
          {fmt::format("elements that are not neighbours are nearer to each other than their thickness (found at {} "
                       "points), the "
                       "nearest are {} and {}, {:.3g} apart at {}; the program does not see this contact",
                       found.number, name(found.cells[0]), name(found.cells[1]), found.least, place_of(found.where)),
           found.where});
  }

 private:
  struct Found {
    std::size_t number = 0;
    double least = HUGE_VAL;
    std::array<std::size_t, 2> cells{};
    Vector3d where = Vector3d::Zero();

    void add(double distance, const std::array<std::size_t, 2>& pair, const Vector3d& place) {
      ++number;
      if (distance >= least) return;
      least = distance;
      cells = pair;
      where = place;
    }
  };

  std::string name(std::size_t cell) const { return place_of(mesh_.cells[cell]); }
  double thickness(std::size_t cell) const { return thickness_[mesh_.cells[cell].region]; }

  /// A cell is above the point if the nearest point of it is the foot of a perpendicular, and if the way there leaves
  /// the point's own surface.
  void find_above(std::size_t cell, const Vector3d& point, Found& found) const {
    const double reach = std::ranges::max(thickness_);
    SpaceBox box;
    box.add(point);
    facets_.tree().visit(box.widened(reach), [&](std::size_t other) {
      if (other == cell || share_a_node(corners_[cell], corners_[other])) return;
      const Vector3d way = facets_.nearest(other, point) - point;
      const double d = way.norm();
      const auto cosine = [&](std::size_t c) { return std::abs(way.dot(facets_.normal(c))) / d; };
      if (d < (thickness(cell) + thickness(other)) / 2 && (d == 0 || (cosine(other) > 0.9 && cosine(cell) > 0.5)))
        found.add(d, {cell, other}, point);
    });
  }

  const SpaceMesh& mesh_;
  const std::vector<double>& thickness_;
  CellFacets facets_;
  std::vector<std::array<int, 4>> corners_;
};

}  // namespace

void find_intersections(const SpaceMesh& mesh, const std::vector<double>& thickness, SurfaceFlaws& flaws) {
  const IntersectionSearch search(mesh, thickness);
  search.find_crossings(flaws);
  if (!thickness.empty()) search.find_near_cells(flaws);
}

}  // namespace plastron::topology
