// All that defines a computation: geometry, shell, supports, loads, obstacle, discretisation. Plain values.
#pragma once
#include <plastron/assembly/cross_sections.hpp>
#include <plastron/assembly/loads.hpp>
#include <plastron/assembly/supports.hpp>
#include <plastron/computation/unit_names.hpp>
#include <plastron/contact/settings.hpp>
#include <plastron/element/formulation.hpp>
#include <plastron/fem/domain.hpp>
#include <plastron/fem/join.hpp>
#include <plastron/fem/reference_cell.hpp>
#include <plastron/fem/rigid_bodies.hpp>
#include <plastron/geometry/chart.hpp>
#include <plastron/obstacle/gap.hpp>

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plastron::computation {

enum class Layers {
  none,      ///< the domain's own coarsest mesh
  automatic  ///< with rows of thin cells along the edges, see start_mesh.hpp
};

struct Discretisation {
  fem::Shape cells = fem::Shape::quadrilateral;
  int degree = 2;     ///< k, 1 to 8; 1 or 2 on triangles
  bool tying = true;  ///< (M22); triangles are never tied
  element::Tangency tangency{};
  Layers layers = Layers::none;
  int refinements = 3;  ///< uniform refinements of the coarsest mesh; every level is solved
};

/// What is to be accurate, in place of a number of refinements: meshes are refined until estimated errors are below tolerances.
struct Accuracy {
  struct Goal {
    std::string name;      ///< of goal_names()
    double tolerance = 0;  ///< of the error, relative
  };
  std::vector<Goal> goals{};
  double max_unknowns = 2e6;
  double max_seconds = std::numeric_limits<double>::infinity();
  bool is_uniform = false;  ///< all cells are divided, for comparison
};

/// How the gaps of curved obstacles are met (M16).
struct Linearisation {
  bool once = false;   ///< at the undeformed shell, and not again at the deformed one
  int max_steps = 50;  ///< on one mesh
  double tolerance =
      1e-8;  ///< between faces in contact and where their gaps are linearised, over the largest displacement
};

/// A point of Omega where the results are wanted.
struct Probe {
  std::string name;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
};

/// Loads, forces on obstacles and their motions go from where the step before has left them to what they are at this one's end.
struct Step {
  std::string name{};
  double load_factor = 1;               ///< of all loads at the step's end
  int parts = 1;                        ///< equal, each of them solved
  std::vector<double> force_factors{};  ///< of the forces on obstacles, one by one, at the step's end; empty: 1
};

/// Points of Omega along which results are written as a table.
struct Line {
  std::string name;
  std::vector<Eigen::Vector2d> points{};
};

/// How results are given.
struct Output {
  std::optional<Eigen::Vector3d> axis{};  ///< that t1 follows, projected on the surface; empty: d phi/dx
  bool smooth = true;                     ///< recovered over patches of cells; else of each cell alone
  Eigen::Vector3d moment_point = Eigen::Vector3d::Zero();  ///< that moments of forces are about [m]
  std::vector<double> heights{};  ///< z / e, at which fields have stresses besides faces and middle
  bool double_precision = false;  ///< of the numbers in .vtu files
  int solid_layers = 0;           ///< of cells through the thickness in solid.vtu; 0: no such file
  UnitNames units{};              ///< as texts and files call them
};

struct Problem {
  fem::Domain domain = fem::Rectangle{};
  std::vector<fem::Join> joins{};                 ///< edges that are joined
  std::vector<fem::RigidBody> rigid_bodies{};     ///< that carry edges
  std::map<std::string, geometry::Chart> charts;  ///< by region; the unnamed region is ""
  assembly::CrossSections sections{};             ///< thickness, material and density, by region
  std::vector<assembly::Support> supports{};
  std::vector<assembly::AreaLoad> area_loads{};
  std::vector<assembly::EdgeLoad> edge_loads{};
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< acceleration g that makes the weight of the density [m/s^2]
  std::vector<obstacle::Obstacle> obstacles{};
  std::vector<Step> steps{};  ///< obstacles have a motion for each, or none; without steps all is where it is
  std::vector<Probe> probes{};
  std::vector<Line> lines{};
  Discretisation discretisation{};
  std::optional<Accuracy> accuracy{};
  contact::Settings contact{};
  Linearisation linearisation{};
  Output output{};
  bool admissible = false;  ///< bounds of gaps are lifted until the shell is out of obstacles between nodes, too
  double face_scale = 1;  ///< faces lie at this multiple of e/2; other than 1 in studies that vary the stiffness alone
};

}  // namespace plastron::computation
