#include <plastron/certificate/certificate.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/assembly/normal_rotation.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/solution/pushed_sideways.hpp>
#include <plastron/zones/contact_zones.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace plastron::certificate {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Vector6 block6(const algebra::Vector& v, std::size_t node) {
  return Eigen::Map<const Vector6>(v.local().data() + 6 * node);
}

/// Forces, moments and energies of strains as large as the displacements relative to the shell's size.
struct StrainScale {
  double force = 0, squared_force = 0, moment = 0, energy = 0;

  void add(const assembly::NodalPoint& p, const Vector6& y, double size) {
    const double u = y.head<3>().norm() + size * y.tail<3>().norm(), f = p.young * p.thickness * u;
    force += f;
    squared_force += f * f;
    moment += f * (p.phi.norm() + size);
    energy += f * u * p.weight / (size * size);
  }
  StrainScale over_ranks(MPI_Comm comm) const {
    return {algebra::sum_over_ranks(force, comm), algebra::sum_over_ranks(squared_force, comm),
            algebra::sum_over_ranks(moment, comm), algebra::sum_over_ranks(energy, comm)};
  }
};

/// Half the diagonal of the bounding box of all ranks' nodes.
double size_of(const assembly::DiscreteShell& discrete) {
  const auto place = [&](std::size_t i) { return discrete.points[i].phi; };
  return assembly::bounding_box(discrete.points.size(), place, discrete.space().layout->comm).half_diagonal();
}

/// Sum of the norms of the nodal loads, couples divided by `size` [N] (collective).
double load_norms(const assembly::DiscreteShell& discrete, double size) {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    const Vector6 load = block6(discrete.load, i);
    sum += load.head<3>().norm() + load.tail<3>().norm() / size;
  }
  return algebra::sum_over_ranks(sum, discrete.space().layout->comm);
}

/// Sums over the owned nodes of one rank.
struct Sums {
  solution::Wrench loads, supports;
  std::vector<solution::ObstacleContact> obstacles{};
  double force_scale = 0, moment_scale = 0;  // sums of the norms of all nodal contributions
  double load_work = 0, contact_work = 0, support_work = 0, lift_work = 0;
  double free_residual = 0, all_forces = 0;
  double max_pressure = 0, complementarity = 0, support_error = 0;
  double displacement = 0, relative_displacement = 0, rotation = 0;
  double thickness = std::numeric_limits<double>::infinity();
  StrainScale strain_scale;
  double min_pressure = std::numeric_limits<double>::infinity(), min_gap = std::numeric_limits<double>::infinity();
  std::int64_t touching = 0;
  std::vector<solution::NodalSupportForce> at_supports{};
};

void add(solution::Wrench& wrench, const assembly::NodalPoint& p, const Vector6& f, Sums& sums) {
  wrench += solution::nodal_wrench(p.phi, p.a3, f);
  sums.force_scale += f.head<3>().norm() + f.tail<3>().norm() / p.thickness;
  sums.moment_scale += p.phi.cross(f.head<3>()).norm() + f.tail<3>().norm();
}

/// The row of the gap in (u, r). It contains only the tangential part of r (D4).
Vector6 gap_row(const obstacle::Gap& gap, const Vector3d& a3) {
  Vector6 row;
  row << gap.normal, gap.z * geometry::tangential(gap.normal, a3);
  return row;
}

/// Displacement of the material per unit of a coordinate, rotations at a lever of e. A generalised force divided by
/// this is a force.
double lever(const Vector6& direction, double thickness) {
  return direction.head<3>().norm() + thickness * direction.tail<3>().norm();
}

void note_size(const assembly::NodalPoint& p, const Vector6& y, Sums& sums) {
  const double u = y.head<3>().norm();
  sums.displacement = std::max(sums.displacement, u);
  sums.relative_displacement = std::max(sums.relative_displacement, u / p.thickness);
  sums.rotation = std::max(sums.rotation, y.tail<3>().norm());
  sums.thickness = std::min(sums.thickness, p.thickness);
}

/// Adds one obstacle at one node. Returns its generalised force.
Vector6 add_contact(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                    const assembly::ContactRow& row, const Vector6& y, Sums& sums) {
  const auto k = static_cast<std::size_t>(row.obstacle);
  const obstacle::Gap& gap = discrete.coordinates.gaps[k][row.node];
  const assembly::NodalPoint& point = discrete.points[row.node];
  const double g = gap(y.head<3>(), geometry::tangential(y.tail<3>(), point.a3));
  if (row.is_touchable() || row.is_left_out) sums.min_gap = std::min(sums.min_gap, g);
  const std::size_t at = row.node * discrete.coordinates.gaps.size() + k;
  if (solution.touching.local()[at] == 0) return Vector6::Zero();
  const double pressure = solution.pressure.local()[at];
  solution::ObstacleContact& contact = sums.obstacles[k];
  contact.nodes += 1;
  sums.max_pressure = std::max(sums.max_pressure, pressure);
  sums.min_pressure = std::min(sums.min_pressure, pressure);
  const double lift = discrete.state.lift(row.node, k);
  sums.complementarity = std::max(sums.complementarity, std::abs(pressure * (g - lift)));
  sums.lift_work += pressure * point.weight * lift;
  Vector6 force = pressure * point.weight * gap_row(gap, point.a3);
  sums.contact_work += force.dot(y);
  add(contact.reaction, point, force, sums);
  return force;
}

/// Adds all obstacles at one node. Returns their generalised force.
Vector6 add_contacts(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, std::size_t i,
                     const Vector6& y, Sums& sums) {
  Vector6 force = Vector6::Zero();
  for (const assembly::ContactRow& row : discrete.coordinates.rows_of(i))
    force += add_contact(discrete, solution, row, y, sums);
  if (solution::touches(solution, i)) sums.touching += 1;
  return force;
}

void add_node(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, std::size_t i,
              const Vector6& r, Sums& sums) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const Vector6 y = block6(solution.y, i), load = block6(discrete.load, i);
  add(sums.loads, discrete.points[i], load, sums);
  sums.load_work += load.dot(y);
  note_size(discrete.points[i], y, sums);
  if (coordinates.tied[i]) return;
  const Vector6 contact = add_contacts(discrete, solution, i, y, sums);
  const Vector6 rest = r - contact;
  Vector6 support = Vector6::Zero();
  for (int k = 0; k < coordinates.width; ++k) {
    const Vector6 direction = coordinates.direction(i, k);
    if (direction.isZero(0)) continue;
    const double component = direction.dot(rest);
    const double per_force = 1 / std::pow(lever(direction, discrete.points[i].thickness), 2);
    sums.all_forces += per_force * (std::pow(direction.dot(load), 2) + std::pow(direction.dot(contact), 2));
    if (coordinates.is_prescribed(i, k)) {
      add(sums.supports, discrete.points[i], component * direction, sums);
      support += component * direction;
      sums.support_work += component * direction.dot(y);
      // Prescribed directions are unit vectors orthogonal to the node's other directions: the coordinate is a
      // projection.
      const double error = std::abs(direction.dot(y) - coordinates.lower.local()[coordinates.at(i, k)]);
      sums.support_error = std::max(sums.support_error, lever(direction, discrete.points[i].thickness) * error);
      sums.all_forces += per_force * component * component;
    } else {
      sums.free_residual += per_force * component * component;
    }
  }
  if (!support.isZero(0)) sums.at_supports.push_back({i, support});
}

/// Adds the unknowns of rigid bodies. Only the first rank adds the values that all ranks share.
void add_bodies(const solution::BodyBalance& balance, MPI_Comm comm, Sums& sums) {
  sums.free_residual += balance.free_residual;
  sums.all_forces += balance.all_forces;
  sums.support_error = std::max(sums.support_error, balance.support_error);
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank != 0) return;
  sums.supports += balance.reaction;
  sums.support_work += balance.support_work;
  sums.force_scale += balance.force_scale;
  sums.moment_scale += balance.moment_scale;
}

double max_normal_rotation(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  const assembly::ShellOperator& shell = discrete.shell;
  double most = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(shell.space().layout->owned); ++i)
    most = std::max(most, std::abs(block6(y, i).tail<3>().dot(discrete.points[i].a3)));
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const element::FieldRows rows =
        shell.interpolation().fields(c, shell.tables().quadrature, shell.quadrature_bases(c), shell.gather(c, y));
    for (int q = 0; q < shell.tables().points_per_cell(); ++q)
      most = std::max(most, std::abs(rows.at(q).r.dot(shell.point(c, q).frame.a3)));
  }
  return algebra::max_over_ranks(most, shell.space().layout->comm);
}

/// A ratio of squares. Smaller strains relative to displacements are rounding: double precision leaves 1e-32 (L/h)^2.
constexpr double rounding_of_energy = 1e-22;

solution::Summary summary_of(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                             const Sums& sums) {
  const MPI_Comm comm = discrete.space().layout->comm;
  solution::Summary s;
  s.energy = discrete.shell.energies(solution.y);
  s.second_order = assembly::second_order(discrete.shell, solution.y);
  s.load_work = algebra::sum_over_ranks(sums.load_work, comm);
  s.loads = solution::over_ranks(sums.loads, comm);
  const std::vector<double> areas = zones::contact_areas(discrete, solution);
  for (const solution::ObstacleContact& contact : sums.obstacles) {
    s.obstacles.push_back(contact);
    s.obstacles.back().reaction = solution::over_ranks(contact.reaction, comm);
    s.obstacles.back().area = areas[s.obstacles.size() - 1];
    s.contact_area += s.obstacles.back().area;
    s.obstacles.back().nodes = algebra::sum_over_ranks(contact.nodes, comm);
    s.reaction.force += s.obstacles.back().reaction.force;
    s.reaction.moment += s.obstacles.back().reaction.moment;
  }
  s.support_reaction = solution::over_ranks(sums.supports, comm);
  s.touching_nodes = algebra::sum_over_ranks(sums.touching, comm);
  s.max_pressure = algebra::max_over_ranks(sums.max_pressure, comm);
  s.max_displacement = algebra::max_over_ranks(sums.displacement, comm);
  s.max_relative_displacement = algebra::max_over_ranks(sums.relative_displacement, comm);
  s.max_rotation = algebra::max_over_ranks(sums.rotation, comm);
  s.least_thickness = algebra::min_over_ranks(sums.thickness, comm);
  s.edge = solution::edge_contact(discrete, solution);
  s.tangency_energy = tangency_energy(discrete.shell, discrete.tangency_factor(), solution.y);
  s.max_normal_rotation = max_normal_rotation(discrete, solution.y);
  s.is_admissible_wanted = discrete.state.is_admissible();
  if (s.is_admissible_wanted) s.largest_lift = algebra::max_abs(discrete.state.lifts);
  s.lift_work = algebra::sum_over_ranks(sums.lift_work, comm);
  if (solution.lambda.layout()) s.multiplier_norm = gradient_norm(discrete.shell, solution.lambda);
  return s;
}

double ratio(double part, double whole) { return whole > 0 ? part / whole : part; }

/// `least` are the scales below which forces and energies are rounding.
Certificate certificate_of(const assembly::DiscreteShell& discrete, const Sums& sums, const solution::Summary& s,
                           const StrainScale& least) {
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
  const Vector3d force = s.loads.force + s.reaction.force + s.support_reaction.force;
  const Vector3d moment = s.loads.moment + s.reaction.moment + s.support_reaction.moment;
  c.force_balance = ratio(force.norm(), std::max(sum(sums.force_scale), least.force));
  c.moment_balance = ratio(moment.norm(), std::max(sum(sums.moment_scale), least.moment));
  const double work = s.load_work + sum(sums.contact_work) + sum(sums.support_work);
  const double a = 2 * (s.energy.total() + s.tangency_energy);
  c.energy_identity = ratio(std::abs(a - work), std::max(a, least.energy));
  return c;
}

/// The obstacle's place, with no contact.
solution::ObstacleContact untouched(const obstacle::Obstacle& at_start, const obstacle::Obstacle& now) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(now.placement.rotation * at_start.placement.rotation.transpose()));
  return {.name = now.name,
          .translation = now.placement.translation - at_start.placement.translation,
          .rotation = turn.angle() * turn.axis()};
}

/// Removes the cells at rigid bodies: no bound keeps a body's nodes out of obstacles. BodyReaction contains their
/// depth.
void leave_out_bodies(const fem::Space& space, std::vector<CellGap>& cells) {
  if (!space.carried) return;
  std::vector<char> is_of_body(static_cast<std::size_t>(space.layout->local_size()));
  for (const fem::PlacedBody& body : space.carried->bodies)
    for (const std::size_t member : body.members)
      is_of_body[static_cast<std::size_t>(space.carried->nodes[member].node)] = 1;
  std::erase_if(cells, [&](const CellGap& cell) {
    return std::ranges::any_of(space.nodes(cell.cell), [&](algebra::LocalIndex node) {
      return is_of_body[static_cast<std::size_t>(node)] != 0;
    });
  });
}

/// Adds the searched gaps, and for each obstacle the least gap of all ranks with its place.
void add_least_gaps(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                    Verdict& verdict) {
  if (discrete.obstacles.empty()) return;
  const MPI_Comm comm = discrete.space().layout->comm;
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  auto cells =
      algebra::in_agreement<obstacle::ObstacleError>(comm, [&] { return searched_gaps(discrete, solution.y); });
  leave_out_bodies(discrete.space(), cells);
  for (std::size_t k = 0; k < verdict.summary.obstacles.size(); ++k) {
    solution::ObstacleContact& contact = verdict.summary.obstacles[k];
    Eigen::Vector2d at(nowhere, nowhere);
    double least = nowhere;
    for (const CellGap& cell : cells)
      if (cell.obstacle == k && cell.gap < least) {
        least = cell.gap;
        at = cell.x;
      }
    contact.least_gap = algebra::min_over_ranks(least, comm);
    if (!std::isfinite(contact.least_gap)) continue;
    if (least > contact.least_gap) at.setConstant(nowhere);
    contact.least_gap_at[0] = algebra::min_over_ranks(at[0], comm);
    contact.least_gap_at[1] = algebra::min_over_ranks(at[0] > contact.least_gap_at[0] ? nowhere : at[1], comm);
  }
  std::ranges::copy_if(cells, std::back_inserter(verdict.entered), [](const CellGap& cell) { return cell.gap < 0; });
}

}  // namespace

Verdict certify(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  const MPI_Comm comm = discrete.space().layout->comm;
  const algebra::Vector r = solution::residual(discrete, solution);
  const double size = size_of(discrete);
  Sums sums;
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k)
    sums.obstacles.push_back(untouched(discrete.obstacles_at_start.all[k], discrete.obstacles.now(k)));
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    add_node(discrete, solution, i, block6(r, i), sums);
    sums.strain_scale.add(discrete.points[i], block6(solution.y, i), size);
  }
  solution::BodyBalance bodies = solution::body_balance(discrete, solution.y, r);
  add_bodies(bodies, comm, sums);

  Verdict verdict{.summary = summary_of(discrete, solution, sums), .certificate = {}};
  verdict.summary.size = size;
  add_least_gaps(discrete, solution, verdict);
  solution::add_pushed_sideways(discrete, solution, verdict.summary);
  const double a = 2 * (verdict.summary.energy.total() + verdict.summary.tangency_energy);
  const StrainScale scale = sums.strain_scale.over_ranks(comm);
  const bool is_unstrained = a < rounding_of_energy * scale.energy;
  verdict.summary.is_unstrained = is_unstrained;
  verdict.summary.rounding_energy = rounding_of_energy * scale.energy;
  if (is_unstrained) verdict.summary.second_order.work = 0;  // membrane forces are only rounding
  verdict.summary.load_norms = load_norms(discrete, size);
  solution::SupportReactions supports = solution::support_reactions(discrete, sums.at_supports);
  verdict.summary.support_reactions = std::move(supports.boundaries);
  verdict.summary.corner_reactions = std::move(supports.corners);
  verdict.summary.point_reactions = std::move(supports.points);
  verdict.summary.body_reactions = std::move(bodies.bodies);
  verdict.certificate = certificate_of(discrete, sums, verdict.summary, is_unstrained ? scale : StrainScale{});
  return verdict;
}

}  // namespace plastron::certificate
