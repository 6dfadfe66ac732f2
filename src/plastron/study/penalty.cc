// U_p is followed down to the smallest p that can be computed. Two references on the same mesh: the last U_p, which shows
// the rate in p undisturbed by the mesh, and the tangent solution, which shows where the mesh and locking take over.
#include <plastron/study/penalty.hpp>

#include <plastron/computation/solve.hpp>
#include <plastron/study/energy_distance.hpp>
#include <plastron/study/exponents.hpp>
#include <plastron/study/formulations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::study {

namespace {

using element::Formulation;

struct Sample {
  double p = 0;
  contact::Status status = contact::Status::solved;
  computation::Level finest{};
  double tangency_energy = 0;  ///< of the penalty [J]
  algebra::Vector y{};
};

Sample solve_for(computation::Problem problem, const element::Tangency& tangency, MPI_Comm comm,
                 const computation::Observer& observer, std::optional<computation::Solution>* keep = nullptr) {
  problem.discretisation.tangency = tangency;
  problem.probes.clear();
  computation::Result result = computation::solve(problem, comm, observer);
  Sample sample{.p = tangency.penalty, .status = result.status};
  if (!result.levels.empty()) sample.finest = result.levels.back();
  sample.tangency_energy = result.summary.tangency_energy;
  if (result.solution) sample.y = result.solution->nodal.y;
  if (keep) *keep = std::move(result.solution);
  return sample;
}

/// The penalty's energy falls like p once p is small. Where it rises again, or the solver fails, rounding decides.
class Conditioning {
 public:
  bool spoils(const Sample& s) {
    const bool failed = s.status != contact::Status::solved || s.finest.linear_residual > 1e-8;
    if (failed || (has_fallen_ && s.tangency_energy > 1.5 * least_)) return true;
    has_fallen_ = has_fallen_ || s.tangency_energy < 0.5 * last_;
    last_ = s.tangency_energy;
    least_ = std::min(least_, last_);
    return false;
  }

 private:
  bool has_fallen_ = false;
  double last_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
};

/// r . a_3 takes no part: flat shells, and such as do not move.
bool is_idle(const Sample& s) { return s.tangency_energy <= 1e-20 * s.finest.energy; }

/// What the rows say, from p = 1 downwards.
struct Followed {
  std::vector<double> p{}, to_limit{}, to_tangent{}, normal_rotation{};
  std::vector<double> step{};  ///< |U_p - U_{10 p}|_a, relative; NaN for the first
  double noise = 0;            ///< relative, in the energy norm
  bool is_idle = false;
};

Table empty_table() {
  return {.name = "penalty",
          .title = "Does the penalised solution converge as the penalty parameter goes to zero?",
          .columns = {{"penalty", "p", "1"},
                      {"to the limit", "|U_p - U_0|_a", "1"},
                      {"to tangent", "|U_p - U|_a", "1"},
                      {"normal_rotation", "max |r.a3|", "1"},
                      {"penalty energy", "", "J"},
                      {"energy", "1/2 a(U,U)", "J"},
                      {"reaction", "|R|", "N"},
                      {"steps", "", "1"},
                      {"residual", "", "1"}}};
}

/// Why nothing can be said; empty if something can.
std::string nothing_to_say(const Followed& f) {
  if (!(f.noise < too_noisy)) return "the solution has no energy beyond rounding";
  if (f.is_idle) return "r . a_3 takes no part on this shell: it is zero up to rounding";
  if (f.p.size() < 3) return fmt::format("only {} values of p could be computed", f.p.size());
  return "";
}

/// Theorem 3 and Remark 4: r . a_3 and with it U_p - U_0 go to zero with p. A sequence that only drifts, like log p, has steps
/// that do not fall; those to a limit fall like p, wherever they begin to (before, the mesh's locking sets in).
void add_claims(const Followed& f, Table& table) {
  constexpr double least_exponent = 0.5;
  const std::string falling = "the largest |r . a_3| falls with p", approaching =
                                                                        "U_p approaches its limit on this mesh "
                                                                        "with p";
  if (const std::string why = nothing_to_say(f); !why.empty()) {
    table.claims = {not_judged(falling, why), not_judged(approaching, why)};
    return;
  }
  const double exponent = fitted_exponent(f.p, f.normal_rotation, f.p.size());
  table.fits.push_back({"normal_rotation", "p", exponent});
  table.claims.push_back(
      judged(falling, fmt::format("like p^{:.2f} from p = 1 to {:g}", exponent, f.p.back()),
             exponent > least_exponent &&
                 std::ranges::adjacent_find(f.normal_rotation, std::less_equal<>{}) == f.normal_rotation.end()));
  const std::size_t last = last_step_above(f.step, f.noise);
  if (last == 0) {
    table.claims.push_back(not_judged(
        approaching, fmt::format("from one p to the next U_p changes by less than the noise, {:.0e}", f.noise)));
    return;
  }
  const double rate = local_exponents(f.p, f.step)[last];
  table.fits.push_back({"change of U_p", "p", rate});
  table.claims.push_back(
      judged(approaching,
             fmt::format("its changes from one p to the next fall like p^{:.2f}, down to {:.1e} at p "
                         "= {:g}",
                         rate, f.step[last], f.p[last]),
             rate > least_exponent));
}

void add_rows(const std::vector<Sample>& samples, const Followed& f, Table& table) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    table.rows.push_back({s.p, i + 1 == samples.size() ? NAN : f.to_limit[i], f.to_tangent[i], f.normal_rotation[i],
                          s.tangency_energy, s.finest.energy, s.finest.reaction,
                          static_cast<std::int64_t>(s.finest.iterations), s.finest.linear_residual});
  }
}

Followed follow(const std::vector<Sample>& samples, const Sample& tangent, const computation::Solution& kept) {
  const assembly::ShellOperator& shell = kept.discrete->shell;
  Followed f{.noise = relative_noise(kept, std::sqrt(2 * tangent.finest.energy)), .is_idle = is_idle(samples.back())};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    f.p.push_back(s.p);
    f.to_limit.push_back(relative_distance(shell, s.y, samples.back().y));
    f.to_tangent.push_back(relative_distance(shell, s.y, tangent.y));
    f.normal_rotation.push_back(s.finest.max_normal_rotation);
    f.step.push_back(i > 0 ? relative_distance(shell, s.y, samples[i - 1].y) : NAN);
    f.noise = std::max(f.noise, s.finest.linear_residual);
  }
  return f;
}

/// The decades of p until conditioning ends them or somebody interrupts, and a sentence on what did.
std::string solve_decades(const computation::Problem& problem, MPI_Comm comm, const StudyObserver& observer,
                          std::vector<Sample>& samples, contact::Status& status) {
  constexpr int most_decades = 16;
  Conditioning conditioning;
  for (int decade = 0; decade <= most_decades; ++decade) {
    const double p = std::pow(10.0, -decade);
    if (observer.stage) observer.stage(fmt::format("p = {:g}", p));
    Sample s = solve_for(problem, {.formulation = Formulation::penalised, .penalty = p}, comm, observer.solve);
    if (s.status == contact::Status::interrupted) {
      status = s.status;
      return std::string(contact::explain(s.status));
    }
    if (conditioning.spoils(s))
      return fmt::format(
          "conditioning stops it at p = {:g}, where rounding and no longer p decides the penalty's energy ({}, "
          "relative "
          "residual {:.1e}, {:.1e} J)",
          p, contact::to_string(s.status), s.finest.linear_residual, s.tangency_energy);
    samples.push_back(std::move(s));
    if (samples.size() > 2 && is_idle(samples.back()))
      return "r . a_3 takes no part on this shell: no smaller p was tried";
  }
  return "no end was met";
}

Plot plot_of(const Followed& f) {
  return {.title = "Penalised formulation as p goes to zero",
          .x = {"penalty p", true},
          .y = {"relative difference in the energy norm, largest |r.a3|", true},
          .series = {{"to the limit", {f.p.begin(), f.p.end() - 1}, {f.to_limit.begin(), f.to_limit.end() - 1}},
                     {"to the tangent formulation", f.p, f.to_tangent},
                     {"largest |r.a3|", f.p, f.normal_rotation, true}},
          .slopes = {{1, "slope 1"}}};
}

}  // namespace

std::vector<Variant> penalty_variants(const computation::Problem& problem, const StudyOptions&) {
  return {{"the tangent formulation", in_formulation(problem, Formulation::tangent)},
          {"the penalised formulation", in_formulation(problem, Formulation::penalised)}};
}

Report penalty(const computation::Problem& problem, const StudyOptions&, MPI_Comm comm, const StudyObserver& observer) {
  Report report{.table = empty_table(), .plot = {}};
  if (observer.stage) observer.stage("tangent");
  std::optional<computation::Solution> kept;
  const Sample tangent = solve_for(problem, {.formulation = Formulation::tangent}, comm, observer.solve, &kept);
  report.status = tangent.status;
  if (tangent.status != contact::Status::solved) return report;
  std::vector<Sample> samples;
  const std::string end = solve_decades(problem, comm, observer, samples, report.status);
  if (samples.empty() && report.status == contact::Status::interrupted) return report;
  if (samples.empty()) return report.status = contact::Status::linear_solver_stalled, report;
  const Followed followed = follow(samples, tangent, *kept);
  add_rows(samples, followed, report.table);
  add_claims(followed, report.table);
  if (nothing_to_say(followed).empty()) {
    const auto nearest = std::ranges::min_element(followed.to_tangent);
    report.table.remarks.push_back(fmt::format(
        "closest to the tangent formulation at p = {:g}: {:.2e}; with smaller p the elements lock, for polynomials "
        "cannot "
        "keep r . a_3 = 0 between the nodes of a curved chart: the less, the higher the degree and the finer the mesh",
        followed.p[static_cast<std::size_t>(nearest - followed.to_tangent.begin())], *nearest));
  }
  report.table.remarks.push_back(end);
  report.plot = plot_of(followed);
  return report;
}

}  // namespace plastron::study
