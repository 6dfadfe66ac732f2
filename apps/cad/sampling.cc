#include "sampling.hpp"

#include "edge_curve.hpp"
#include "face_surface.hpp"

#include <plastron/topology/surface_directors.hpp>
#include <plastron/topology/surface_patch.hpp>

#include <TopoDS.hxx>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace plastron::cad {

namespace {

/// The worst shape at the nodes of a cell, and its place.
std::pair<double, Vector3d> shape_of(const mesh::LatticeTable& at_nodes, const topology::SpaceMesh& surface,
                                     const topology::SurfaceCell& cell) {
  const topology::PatchPoints points = topology::patch_points(at_nodes, surface, cell);
  std::pair<double, Vector3d> worst{1, Vector3d::Zero()};
  for (Eigen::Index n = 0; n < points.phi.rows(); ++n) {
    const double product = points.a1.row(n).norm() * points.a2.row(n).norm();
    const double shape = product > 0 ? points.normal(n).dot(cell.normals[static_cast<std::size_t>(n)]) / product : 0;
    if (shape < worst.first) worst = {shape, points.phi.row(n)};
  }
  return worst;
}

class Sampler {
 public:
  Sampler(const JoinedPart& part, const Quads& quads) : quads_(quads) {
    for (const LabelledFace& face : part.labelled) surfaces_.emplace_back(face.face);
    for (const Quads::Line& line : quads.lines) {
      if (!curves_.contains(line.edge)) curves_.emplace(line.edge, EdgeCurve(TopoDS::Edge(part.edges(line.edge))));
      lines_[key(line.ends[0], line.ends[1])] = &line;
    }
    place_corners();
  }

  SampledMesh operator()(int degree) {
    SampledMesh mesh{.degree = degree, .surface = {.nodes = corners_, .cells = {}}, .lines = {}};
    sides_.clear();
    set_tables(degree);
    for (const Quads::Line& line : quads_.lines) {
      mesh.lines.push_back({side_nodes(line.ends[0], line.ends[1], -1, mesh), line.edge});
      measure_line(mesh.lines.back(), mesh);
    }
    for (const Quads::Cell& cell : quads_.cells) add_cell(cell, mesh);
    return mesh;
  }

 private:
  void set_tables(int degree) {
    constexpr auto square = mesh::Shape::quadrilateral;
    steps_.clear();
    for (int k = 0; k <= degree; ++k) steps_.push_back(static_cast<double>(k) / degree);
    // Places between the nodes, in the first and the middle interval.
    const int middle = degree / 2;
    between_ = degree == 1 ? std::vector<double>{0.5} : std::vector<double>{0.5 / degree, (middle + 0.5) / degree};
    std::vector<Vector2d> places;
    for (const double y : between_)
      for (const double x : between_) places.emplace_back(x, y);
    at_nodes_ = mesh::lattice_table(square, degree, mesh::lattice(square, degree));
    between_nodes_ = mesh::lattice_table(square, degree, std::move(places));
  }

  static std::pair<int, int> key(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  const FaceSurface& surface(int face) const { return surfaces_[face - 1]; }

  /// Puts the corners of cells onto the part: corners inside faces onto the face, others onto an edge.
  void place_corners() {
    corners_ = quads_.points;
    std::vector<bool> is_placed(corners_.size(), false);
    for (const Quads::Line& line : quads_.lines)
      for (const int end : line.ends) {
        if (is_placed[end]) continue;
        const EdgeCurve& curve = curves_.at(line.edge);
        corners_[end] = curve.at(curve.nearest(corners_[end]));
        is_placed[end] = true;
      }
    for (const Quads::Cell& cell : quads_.cells)
      for (const int corner : cell.corners) {
        if (is_placed[corner]) continue;
        corners_[corner] = surface(cell.face).nearest(corners_[corner]).position;
        is_placed[corner] = true;
      }
  }

  /// Parameters of a corner on a face.
  const Vector2d& parameters(int face, int corner) {
    const auto [found, is_new] = parameters_.try_emplace({face, corner});
    if (is_new) found->second = surface(face).nearest(corners_[corner]).parameters;
    return found->second;
  }

  /// Parameters near a place of a cell, between those of its corners.
  struct Guess {
    std::array<Vector2d, 4> corners;
    Vector2d operator()(double x, double y) const {
      return (1 - x) * (1 - y) * corners[0] + x * (1 - y) * corners[1] + (1 - x) * y * corners[2] + x * y * corners[3];
    }
  };
  Guess guess_in(const std::array<int, 4>& corners, int face) {
    Guess guess{{parameters(face, corners[0])}};
    for (int k = 1; k < 4; ++k)
      guess.corners[k] = surface(face).continued(parameters(face, corners[k]), guess.corners[0]);
    return guess;
  }

  /// Nodes from a to b: on an edge of the part at equal steps of its parameter, elsewhere below the straight line.
  std::vector<std::int32_t> side_nodes(int a, int b, int face, SampledMesh& mesh) {
    const auto [low, high] = key(a, b);
    auto [found, is_new] = sides_.try_emplace({low, high});
    std::vector<int>& inner = found->second;
    if (is_new) {
      const auto line = lines_.find({low, high});
      for (int k = 1; k < mesh.degree; ++k) {
        const double s = steps_[k];
        Vector3d at;
        if (line != lines_.end()) {
          const EdgeCurve& curve = curves_.at(line->second->edge);
          const auto t = curve.ends(corners_[low], corners_[high]);
          at = curve.at((1 - s) * t[0] + s * t[1]);
        } else {
          const Vector2d from = parameters(face, low), to = surface(face).continued(parameters(face, high), from);
          at = surface(face).nearest((1 - s) * corners_[low] + s * corners_[high], (1 - s) * from + s * to).position;
        }
        inner.push_back(static_cast<int>(mesh.surface.nodes.size()));
        mesh.surface.nodes.push_back(at);
      }
    }
    std::vector<std::int32_t> nodes{low};
    nodes.insert(nodes.end(), inner.begin(), inner.end());
    nodes.push_back(high);
    if (a != low) std::ranges::reverse(nodes);
    return nodes;
  }

  /// Corners in the order (0,0), (1,0), (0,1), (1,1) with a_1 x a_2 on the side of the face's normal.
  std::array<int, 4> ordered(const Quads::Cell& cell) {
    const auto& [a, b, c, d] = cell.corners;
    const Vector3d middle = (corners_[a] + corners_[b] + corners_[c] + corners_[d]) / 4;
    const Vector3d drawn = (corners_[c] - corners_[a]).cross(corners_[d] - corners_[b]);
    const Vector2d guess = guess_in({a, b, d, c}, cell.face)(0.5, 0.5);
    const bool agrees = drawn.dot(surface(cell.face).normal(middle, guess, corners_[a])) > 0;
    return agrees ? std::array{a, b, d, c} : std::array{a, d, b, c};
  }

  void add_cell(const Quads::Cell& cell, SampledMesh& mesh) {
    const int q = mesh.degree, row = q + 1;
    const std::array<int, 4> corners = ordered(cell);
    topology::SurfaceCell sampled{
        .nodes = std::vector<std::int32_t>(static_cast<std::size_t>(row * row), -1), .order = q, .region = cell.face};
    const auto left = side_nodes(corners[0], corners[2], cell.face, mesh);
    const auto right = side_nodes(corners[1], corners[3], cell.face, mesh);
    const auto bottom = side_nodes(corners[0], corners[1], cell.face, mesh);
    const auto top = side_nodes(corners[2], corners[3], cell.face, mesh);
    for (int k = 0; k <= q; ++k) {
      sampled.nodes[k * row] = left[k];
      sampled.nodes[k * row + q] = right[k];
      sampled.nodes[k] = bottom[k];
      sampled.nodes[q * row + k] = top[k];
    }
    const auto at = [&](int node) -> const Vector3d& { return mesh.surface.nodes[node]; };
    const Guess guess = guess_in(corners, cell.face);
    for (int j = 1; j < q; ++j)
      for (int i = 1; i < q; ++i) {
        const double x = steps_[i], y = steps_[j];
        const Vector3d blended = (1 - x) * at(left[j]) + x * at(right[j]) + (1 - y) * at(bottom[i]) + y * at(top[i]) -
                                 ((1 - x) * (1 - y) * at(corners[0]) + x * (1 - y) * at(corners[1]) +
                                  (1 - x) * y * at(corners[2]) + x * y * at(corners[3]));
        sampled.nodes[j * row + i] = static_cast<int>(mesh.surface.nodes.size());
        mesh.surface.nodes.push_back(surface(cell.face).nearest(blended, guess(x, y)).position);
      }
    const Vector3d middle = (at(corners[0]) + at(corners[1]) + at(corners[2]) + at(corners[3])) / 4;
    for (int j = 0; j <= q; ++j)
      for (int i = 0; i <= q; ++i)
        sampled.normals.push_back(
            surface(cell.face).normal(at(sampled.nodes[j * row + i]), guess(steps_[i], steps_[j]), middle));
    measure_shape(sampled, mesh);
    measure_error(sampled, guess, mesh);
    mesh.surface.cells.push_back(std::move(sampled));
  }

  void measure_line(const SampledLine& line, SampledMesh& mesh) const {
    const EdgeCurve& curve = curves_.at(line.edge);
    for (const double s : between_) {
      const auto values = mesh::lagrange(steps_, s).value;
      Vector3d at = Vector3d::Zero();
      for (Eigen::Index k = 0; k < values.size(); ++k) at += values[k] * mesh.surface.nodes[line.nodes[k]];
      mesh.error.distance = std::max(mesh.error.distance, (curve.at(curve.nearest(at)) - at).norm());
    }
  }

  /// Finds the worst shape at the nodes of a cell.
  void measure_shape(const topology::SurfaceCell& cell, SampledMesh& mesh) const {
    const auto [worst, place] = shape_of(at_nodes_, mesh.surface, cell);
    if (worst < mesh.worst_shape) {
      mesh.worst_shape = worst;
      mesh.worst_place = place;
    }
    if (worst >= fair_shape) return;
    const auto corners = topology::corner_nodes(mesh::Shape::quadrilateral, cell);
    const auto at = [&](int k) -> const Vector3d& { return mesh.surface.nodes[corners[k]]; };
    const double shortest =
        std::min({(at(1) - at(0)).norm(), (at(3) - at(2)).norm(), (at(2) - at(0)).norm(), (at(3) - at(1)).norm()});
    mesh.bad.push_back({worst, {(at(0) + at(1) + at(2) + at(3)) / 4, 0.7 * shortest}});
  }

  /// Compares a cell with its face between its nodes.
  void measure_error(const topology::SurfaceCell& cell, const Guess& guess, SampledMesh& mesh) const {
    const topology::PatchPoints points = topology::patch_points(between_nodes_, mesh.surface, cell);
    for (Eigen::Index p = 0; p < points.phi.rows(); ++p) {
      Vector3d normal = Vector3d::Zero();
      for (std::size_t n = 0; n < cell.normals.size(); ++n)
        normal += between_nodes_.value(p, static_cast<Eigen::Index>(n)) * cell.normals[n];
      const Vector3d at = points.phi.row(p);
      const Vector2d& xi = between_nodes_.xi[static_cast<std::size_t>(p)];
      const FacePoint there = surface(cell.region).nearest(at, guess(xi[0], xi[1]));
      mesh.error.distance = std::max(mesh.error.distance, (there.position - at).norm());
      if (there.normal)
        mesh.error.direction = std::max(mesh.error.direction, topology::angle_between(normal, *there.normal));
    }
  }

  const Quads& quads_;
  std::vector<FaceSurface> surfaces_{};
  std::map<int, EdgeCurve> curves_{};                          // by edge
  std::map<std::pair<int, int>, const Quads::Line*> lines_{};  // by ends, ascending
  std::vector<Vector3d> corners_{};
  std::map<std::pair<int, int>, Vector2d> parameters_{};  // by face and corner
  std::vector<double> steps_{}, between_{};               // on [0, 1]: nodes of a line, and places between them
  mesh::LatticeTable at_nodes_{}, between_nodes_{};
  std::map<std::pair<int, int>, std::vector<int>> sides_{};  // inner nodes from the lower end to the higher one
};

}  // namespace

std::pair<double, Vector3d> worst_shape(const SampledMesh& sampled) {
  constexpr auto square = mesh::Shape::quadrilateral;
  const mesh::LatticeTable at_nodes =
      mesh::lattice_table(square, sampled.degree, mesh::lattice(square, sampled.degree));
  std::pair<double, Vector3d> worst{1, Vector3d::Zero()};
  for (const topology::SurfaceCell& cell : sampled.surface.cells)
    if (const auto own = shape_of(at_nodes, sampled.surface, cell); own.first < worst.first) worst = own;
  return worst;
}

SampledMesh sampled_coarsely(const JoinedPart& part, const Quads& quads) { return Sampler(part, quads)(2); }

SampledMesh sampled(const JoinedPart& part, const Quads& quads, double diagonal) {
  constexpr double negligible_direction = 1e-7, negligible_distance = 1e-9, most_nodes = 5e5;
  Sampler sampler(part, quads);
  SampledMesh mesh;
  for (const int degree : {1, 2, 4, 6, 8}) {
    if (degree > 2 && static_cast<double>(quads.cells.size()) * degree * degree > most_nodes) break;
    SampledMesh next = sampler(degree);
    // Near tips and tangent edges a higher degree may fold what a lower one does not.
    constexpr double unfolded = -1e-6;
    if (degree > 2 && next.worst_shape < std::min(unfolded, mesh.worst_shape)) break;
    mesh = std::move(next);
    if (mesh.error.direction <= negligible_direction && mesh.error.distance <= negligible_distance * diagonal) break;
  }
  return mesh;
}

}  // namespace plastron::cad
