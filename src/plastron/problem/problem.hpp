// Plain values that define a computation: geometry, shell, supports, loads, obstacle, discretisation.
#pragma once
#include <plastron/assembly/description.hpp>
#include <plastron/contact/settings.hpp>
#include <plastron/domain/domain.hpp>
#include <plastron/energy/factors.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/fem/shape_field.hpp>
#include <plastron/geometry/chart.hpp>
#include <plastron/geometry/space_function.hpp>
#include <plastron/mesh/reference_cell.hpp>
#include <plastron/problem/unit_names.hpp>

#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plastron::problem {

enum class Layers {
  none,      ///< the domain's own coarsest mesh
  automatic  ///< with rows of thin cells along the edges, see start_mesh.hpp
};

struct Discretisation {
  mesh::Shape cells = mesh::Shape::quadrilateral;
  int degree = 2;  ///< k, 1 to 8; 1 or 2 on triangles
  Layers layers = Layers::none;
  int refinements = 3;  ///< uniform refinements of the coarsest mesh; every level is solved
};

/// Required accuracy, instead of a number of refinements: meshes are refined until estimated errors are below
/// tolerances.
struct Accuracy {
  struct Goal {
    std::string name;      ///< one of goal_names()
    double tolerance = 0;  ///< relative tolerance of the error
  };
  std::vector<Goal> goals{};
  double max_unknowns = 2e6;
  double max_seconds = std::numeric_limits<double>::infinity();
  bool is_uniform = false;  ///< all cells are divided, for comparison
};

/// Settings for the gaps of curved obstacles (M16) that are linearised again at the deformed shell.
struct Linearisation {
  int max_steps = 50;  ///< largest number of steps on one mesh
  double tolerance =
      /// Limit of the distance between faces in contact and their points of linearisation, relative to the largest
      /// displacement.
      1e-8;
};

/// A point of Omega where the results are wanted.
struct Probe {
  std::string name;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector3d> in_space{};  ///< if given, `at` is the nearest point: locate_points() sets it [m]
};

/// Numbers of modes to compute about the last solution, with contact held.
struct Modes {
  int buckling = 0;
  int vibration = 0;
};

/// Loads that follow a displacement: their factor is sought with which u . direction of a probe changes in equal parts.
struct Control {
  std::string probe{};
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit vector
  double to = 0;                                         ///< value at the step's end [m]
  std::string load{};                                    ///< name of the loads that follow; empty: all without a factor
  int factor = -1;                                       ///< its place in Problem::factor_names
};

/// A step. Loads, prescribed components, forces on obstacles and their motions change from their values after the previous step to the values
/// at its end.
struct Step {
  std::string name{};
  energy::Factors factors = energy::Factors();  ///< at the step's end; the time has no meaning
  std::optional<Control> control{};             ///< if given, the factor of the loads has no meaning
  int parts = 1;                                ///< number of equal parts; each is solved
  bool chooses_parts = false;                   ///< parts are chosen by how the iteration goes (step_control.hpp)
  static constexpr double longest_chosen_part = 0.25;
};

/// Points of Omega along which results are written as a table.
struct Line {
  std::string name;
  std::vector<Eigen::Vector2d> points{};
  std::vector<Eigen::Vector3d>
      in_space{};  ///< if given, `points` are the nearest points: locate_points() sets them [m]
};

/// A difference of the stress-free mid-surface from its charts or its mesh. Exactly one of the three is given.
struct Imperfection {
  std::shared_ptr<const geometry::SpaceFunction> normal{};  ///< displacement along a_3, on a mesh in space [m]
  std::array<std::shared_ptr<const geometry::SpaceFunction>, 3> displacement{};  ///< on a mesh in space [m]
  std::string mode_file{};                         ///< path of a mode, which `shift` is read from
  double amplitude = 0;                            ///< largest displacement by the mode [m]
  std::shared_ptr<const fem::ShapeField> shift{};  ///< the mode, multiplied by the amplitude
};

/// Form of the results.
/// Load cases whose numbers and fields are compared.
struct Envelope {
  std::string name;
  std::vector<std::string> cases{};
};

struct Output {
  std::optional<Eigen::Vector3d> axis{};  ///< direction that t1 follows, projected on the surface; empty: d phi/dx
  bool smooth = true;                     ///< recovered over patches of cells; otherwise in each cell alone
  Eigen::Vector3d moment_point = Eigen::Vector3d::Zero();  ///< reference point of the moments of forces [m]
  std::vector<double> heights{};  ///< z / e of additional stress fields besides faces and middle
  bool double_precision = false;  ///< double precision of the numbers in .vtu files
  int solid_layers = 0;           ///< layers of cells through the thickness in solid.vtu; 0: no such file
  UnitNames units{};              ///< names in texts and files
  std::vector<Envelope> envelopes{};
};

struct Problem {
  domain::Domain domain = domain::Rectangle{};
  std::vector<fem::Join> joins{};                 ///< edges that are joined
  std::vector<fem::RigidBody> rigid_bodies{};     ///< bodies that carry edges
  std::map<std::string, geometry::Chart> charts;  ///< charts by region; the unnamed region is ""
  std::vector<Imperfection> imperfections{};      ///< besides those that are part of the charts
  assembly::ShellDescription shell{};             ///< sections, formulation, supports, loads and obstacles
  std::vector<std::string> factor_names{};  ///< names of loads, supports and temperatures, see energy::Factors::named
  std::vector<Step> steps{};                ///< obstacles have a motion for each, or none; without steps nothing moves
  bool steps_are_cases = false;             ///< each step is a load case, which starts from the undeformed shell
  std::vector<Probe> probes{};
  std::vector<Line> lines{};
  Discretisation discretisation{};
  std::optional<Accuracy> accuracy{};
  contact::Settings contact{};
  Linearisation linearisation{};
  Output output{};
  Modes modes{};
  bool checks_model = true;  ///< small rotations: the solution is compared with the model of finite rotations
  bool admissible = false;   ///< bounds of gaps are lifted until the shell is outside the obstacles also between nodes
};

/// Sets the points of Omega of probes, lines and supports that are given in space: the nearest points of the mid-surface,
/// and for supports the nearest nodes that every mesh keeps. Throws mesh::DomainError of the mesh.
void locate_points(Problem& problem);

}  // namespace plastron::problem
