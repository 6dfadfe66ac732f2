#include <plastron/certificate/certificate.hpp>

#include <plastron/certificate/inside_obstacles.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/zones/contact_zones.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::certificate {

namespace {

using assembly::node_values;
using assembly::Vector6;

/// Sums over the owned nodes of one rank.
struct Sums {
  double force_scale = 0, moment_scale = 0;  // sums of the norms of all nodal contributions
  double contact_work = 0, support_work = 0;
  double free_residual = 0, all_forces = 0;
  double complementarity = 0, support_error = 0;
  double min_pressure = std::numeric_limits<double>::infinity(), min_gap = std::numeric_limits<double>::infinity();
};

void add_scales(const assembly::NodalPoint& p, const Vector6& f, Sums& sums) {
  sums.force_scale += f.head<3>().norm() + f.tail<3>().norm() / p.thickness;
  sums.moment_scale += p.phi.cross(f.head<3>()).norm() + f.tail<3>().norm();
}

/// Displacement of the material per unit of a coordinate, rotations at a lever of e. A generalised force divided by
/// this is a force.
double lever(const Vector6& direction, double thickness) {
  return direction.head<3>().norm() + thickness * direction.tail<3>().norm();
}

/// Adds one obstacle at one node. Returns its generalised force.
Vector6 add_contact(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                    const assembly::ContactRow& row, Sums& sums) {
  const auto k = static_cast<std::size_t>(row.obstacle);
  // The surface of a bed gives by its pressure.
  const double closed = row.bed > 0 ? discrete.obstacles.all[k].bed.closure(solution.pressure.at(row.node)[k]) : 0;
  const double gap = discrete.nodal_gap(k, row.node, solution.y) + closed;
  if (row.is_touchable() || row.is_left_out) sums.min_gap = std::min(sums.min_gap, gap);
  Vector6 force = contact_force(discrete, solution, row);
  if (solution.touching.at(row.node)[k] == 0) return force;
  const double pressure = solution.pressure.at(row.node)[k];
  sums.min_pressure = std::min(sums.min_pressure, pressure);
  sums.complementarity = std::max(sums.complementarity, std::abs(pressure * (gap - discrete.state.lift(row.node, k))));
  sums.contact_work += force.dot(node_values(solution.y, row.node));
  add_scales(discrete.place(row.node), force, sums);
  return force;
}

/// Adds one node with the residual r. Along prescribed coordinates, supports carry what obstacles do not; along free
/// ones, the rest is the error. `load`: with the forces of initial strains; `carried`: the forces on foundations.
void add_node(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, std::size_t i,
              const Vector6& r, const Vector6& load, const Vector6& carried, Sums& sums) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const assembly::NodalPoint& point = discrete.place(i);
  const Vector6 y = node_values(solution.y, i), in_coordinates = discrete.in_coordinates(solution.y, i);
  add_scales(point, load, sums);
  add_scales(point, carried, sums);
  if (discrete.space().continuity.constrains(i)) return;
  Vector6 contact = Vector6::Zero();
  for (const assembly::ContactRow& row : coordinates.rows_of(i)) contact += add_contact(discrete, solution, row, sums);
  const Vector6 rest = r - contact;
  for (int k = 0; k < coordinates.width; ++k) {
    const Vector6 direction = coordinates.direction(i, k);
    if (direction.isZero(0)) continue;
    const double component = direction.dot(rest);
    const double per_force = 1 / std::pow(lever(direction, point.thickness), 2);
    sums.all_forces += per_force * (std::pow(direction.dot(load), 2) + std::pow(direction.dot(carried), 2) +
                                    std::pow(direction.dot(contact), 2));
    if (coordinates.is_prescribed(i, k)) {
      add_scales(point, component * direction, sums);
      sums.support_work += component * direction.dot(y);
      // Prescribed directions are unit vectors orthogonal to the node's other directions: the coordinate is a
      // projection.
      const double error = std::abs(direction.dot(in_coordinates) - coordinates.lower.local()[coordinates.at(i, k)]);
      sums.support_error = std::max(sums.support_error, lever(direction, point.thickness) * error);
      sums.all_forces += per_force * component * component;
    } else {
      sums.free_residual += per_force * component * component;
    }
  }
}

/// Adds the unknowns of rigid bodies. Only the first rank adds the values that all ranks share.
void add_bodies(const solution::BodyBalance& balance, MPI_Comm comm, Sums& sums) {
  sums.free_residual += balance.free_residual;
  sums.all_forces += balance.all_forces;
  sums.support_error = std::max(sums.support_error, balance.support_error);
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank != 0) return;
  sums.support_work += balance.support_work;
  sums.force_scale += balance.force_scale;
  sums.moment_scale += balance.moment_scale;
}

/// Adds the areas in contact.
void add_areas(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
               solution::Summary& summary) {
  const std::vector<double> areas = zones::contact_areas(discrete, solution);
  for (std::size_t k = 0; k < areas.size(); ++k) {
    summary.obstacles[k].area = areas[k];
    summary.contact_area += areas[k];
  }
}

double ratio(double part, double whole) { return whole > 0 ? part / whole : part; }

/// Returns the error of the energy's derivative along (u, r) itself. Differences of fourth order are exact for W, a polynomial of
/// fourth degree.
double energy_derivative(const assembly::DiscreteShell& discrete, const algebra::Vector& y, double energy) {
  constexpr double step = 1e-3;
  const auto at = [&](double t) {
    algebra::Vector scaled = y;
    for (double& value : scaled.local()) value *= 1 + t;
    return discrete.energies(scaled).total();
  };
  const double slope = (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
  const double work = algebra::dot(forces_of_energy(discrete, y), y);
  return ratio(std::abs(slope - work), std::max(std::abs(work), 2 * energy));
}

/// `least` are the scales below which forces and energies are rounding.
Certificate certificate_of(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                           const Sums& sums, const solution::Summary& s, const solution::StrainScale& least) {
  const MPI_Comm comm = discrete.space().layout->comm;
  const auto sum = [comm](double value) { return algebra::sum_over_ranks(value, comm); };
  Certificate c{.min_gap_between = std::numeric_limits<double>::infinity()};
  c.stationarity =
      ratio(std::sqrt(sum(sums.free_residual)), std::sqrt(std::max(sum(sums.all_forces), least.squared_force)));
  c.min_pressure = s.touching_nodes > 0 ? algebra::min_over_ranks(sums.min_pressure, comm) : 0;
  c.min_gap_nodes = algebra::min_over_ranks(sums.min_gap, comm);
  for (const solution::ObstacleContact& obstacle : s.obstacles)
    c.min_gap_between = std::min(c.min_gap_between, obstacle.least_gap);
  c.support_error = algebra::max_over_ranks(sums.support_error, comm);
  c.complementarity = algebra::max_over_ranks(sums.complementarity, comm);
  const solution::Wrench carried = s.foundation_reaction();
  const Vector3d force = s.loads.force + s.reaction.force + s.support_reaction.force + carried.force;
  const Vector3d moment = s.loads.moment + s.reaction.moment + s.support_reaction.moment + carried.moment;
  c.force_balance = ratio(force.norm(), std::max(sum(sums.force_scale), least.force));
  c.moment_balance = ratio(moment.norm(), std::max(sum(sums.moment_scale), least.moment));
  if (!discrete.has_linear_strains()) {
    c.energy_derivative = energy_derivative(discrete, solution.y, std::max(s.energy.total(), least.energy));
    return c;
  }
  const double by_contact = sum(sums.contact_work), by_supports = sum(sums.support_work);
  const double a = 2 * (discrete.motion_energies(solution.y).total() + s.tangency_energy),
               by_initial_strains = algebra::dot(discrete.initial_forces, solution.y);
  c.energy_identity = ratio(std::abs(a - s.load_work - by_initial_strains - by_contact - by_supports),
                            std::max({a, std::abs(s.load_work), std::abs(by_initial_strains), std::abs(by_contact),
                                      std::abs(by_supports), least.energy}));
  return c;
}

}  // namespace

Verdict certify(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  const algebra::Vector r = solution::residual(discrete, solution);
  const solution::BodyBalance bodies = solution::body_balance(discrete, solution.y, r);
  Verdict verdict{.summary = solution::summarise(discrete, solution, r, bodies), .certificate = {}};
  add_areas(discrete, solution, verdict.summary);
  verdict.entered = add_least_gaps(discrete, solution, verdict.summary);
  add_pushed_nodes(discrete, solution, verdict.summary);
  Sums sums;
  const algebra::Vector loads = loads_and_initial_forces(discrete);
  algebra::Vector carried(loads.layout(), 6);
  for (const auto& [foundation, term] : discrete.foundations)
    if (term) term->add_forces(discrete.shell, solution.y, carried);
  carried.accumulate_ghosts();
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i)
    add_node(discrete, solution, i, node_values(r, i), node_values(loads, i), node_values(carried, i), sums);
  add_bodies(bodies, discrete.space().layout->comm, sums);
  auto least = verdict.summary.is_unstrained ? solution::strain_scale(discrete, solution.y, verdict.summary.size)
                                             : solution::StrainScale{};
  least.energy = std::max(least.energy, verdict.summary.least_energy());
  verdict.certificate = certificate_of(discrete, solution, sums, verdict.summary, least);
  return verdict;
}

}  // namespace plastron::certificate
