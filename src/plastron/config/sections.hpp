// One reader for each section of a case file. Each fills its part of the problem and notes its effective settings.
#pragma once
#include <plastron/config/table.hpp>
#include <plastron/problem/problem.hpp>

#include <optional>
#include <string>
#include <vector>

namespace plastron::config {

/// Fills Reading::constants, which all other sections use.
void read_constants(Table& root);
void read_shell(Table& root, problem::Problem& problem);
/// Reads cross-sections of regions. Call it after [shell], whose values are their initial values.
void read_regions(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem);
/// Reads gravity. Call it after all densities.
void read_gravity(Table& root, problem::Problem& problem);
/// Reads the domain and its charts; returns nothing if the domain is wrong.
std::optional<fem::Domain> read_geometry(Table& root, problem::Problem& problem);
std::optional<fem::Domain> read_domain(Table& geometry);
void read_charts(Table& geometry, const fem::Domain& domain, problem::Problem& problem);
void read_mesh(Table& root, problem::Problem& problem);
/// Reads the accuracy. Call it after probes, supports and obstacles, because it uses their names.
void read_accuracy(Table& root, problem::Problem& problem);
void read_contact(Table& root, problem::Problem& problem);
void read_solver(Table& root, problem::Problem& problem);
void read_units(Table& root, problem::UnitNames& units);
/// Reads the output; returns whether a report is requested.
bool read_output(Table& root, problem::Problem& problem);
void read_joins(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem);
void read_rigid_bodies(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem);
void read_supports(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem);
void read_loads(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem);
void read_obstacles(Table& root, problem::Problem& problem);
/// Returns places in the problem's list: two for an obstacle that both faces may touch, none for an unknown name.
std::vector<std::size_t> obstacles_named(const problem::Problem& problem, const std::string& name);
/// Reads the steps. Call it after the obstacles.
void read_steps(Table& root, problem::Problem& problem);
void read_lines(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem);
void read_probes(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem);

/// Returns the names under "boundary". They must be boundaries of the domain if its names are known.
std::optional<std::vector<std::string>> read_boundaries(Table& table, const std::optional<fem::Domain>& domain);

/// Returns the fault of a closed polygon, in words; "" if there is none.
std::string polygon_fault(const std::vector<Eigen::Vector2d>& corners);
/// Returns false if the point is certainly not in the domain; mesh files are not read.
bool may_contain(const fem::Domain& domain, const Eigen::Vector2d& point);

}  // namespace plastron::config
