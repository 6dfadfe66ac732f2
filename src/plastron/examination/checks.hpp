// The checks of an examination and their common data: a sample mesh on every rank, and the expressions of the case.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/element/element_tables.hpp>
#include <plastron/examination/examine.hpp>
#include <plastron/fem/surface.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plastron::examination {

/// A problem under examination: its sample mesh, and the findings so far.
struct Examined {
  /// Makes the sample mesh. Throws mesh::DomainError.
  explicit Examined(const problem::Problem& problem);

  template <class... Args>
  void add(Severity severity, fmt::format_string<Args...> text, Args&&... args) {
    findings.push_back({severity, fmt::format(text, std::forward<Args>(args)...)});
  }

  /// Returns "x = ..., y = ..." for a point of Omega, without rounding.
  std::string place(const Eigen::Vector2d& x) const;

  const problem::Problem& problem;
  std::shared_ptr<const fem::Space> space;  ///< some hundred cells, all on this rank
  std::shared_ptr<const fem::Surface> surface;
  element::ElementTables tables;
  std::vector<Finding> findings;
  // Known after check_chart:
  double size = 0;              ///< half the diagonal of the box around the mid-surface [m]
  bool is_developable = false;  ///< no Gaussian curvature at any sample point
  // Known after check_surface_mesh:
  std::map<std::string, double> symmetry_accuracy{};  ///< domain::FileSurface
};

/// The nodes of the sample mesh with their supports and gaps.
struct ExaminedNodes {
  /// Computes the supports and gaps, with the supports that these factors do not release. Throws assembly::SupportError.
  explicit ExaminedNodes(const Examined& examined, const energy::Factors& factors = {});

  std::vector<assembly::NodalPoint> points;
  assembly::NodalCoordinates coordinates;
};

/// Returns "the obstacle", or the name of one of several.
std::string obstacle_text(const problem::Problem& problem, std::size_t obstacle);

/// Returns (x, y, z) for the user, without parts that are negligible against `size` or the vector itself.
std::string vector_text(Eigen::Vector3d v, double size = 0);

/// Returns the angle between two unit vectors whose difference has this length.
double degrees_between(double unit_difference);

/// An expression of a load or support, with its name in messages.
struct NamedExpression {
  std::string name{};  ///< "the z component of a load's force, "1/x","
  geometry::Expression f{};
  std::string boundary{};                  ///< boundary where it acts; empty: in the domain
  std::vector<std::string> regions{};      ///< regions of the domain; empty: in all of it
  std::optional<Eigen::Vector2d> point{};  ///< the only point where it acts

  /// Whether it acts inside the cells of a region.
  bool acts_in(const std::string& region) const {
    return regions.empty() || std::ranges::find(regions, region) != regions.end();
  }
};

/// Returns the expressions of supports that are not constant or not finite. The same holds for `load_expressions`.
std::vector<NamedExpression> support_expressions(const problem::Problem& problem);
std::vector<NamedExpression> load_expressions(const problem::Problem& problem);

/// Returns an expression for a message: in quotes, shortened if it is long.
std::string quoted(const geometry::Expression& f);

/// Checks that the mesh has the boundaries, regions and nodes that supports, loads and cross-sections name.
void check_names(Examined& examined);
/// Checks that the chart is regular, the thickness positive, and thin against the curvature. Other checks rely on it.
void check_chart(Examined& examined);
/// Checks that the charts of two regions meet with one normal.
void check_normals(Examined& examined);
/// Reports what a mesh in space consists of, and what is doubtful in it.
void check_surface_mesh(Examined& examined);
/// Checks that no edges coincide without being joined.
void check_seams(Examined& examined);
/// Checks that loads and prescribed values are finite.
void check_finite(Examined& examined);
/// Checks that chart and thickness are smooth inside each cell; names loads that are not.
void check_inside_cells(Examined& examined);
/// Warns of moduli and densities that no material has in the units of the case.
void check_materials(Examined& examined);
/// Warns of a density without use.
void check_weight(Examined& examined);
/// Checks that elements do not lock.
void check_locking(Examined& examined);
/// Checks that one director describes laminates with soft layers.
void check_soft_layers(Examined& examined);
/// Checks that double precision is sufficient for such a thin shell on the finest mesh.
void check_precision(Examined& examined);
/// Returns the relative effect of rounding on forces and energy where a shell bends: the order of magnitude.
double rounding_residual(const problem::Problem& problem);
/// Reports the rows of cells of the first mesh to the user.
void check_start_mesh(Examined& examined);
/// Checks that probes and lines are in the domain.
void check_lines(Examined& examined);
void check_probes(Examined& examined);
/// Checks that a symmetry edge is in one plane that the shell meets at a right angle. Throws assembly::SupportError.
void check_symmetry(Examined& examined);
/// Checks that supports of all of r prescribe directors of length 1, with finite rotations. Throws assembly::SupportError.
void check_directors(Examined& examined);
/// Checks that chart and supports satisfy the requirements of the formulation.
void check_formulation(Examined& examined, const ExaminedNodes& nodes);
/// Checks the initial gap against one obstacle, and that no support fixes the shell inside it.
void check_gap(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle);
/// Checks that no cell is pushed out of an obstacle to opposite sides.
void check_sides(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle);
/// Checks that obstacles' surfaces are the same as in their files.
void check_surfaces(Examined& examined);
/// Checks that the face that will touch an obstacle is the near one.
void check_face(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle);
/// Checks that two obstacles leave the thickness of the shell free between them.
void check_room(Examined& examined, const ExaminedNodes& nodes);
/// Distances to other shapes need a search, which takes too long for thousands of points.
bool has_fast_distance(const obstacle::Obstacle& obstacle);
/// Checks that no rigid motion is free, except motions that the loads press onto the obstacle.
void check_rigid_motions(Examined& examined, const ExaminedNodes& nodes);

}  // namespace plastron::examination
