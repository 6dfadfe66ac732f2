#include "mid_surface.hpp"

#include "face_surface.hpp"

#include <BRepClass3d_SolidClassifier.hxx>
#include <TopoDS_Shape.hxx>

#include <fmt/format.h>

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace plastron::cad {

namespace {

/// The middle of a cell of each face must lie in a solid.
void check_inside(const PartFile& part, const JoinedPart& joined, const SampledMesh& mesh) {
  std::set<int> seen;
  for (const topology::SurfaceCell& cell : mesh.surface.cells) {
    const LabelledFace& face = joined.labelled[static_cast<std::size_t>(cell.region) - 1];
    if (face.thickness == 0 || !seen.insert(cell.region).second) continue;
    Vector3d middle = Vector3d::Zero();
    for (const int corner : topology::corner_nodes(mesh::Shape::quadrilateral, cell))
      middle += mesh.surface.nodes[corner] / 4;
    const bool is_inside = std::ranges::any_of(part.solids, [&](const TopoDS_Shape& solid) {
      return BRepClass3d_SolidClassifier(solid, point_of(middle), 1e-9).State() == TopAbs_IN;
    });
    if (!is_inside)
      throw PartError(fmt::format(
          "the middle of the sheet at face {}, near ({:.6g}, {:.6g}, {:.6g}) mm, is outside of the solid, which is "
          "damaged or turned inside out; choose the faces of the shell: faces = [...]",
          face.number, middle[0], middle[1], middle[2]));
  }
}

/// A face of a node, and how far the node shall move against its normal.
struct Condition {
  Vector3d normal;
  double distance;
};

/// The shortest move that meets all conditions.
Vector3d least_move(const std::vector<Condition>& conditions) {
  if (conditions.empty()) return Vector3d::Zero();
  Eigen::MatrixX3d normals(static_cast<Eigen::Index>(conditions.size()), 3);
  Eigen::VectorXd distances(normals.rows());
  for (Eigen::Index k = 0; k < normals.rows(); ++k) {
    normals.row(k) = conditions[static_cast<std::size_t>(k)].normal;
    distances[k] = -conditions[static_cast<std::size_t>(k)].distance;
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(normals, Eigen::ComputeThinU | Eigen::ComputeThinV);
  constexpr double parallel = 1e-3;
  svd.setThreshold(parallel);
  return svd.solve(distances);
}

/// Nodes where faces meet also move along these faces. Spreads this part of the moves over the cells there: linearly along their other
/// sides, and from the sides to the inside (Coons).
void spread_moves(const JoinedPart& joined, const SampledMesh& mesh, std::vector<Vector3d>& moves) {
  const int q = mesh.degree, row = q + 1;
  if (q == 1) return;
  const auto each_cell = [&](const auto& visit) {
    for (const topology::SurfaceCell& cell : mesh.surface.cells) {
      const double to_middle = joined.labelled[static_cast<std::size_t>(cell.region) - 1].to_middle;
      // The part of a move along the face.
      const auto along = [&](int i, int j) -> Vector3d {
        const auto k = static_cast<std::size_t>(j * row + i);
        return moves[static_cast<std::size_t>(cell.nodes[k])] + to_middle * cell.normals[k];
      };
      const auto set = [&](int i, int j, const Vector3d& value) {
        const auto k = static_cast<std::size_t>(j * row + i);
        moves[static_cast<std::size_t>(cell.nodes[k])] = value - to_middle * cell.normals[k];
      };
      visit(along, set);
    }
  };
  each_cell([&](const auto& along, const auto& set) {
    for (int side = 0; side < 4; ++side) {
      const auto place = [&](int k) {
        return side < 2 ? std::pair(k, side == 0 ? 0 : q) : std::pair(side == 2 ? 0 : q, k);
      };
      const auto at = [&](int k) { return along(place(k).first, place(k).second); };
      const double size = at(0).norm() + at(q).norm();
      constexpr double negligible = 1e-6;
      bool stays = size > 0;
      for (int k = 1; k < q; ++k) stays = stays && at(k).norm() < negligible * size;
      if (!stays) continue;
      const Vector3d from = at(0), to = at(q);
      for (int k = 1; k < q; ++k) set(place(k).first, place(k).second, from + (to - from) * k / q);
    }
  });
  each_cell([&](const auto& along, const auto& set) {
    for (int j = 1; j < q; ++j)
      for (int i = 1; i < q; ++i) {
        const double x = static_cast<double>(i) / q, y = static_cast<double>(j) / q;
        set(i, j,
            (1 - x) * along(0, j) + x * along(q, j) + (1 - y) * along(i, 0) + y * along(i, q) -
                ((1 - x) * (1 - y) * along(0, 0) + x * (1 - y) * along(q, 0) + (1 - x) * y * along(0, q) +
                 x * y * along(q, q)));
      }
  });
}

/// Does the same where cells are smaller than the moves: the part along the faces fades out with the distance from these nodes.
void fade_moves(const JoinedPart& joined, const SampledMesh& mesh, std::vector<Vector3d>& moves) {
  struct Source {
    Vector3d position, along;
  };
  std::vector<Vector3d> ordinary(moves.size(), Vector3d::Zero());
  std::vector<Source> sources;
  for (const topology::SurfaceCell& cell : mesh.surface.cells)
    for (std::size_t k = 0; k < cell.nodes.size(); ++k)
      ordinary[static_cast<std::size_t>(cell.nodes[k])] =
          -joined.labelled[static_cast<std::size_t>(cell.region) - 1].to_middle * cell.normals[k];
  constexpr double negligible = 1e-6, reach = 4;  // relative to the move
  std::vector<bool> is_source(moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const Vector3d along = moves[i] - ordinary[i];
    is_source[i] = along.norm() > negligible * moves[i].norm();
    if (is_source[i]) sources.push_back({mesh.surface.nodes[i], along});
  }
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (is_source[i]) continue;
    double nearest = HUGE_VAL, weights = 0, size = 0;
    Vector3d along = Vector3d::Zero();
    for (const Source& source : sources) {
      const double distance = (source.position - mesh.surface.nodes[i]).norm(), weight = std::pow(distance, -6);
      nearest = std::min(nearest, distance);
      weights += weight;
      along += weight * source.along;
      size += weight * source.along.norm();
    }
    const double t = nearest / (reach * size / weights);
    if (t < 1) moves[i] += (1 - t) * (1 - t) * (1 + 2 * t) * along / weights;
  }
}

/// Nodes that moved along curved faces have left the middle: moves them to the place that has the distance from all faces of its
/// cells, and takes the normals there.
void put_on_middles(const JoinedPart& joined, SampledMesh& mesh, const std::vector<Vector3d>& moves) {
  struct At {
    int face;
    Vector3d* normal;
  };
  std::map<std::int32_t, std::vector<At>> moved;
  std::vector<FaceSurface> surfaces;
  surfaces.reserve(joined.labelled.size());
  for (const LabelledFace& face : joined.labelled) surfaces.emplace_back(face.face);
  constexpr double negligible = 1e-9;
  for (topology::SurfaceCell& cell : mesh.surface.cells)
    for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
      const double to_middle = joined.labelled[static_cast<std::size_t>(cell.region) - 1].to_middle;
      const Vector3d& move = moves[static_cast<std::size_t>(cell.nodes[k])];
      if ((move + to_middle * cell.normals[k]).norm() > negligible * move.norm()) moved[cell.nodes[k]];
    }
  for (topology::SurfaceCell& cell : mesh.surface.cells)
    for (std::size_t k = 0; k < cell.nodes.size(); ++k)
      if (const auto found = moved.find(cell.nodes[k]); found != moved.end())
        found->second.push_back({cell.region - 1, &cell.normals[k]});
  for (auto& [node, places] : moved) {
    Vector3d& position = mesh.surface.nodes[static_cast<std::size_t>(node)];
    constexpr int steps = 6;
    for (int step = 0; step < steps; ++step) {
      std::vector<Condition> conditions;
      conditions.reserve(places.size());
      for (const At& at : places) {
        const FacePoint foot = surfaces[static_cast<std::size_t>(at.face)].nearest(position);
        if (foot.normal) *at.normal = *foot.normal;
        conditions.push_back({*at.normal, joined.labelled[static_cast<std::size_t>(at.face)].to_middle +
                                              at.normal->dot(position - foot.position)});
      }
      const Vector3d change = least_move(conditions);
      position += change;
      if (change.norm() < negligible) break;
    }
  }
}

}  // namespace

void move_to_middle(const PartFile& part, const JoinedPart& joined, SampledMesh& mesh) {
  if (std::ranges::none_of(joined.labelled, [](const LabelledFace& face) { return face.thickness > 0; })) return;
  std::vector<std::vector<Condition>> conditions(mesh.surface.nodes.size());
  constexpr double one_normal = 1e-4;  // normals that differ by less are one
  for (const topology::SurfaceCell& cell : mesh.surface.cells)
    for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
      auto& known = conditions[static_cast<std::size_t>(cell.nodes[k])];
      const Vector3d& n = cell.normals[k];
      if (std::ranges::none_of(known, [&](const Condition& c) { return (c.normal - n).norm() < one_normal; }))
        known.push_back({n, joined.labelled[static_cast<std::size_t>(cell.region) - 1].to_middle});
    }
  std::vector<Vector3d> moves(mesh.surface.nodes.size(), Vector3d::Zero());
  std::ranges::transform(conditions, moves.begin(), least_move);
  const SampledMesh before = mesh;
  const auto move_by = [&](const std::vector<Vector3d>& by) {
    for (std::size_t i = 0; i < by.size(); ++i) mesh.surface.nodes[i] += by[i];
    put_on_middles(joined, mesh, by);
  };
  std::vector<Vector3d> spread = moves;
  spread_moves(joined, mesh, spread);
  move_by(spread);
  if (worst_shape(mesh).first < fair_shape) {
    mesh = before;
    fade_moves(joined, mesh, moves);
    move_by(moves);
  }
  if (const auto [shape, place] = worst_shape(mesh); shape < least_shape)
    throw PartError(fmt::format(
        "a cell folds over when it is moved to the middle of its sheet, at ({:.6g}, {:.6g}, {:.6g}) mm: faces "
        "that meet there are narrower than the sheet is thick, or cells are; choose the faces of the shell: "
        "faces = [...], or give size",
        place[0], place[1], place[2]));
  check_inside(part, joined, mesh);
}

}  // namespace plastron::cad
