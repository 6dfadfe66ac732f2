// The sections of a case file, one source file for each family: it declares the keys, reads them into the problem and
// notes the effective settings. A reader uses what earlier ones have read, so their order in case.cc matters.
#pragma once
#include <plastron/config/table.hpp>
#include <plastron/problem/problem.hpp>

#include <optional>
#include <string>
#include <vector>

namespace plastron::config {

std::vector<Section> constants_sections();
/// Fills Reading::constants, which all other sections use.
void read_constants(Table& root);

/// Poisson's ratio of isotropic materials.
inline constexpr Range poisson_range{.low = -0.999, .high = 0.5, .high_open = true};

std::vector<Section> material_sections();
/// Fills Reading::materials, which [shell] and [[region]] use.
void read_materials(Table& root);
/// Reports that no material has the name that `material` of the table gives.
void report_unknown_material(const Table& table, const std::string& name);

/// Returns [shell], [[region]] and [gravity].
std::vector<Section> shell_sections();
void read_shell(Table& root, problem::Problem& problem);
/// Reads cross-sections of regions. Call it after [shell], whose values are their initial values.
void read_regions(Table& root, problem::Problem& problem);
/// Reads gravity. Call it after all densities.
void read_gravity(Table& root, problem::Problem& problem);
/// Returns [[temperature]].
std::vector<Section> temperature_sections();
/// Reads the temperatures. Call it after shell and regions.
void read_temperatures(Table& root, problem::Problem& problem);
/// Checks that finite rotations agree with the other choices of the case.
void check_rotations(Table& root, const problem::Problem& problem);

std::vector<Section> geometry_sections();
/// Reads the domain, which Reading::domain also holds, and its charts.
void read_geometry(Table& root, problem::Problem& problem);
/// Sets the planes of symmetry and the thickness, on which a mesh in space depends. Call it after shell, regions and
/// supports.
void complete_geometry(problem::Problem& problem);

/// Returns [[boundary]] and the selectors of faces and edges.
std::vector<Section> cad_sections();
/// Reads `faces` of [geometry] and of a [[region]], and [[boundary]], into Reading::part.
void read_chosen_faces(Table& geometry);
void read_faces_of_region(Table& region, const std::optional<std::string>& name);
void read_named_edges(Table& root);
/// Writes the job for plastron-cad. Call it after [units], to which lengths are converted.
void complete_part(Table& root, problem::Problem& problem);

std::vector<Section> imperfection_sections();
/// Reads the imperfections. Those in expressions of x and y become part of the charts. Call it after [geometry].
void read_imperfections(Table& root, problem::Problem& problem);
/// Returns the domain of [geometry] and its shapes.
std::vector<Section> domain_sections();
std::optional<domain::Domain> read_domain(Table& geometry);
/// Reads the path of a file from a key; reports a path that is no file. `what`: its kind in messages, "mesh file".
std::optional<std::string> read_path(Table& table, const std::string& key, const std::string& what,
                                     const std::string& advice);
/// The same for a mesh file.
std::optional<std::string> read_mesh_path(Table& table, const std::string& key);

/// Reports a "name" that cannot be part of a file's name. `what`: "a line".
void check_file_name(const Table& table, const std::string& name, const char* what);

std::vector<Section> accuracy_sections();
/// Reads the accuracy. Call it after probes, supports and obstacles, because it uses their names.
void read_accuracy(Table& root, problem::Problem& problem);

std::vector<Section> mesh_sections();
void read_mesh(Table& root, problem::Problem& problem);

std::vector<Section> join_sections();
void read_joins(Table& root, problem::Problem& problem);

std::vector<Section> rigid_body_sections();
void read_rigid_bodies(Table& root, problem::Problem& problem);

std::vector<Section> support_sections();
void read_supports(Table& root, problem::Problem& problem);

std::vector<Section> load_sections();
void read_loads(Table& root, problem::Problem& problem);

/// Declares `axes`, two directions at a right angle for the components of something.
Key axes_key(const std::string& what);
/// Returns the axes in the rows of a matrix; nothing if they are not given, or wrong.
std::optional<Eigen::Matrix3d> read_axes(Table& table);

/// Returns [[foundation]] and [[spring]].
std::vector<Section> foundation_sections();
/// Reads them. Call it after shell and regions, whose thickness it asks for.
void read_foundations(Table& root, problem::Problem& problem);

std::vector<Section> obstacle_sections();
void read_obstacles(Table& root, problem::Problem& problem);
/// Returns the place of the name in Problem::factor_names that the table gives by `name`, -1 if it gives none: what has the same name has
/// the same factor.
int read_factor_name(Table& table, problem::Problem& problem);
/// Returns the place of this name, which is added if it is new.
int factor_of(const std::string& name, problem::Problem& problem);

/// Returns places in the problem's list: two for an obstacle that both faces may touch, none for an unknown name.
std::vector<std::size_t> obstacles_named(const problem::Problem& problem, const std::string& name);
/// Returns the shapes that are tables of their own keys.
std::vector<Section> obstacle_shape_sections();
/// Returns the shape that an [[obstacle]] names. Reports mistakes, also if it names none or two.
std::optional<obstacle::Shape> read_shape(Table& obstacle);

std::vector<Section> step_sections();
/// Reads the steps. Call it after the obstacles.
void read_steps(Table& root, problem::Problem& problem);
/// Checks that steps with control agree with the other choices of the case. Call it after the probes.
void check_control(Table& root, const problem::Problem& problem);
/// Returns the declaration of a rotation about a line, for the table at `path`.
Section rotate_section(const std::string& path);
/// Reads `rotate`, then `translate`.
std::optional<obstacle::Motion> read_motion(Table& table);

/// Returns [[probe]] and [[line]].
std::vector<Section> probe_sections();
void read_probes(Table& root, problem::Problem& problem);
void read_lines(Table& root, problem::Problem& problem);

/// Returns [output] and [units].
std::vector<Section> output_sections();
/// Reads the output; returns whether a report is requested.
bool read_output(Table& root, problem::Problem& problem);
void read_units(Table& root, problem::Problem& problem);

/// Returns [contact], [model], [modes] and [solver].
std::vector<Section> solver_sections();
void read_contact(Table& root, problem::Problem& problem);
void read_model(Table& root, problem::Problem& problem);
/// Reads the modes. Call it after all densities.
void read_modes(Table& root, problem::Problem& problem);
void read_solver(Table& root, problem::Problem& problem);

/// Returns the names of a key. They must be boundaries of the domain if its names are known.
std::optional<std::vector<std::string>> read_boundaries(Table& table, const std::string& name = "boundary");

/// Returns the fault of a closed polygon, in words; "" if there is none.
std::string polygon_fault(const std::vector<Eigen::Vector2d>& corners);
/// Reports at the key `name` parameters that are certainly not in the domain; mesh files are not read. `what`: "the point".
/// Returns whether they may be in it; true for a place in space.
bool check_inside(const Table& table, const std::string& name, const std::string& what, const ShellPlace& place);

}  // namespace plastron::config
