// U_p is followed from p = 1 downwards and set against the tangent solution U on the same meshes. Theorem 3 makes their
// difference fall with p; locking, which falls with the mesh, makes it rise again: docs/research/penalty.md.
#include <plastron/computation/solve.hpp>
#include <research/study/measures.hpp>
#include <research/study/studies.hpp>
#include <research/study/variations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace plastron::study {

namespace {

using element::Formulation;

struct Sample {
  double p = 0;
  contact::Status status = contact::Status::solved;
  computation::Level finest{};
  double tangency_energy = 0;        ///< of the penalty [J]
  std::vector<double> to_tangent{};  ///< |U_p - U|_a on each mesh, relative
  algebra::Vector y{};               ///< on the finest mesh
};

/// The tangent solution U with its nodal values on each mesh.
struct Tangent {
  computation::Result result;
  std::vector<algebra::Vector> fields{};
};

Tangent solve_tangent(problem::Problem problem, MPI_Comm comm, computation::Observer observer) {
  problem.shell.tangency = {.formulation = Formulation::tangent};
  problem.probes.clear();
  Tangent tangent;
  observer.solution = [&](int, const computation::Solution& s) { tangent.fields.push_back(s.nodal.y); };
  tangent.result = computation::solve(problem, comm, observer);
  return tangent;
}

Sample solve_penalised(problem::Problem problem, double p, const Tangent& tangent, MPI_Comm comm,
                       computation::Observer observer) {
  problem.shell.tangency = {.formulation = Formulation::penalised, .penalty = p};
  problem.probes.clear();
  Sample sample{.p = p};
  observer.solution = [&](int level, const computation::Solution& s) {
    const algebra::Vector& u = tangent.fields.at(static_cast<std::size_t>(level));
    sample.to_tangent.push_back(relative_distance(s.discrete->shell, s.nodal.y, u));
  };
  const computation::Result result = computation::solve(problem, comm, observer);
  sample.status = result.status;
  if (!result.levels.empty()) sample.finest = result.levels.back();
  sample.tangency_energy = result.summary.tangency_energy;
  if (result.solution) sample.y = result.solution->nodal.y;
  return sample;
}

/// Says where following p ends. P = 1/(2p) c(r_p, r_p), the penalty's energy, is how fast the least potential energy J_p rises
/// as p falls, P = -dJ_p / d log p, so the sum of what the fields lose that lock near p. P falls like p once those of the
/// solution have; where it rises again, fields lock that have even less r . a_3 between the nodes.
class Descent {
 public:
  /// A sentence on why p is the last one; empty to go on.
  std::string end_at(const Sample& s) {
    if (s.status != contact::Status::solved || s.finest.linear_residual > 1e-8)
      return fmt::format("the solver ends it at p = {:g} ({}, relative residual {:.1e})", s.p,
                         contact::to_string(s.status), s.finest.linear_residual);
    if (has_fallen_ && s.tangency_energy > 1.5 * least_)
      return fmt::format(
          "no p below {:g} was tried: from there on the penalty's energy rises again ({:.1e} J), for fields lock that "
          "have even less r . a_3 between the nodes, and smaller p say nothing of the shell",
          s.p, s.tangency_energy);
    has_fallen_ = has_fallen_ || s.tangency_energy < 0.5 * last_;
    last_ = s.tangency_energy;
    least_ = std::min(least_, last_);
    return "";
  }

 private:
  bool has_fallen_ = false;
  double last_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
};

/// r . a_3 takes no part: flat shells, and such as do not move.
bool is_idle(const Sample& s) { return s.tangency_energy <= 1e-20 * s.finest.energy; }

/// The values of the rows in the order of falling p, from p = 1.
struct Followed {
  std::vector<double> p{}, normal_rotation{};
  std::vector<double> to_tangent{};   ///< |U_p - U|_a on the finest mesh, relative
  std::vector<double> mesh_before{};  ///< the same on the one before; NaN if there is none
  std::vector<double> change{};       ///< |U_p - U_{10 p}|_a, relative; NaN for the first
  double noise = 0;                   ///< relative, in the energy norm
  bool is_idle = false;
};

Table penalty_table() {
  return {.name = "penalty",
          .title = "Does the penalised solution converge as the penalty parameter goes to zero?",
          .columns = {{"penalty", "p", "1"},
                      {"to tangent", "|U_p - U|_a", "1"},
                      {"mesh before", "|U_p - U|_a", "1"},
                      {"change", "|U_p - U_10p|_a", "1"},
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

constexpr double least_exponent = 0.5;

/// Remark 4: r . a_3 goes to zero with p.
Claim normal_rotation_falls(const Followed& f, Table& table) {
  const std::string statement = "the largest |r . a_3| falls with p";
  if (const std::string why = nothing_to_say(f); !why.empty()) return not_judged(statement, why);
  const double exponent = fitted_exponent(f.p, f.normal_rotation, f.p.size());
  table.fits.push_back({"normal_rotation", "p", exponent});
  const bool falls = std::ranges::adjacent_find(f.normal_rotation, std::less_equal<>{}) == f.normal_rotation.end();
  return judged(statement, fmt::format("like p^{:.2f} from p = 1 to {:g}", exponent, f.p.back()),
                exponent > least_exponent && falls);
}

/// |U_p - U|_a is no matter of the mesh: the one before finds it as well, and what a mesh adds falls like h^{1/2} or faster.
/// Shells that are locked altogether agree too, in differences that are no longer small.
bool meshes_agree(const Followed& f, std::size_t i) {
  constexpr double small = 0.1;
  const auto [least, most] = std::minmax(f.to_tangent[i], f.mesh_before[i]);
  return most < small && most < std::numbers::sqrt2 * least;
}

/// Theorem 3: U_p tends to U. With locking the limits are h -> 0 first, then p -> 0, so p counts down to where U_p is nearest
/// to U; if it never comes near, that speaks against the theorem only where the mesh is not what keeps it away.
Claim approaches_tangent(const Followed& f, Table& table) {
  const std::string statement = "U_p approaches the tangent solution with p, until the mesh locks";
  if (const std::string why = nothing_to_say(f); !why.empty()) return not_judged(statement, why);
  if (!(f.to_tangent.front() > f.noise))
    return not_judged(statement, fmt::format("at p = 1 they differ by less than the noise, {:.0e}", f.noise));
  const auto nearest = static_cast<std::size_t>(std::ranges::min_element(f.to_tangent) - f.to_tangent.begin());
  const std::size_t at = std::max<std::size_t>(nearest, 1);
  const double exponent = std::log(f.to_tangent[at] / f.to_tangent.front()) / std::log(f.p[at] / f.p.front());
  const std::string measured = fmt::format("their difference is {:.1e} at p = 1 and {:.1e} at p = {:g}",
                                           f.to_tangent.front(), f.to_tangent[at], f.p[at]);
  const bool approaches = exponent > least_exponent;
  if (!approaches && std::isnan(f.mesh_before[at]))
    return not_judged(statement, measured + ", and one mesh does not tell whether it locks: take more refinements");
  if (!approaches && !meshes_agree(f, at))
    return not_judged(statement, fmt::format("{}, but {:.1e} on the mesh before: the elements lock. Refine the mesh or "
                                             "raise the degree",
                                             measured, f.mesh_before[at]));
  table.fits.push_back({"to tangent", "p", exponent});
  return judged(statement, fmt::format("{}: p^{:.2f}", measured, exponent), approaches);
}

void add_rows(const std::vector<Sample>& samples, const Followed& f, Table& table) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    table.rows.push_back({s.p, f.to_tangent[i], f.mesh_before[i], f.change[i], f.normal_rotation[i], s.tangency_energy,
                          s.finest.energy, s.finest.reaction, static_cast<std::int64_t>(s.finest.iterations),
                          s.finest.linear_residual});
  }
}

Followed follow(const std::vector<Sample>& samples, const Tangent& tangent) {
  const computation::Solution& kept = *tangent.result.solution;
  Followed f{.noise = relative_noise(kept, std::sqrt(2 * tangent.result.levels.back().energy)),
             .is_idle = is_idle(samples.back())};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    const std::size_t meshes = s.to_tangent.size();
    f.p.push_back(s.p);
    f.to_tangent.push_back(s.to_tangent.back());
    f.mesh_before.push_back(meshes > 1 ? s.to_tangent[meshes - 2] : NAN);
    f.change.push_back(i > 0 ? relative_distance(kept.discrete->shell, s.y, samples[i - 1].y) : NAN);
    f.normal_rotation.push_back(s.finest.max_normal_rotation);
    f.noise = std::max(f.noise, s.finest.linear_residual);
  }
  return f;
}

/// The decades of p until something ends them or somebody interrupts, and a sentence on what did.
std::string solve_decades(const problem::Problem& problem, const Tangent& tangent, MPI_Comm comm,
                          const StudyObserver& observer, std::vector<Sample>& samples, contact::Status& status) {
  constexpr int most_decades = 16;
  Descent descent;
  for (int decade = 0; decade <= most_decades; ++decade) {
    const double p = std::pow(10.0, -decade);
    if (observer.stage) observer.stage(fmt::format("p = {:g}", p));
    Sample s = solve_penalised(problem, p, tangent, comm, observer.solve);
    if (s.status == contact::Status::interrupted) {
      status = s.status;
      return std::string(contact::explain(s.status));
    }
    if (std::string end = descent.end_at(s); !end.empty()) return end;
    samples.push_back(std::move(s));
    if (samples.size() > 2 && is_idle(samples.back()))
      return "r . a_3 takes no part on this shell: no smaller p was tried";
  }
  return "no end was met";
}

std::string remark_on_locking(const Followed& f) {
  const auto nearest = std::ranges::min_element(f.to_tangent);
  return fmt::format(
      "closest to the tangent formulation at p = {:g}: {:.2e}; with smaller p the elements lock, for polynomials "
      "cannot "
      "keep r . a_3 = 0 between the nodes of a curved chart: the less, the higher the degree and the finer the mesh",
      f.p[static_cast<std::size_t>(nearest - f.to_tangent.begin())], *nearest);
}

io::Plot plot_of(const Followed& f) {
  return {.title = "Penalised formulation as p goes to zero",
          .x = {"penalty p", true},
          .y = {"relative difference in the energy norm, largest |r.a3|", true},
          .series = {{"to the tangent formulation", f.p, f.to_tangent},
                     {"the same on the mesh before", f.p, f.mesh_before},
                     {"largest |r.a3|", f.p, f.normal_rotation, true}},
          .slopes = {{1, "slope 1"}}};
}

}  // namespace

std::vector<Variant> penalty_variants(const problem::Problem& problem, const StudyOptions&) {
  return {{"the tangent formulation", in_formulation(problem, Formulation::tangent)},
          {"the penalised formulation", in_formulation(problem, Formulation::penalised)}};
}

Report penalty(const problem::Problem& problem, const StudyOptions&, MPI_Comm comm, const StudyObserver& observer) {
  Report report{.table = penalty_table(), .plot = {}};
  if (observer.stage) observer.stage("tangent");
  const Tangent tangent = solve_tangent(problem, comm, observer.solve);
  report.status = tangent.result.status;
  if (report.status != contact::Status::solved) return report;
  std::vector<Sample> samples;
  const std::string end = solve_decades(problem, tangent, comm, observer, samples, report.status);
  if (samples.empty() && report.status == contact::Status::interrupted) return report;
  if (samples.empty()) return report.status = contact::Status::linear_solver_stalled, report;
  const Followed followed = follow(samples, tangent);
  add_rows(samples, followed, report.table);
  report.table.claims = {normal_rotation_falls(followed, report.table), approaches_tangent(followed, report.table)};
  if (nothing_to_say(followed).empty()) report.table.remarks.push_back(remark_on_locking(followed));
  report.table.remarks.push_back(end);
  report.plot = plot_of(followed);
  return report;
}

}  // namespace plastron::study
