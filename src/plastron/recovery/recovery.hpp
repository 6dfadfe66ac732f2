// Results at points: displacement, rotation, gap, reaction, stress resultants in an orthonormal frame of the surface.
#pragma once
#include <plastron/recovery/resultant_patches.hpp>
#include <plastron/shell/section_stress.hpp>

#include <memory>
#include <tuple>
#include <vector>

namespace plastron::recovery {

/// Results at a point. N, M, Q are components in the orthonormal frame (t1, t2) of surface_axes().
struct PointValues {
  Eigen::Vector2d x = Eigen::Vector2d::Zero();  ///< parameters in Omega
  Vector3d phi = Vector3d::Zero();              ///< position on the undeformed mid-surface [m]
  Vector3d t1 = Vector3d::Zero(), t2 = Vector3d::Zero(), a3 = Vector3d::Zero();  ///< orthonormal frame
  /// Principal curvatures, ascending [1/m].
  Eigen::Vector2d curvatures = Eigen::Vector2d::Zero();
  double thickness = 0;                 ///< e [m]
  Vector3d u = Vector3d::Zero();        ///< displacement [m]
  Vector3d r = Vector3d::Zero();        ///< rotation of the normal [rad]
  double gap = 0;                       ///< smallest gap of the touching face to an obstacle [m]; NaN without obstacles
  double pressure = 0;                  ///< eta, the sum of all obstacles [Pa]
  Vector3d carried = Vector3d::Zero();  ///< force of foundations under areas, without shear layers [N/m^2]
  double lambda = 0;                    ///< multiplier of (M14) [N m]
  double touching = 0;                  ///< 1 in contact, 0 free; between 0 and 1 next to the zone's edge
  Eigen::Vector2d face_pressure = Eigen::Vector2d::Zero();   ///< eta on the lower and on the upper face [Pa]
  Eigen::Vector2d face_touching = Eigen::Vector2d::Zero();   ///< `touching` of the lower and of the upper face
  Vector3d N = Vector3d::Zero();                             ///< N_11, N_22, N_12 [N/m]
  Vector3d M = Vector3d::Zero();                             ///< M_11, M_22, M_12 [N]
  Eigen::Vector2d Q = Eigen::Vector2d::Zero();               ///< Q_1, Q_2 [N/m]
  shell::InitialState initial{};                             ///< what strains the section without stress
  shell::Material material{};                                ///< material of the point's region
  std::shared_ptr<const shell::LaminateSection> laminate{};  ///< the laminate in these axes; null if homogeneous
};

/// Returns references to all numbers of a point: all its members but the law of the cross-section.
template <class Point>
auto numbers_of(Point& point) {
  auto& [x, phi, t1, t2, a3, curvatures, thickness, u, r, gap, pressure, carried, lambda, touching, face_pressure,
         face_touching, N, M, Q, initial, material, laminate] = point;
  return std::tie(x, phi, t1, t2, a3, curvatures, thickness, u, r, gap, pressure, carried, lambda, touching,
                  face_pressure, face_touching, N, M, Q, initial.strains, initial.temperature, initial.difference,
                  initial.curvature);
}

/// Sets the law of the cross-section of a point whose axes, thickness and initial state are known.
void set_law(const energy::CrossSection& section, PointValues& point);

/// The forces N, M, Q and the cross-section, which determine the stresses.
inline shell::SectionForces section_forces(const PointValues& point) {
  return {.N = point.N, .M = point.M, .Q = point.Q, .thickness = point.thickness, .laminate = point.laminate};
}

/// Choice of resultants and frames.
struct Choice {
  std::optional<Vector3d> axis{};  ///< direction of t1, see surface_axes()
  /// Patches for smooth resultants. Without them, resultants belong to each cell alone and jump between cells:
  /// polynomials of degree k - 1 through resultant_points().
  std::shared_ptr<const ResultantPatches> patches{};
};

/// Evaluates a solution in cells at fixed points of the reference cell.
class Recovery {
 public:
  Recovery(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
           const std::vector<Eigen::Vector2d>& xi, Choice choice = {});
  std::vector<PointValues> operator()(std::size_t cell) const;

 private:
  std::vector<PointValues> geometry_at_points(std::size_t cell) const;
  void add_nodal_values(std::size_t cell, const element::CellField& field, std::vector<PointValues>& points) const;
  void add_resultants(std::size_t cell, const element::CellField& field, std::vector<PointValues>& points) const;

  const assembly::DiscreteShell& discrete_;
  const NodalSolution& solution_;
  Choice choice_;
  element::BasisAt at_points_;
  ResultantPoints resultant_points_;
  // Maps resultant points to points.
  Eigen::MatrixXd continuation_;
  // Maps nodal reactions to points.
  Eigen::MatrixXd reaction_at_points_;
};

}  // namespace plastron::recovery
