#include <plastron/topology/surface_directors.hpp>
#include <plastron/topology/surface_patch.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

namespace plastron::topology {

namespace {

constexpr double one_degree = std::numbers::pi / 180;

/// Angles between the two sides at each corner.
std::array<double, 4> corner_angles(mesh::Shape shape, const PatchPoints& p, int order) {
  const auto tangents = [&](Eigen::Index n) { return std::pair<Vector3d, Vector3d>(p.a1.row(n), p.a2.row(n)); };
  const auto [a0, b0] = tangents(0);
  const auto [a1, b1] = tangents(order);
  const Eigen::Index last = p.phi.rows() - 1;
  if (shape == mesh::Shape::triangle) {
    const auto [a2, b2] = tangents(last);
    return {angle_between(a0, b0), angle_between(-a1, b1 - a1), angle_between(a2 - b2, -b2), 0};
  }
  const auto [a2, b2] = tangents(last - order);
  const auto [a3, b3] = tangents(last);
  return {angle_between(a0, b0), angle_between(-a1, b1), angle_between(a2, -b2), angle_between(a3, b3)};
}

std::array<int, 4> corner_places(mesh::Shape shape, int order) {
  const int last = mesh::nodes_per_cell(shape, order) - 1;
  if (shape == mesh::Shape::triangle) return {0, order, last, -1};
  return {0, order, last - order, last};
}

std::string in_degrees(double angle) { return fmt::format("{:.4g}", angle / one_degree); }

/// Replaces the mean directors of a node that are near the file's normal.
void use_normal_of_file(const Vector3d& given, std::span<DirectorNode> fans, const Vector3d& where) {
  constexpr double allowed = 60 * one_degree;
  if (!(given.norm() > 0 && given.allFinite()))
    throw SurfaceError(
        SurfaceError::About::surface,
        fmt::format("the normal given at {} has no direction; give a vector that is not zero", place_of(where)));
  const Vector3d unit = given.normalized();
  double nearest = HUGE_VAL;
  for (DirectorNode& fan : fans) {
    const Vector3d along = fan.director.dot(unit) < 0 ? Vector3d(-unit) : unit;
    const double angle = angle_between(along, fan.director);
    nearest = std::min(nearest, angle);
    if (angle <= allowed) fan.director = along;
  }
  if (nearest > allowed)
    throw SurfaceError(
        SurfaceError::About::surface,
        fmt::format("the normal given at {} is {} degrees off the elements' mean normal; at most 60 are allowed: "
                    "correct it or leave "
                    "it out, so that the mean normal is taken",
                    place_of(where), in_degrees(nearest)));
}

/// The normals that the file gives for a cell, on the side of a_1 x a_2. Throws SurfaceError where one is far from that.
std::vector<Vector3d> given_normals(const SpaceMesh& mesh, const SurfaceCell& cell, const PatchPoints& points) {
  constexpr double allowed = 60 * one_degree, part = 0.02;
  double side = 0, largest = 0;
  for (Eigen::Index n = 0; n < points.phi.rows(); ++n) {
    side += cell.normals[static_cast<std::size_t>(n)].dot(points.normal(n));
    largest = std::max(largest, points.normal(n).norm());
  }
  std::vector<Vector3d> normals;
  for (Eigen::Index n = 0; n < points.phi.rows(); ++n) {
    const Vector3d given = (side < 0 ? -1 : 1) * cell.normals[static_cast<std::size_t>(n)];
    // Where the edges of a part are tangent to each other, the cell has no normal of its own.
    const bool has_own = points.normal(n).norm() > part * largest;
    if (!(given.norm() > 0) || !given.allFinite() || (has_own && angle_between(given, points.normal(n)) > allowed))
      throw SurfaceError(
          SurfaceError::About::cells,
          fmt::format("the normal that the file gives for {} at {} is more than 60 degrees off that of the element; "
                      "correct it or leave out the normals",
                      place_of(cell),
                      place_of(mesh.nodes[static_cast<std::size_t>(cell.nodes[static_cast<std::size_t>(n)])])));
    normals.push_back(given.normalized());
  }
  return normals;
}

/// Corrections of the normals at the ends of a cell's lines of nodes, see set_directors().
class EndCorrection {
 public:
  /// `means`: unit directors before the correction.
  EndCorrection(const SpaceMesh& mesh, const LatticeNormals& normals,
                const std::vector<std::vector<std::int32_t>>& cell_director_nodes, const std::vector<bool>& ends,
                const std::vector<Vector3d>& means)
      : mesh_(mesh), normals_(normals), copies_(cell_director_nodes), ends_(ends), means_(means) {}

  /// Calls add(place on the cell's lattice, correction).
  template <class Add>
  void for_cell(std::size_t cell, const Add& add) const {
    const int order = mesh_.cells[cell].order;
    if (!mesh_.cells[cell].normals.empty()) return;  // these have no error
    if (mesh_.shape == mesh::Shape::triangle) return on_triangle(cell, add);
    for (int side = 0; side < 4; ++side) {
      if (!ends_[4 * cell + static_cast<std::size_t>(side)]) continue;
      for (int k = 0; k <= order; ++k) {
        const int row = order + 1, first = side < 2 ? k * row : k, last = side < 2 ? first + order : order * row + k;
        const bool is_low = side % 2 == 0;
        add(is_low ? first : last, Vector3d(-turned_deviation(cell, is_low ? last : first, is_low ? first : last)));
      }
    }
  }

 private:
  Vector3d deviation(std::size_t cell, int place) const {
    return means_[static_cast<std::size_t>(copies_[cell][static_cast<std::size_t>(place)])] - normals_.at(cell, place);
  }

  /// Turns the deviation with the cell's normal, from a place to the opposite one.
  Vector3d turned_deviation(std::size_t cell, int from, int to) const {
    const Vector3d v = deviation(cell, from), a = normals_.at(cell, from), b = normals_.at(cell, to), sum = a + b;
    return v - sum.dot(v) / (1 + a.dot(b)) * sum + 2 * a.dot(v) * b;
  }

  /// On a facet with a side at the end: the opposite corner.
  template <class Add>
  void on_triangle(std::size_t cell, const Add& add) const {
    if (mesh_.cells[cell].order > 1) return;
    for (int side = 0; side < 3; ++side) {
      if (!ends_[3 * cell + static_cast<std::size_t>(side)]) continue;
      const auto [from, to] = mesh::anticlockwise_corners(mesh::Shape::triangle, side);
      const int opposite = 3 - from - to;
      for (const int place : {from, to}) add(place, Vector3d(-deviation(cell, opposite)));
    }
  }

  const SpaceMesh& mesh_;
  const LatticeNormals& normals_;
  const std::vector<std::vector<std::int32_t>>& copies_;
  const std::vector<bool>& ends_;
  const std::vector<Vector3d>& means_;
};

/// Normalises the sums of the weighted normals, with the corrections at the ends of the surface.
void correct_at_ends(const SpaceMesh& mesh, const LatticeNormals& normals,
                     const std::vector<std::vector<std::int32_t>>& cell_director_nodes, const std::vector<bool>& ends,
                     std::vector<DirectorNode>& director_nodes) {
  std::vector<Vector3d> means;
  means.reserve(director_nodes.size());
  for (const DirectorNode& fan : director_nodes) means.push_back(fan.director.normalized());
  const EndCorrection correction(mesh, normals, cell_director_nodes, ends, means);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    correction.for_cell(c, [&](int place, const Vector3d& change) {
      const std::size_t i = normals.first[c] + static_cast<std::size_t>(place);
      director_nodes[static_cast<std::size_t>(cell_director_nodes[c][static_cast<std::size_t>(place)])].director +=
          normals.weight[i] * change;
    });
  for (DirectorNode& fan : director_nodes) fan.director.normalize();
}

void check_transversal(const DirectorAngle& largest, const SpaceMesh& mesh) {
  constexpr double allowed = 80 * one_degree;
  if (largest.angle > allowed)
    throw SurfaceError(
        SurfaceError::About::cells,
        fmt::format(
            "the director at {} is {} degrees off the normal of {}; at most 80 are allowed: use smaller elements "
            "there, or a smaller smooth angle, so that sharp edges become folds",
            place_of(largest.where), in_degrees(largest.angle), place_of(mesh.cells[largest.cell])));
}

}  // namespace

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

LatticeNormals lattice_normals(const SpaceMesh& mesh) {
  PatchTables tables(mesh.shape, [&](int order) { return mesh::lattice(mesh.shape, order); });
  LatticeNormals normals;
  for (const SurfaceCell& cell : mesh.cells) {
    const PatchPoints points = patch_points(tables(cell.order), mesh, cell);
    const double degenerate = degenerate_normal(points);
    normals.first.push_back(normals.normal.size());
    const bool has_normals = !cell.normals.empty();
    if (has_normals) std::ranges::copy(given_normals(mesh, cell, points), std::back_inserter(normals.normal));
    for (Eigen::Index n = 0; n < points.phi.rows(); ++n) {
      if (!has_normals && !(points.normal(n).norm() > degenerate))
        throw SurfaceError(
            SurfaceError::About::cells,
            fmt::format(
                "{} is degenerate at {}: it has no normal there; all corners must be above 0 and below 180 degrees, "
                "and no two nodes may coincide",
                place_of(cell), place_of(mesh.nodes[cell.nodes[n]])));
      if (!has_normals) normals.normal.push_back(points.normal(n).normalized());
      normals.weight.push_back(1);
    }
    const auto places = corner_places(mesh.shape, cell.order);
    const auto angles = corner_angles(mesh.shape, points, cell.order);
    for (int k = 0; k < mesh::corner_count(mesh.shape); ++k)
      normals.weight[normals.first.back() + places[k]] = angles[k];
  }
  return normals;
}

DirectorAngle set_directors(const SpaceMesh& mesh, const LatticeNormals& normals,
                            const std::vector<std::vector<std::int32_t>>& cell_director_nodes,
                            const std::vector<bool>& ends, std::vector<DirectorNode>& director_nodes) {
  for (DirectorNode& fan : director_nodes) fan.director = Vector3d::Zero();
  const auto visit = [&](const auto& visit_node) {
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (std::size_t n = 0; n < mesh.cells[c].nodes.size(); ++n)
        visit_node(c, director_nodes[cell_director_nodes[c][n]], normals.first[c] + n);
  };
  visit([&](std::size_t, DirectorNode& fan, std::size_t i) { fan.director += normals.weight[i] * normals.normal[i]; });
  correct_at_ends(mesh, normals, cell_director_nodes, ends, director_nodes);
  if (!mesh.normals.empty())
    for (std::size_t i = 0, end = 0; i < director_nodes.size(); i = end) {
      const std::int32_t node = director_nodes[i].node;
      for (end = i + 1; end < director_nodes.size() && director_nodes[end].node == node;) ++end;
      if (mesh.normals[node]) use_normal_of_file(*mesh.normals[node], {&director_nodes[i], end - i}, mesh.nodes[node]);
    }
  DirectorAngle largest;
  visit([&](std::size_t c, const DirectorNode& fan, std::size_t i) {
    const double angle = angle_between(fan.director, normals.normal[i]);
    if (angle > largest.angle) largest = {angle, c, mesh.nodes[fan.node]};
  });
  check_transversal(largest, mesh);
  return largest;
}

}  // namespace plastron::topology
