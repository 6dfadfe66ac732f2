// U_p is followed down to the smallest p that can be computed. Two references on the same mesh: the last U_p, which shows
// the rate in p undisturbed by the mesh, and the tangent solution, which shows where the mesh and locking take over.
#include <plastron/study/penalty.hpp>

#include <plastron/study/exponents.hpp>
#include <plastron/study/solve.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace plastron::study {

namespace {

using assembly::Formulation;

struct Sample {
  double p = 0;
  contact::Status status = contact::Status::solved;
  Level finest{};
  double tilt_energy = 0;  ///< of the penalty [J]
  algebra::Vector y{};
};

Sample solve_for(Problem problem, const assembly::Tangency& tangency, MPI_Comm comm, const Observer& observer,
                 std::optional<Solution>* keep = nullptr) {
  problem.discretisation.tangency = tangency;
  problem.probes.clear();
  Result result = solve(problem, comm, observer);
  Sample sample{.p = tangency.penalty, .status = result.status};
  if (!result.levels.empty()) sample.finest = result.levels.back();
  sample.tilt_energy = result.summary.tilt_energy;
  if (result.solution) sample.y = result.solution->nodal.y;
  if (keep) *keep = std::move(result.solution);
  return sample;
}

/// || y - reference ||_a / || reference ||_a
double relative_distance(const assembly::ShellOperator& shell, algebra::Vector y, const algebra::Vector& reference) {
  for (std::size_t i = 0; i < y.local().size(); ++i) y.local()[i] -= reference.local()[i];
  return std::sqrt(shell.energies(y).total() / shell.energies(reference).total());
}

/// The penalty's energy falls like p once p is small. Where it rises again, or the solver fails, rounding decides.
class Conditioning {
 public:
  bool spoils(const Sample& s) {
    const bool failed = s.status != contact::Status::solved || s.finest.linear_residual > 1e-8;
    if (failed || (has_fallen_ && s.tilt_energy > 1.5 * least_)) return true;
    has_fallen_ = has_fallen_ || s.tilt_energy < 0.5 * last_;
    last_ = s.tilt_energy;
    least_ = std::min(least_, last_);
    return false;
  }

 private:
  bool has_fallen_ = false;
  double last_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
};

/// r . a_3 takes no part: flat shells.
bool is_idle(const Sample& s) { return s.tilt_energy < 1e-20 * s.finest.energy; }

Table empty_table() {
  return {.name = "penalty",
          .title = "Does the penalised solution converge as the penalty parameter goes to zero?",
          .columns = {{"penalty", "p", "1"},
                      {"to the limit", "|U_p - U_0|_a", "1"},
                      {"to tangent", "|U_p - U|_a", "1"},
                      {"tilt", "max |r.a3|", "1"},
                      {"penalty energy", "", "J"},
                      {"energy", "1/2 a(U,U)", "J"},
                      {"reaction", "|R|", "N"},
                      {"steps", "", "1"},
                      {"residual", "", "1"}}};
}

/// Theorem 3 and Remark 4: r . a_3 and with it U_p - U_0 go to zero with p.
void add_claims(const std::vector<double>& p, const std::vector<double>& to_limit, const std::vector<double>& tilt,
                bool is_idle, Table& table) {
  const double exponent = fitted_exponent(p, tilt, p.size());
  const auto falls = [](std::span<const double> values) {
    return std::ranges::adjacent_find(values, std::less_equal<>{}) == values.end();
  };
  const std::string none = "zero up to rounding: r . a_3 takes no part on this shell";
  table.fits.push_back({"tilt", "p", exponent});
  table.claims.push_back(
      {.statement = "the largest |r . a_3| falls with p",
       .measured = is_idle ? none : fmt::format("like p^{:.2f} from p = 1 to {:g}", exponent, p.back()),
       .holds = is_idle || falls(tilt)});
  table.claims.push_back({.statement = "U_p approaches its limit on this mesh with p",
                          .measured = is_idle
                                          ? none
                                          : fmt::format("relative distance from the last U_p {:.1e} at p = 1, {:.1e} "
                                                        "at the last p before",
                                                        to_limit.front(), to_limit[to_limit.size() - 2]),
                          .holds = is_idle || falls(std::span(to_limit))});
}

}  // namespace

Report penalty(const Problem& problem, const StudyOptions&, MPI_Comm comm, const StudyObserver& observer) {
  constexpr int most_decades = 16;
  Report report{.table = empty_table(),
                .plot = {.title = "Penalised formulation as p goes to zero",
                         .x = {"penalty p", true},
                         .y = {"relative difference in the energy norm, largest |r.a3|", true}}};
  if (observer.stage) observer.stage("tangent");
  std::optional<Solution> kept;
  const Sample tangent = solve_for(problem, {}, comm, observer.solve, &kept);
  report.status = tangent.status;
  if (tangent.status != contact::Status::solved) return report;
  const assembly::ShellOperator& shell = kept->discrete->shell;

  std::vector<Sample> samples;
  Conditioning conditioning;
  std::string end = "no end was met";
  for (int decade = 0; decade <= most_decades; ++decade) {
    const double p = std::pow(10.0, -decade);
    if (observer.stage) observer.stage(fmt::format("p = {:g}", p));
    Sample s = solve_for(problem, {.formulation = Formulation::penalised, .penalty = p}, comm, observer.solve);
    if (s.status == contact::Status::interrupted) {
      report.status = s.status;
      end = contact::explain(s.status);
      break;
    }
    if (conditioning.spoils(s)) {
      end = fmt::format(
          "conditioning stops it at p = {:g}, where rounding and no longer p decides the penalty's energy ({}, "
          "relative "
          "residual {:.1e}, {:.1e} J)",
          p, contact::to_string(s.status), s.finest.linear_residual, s.tilt_energy);
      break;
    }
    samples.push_back(std::move(s));
    if (samples.size() > 2 && is_idle(samples.back())) {
      end = "r . a_3 takes no part on this shell: no smaller p was tried";
      break;
    }
  }
  if (samples.empty() && report.status == contact::Status::interrupted) return report;
  if (samples.empty()) return report.status = contact::Status::linear_solver_stalled, report;

  std::vector<double> p, to_limit, to_tangent, tilt;
  for (const Sample& s : samples) {
    p.push_back(s.p);
    to_limit.push_back(relative_distance(shell, s.y, samples.back().y));
    to_tangent.push_back(relative_distance(shell, s.y, tangent.y));
    tilt.push_back(s.finest.max_tilt);
    report.table.rows.push_back({s.p, &s == &samples.back() ? std::nan("") : to_limit.back(), to_tangent.back(),
                                 tilt.back(), s.tilt_energy, s.finest.energy, s.finest.reaction,
                                 static_cast<std::int64_t>(s.finest.iterations), s.finest.linear_residual});
  }
  add_claims(p, to_limit, tilt, is_idle(samples.back()), report.table);
  const auto nearest = std::ranges::min_element(to_tangent);
  report.table.remarks.push_back(fmt::format(
      "closest to the tangent formulation at p = {:g}: {:.2e}; with smaller p the elements lock, for polynomials "
      "cannot "
      "keep r . a_3 = 0 between the nodes of a curved chart: the less, the higher the degree and the finer the mesh",
      p[static_cast<std::size_t>(nearest - to_tangent.begin())], *nearest));
  report.table.remarks.push_back(end);
  to_limit.pop_back();
  report.plot.series = {{"to the limit", {p.begin(), p.end() - 1}, to_limit},
                        {"to the tangent formulation", p, to_tangent},
                        {"largest |r.a3|", p, tilt, true}};
  report.plot.slopes = {{1, "slope 1"}};
  return report;
}

}  // namespace plastron::study
