#include <plastron/topology/surface_flaws.hpp>
#include <plastron/topology/surface_patch.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace plastron::topology {

namespace {

/// Cells with a flaw of one kind.
struct BadCells {
  std::size_t number = 0;
  std::size_t worst_cell = 0;
  double worst = 0;
  Vector3d where = Vector3d::Zero();

  void add(std::size_t cell, double badness, const Vector3d& place) {
    if (number++ == 0 || badness > worst) {
      worst_cell = cell;
      worst = badness;
      where = place;
    }
  }
  /// Returns "element 7 at (1, 0, 0) (the worst of 3)".
  std::string text(const SpaceMesh& mesh) const {
    const std::string one = fmt::format("{} at {}", place_of(mesh.cells[worst_cell]), place_of(where));
    return number == 1 ? one : fmt::format("{} (the worst of {})", one, number);
  }
};

void find_same_cells(const SpaceMesh& mesh, SurfaceFlaws& flaws) {
  std::vector<std::pair<std::array<int, 4>, std::size_t>> corners;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    auto own = corner_nodes(mesh.shape, mesh.cells[c]);
    std::ranges::sort(own);
    corners.emplace_back(own, c);
  }
  std::ranges::sort(corners);
  std::size_t number = 0;
  std::array<std::size_t, 2> first{};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (corners[i].first != corners[i - 1].first) continue;
    const std::array pair{corners[i - 1].second, corners[i].second};
    if (number++ == 0 || pair < first) first = pair;
  }
  if (number == 0) return;
  const Vector3d where = mesh.nodes[mesh.cells[first[0]].nodes[0]];
  flaws.errors.push_back(
      {fmt::format(
           "elements have the same corners (number of pairs: {}), first {} and {} at {}; remove one of each pair, or "
           "divide the elements of a tube that has only two round its axis",
           number, place_of(mesh.cells[first[0]]), place_of(mesh.cells[first[1]]), place_of(where)),
       where});
}

/// Length of the longest side over the mean height above it, if the cell were flat.
double aspect(const SpaceMesh& mesh, const SurfaceCell& cell, double mean_normal) {
  const auto corners = corner_nodes(mesh.shape, cell);
  double longest = 0;
  for (int side = 0; side < mesh::corner_count(mesh.shape); ++side) {
    const auto [from, to] = mesh::side_corners(mesh.shape, side);
    longest = std::max(longest, (mesh.nodes[corners[to]] - mesh.nodes[corners[from]]).norm());
  }
  return longest * longest / mean_normal;
}

}  // namespace

void find_bad_cells(const SpaceMesh& mesh, SurfaceFlaws& flaws) {
  constexpr double allowed = 2000;
  PatchTables tables(mesh.shape, [&](int order) { return mesh::lattice(mesh.shape, order == 1 ? 1 : 2 * order); });
  BadCells folded, slender, uneven;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const SurfaceCell& cell = mesh.cells[c];
    const PatchPoints points = patch_points(tables(cell.order), mesh, cell);
    const double degenerate = degenerate_normal(points);
    std::vector<Vector3d> normals;
    Vector3d mean = Vector3d::Zero();
    for (Eigen::Index p = 0; p < points.phi.rows(); ++p)
      mean += normals.emplace_back(points.normal(p)) / static_cast<double>(points.phi.rows());
    double longest = 0;
    for (const Vector3d& normal : normals) longest = std::max(longest, normal.norm());
    // Cells with normals of a part may have a corner where edges are tangent to each other, as the part has.
    constexpr double tip = 1e-3;
    const double ignored = cell.normals.empty() ? -1 : tip * longest;
    std::size_t worst = 0;
    double least_cosine = 1, least = HUGE_VAL, largest = 0;
    for (std::size_t p = 0; p < normals.size(); ++p) {
      const double norm = normals[p].norm();
      if (norm <= ignored) continue;
      const double cosine = norm > degenerate ? normals[p].dot(mean) / (norm * mean.norm()) : -1;
      if (!(cosine >= least_cosine)) {
        least_cosine = cosine;
        worst = p;
      }
      least = std::min(least, norm);
      largest = std::max(largest, norm);
    }
    const Vector3d where = points.phi.row(static_cast<Eigen::Index>(worst));
    if (!(least_cosine > 1e-9)) {
      folded.add(c, -least_cosine, where);
      continue;
    }
    if (const double a = aspect(mesh, cell, mean.norm()); a > allowed) slender.add(c, a, where);
    if (largest > allowed * least) uneven.add(c, largest / least, where);
  }
  if (folded.number > 0)
    flaws.errors.push_back(
        {fmt::format(
             "{} is degenerate or folds over: its normal vanishes or changes by more than 90 degrees; all corners "
             "must be above 0 and below 180 degrees, no two nodes may coincide, and no curved side may reach "
             "through the element",
             folded.text(mesh)),
         folded.where});
  if (slender.number > 0)
    flaws.warnings.push_back(
        {fmt::format("{} is {:.4g} times longer than wide, more than {}; mesh the surface again without slivers",
                     slender.text(mesh), slender.worst, allowed),
         slender.where});
  if (uneven.number > 0)
    flaws.warnings.push_back(
        {fmt::format(
             "{} is nearly degenerate: its normal a_1 x a_2 is {:.4g} times longer at one node than at another, "
             "more than {}; mesh the surface again with more even elements",
             uneven.text(mesh), uneven.worst, allowed),
         uneven.where});
}

SurfaceFlaws find_flaws(const SpaceMesh& mesh, const FlawLimits& limits) {
  SurfaceFlaws flaws;
  for (const SurfaceCell& cell : mesh.cells)
    for (const std::int32_t n : cell.nodes)
      if (!mesh.nodes[n].allFinite()) {
        flaws.errors.push_back({fmt::format("{} has a node at {}; coordinates must be finite numbers", place_of(cell),
                                            place_of(mesh.nodes[n])),
                                mesh.nodes[n]});
        return flaws;
      }
  find_same_cells(mesh, flaws);
  find_bad_cells(mesh, flaws);
  if (limits.gap > 0) find_gaps(mesh, limits.gap, flaws);
  find_intersections(mesh, limits.thickness, flaws);
  return flaws;
}

}  // namespace plastron::topology
