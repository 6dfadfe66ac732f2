#include <plastron/finite/modes.hpp>

#include <plastron/algebra/eigenvalues.hpp>
#include <plastron/algebra/factorisation.hpp>
#include <plastron/finite/controlled_point.hpp>
#include <plastron/finite/scalar_blocks.hpp>
#include <plastron/finite/tangent.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace plastron::finite {

using algebra::Vector;
using assembly::NodalCoordinates;

namespace {

/// Coordinates of small motions about a solution, of which supports and contact fix some.
struct SmallMotions {
  NodalCoordinates coordinates;
  std::vector<char> fixed;
};

/// Returns the coordinates of the shell without a relaxed formulation.
NodalCoordinates tangent_coordinates(const assembly::DiscreteShell& discrete) {
  if (discrete.has_increments()) return discrete.coordinates;
  return nodal_coordinates(discrete.shell.space_pointer(), discrete.points,
                           node_supports(discrete.space(), discrete.shell.surface(), discrete.points, discrete.supports,
                                         discrete.state.factors),
                           discrete.obstacles, element::Formulation::tangent, discrete.state);
}

SmallMotions small_motions(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  SmallMotions motions{.coordinates = tangent_coordinates(discrete), .fixed = {}};
  motions.fixed = motions.coordinates.prescribed();
  const auto activity = assembly::likely_activity(motions.coordinates, solution.touching);
  for (std::size_t i = 0; i < activity.size(); ++i)
    if (activity[i] != contact::Activity::free) motions.fixed[i] = 1;
  return motions;
}

/// Returns the matrix of int rho (e u . v + e^3/12 r . s) dS.
algebra::Matrix mass_matrix(const assembly::DiscreteShell& discrete, const NodalCoordinates& coordinates) {
  const energy::ShellOperator& shell = discrete.shell;
  const Eigen::MatrixXd& value = shell.tables().quadrature.value;
  return assembly::matrix_of_cells(*coordinates.space, coordinates.width, [&](std::size_t c) {
    Eigen::VectorXd of_u(value.rows()), of_r(value.rows());
    for (Eigen::Index q = 0; q < value.rows(); ++q) {
      const energy::QuadraturePoint p = shell.point(c, static_cast<int>(q));
      of_u[q] = shell.section(c).density * p.thickness * p.area;
      of_r[q] = of_u[q] * p.thickness * p.thickness / 12;
    }
    ScalarBlocks mass = zero_blocks(shell.tables().nodes_per_cell());
    mass.of_u = weighted_product(value, of_u, value);
    mass.of_r = weighted_product(value, of_r, value);
    return in_coordinates(coordinates, c, mass);
  });
}

/// Returns (u, r) of a motion, with the largest displacement 1 and the sign that makes the largest component positive.
Vector shape_of(const NodalCoordinates& coordinates, const Vector& z) {
  Vector y(z.layout(), 6);
  coordinates.to_cartesian(z, y);
  const double size = solution::largest_displacement(y);
  double most = 0, least = 0;
  for (std::size_t i = 0; i < y.owned().size(); ++i)
    if (i % 6 < 3) {
      most = std::max(most, y.owned()[i]);
      least = std::min(least, y.owned()[i]);
    }
  most = algebra::max_over_ranks(most, z.layout()->comm);
  least = algebra::min_over_ranks(least, z.layout()->comm);
  const double factor = (most >= -least ? 1 : -1) / (size > 0 ? size : 1);
  for (double& value : y.local()) value *= factor;
  return y;
}

/// Whether stresses leave the stiffness as it is, up to rounding.
bool is_negligible(const algebra::Matrix& geometric, const algebra::Matrix& stiffness) {
  constexpr double rounding = 1e-15;
  const auto size = [](const algebra::Matrix& matrix) {
    Vector ones(matrix.layout(), matrix.block()), sums(ones);
    ones.fill(1);
    matrix.multiply_absolute(ones, sums);
    double largest = 0;
    for (const double sum : sums.owned()) largest = std::max(largest, sum);
    return algebra::max_over_ranks(largest, matrix.layout()->comm);
  };
  return !(size(geometric) > rounding * size(stiffness));
}

/// Returns the largest nu of -K_G v = nu K_M v, descending; no result if K_M is not definite.
std::optional<algebra::Eigenpairs> largest_destabilisations(const algebra::Matrix& stiffness,
                                                            const algebra::Matrix& geometric,
                                                            std::span<const char> fixed,
                                                            const algebra::EigenSettings& settings) {
  if (is_negligible(geometric, stiffness)) return algebra::Eigenpairs{.converged = true};
  algebra::Factorisation factor(stiffness);
  if (!factor.factorise(fixed)) return {};
  const auto apply = [&](const Vector& x, Vector& y) {
    Vector force(x.layout(), x.block());
    geometric.multiply(x, force);
    for (std::size_t i = 0; i < fixed.size(); ++i) force.owned()[i] = fixed[i] ? 0 : -force.owned()[i];
    factor.solve(force, y);
  };
  const auto inner = [&](const Vector& x, Vector& y) { stiffness.multiply(x, y); };
  return algebra::eigenpairs({.layout = stiffness.layout(),
                              .block = stiffness.block(),
                              .apply = apply,
                              .inner_product = inner,
                              .fixed = fixed},
                             algebra::End::largest, settings);
}

/// Touching nodes whose eta is below weak_part of its obstacle's largest.
struct WeakContact {
  std::vector<const assembly::ContactRow*> rows{};  // of owned nodes
  std::int64_t nodes = 0;                           // over all ranks
  double force = 0, area = 0;                       // as parts of those of all touching nodes

  bool is_idle() const { return force < 0.01 && area > 0.5; }
};

WeakContact weak_contact(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  const NodalCoordinates& coordinates = discrete.coordinates;
  const MPI_Comm comm = discrete.space().layout->comm;
  const auto pressure = [&](const assembly::ContactRow& row) {
    return solution.pressure.at(row.node)[static_cast<std::size_t>(row.obstacle)];
  };
  std::vector<double> largest(coordinates.gaps.size(), 0);
  for (const assembly::ContactRow& row : coordinates.rows) {
    double& most = largest[static_cast<std::size_t>(row.obstacle)];
    most = std::max(most, pressure(row));
  }
  for (double& most : largest) most = algebra::max_over_ranks(most, comm);
  WeakContact weak;
  Eigen::Vector2d of_weak(0, 0), of_all(0, 0);  // force, area
  for (const assembly::ContactRow& row : coordinates.rows) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    if (!row.binds || solution.touching.at(row.node)[k] == 0) continue;
    const Eigen::Vector2d own = discrete.points[row.node].weight * Eigen::Vector2d(std::abs(pressure(row)), 1);
    of_all += own;
    if (pressure(row) > Stability::weak_part * largest[k]) continue;
    of_weak += own;
    weak.rows.push_back(&row);
  }
  const auto part = [&](int i) {
    const double all = algebra::sum_over_ranks(of_all[i], comm), of_them = algebra::sum_over_ranks(of_weak[i], comm);
    return all > 0 ? of_them / all : 0;
  };
  weak.nodes = algebra::sum_over_ranks(static_cast<std::int64_t>(weak.rows.size()), comm);
  weak.force = part(0);
  weak.area = part(1);
  return weak;
}

/// Turns a motion so that it opens the gaps of these nodes (collective).
void turn_away(const assembly::DiscreteShell& discrete, const WeakContact& weak, Vector& motion) {
  double opening = 0;
  for (const assembly::ContactRow* row : weak.rows) {
    const obstacle::Gap& gap = discrete.coordinates.gaps[static_cast<std::size_t>(row->obstacle)][row->node];
    opening += discrete.points[row->node].weight *
               gap.normal.dot(Eigen::Map<const Eigen::Vector3d>(motion.at(row->node).data()));
  }
  if (algebra::sum_over_ranks(opening, motion.layout()->comm) < 0)
    for (double& value : motion.local()) value = -value;
}

/// Returns v' K v for a motion v, as a part of the same sum with the absolute values of the diagonal of K alone.
double relative_energy(const Vector& motion, const algebra::Matrix& stiffness, const Vector& diagonal) {
  Vector forces(motion.layout(), motion.block());
  stiffness.multiply(motion, forces);
  double alone = 0;
  for (std::size_t i = 0; i < motion.owned().size(); ++i)
    alone += std::abs(diagonal.owned()[i]) * motion.owned()[i] * motion.owned()[i];
  alone = algebra::sum_over_ranks(alone, motion.layout()->comm);
  return algebra::dot(motion, forces) / alone;
}

/// Whether a motion lowers the energy by more than rounding.
bool is_lowered(double reciprocal, const Vector& motion, const algebra::Matrix& stiffness, const Vector& diagonal) {
  constexpr double rounding = 1e-11;
  return reciprocal * relative_energy(motion, stiffness, diagonal) > rounding;
}

/// Whether a motion has no energy beyond rounding. Rigid motions have up to 3e-16, the first bending of a plate of a
/// thickness of 1e-5 of its length has 4e-11.
bool costs_nothing(const Vector& motion, const algebra::Matrix& stiffness, const Vector& diagonal) {
  constexpr double rounding = 1e-14;
  return std::abs(relative_energy(motion, stiffness, diagonal)) <= rounding;
}

}  // namespace

Modes buckling_modes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, int count,
                     const std::function<bool()>& stop) {
  const SmallMotions motions = small_motions(discrete, solution);
  const algebra::Matrix stiffness = material_matrix(discrete, motions.coordinates),
                        geometric = geometric_matrix(discrete, prestress(discrete, solution), motions.coordinates);
  constexpr int most_restarts = 100;  // without compression the reciprocals of all factors crowd below 0
  const auto pairs = largest_destabilisations(stiffness, geometric, motions.fixed,
                                              {.count = count, .max_restarts = most_restarts, .stop = stop});
  if (!pairs) return {};
  constexpr double never = 1e-9;  // reciprocals of factors, relative to the largest, that are rounding
  const Vector diagonal = geometric.diagonal();
  Modes modes{.has_solution = pairs->converged, .was_stopped = pairs->was_stopped};
  for (std::size_t i = 0; i < pairs->values.size(); ++i) {
    if (!(pairs->values[i] > never * pairs->values[0])) break;
    if (!is_lowered(pairs->values[i], pairs->vectors[i], stiffness, diagonal)) break;
    modes.values.push_back(1 / pairs->values[i]);
    modes.shapes.push_back(shape_of(motions.coordinates, pairs->vectors[i]));
  }
  return modes;
}

namespace {

/// Finds the smallest theta of (K_M + K_G) v = theta K_M v with different sets of fixed coordinates.
class SoftestMotion {
 public:
  SoftestMotion(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                const NodalCoordinates& coordinates)
      : discrete_(discrete),
        solution_(solution),
        coordinates_(coordinates),
        material_(material_matrix(discrete, coordinates)),
        tangent_(hessian(discrete, solution, coordinates)) {}

  /// Holds a controlled displacement.
  void hold(const ControlledPoint& control) {
    const double rho = control.stiffness(material_);
    control.add(rho, material_);
    control.add(rho, tangent_);
  }

  /// Returns theta to three digits with its motion; no result if K_M is not definite (collective).
  std::optional<algebra::Eigenpairs> operator()(std::span<const char> fixed) const {
    const algebra::EigenSettings settings{.count = 1, .tolerance = 1e-3, .max_restarts = 30};
    if (auto pairs = algebra::smallest_eigenpairs(tangent_, material_, fixed, 0, settings); pairs.converged)
      return pairs;
    // A motion lowers the energy, so that the tangent has no Cholesky factor.
    algebra::Matrix geometric = geometric_matrix(discrete_, prestress(discrete_, solution_), coordinates_);
    add_curvature_of_obstacles(discrete_, solution_, geometric);
    auto pairs = largest_destabilisations(material_, geometric, fixed, settings);
    if (pairs)
      for (double& value : pairs->values) value = 1 - value;
    return pairs;
  }

 private:
  const assembly::DiscreteShell& discrete_;
  const solution::NodalSolution& solution_;
  const NodalCoordinates& coordinates_;
  algebra::Matrix material_, tangent_;
};

double margin_of(const std::optional<algebra::Eigenpairs>& pairs) {
  return pairs && !pairs->values.empty() ? std::min(pairs->values[0], 1.0) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

bool has_idle_contact(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  return weak_contact(discrete, solution).is_idle();
}

ExaminedStability examine_stability(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  SmallMotions motions = small_motions(discrete, solution);
  SoftestMotion softest(discrete, solution, motions.coordinates);
  ExaminedStability result;
  Stability& stability = result.stability;
  if (discrete.state.control) {
    stability.margin_under_loads = margin_of(softest(motions.fixed));
    softest.hold(ControlledPoint(discrete));
  }
  const auto held = softest(motions.fixed);
  stability.margin = stability.margin_without_weak_contact = margin_of(held);
  if (stability.margin < 1) result.motion = shape_of(motions.coordinates, held->vectors[0]);
  const WeakContact weak = weak_contact(discrete, solution);
  stability.weak_nodes = weak.nodes;
  if (stability.weak_nodes == 0) return result;
  for (const assembly::ContactRow* row : weak.rows)
    motions.fixed[discrete.coordinates.at(row->node, row->coordinate)] = 0;
  const auto released = softest(motions.fixed);
  stability.margin_without_weak_contact = margin_of(released);
  if (weak.is_idle() && stability.margin_without_weak_contact <= 0) {
    result.away = shape_of(motions.coordinates, released->vectors[0]);
    turn_away(discrete, weak, result.away);
  }
  return result;
}

Modes vibration_modes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, int count,
                      const std::function<bool()>& stop) {
  const SmallMotions motions = small_motions(discrete, solution);
  const algebra::Matrix stiffness = discrete.has_linear_strains()
                                        ? tangent_matrix(discrete, prestress(discrete, solution), motions.coordinates)
                                        : hessian(discrete, solution, motions.coordinates),
                        mass = mass_matrix(discrete, motions.coordinates);
  // A shift makes the stiffness of free motions and of unstable solutions positive. The largest ratio of the diagonals is
  // near the largest square of a frequency.
  const Vector k = stiffness.diagonal(), m = mass.diagonal();
  double largest = 0;
  for (std::size_t i = 0; i < k.owned().size(); ++i)
    if (!motions.fixed[i] && m.owned()[i] > 0) largest = std::max(largest, k.owned()[i] / m.owned()[i]);
  largest = algebra::max_over_ranks(largest, discrete.space().layout->comm);
  algebra::Eigenpairs pairs;
  for (double shift = 0; !pairs.converged && !pairs.was_stopped && shift < largest;
       shift = shift == 0 ? 1e-12 * largest : 10 * shift) {
    pairs = algebra::smallest_eigenpairs(stiffness, mass, motions.fixed, shift, {.count = count, .stop = stop});
    pairs.was_stopped = pairs.was_stopped || (!pairs.converged && stop && stop());
  }
  Modes modes{.has_solution = pairs.converged, .was_stopped = pairs.was_stopped, .values = pairs.values};
  for (std::size_t i = 0; i < pairs.vectors.size(); ++i) {
    if (costs_nothing(pairs.vectors[i], stiffness, k)) modes.values[i] = 0;
    modes.shapes.push_back(shape_of(motions.coordinates, pairs.vectors[i]));
  }
  return modes;
}

}  // namespace plastron::finite
