// The checks of an examination, one a file, and what they share: a sample mesh that every rank has for itself.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/element/element_tables.hpp>
#include <plastron/examination/examine.hpp>
#include <plastron/fem/surface.hpp>

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace plastron::examination {

/// A problem under examination: its sample mesh, and what the checks found so far.
struct Examined {
  /// Throws fem::DomainError.
  explicit Examined(const computation::Problem& problem);

  template <class... Args>
  void add(Severity severity, fmt::format_string<Args...> text, Args&&... args) {
    findings.push_back({severity, fmt::format(text, std::forward<Args>(args)...)});
  }

  /// "x = ..., y = ..." for a point of Omega, rounding cleared away.
  std::string place(const Eigen::Vector2d& x) const;

  const computation::Problem& problem;
  std::shared_ptr<const fem::Space> space;  ///< of some hundred cells, all on this rank
  std::shared_ptr<const fem::Surface> surface;
  element::ElementTables tables;
  std::vector<Finding> findings;
  // Known once check_chart is through:
  double size = 0;              ///< half the diagonal of the box that holds the mid-surface [m]
  bool is_developable = false;  ///< no Gaussian curvature at any sample point
};

/// The nodes of the sample mesh with their supports and gaps.
struct ExaminedNodes {
  /// Throws assembly::SupportError.
  explicit ExaminedNodes(const Examined& examined);

  std::vector<assembly::NodalPoint> points;
  assembly::NodalCoordinates coordinates;
};

/// "the obstacle", or which of several.
std::string obstacle_text(const computation::Problem& problem, std::size_t obstacle);

/// (x, y, z) for the user, without what is negligible beside `size` or the vector itself.
std::string vector_text(Eigen::Vector3d v, double size = 0);

/// The angle between two unit vectors whose difference is that long.
double degrees_between(double unit_difference);

/// The mesh has the boundaries, regions and nodes that supports, loads and cross-sections name.
void check_names(Examined& examined);
/// The chart is regular, the thickness positive, and thin against the curvature. Others rely on it.
void check_chart(Examined& examined);
/// The charts of two regions meet with one normal.
void check_normals(Examined& examined);
/// No edges lie on each other without being joined.
void check_seams(Examined& examined);
/// Loads and prescribed values are finite.
void check_finite(Examined& examined);
/// Chart and thickness are smooth inside of each cell; loads that are not are named.
void check_inside_cells(Examined& examined);
/// Elements do not lock.
void check_locking(Examined& examined);
/// Double precision is enough for so thin a shell on the finest mesh.
void check_precision(Examined& examined);
/// What rounding spoils of forces and energy where a shell bends, relative: the order of magnitude.
double rounding_residual(const computation::Problem& problem);
/// What rows of cells the mesh begins with, for the user to know.
void check_start_mesh(Examined& examined);
/// Probes lie in the domain.
void check_lines(Examined& examined);
void check_probes(Examined& examined);
/// A symmetry edge lies in one plane that the shell meets at a right angle. Throws assembly::SupportError.
void check_symmetry(Examined& examined);
/// The formulation has what it asks of chart and supports.
void check_formulation(Examined& examined, const ExaminedNodes& nodes);
/// The initial gap against one obstacle, and no support that holds the shell inside of it.
void check_gap(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle);
/// No cell is pushed out of an obstacle to opposite sides.
void check_sides(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle);
/// Obstacles' surfaces are as their files have them.
void check_surfaces(Examined& examined);
/// The face that is to touch an obstacle is the near one.
void check_face(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle);
/// No rigid motion is left free but those that the loads press on the obstacle.
void check_rigid_motions(Examined& examined, const ExaminedNodes& nodes);

}  // namespace plastron::examination
