#include <research/study/measures.hpp>

#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/contact/solve.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plastron::study {

namespace {

/// Some component is prescribed, and not at zero.
bool is_moved_by_support(const assembly::NodalCoordinates& coordinates, std::size_t node) {
  for (int k = 0; k < coordinates.width; ++k)
    if (coordinates.is_prescribed(node, k) && coordinates.lower.local()[coordinates.at(node, k)] != 0) return true;
  return false;
}

/// Supports at zero, the gap's change prescribed at the marked nodes, all else free; no load.
void prescribe_lifting(const assembly::DiscreteShell& discrete, std::span<const char> at, double change,
                       contact::BoxProblem& box) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto width = static_cast<std::size_t>(box.load.block());
  for (std::size_t i = 0; i < box.load.owned().size(); ++i) {
    const std::size_t node = i / width;
    const bool is_gap = i % width == 0 && discrete.coordinates.is_touchable(node);
    const bool fixed = !is_gap && box.lower.owned()[i] == box.upper.owned()[i];
    const bool lifted = is_gap && at[node];
    box.lower.owned()[i] = lifted ? change : fixed ? 0 : -infinity;
    box.upper.owned()[i] = lifted ? change : fixed ? 0 : infinity;
    box.load.owned()[i] = 0;
  }
  box.lower.update_ghosts();
  box.upper.update_ghosts();
}

bool usable(double x, double y) { return x > 0 && y > 0 && std::isfinite(x) && std::isfinite(y); }

}  // namespace

ShellSize shell_size(const assembly::DiscreteShell& discrete) {
  const MPI_Comm comm = discrete.space().layout->comm;
  double area = 0, volume = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    area += discrete.points[i].weight;
    volume += discrete.points[i].weight * discrete.points[i].thickness;
  }
  area = algebra::sum_over_ranks(area, comm);
  return {.area = area,
          .thickness = algebra::sum_over_ranks(volume, comm) / area,
          .mesh_size = std::sqrt(area / static_cast<double>(discrete.space().global_cells))};
}

double rounding_norm(const computation::Solution& solution) {
  constexpr double of_nodal_values = 16 * std::numeric_limits<double>::epsilon();  // they passed a few sums
  // The solver's tolerance is relative to what it starts from: prescribed motions at the supports, nothing elsewhere.
  constexpr double of_prescribed_motion = 1e-12;
  const assembly::DiscreteShell& discrete = *solution.discrete;
  const auto& layout = *discrete.space().layout;
  double area = 0, displacement = 0, rotation = 0, shear = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(layout.owned); ++i) {
    const double* y = solution.nodal.y.local().data() + 6 * i;
    const assembly::NodalPoint& p = discrete.points[i];
    const double error = is_moved_by_support(discrete.coordinates, i) ? of_prescribed_motion : of_nodal_values;
    const double u = y[0] * y[0] + y[1] * y[1] + y[2] * y[2], r = y[3] * y[3] + y[4] * y[4] + y[5] * y[5];
    const double weight = error * error * p.weight * p.young * p.thickness;
    area += p.weight;
    displacement += weight * u;
    rotation += weight * p.thickness * p.thickness * r;
    shear += weight * r;
  }
  area = algebra::sum_over_ranks(area, layout.comm);
  const double degree = discrete.space().degree;
  const double spacing_squared = area / (static_cast<double>(discrete.space().global_cells) * degree * degree);
  const double strains = algebra::sum_over_ranks((displacement + rotation) / spacing_squared + shear, layout.comm);
  return std::sqrt(strains);
}

double relative_noise(const computation::Solution& solution, double energy_norm) {
  const double rounding = rounding_norm(solution);
  if (!(energy_norm > 0)) return std::numeric_limits<double>::infinity();
  return std::max(solver_noise, rounding / energy_norm);
}

algebra::Vector difference(algebra::Vector a, const algebra::Vector& b) {
  for (std::size_t i = 0; i < a.local().size(); ++i) a.local()[i] -= b.local()[i];
  return a;
}

double relative_distance(const energy::ShellOperator& shell, const algebra::Vector& y,
                         const algebra::Vector& reference) {
  const double scale = shell.energies(reference).total();
  const double distance = shell.energies(difference(y, reference)).total();
  return scale > 0 ? std::sqrt(distance / scale) : no_value;
}

double relative_difference(double value, double reference) {
  return reference != 0 ? value / reference - 1 : value == 0 ? 0 : no_value;
}

std::optional<double> lifting_norm(const assembly::DiscreteShell& discrete, std::span<const char> at, double change) {
  std::int64_t marked = 0;
  for (const char mark : at) marked += mark != 0;
  if (algebra::sum_over_ranks(marked, discrete.space().layout->comm) == 0) return 0;
  const algebra::Matrix A = assembly::stiffness_matrix(discrete);
  algebra::Factorisation F(A);
  contact::BoxProblem box = assembly::box_problem(discrete, A);
  prescribe_lifting(discrete, at, change, box);
  contact::BoxSolution w = contact::solve(box, {}, F);
  if (w.status != contact::Status::solved) return {};
  algebra::Vector force(w.z.layout(), w.z.block());
  w.z.update_ghosts();
  box.apply(w.z, force);
  return std::sqrt(std::max(0.0, algebra::dot(w.z, force)));
}

std::vector<double> local_exponents(std::span<const double> x, std::span<const double> y) {
  std::vector<double> exponents(x.size(), no_value);
  for (std::size_t i = 1; i < x.size(); ++i)
    if (usable(x[i - 1], y[i - 1]) && usable(x[i], y[i]))
      exponents[i] = std::log(y[i] / y[i - 1]) / std::log(x[i] / x[i - 1]);
  return exponents;
}

double fitted_exponent(std::span<const double> x, std::span<const double> y, std::size_t last) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = x.size() > last ? x.size() - last : 0; i < x.size(); ++i) {
    if (!usable(x[i], y[i])) continue;
    const double a = std::log(x[i]), b = std::log(y[i]);
    n += 1;
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  const double spread = n * sxx - sx * sx;
  return n < 2 || !(spread > 1e-12 * n * sxx) ? no_value : (n * sxy - sx * sy) / spread;
}

std::size_t last_step_above(std::span<const double> values, double noise) {
  for (std::size_t i = values.size(); i-- > 1;)
    if (values[i - 1] > noise && values[i] > noise) return i;
  return 0;
}

}  // namespace plastron::study
