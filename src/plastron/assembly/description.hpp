// Data of a discrete shell that do not depend on the mesh, as plain values.
#pragma once
#include <plastron/assembly/supports.hpp>
#include <plastron/element/formulation.hpp>
#include <plastron/energy/cross_sections.hpp>
#include <plastron/energy/foundation.hpp>
#include <plastron/energy/loads.hpp>
#include <plastron/obstacle/gap.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <optional>
#include <vector>

namespace plastron::assembly {

using geometry::Vector3d;

struct State;

/// The obstacles of a shell.
struct RigidObstacles {
  std::vector<obstacle::Obstacle> all{};  ///< obstacles at the positions where their gaps are linearised
  std::vector<Vector3d> moved{};          ///< displacement of each by its force since then; empty: zero [m]
  double face_scale = 1;    ///< faces lie at this multiple of e/2; not 1 in studies that vary the stiffness alone
  bool are_linear = false;  ///< gaps are linear: (M16) at the undeformed shell, in every state

  bool empty() const { return all.empty(); }
  /// Returns the obstacle that has a bed: at most one.
  std::optional<std::size_t> on_bed() const {
    const auto found = std::ranges::find_if(all, &obstacle::Obstacle::has_bed);
    return found == all.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - all.begin()));
  }
  /// Whether the stiffness of a bed depends on its closure.
  bool has_segments() const {
    return std::ranges::any_of(all, [](const obstacle::Obstacle& o) { return o.bed.has_segments(); });
  }
  Vector3d way(std::size_t k) const { return moved.empty() ? Vector3d(0, 0, 0) : moved[k]; }
  /// Returns the gap (M16) against obstacle k, with the normals of the linearisation.
  obstacle::Gap gap(std::size_t k, obstacle::ShellPoint at) const {
    at.thickness *= face_scale;
    obstacle::Gap gap = obstacle::gap_at(all[k], at);
    gap.initial -= gap.normal.dot(way(k));
    return gap;
  }
  /// The same at a node with this reach.
  obstacle::Gap gap(std::size_t k, obstacle::ShellPoint at, const obstacle::Reach& reach) const {
    at.thickness *= face_scale;
    obstacle::Gap gap = obstacle::gap_at(all[k], at, reach);
    gap.initial -= gap.normal.dot(way(k));
    return gap;
  }
  /// Returns the gap between the shell at `at` and obstacle k, whose present position is `now`. It is linearised only
  /// if the gaps are linear, as with planes.
  obstacle::FaceGap true_gap(std::size_t k, const obstacle::Obstacle& now, obstacle::ShellPoint at) const {
    if (are_linear) {
      obstacle::ShellPoint undeformed = at;
      undeformed.u = undeformed.r = Vector3d::Zero();
      const obstacle::Gap linear = gap(k, undeformed);
      const double distance = linear(at.u, at.r);
      return {.z = linear.z, .distance = distance, .normal = linear.normal, .clearance = distance};
    }
    at.thickness *= face_scale;
    return obstacle::face_gap(now, at);
  }
  /// Prepares `body`, one of the obstacles at some position, for the gaps at the points point(0), ..., point(count - 1).
  template <class Point>
  void prepare_gaps(const obstacle::Obstacle& body, std::size_t count, const Point& point) const {
    if (!body.is_searched()) return;
    std::vector<obstacle::ShellPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
      points.push_back(point(i));
      points.back().thickness *= face_scale;
    }
    obstacle::prepare_gaps(body, points);
  }
  /// Returns obstacle k at its present position.
  obstacle::Obstacle now(std::size_t k) const {
    obstacle::Obstacle result = all[k];
    result.placement.translation += way(k);
    return result;
  }
  /// Returns the same obstacles at their positions in the state.
  RigidObstacles standing(const State& state) const;
};

/// A shell without its mesh and its charts.
struct ShellDescription {
  energy::CrossSections sections{};  ///< thickness, material and density, by region
  bool tying = true;                 ///< (M22); triangles are never tied
  element::Tangency tangency{};
  element::Rotations rotations = element::Rotations::small;
  bool is_objective = false;  ///< with finite rotations: ShellOperator::interpolate_reference()
  std::vector<Support> supports{};
  energy::Loads loads{};
  std::vector<energy::Foundation> foundations{};
  RigidObstacles obstacles{};
};

}  // namespace plastron::assembly
