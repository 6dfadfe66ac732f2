// The table of errors over mesh size, with and without obstacle, and what it says about the orders that theory gives
// (docs/research/convergence.md).
#include <plastron/meshing/sizes.hpp>
#include <research/study/error_sequence.hpp>
#include <research/study/measures.hpp>
#include <research/study/studies.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plastron::study {

namespace {

using Sequence = ErrorSequence;

Table convergence_table() {
  return {.name = "convergence",
          .title = "How fast does the error fall with the mesh size?",
          .columns = {{"obstacle", "", "-"},
                      {"level", "", "1"},
                      {"cells", "", "1"},
                      {"unknowns", "", "1"},
                      {"mesh size", "h", "m"},
                      {"energy", "|U - U_h|_a", "1"},
                      {"H1", "|U - U_h|_1", "1"},
                      {"L2", "|U - U_h|_0", "1"},
                      {"H1 of u", "|u - u_h|_1", "1"},
                      {"H1 of r", "|r - r_h|_1", "1"},
                      {"L2 of u", "|u - u_h|_0", "1"},
                      {"L2 of r", "|r - r_h|_0", "1"},
                      {"energy rate", "", "1"},
                      {"H1 rate", "", "1"},
                      {"L2 rate", "", "1"},
                      {"interpolation", "|U - W_h|_a", "1"},
                      {"reaction", "(2 <l - A U, U - W_h + U_h - W>)^{1/2}", "1"},
                      {"consistency", "2 kappa", "1"},
                      {"right side", "", "1"},
                      {"right / left", "", "1"},
                      {"right rate", "", "1"},
                      {"right side in L2", "", "1"},
                      {"right rate in L2", "", "1"}}};
}

using Side = double (*)(const FalkTerms&);
double positive_root(double x) { return std::sqrt(std::max(0.0, x)); }
double interpolation(const FalkTerms& f) { return positive_root(f.interpolation); }
double reaction(const FalkTerms& f) { return std::copysign(std::sqrt(2 * std::abs(f.reaction)), f.reaction); }
double consistency(const FalkTerms& f) { return 2 * f.consistency; }
double right_side(const FalkTerms& f) { return positive_root(f.interpolation + 2 * f.reaction); }
double right_over_left(const FalkTerms& f) { return right_side(f) / positive_root(f.error); }
double right_side_in_l2(const FalkTerms& f) { return positive_root(f.interpolation + 2 * f.l2_reaction); }

/// One side of the estimate on every mesh; NaN where the estimate cannot be evaluated.
std::vector<double> of_estimate(const Sequence& s, Side side) {
  std::vector<double> values(s.errors.size(), NAN);
  for (std::size_t l = 0; l < s.falk.size(); ++l) values[l] = side(s.falk[l]);
  return values;
}

void add_rows(const Sequence& s, const std::string& obstacle, Table& table) {
  const std::array<std::vector<double>, 8> sides{
      of_estimate(s, interpolation),    of_estimate(s, reaction),
      of_estimate(s, consistency),      of_estimate(s, right_side),
      of_estimate(s, right_over_left),  local_exponents(s.h, of_estimate(s, right_side)),
      of_estimate(s, right_side_in_l2), local_exponents(s.h, of_estimate(s, right_side_in_l2))};
  const auto energy = local_exponents(s.h, s.of(&Norms::energy));
  const auto h1 = local_exponents(s.h, s.of(&Norms::h1)), l2 = local_exponents(s.h, s.of(&Norms::l2));
  for (std::size_t l = 0; l < s.errors.size(); ++l) {
    std::vector<Entry> row{obstacle, static_cast<std::int64_t>(l), s.levels[l].cells, s.levels[l].unknowns, s.h[l]};
    for (const auto norm : norm_of) row.emplace_back(s.errors[l].*norm);
    row.insert(row.end(), {energy[l], h1[l], l2[l]});
    for (const auto& side : sides) row.emplace_back(side[l]);
    table.rows.push_back(std::move(row));
  }
}

/// Errors below the noise have no exponent.
void add_fits(const Sequence& s, const std::string& obstacle, Table& table) {
  for (const auto& [name, norm] :
       {std::pair{"energy error", &Norms::energy}, {"H1 error", &Norms::h1}, {"L2 error", &Norms::l2}}) {
    auto errors = s.of(norm);
    for (double& e : errors)
      if (!(e > s.noise)) e = NAN;
    table.fits.push_back({fmt::format("{}, {}", name, obstacle), "h", fitted_exponent(s.h, errors)});
  }
  if (s.falk.empty() || !(s.of(&Norms::energy).back() > s.noise)) return;
  for (const auto& [name, side] :
       {std::pair<const char*, Side>{"right side", right_side}, {"right side in L2", right_side_in_l2}})
    table.fits.push_back({fmt::format("{}, {}", name, obstacle), "h", fitted_exponent(s.h, of_estimate(s, side))});
}

/// Errors in the energy norm of the levels that say something: above rounding and, with obstacle, in contact with it. NaN
/// for the others.
std::vector<double> telling(const Sequence& s, bool with_obstacle) {
  auto errors = s.of(&Norms::energy);
  const bool touches = !with_obstacle || s.levels.back().active > 0;
  for (std::size_t l = 0; l < errors.size(); ++l)
    if (!touches || (with_obstacle && s.levels[l].active == 0)) errors[l] = NAN;
  return errors;
}

/// Why no two meshes can be compared; empty if two can.
std::string nothing_to_compare(const Sequence& s, const std::vector<double>& errors, bool with_obstacle) {
  if (errors.size() < 2) return "one mesh has no rate; take more refinements";
  if (!(s.energy_norm > 0) || !(s.noise < too_noisy))
    return fmt::format("the solution has no energy beyond rounding, {:.1e} J", s.energy_norm * s.energy_norm / 2);
  if (last_step_above(errors, s.noise) > 0) return "";
  if (with_obstacle && s.levels.back().active == 0) return "the shell does not touch the obstacle";
  if (std::ranges::count_if(errors, [](double e) { return !std::isnan(e); }) < 2)
    return "the shell touches the obstacle on fewer than two of the meshes; take more refinements";
  return fmt::format("the errors are rounding: less than {:.0e} of the solution", s.noise);
}

std::string listed(const std::vector<double>& errors) {
  std::vector<std::string> texts;
  texts.reserve(errors.size());
  for (const double e : errors) texts.push_back(std::isnan(e) ? "-" : fmt::format("{:.2e}", e));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// From every mesh whose error is more than rounding to the next one.
bool falls(const std::vector<double>& errors, double noise) {
  for (std::size_t l = 1; l < errors.size(); ++l)
    if (errors[l - 1] > noise && errors[l] >= errors[l - 1]) return false;
  return true;
}

/// Between the finest two meshes that say something.
Claim reaches(const Sequence& s, const std::vector<double>& errors, const std::string& statement, double order) {
  constexpr double slack = 0.25;  // of a rate measured on few meshes
  const std::size_t fine = last_step_above(errors, s.noise);
  const double rate = local_exponents(s.h, errors)[fine];
  return judged(statement, fmt::format("h^{:.2f} between meshes {} and {}", rate, fine - 1, fine),
                rate >= order - slack);
}

/// Compares the errors of all meshes that are above rounding. Differences of forms and spaces between meshes may be added.
Claim is_below_right_side(const Sequence& s, const std::vector<double>& errors, const std::string& statement) {
  if (!s.why_without_falk.empty()) return not_judged(statement, s.why_without_falk);
  constexpr double rounding = 1e-6;
  std::vector<std::string> ratios;
  bool holds = true;
  for (std::size_t l = 0; l < errors.size(); ++l) {
    if (!(errors[l] > s.noise)) continue;
    const FalkTerms& f = s.falk[l];
    ratios.push_back(fmt::format("{:.3f}", right_over_left(f)));
    holds = holds && f.error <= (1 + rounding) * (f.interpolation + 2 * f.reaction + 2 * std::abs(f.consistency));
  }
  return judged(statement, fmt::format("right / left {}", fmt::join(ratios, ", ")), holds);
}

void add_claims(const Sequence& s, bool with_obstacle, int degree, Table& table) {
  const std::string obstacle = with_obstacle ? "with obstacle" : "without obstacle";
  const double order = with_obstacle ? std::min<double>(degree, 1.25) : degree;
  const std::string falling = obstacle + ": the error in the energy norm falls from mesh to mesh";
  const std::string reaching = fmt::format("{}: the energy error falls like h^{:.3g} or faster ({})", obstacle, order,
                                           with_obstacle ? "Falk's estimate" : "Cea's lemma, a smooth solution");
  const std::string below = fmt::format("{}: {}, both sides evaluated: |U - U_h|_a is no more than the right side",
                                        obstacle, with_obstacle ? "Falk's estimate" : "Cea's lemma");
  const auto errors = telling(s, with_obstacle);
  if (const std::string why = nothing_to_compare(s, errors, with_obstacle); !why.empty()) {
    table.claims.push_back(not_judged(falling, why));
    table.claims.push_back(not_judged(reaching, why));
    table.claims.push_back(not_judged(below, why));
    return;
  }
  table.claims.push_back(judged(falling, listed(errors), falls(errors, s.noise)));
  table.claims.push_back(reaches(s, errors, reaching, order));
  table.claims.push_back(is_below_right_side(s, errors, below));
}

void add_series(const Sequence& s, const std::string& obstacle, bool dashed, io::Plot& plot) {
  for (const auto& [name, norm] : {std::pair{"energy", &Norms::energy}, {"H1", &Norms::h1}, {"L2", &Norms::l2}})
    plot.series.push_back({fmt::format("{}, {}", name, obstacle), s.h, s.of(norm), dashed});
  if (!s.falk.empty())
    plot.series.push_back({fmt::format("right side, {}", obstacle), s.h, of_estimate(s, right_side), dashed});
}

void add(const Sequence& s, bool with_obstacle, int degree, Report& report) {
  const std::string obstacle = with_obstacle ? "with obstacle" : "without obstacle";
  add_rows(s, with_obstacle ? "with" : "without", report.table);
  if (s.errors.size() > 1) add_fits(s, obstacle, report.table);
  add_claims(s, with_obstacle, degree, report.table);
  add_series(s, obstacle, with_obstacle, report.plot);
}

void add_slopes(int degree, io::Plot& plot) {
  plot.slopes.push_back({static_cast<double>(degree), fmt::format("slope {}", degree)});
  plot.slopes.push_back({degree + 1.0, fmt::format("slope {}", degree + 1)});
  if (plot.series.size() > 4 && degree > 1) plot.slopes.push_back({1.5, "slope 3/2"});
}

}  // namespace

Report convergence(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                   const StudyObserver& observer) {
  const int degree = problem.discretisation.degree;
  const double length = meshing::extent(problem);
  Report report{
      .table = convergence_table(),
      .plot = {.title = "Error against the mesh size", .x = {"mesh size h [m]", true}, .y = {"relative error", true}}};
  report.table.remarks.push_back(fmt::format(
      "errors are relative to a solution {} levels finer than the finest mesh compared, and measured on its mesh",
      options.reference));
  report.table.remarks.push_back(fmt::format(
      "H1 and L2 take the shell's own length L = {:.4g} m, half the diagonal of the box around it, as unit of "
      "length",
      length));
  report.table.remarks.emplace_back(
      "right side: (interpolation^2 + reaction^2)^(1/2), reaction^2 with the sign of reaction; consistency: 2 kappa, "
      "what tying, quadrature and tangency at nodes may add to its square");
  problem::Problem alone = problem;
  alone.shell.obstacles.all.clear();
  if (observer.stage) observer.stage("without obstacle");
  const Sequence free = error_sequence(alone, options.reference, length, comm, observer.solve);
  const bool held = free.status != contact::Status::singular;
  if (held || problem.shell.obstacles.empty()) {
    report.status = free.status;
    if (free.status != contact::Status::solved) return report;
    add(free, false, degree, report);
  } else {
    report.table.remarks.push_back("the supports alone do not hold the shell, so it is solved with the obstacle only");
  }
  if (!problem.shell.obstacles.empty()) {
    if (observer.stage) observer.stage("with obstacle");
    const Sequence pressed = error_sequence(problem, options.reference, length, comm, observer.solve);
    report.status = pressed.status;
    if (pressed.status != contact::Status::solved) return report;
    add(pressed, true, degree, report);
  }
  add_slopes(degree, report.plot);
  return report;
}

}  // namespace plastron::study
