#include <plastron/solution/summary.hpp>

#include <plastron/energy/normal_rotation.hpp>
#include <plastron/geometry/rotation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::solution {

namespace {

using assembly::node_values;
using assembly::Vector6;

/// A ratio of squares. Smaller strains relative to displacements are rounding: double precision leaves 1e-32 (L/h)^2.
constexpr double rounding_of_energy = 1e-22;

/// Sums over the owned nodes of one rank.
struct Sums {
  Wrench loads, supports;
  std::vector<ObstacleContact> obstacles{};
  double load_work = 0, lift_work = 0, support_norms = 0, area_modulus = 0;
  double max_pressure = 0;
  double displacement = 0, relative_displacement = 0, rotation = 0;
  double thickness = std::numeric_limits<double>::infinity();
  std::int64_t touching = 0;
  std::vector<NodalSupportForce> at_supports{};
};

void note_size(const assembly::DiscreteShell& discrete, const assembly::NodalPoint& p, const Vector6& y, Sums& sums) {
  const double u = y.head<3>().norm();
  sums.displacement = std::max(sums.displacement, u);
  sums.relative_displacement = std::max(sums.relative_displacement, u / p.thickness);
  sums.rotation = std::max(sums.rotation, discrete.angle(p.a3, y.tail<3>()));
  sums.thickness = std::min(sums.thickness, p.thickness);
}

/// Adds all obstacles at one node. Returns their generalised force.
Vector6 add_contacts(const assembly::DiscreteShell& discrete, const NodalSolution& solution, std::size_t i,
                     Sums& sums) {
  const assembly::NodalPoint& point = discrete.place(i);
  Vector6 all = Vector6::Zero();
  for (const assembly::ContactRow& row : discrete.coordinates.rows_of(i)) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    const Vector6 force = contact_force(discrete, solution, row);
    all += force;
    if (solution.touching.at(i)[k] == 0) continue;
    const double pressure = solution.pressure.at(i)[k];
    sums.obstacles[k].nodes += 1;
    sums.obstacles[k].reaction += nodal_wrench(point.phi, point.a3, force);
    sums.obstacles[k].force_norms += force.head<3>().norm();
    if (const obstacle::Bed& bed = discrete.obstacles.all[k].bed; !bed.is_rigid()) {
      sums.obstacles[k].bed_energy += bed.energy(pressure) * point.weight;
      sums.obstacles[k].largest_closure = std::max(sums.obstacles[k].largest_closure, bed.closure(pressure));
    }
    sums.max_pressure = std::max(sums.max_pressure, pressure);
    sums.lift_work += pressure * point.weight * discrete.state.lift(i, k);
  }
  if (touches(solution, i)) sums.touching += 1;
  return all;
}

/// Adds one node. Supports carry the part of its residual r along prescribed coordinates that obstacles do not.
void add_node(const assembly::DiscreteShell& discrete, const NodalSolution& solution, std::size_t i, const Vector6& r,
              Sums& sums) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const assembly::NodalPoint& point = discrete.place(i);
  const Vector6 y = node_values(solution.y, i), load = node_values(discrete.load, i);
  sums.loads += nodal_wrench(point.phi, point.a3, load);
  sums.load_work += load.dot(y);
  sums.area_modulus += discrete.points[i].young * discrete.points[i].weight;
  note_size(discrete, point, y, sums);
  if (discrete.space().continuity.constrains(i)) return;
  const Vector6 contact = add_contacts(discrete, solution, i, sums);
  const Vector6 rest = r - contact;
  Vector6 support = Vector6::Zero();
  for (int k = 0; k < coordinates.width; ++k) {
    const Vector6 direction = coordinates.direction(i, k);
    if (direction.isZero(0) || !coordinates.is_prescribed(i, k)) continue;
    const Vector6 force = direction.dot(rest) * direction;
    sums.supports += nodal_wrench(point.phi, point.a3, force);
    support += force;
  }
  sums.support_norms += support.head<3>().norm();
  if (!support.isZero(0)) sums.at_supports.push_back({i, support});
}

/// The obstacle's place, with no contact.
ObstacleContact untouched(const obstacle::Obstacle& at_start, const obstacle::Obstacle& now) {
  return {.name = now.name,
          .translation = now.placement.translation - at_start.placement.translation,
          .rotation = geometry::rotation_vector(now.placement.rotation * at_start.placement.rotation.transpose())};
}

Sums sums_over_nodes(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                     const algebra::Vector& residual) {
  Sums sums;
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k)
    sums.obstacles.push_back(untouched(discrete.obstacles_at_start.all[k], discrete.obstacles.now(k)));
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i)
    add_node(discrete, solution, i, node_values(residual, i), sums);
  return sums;
}

/// Adds up the sums of all ranks.
void add_totals(const Sums& sums, MPI_Comm comm, Summary& s) {
  s.load_work = algebra::sum_over_ranks(sums.load_work, comm);
  s.loads = over_ranks(sums.loads, comm);
  for (const ObstacleContact& contact : sums.obstacles) {
    s.obstacles.push_back(contact);
    s.obstacles.back().reaction = over_ranks(contact.reaction, comm);
    s.obstacles.back().force_norms = algebra::sum_over_ranks(contact.force_norms, comm);
    s.obstacles.back().nodes = algebra::sum_over_ranks(contact.nodes, comm);
    s.obstacles.back().bed_energy = algebra::sum_over_ranks(contact.bed_energy, comm);
    s.obstacles.back().largest_closure = algebra::max_over_ranks(contact.largest_closure, comm);
    s.reaction += s.obstacles.back().reaction;
  }
  s.support_reaction = over_ranks(sums.supports, comm);
  s.touching_nodes = algebra::sum_over_ranks(sums.touching, comm);
  s.max_pressure = algebra::max_over_ranks(sums.max_pressure, comm);
  s.max_displacement = algebra::max_over_ranks(sums.displacement, comm);
  s.max_relative_displacement = algebra::max_over_ranks(sums.relative_displacement, comm);
  s.max_rotation = algebra::max_over_ranks(sums.rotation, comm);
  s.least_thickness = algebra::min_over_ranks(sums.thickness, comm);
  s.lift_work = algebra::sum_over_ranks(sums.lift_work, comm);
  s.support_norms = algebra::sum_over_ranks(sums.support_norms, comm);
  s.area_modulus = algebra::sum_over_ranks(sums.area_modulus, comm);
}

double max_normal_rotation(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  const energy::ShellOperator& shell = discrete.shell;
  double most = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(shell.space().layout->owned); ++i)
    most = std::max(most, std::abs(node_values(y, i).tail<3>().dot(discrete.points[i].a3)));
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const element::FieldRows rows =
        shell.interpolation().fields(c, shell.tables().quadrature, shell.quadrature_bases(c), shell.gather(c, y));
    for (int q = 0; q < shell.tables().points_per_cell(); ++q)
      most = std::max(most, std::abs(rows.at(q).r.dot(shell.point(c, q).frame.a3)));
  }
  return algebra::max_over_ranks(most, shell.space().layout->comm);
}

/// Returns the largest principal strain of both faces, by absolute value.
double largest_principal(const energy::QuadraturePoint& p, const Eigen::Vector3d& membrane,
                         const Eigen::Vector3d& bending) {
  double largest = 0;
  for (const double z : {-p.thickness / 2, p.thickness / 2}) {
    const Eigen::Vector3d s = membrane + z * bending;
    const double half_trace =
        (p.frame.metric_con(0, 0) * s[0] + p.frame.metric_con(1, 1) * s[1] + p.frame.metric_con(0, 1) * s[2]) / 2;
    const double determinant = (s[0] * s[1] - s[2] * s[2] / 4) * p.frame.metric_con.determinant();
    const double principal = std::abs(half_trace) + std::sqrt(std::max(0.0, half_trace * half_trace - determinant));
    if (!(principal <= largest)) largest = principal;
  }
  return largest;
}

double max_strain(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  const energy::ShellOperator& shell = discrete.shell;
  double most = 0;
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const energy::CellStrain strains = discrete.strains(c, y);
    for (Eigen::Index q = 0; q < strains.rows(); ++q) {
      const double strain = largest_principal(shell.point(c, static_cast<int>(q)), strains.row(q).head<3>().transpose(),
                                              strains.row(q).segment<3>(3).transpose());
      if (!(strain <= most)) most = strain;
    }
  }
  return algebra::max_over_ranks(most, shell.space().layout->comm);
}

/// Returns the energy of the initial strains (collective) [J].
double initial_energy(const assembly::DiscreteShell& discrete) {
  const energy::ShellOperator& shell = discrete.shell;
  double sum = 0;
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c)
    if (const auto strains = shell.initial_strains(c, discrete.state.factors))
      sum += strains->cwiseProduct(*shell.weighted_initial_stresses(c, discrete.state.factors)).sum() / 2;
  return algebra::sum_over_ranks(sum, shell.space().layout->comm);
}

/// Adds energies, and whether they are only rounding.
void add_energies(const assembly::DiscreteShell& discrete, const NodalSolution& solution, Summary& s) {
  s.energy = discrete.energies(solution.y);
  s.tangency_energy = discrete.energy_of_terms(solution.y, true);
  s.max_strain = max_strain(discrete, solution.y);
  s.initial_energy = initial_energy(discrete);
  s.rigid_energy = strain_scale(discrete, solution.y, s.size).energy;
  s.rounding_energy = rounding_of_energy * s.rigid_energy;
  s.is_unstrained = 2 * (s.energy.total() + s.tangency_energy) < s.rounding_energy;
}

/// Returns the force of each foundation on the shell, and its energy (collective).
std::vector<FoundationReaction> foundation_reactions(const assembly::DiscreteShell& discrete,
                                                     const algebra::Vector& y) {
  std::vector<FoundationReaction> all;
  for (std::size_t k = 0; k < discrete.foundations.size(); ++k) {
    const auto& [description, term] = discrete.foundations[k];
    FoundationReaction& one =
        all.emplace_back(FoundationReaction{.name = description.name, .is_spring = description.is_spring()});
    if (!term) continue;
    algebra::Vector forces(y.layout(), 6);
    term->add_forces(discrete.shell, y, forces);
    forces.accumulate_ghosts();
    Wrench sum;
    for (std::size_t i = 0; i < static_cast<std::size_t>(y.layout()->owned); ++i)
      sum += nodal_wrench(discrete.place(i).phi, discrete.place(i).a3, -node_values(forces, i));
    one.reaction = over_ranks(sum, y.layout()->comm);
    one.energy = term->energy(discrete.shell, y);
  }
  return all;
}

/// Sum of the norms of loads_and_initial_forces(), couples divided by `size` [N] (collective).
double load_norms(const assembly::DiscreteShell& discrete, double size) {
  double sum = 0;
  const algebra::Vector loads = loads_and_initial_forces(discrete);
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    const Vector6 load = node_values(loads, i);
    sum += load.head<3>().norm() + load.tail<3>().norm() / size;
  }
  return algebra::sum_over_ranks(sum, discrete.space().layout->comm);
}

}  // namespace

Summary summarise(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                  const algebra::Vector& residual, const BodyBalance& bodies) {
  const MPI_Comm comm = discrete.space().layout->comm;
  Sums sums = sums_over_nodes(discrete, solution, residual);
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank == 0) sums.supports += bodies.reaction;  // all ranks share it
  Summary s;
  const auto place = [&](std::size_t i) { return discrete.points[i].phi; };
  s.size = assembly::bounding_box(discrete.points.size(), place, comm).half_diagonal();
  add_totals(sums, comm, s);
  add_energies(discrete, solution, s);
  s.load_norms = load_norms(discrete, s.size);
  if (discrete.has_linear_strains()) s.max_normal_rotation = max_normal_rotation(discrete, solution.y);
  s.edge = edge_contact(discrete, solution);
  s.is_admissible_wanted = discrete.state.is_admissible();
  if (s.is_admissible_wanted) s.largest_lift = algebra::max_abs(discrete.state.lifts);
  if (solution.lambda.layout()) s.multiplier_norm = gradient_norm(discrete.shell, solution.lambda);
  SupportReactions supports = support_reactions(discrete, sums.at_supports);
  s.is_in_space = discrete.shell.surface().has_directors();
  s.support_reactions = std::move(supports.boundaries);
  s.corner_reactions = std::move(supports.corners);
  s.point_reactions = std::move(supports.points);
  s.body_reactions = bodies.bodies;
  s.foundations = foundation_reactions(discrete, solution.y);
  return s;
}

StrainScale strain_scale(const assembly::DiscreteShell& discrete, const algebra::Vector& y, double size) {
  StrainScale sum;
  // Strains that are not linear are differences of products of places, which round whether the shell has moved or not.
  const double place = discrete.has_linear_strains() ? 0 : size;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    const assembly::NodalPoint& p = discrete.points[i];
    const Vector6 moved = node_values(y, i);
    const double u = place + moved.head<3>().norm() + size * moved.tail<3>().norm(), f = p.young * p.thickness * u;
    sum.force += f;
    sum.squared_force += f * f;
    sum.moment += f * (p.phi.norm() + size);
    sum.energy += f * u * p.weight / (size * size);
  }
  const MPI_Comm comm = discrete.space().layout->comm;
  return {algebra::sum_over_ranks(sum.force, comm), algebra::sum_over_ranks(sum.squared_force, comm),
          algebra::sum_over_ranks(sum.moment, comm), algebra::sum_over_ranks(sum.energy, comm)};
}

void take_moments_about(const Vector3d& point, Summary& summary) {
  const Vector3d by = point - summary.moment_point;
  for (Wrench* wrench : {&summary.loads, &summary.reaction, &summary.support_reaction}) wrench->move_point(by);
  for (SupportReaction& support : summary.support_reactions) support.reaction.move_point(by);
  for (FoundationReaction& foundation : summary.foundations) foundation.reaction.move_point(by);
  for (CornerReaction& corner : summary.corner_reactions) corner.reaction.move_point(by);
  for (ObstacleContact& obstacle : summary.obstacles) {
    obstacle.reaction.move_point(by);
    for (ContactZone& zone : obstacle.zones) zone.reaction.move_point(by);
  }
  summary.moment_point = point;
}

}  // namespace plastron::solution
