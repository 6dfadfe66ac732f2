// The solution under random changes of load, thickness and obstacle, against bounds that follow from the variational
// inequality (M18); proofs in docs/research/continuity.md. Norms are the energy norm of the unchanged shell.
#include <plastron/computation/solve.hpp>
#include <research/study/measures.hpp>
#include <research/study/random_field.hpp>
#include <research/study/studies.hpp>
#include <research/study/variations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::study {

namespace {

using contact::Status;

/// One changed problem: how much was changed, how much the solution did, and the proven bound.
struct Change {
  double size = 0;    ///< in the unit of its kind
  double change = 0;  ///< |U_2 - U_1|_a [J^{1/2}]
  double bound = 0;   ///< [J^{1/2}]
  double noise = 0;   ///< of either, from the two solutions' own [J^{1/2}]
};

/// The samples of one kind. Where change and bound both are noise nothing can be said: their ratio may be anything.
class Tally {
 public:
  Verdict add(const Change& c) {
    constexpr double clear = 10;  // times the noise
    ++samples_;
    if (!(std::max(c.change, c.bound) > clear * c.noise)) {
      noise_ = std::max(noise_, c.noise);
      return Verdict::cannot_be_judged;
    }
    ++judged_;
    worst_ = std::max(worst_, c.change / c.bound);
    const bool holds = c.change <= c.bound * (1 + 1e-6) + c.noise;
    all_hold_ = all_hold_ && holds;
    return holds ? Verdict::holds : Verdict::does_not_hold;
  }

  Claim claim(const std::string& statement, const std::string& why_left_out) const {
    if (samples_ == 0) return not_judged(statement, why_left_out);
    if (judged_ == 0)
      return not_judged(statement, fmt::format("changes and bounds of all {} samples are noise, less than {:.1e} "
                                               "J^(1/2)",
                                               samples_, noise_));
    const std::string others = judged_ < samples_ ? fmt::format("; {} more are noise", samples_ - judged_) : "";
    return judged(statement, fmt::format("ratio at most {:.4f} in {} samples{}", worst_, judged_, others), all_hold_);
  }

 private:
  int samples_ = 0, judged_ = 0;
  double worst_ = 0, noise_ = 0;
  bool all_hold_ = true;
};

class Continuity {
 public:
  Continuity(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm, const StudyObserver& observer)
      : problem_(problem), options_(options), comm_(comm), observer_(observer), random_(options.seed) {
    problem_.probes.clear();
    problem_.shell.obstacles.are_linear = true;  // the bounds are those of one variational inequality
    report_.table = {.name = "continuity",
                     .title = "Does the solution depend continuously on load, thickness and obstacle?",
                     .columns = {{"sample", "", "1"},
                                 {"changed", "", "-"},
                                 {"size", "", "1"},
                                 {"change", "|U_2 - U_1|_a", "J^{1/2}"},
                                 {"bound", "", "J^{1/2}"},
                                 {"ratio", "change / bound", "1"},
                                 {"holds", "", "-"}}};
    report_.plot = {.title = "Change of the solution against its proven bound",
                    .x = {"proven bound [J^(1/2)]", true},
                    .y = {"change |U2 - U1| in the energy norm [J^(1/2)]", true}};
  }

  Report run() {
    base_ = compute(problem_, "unchanged");
    if (report_.status != Status::solved) return std::move(report_);
    norm_ = norm_of(base_.solution->nodal.y);
    largest_ = base_.summary.max_displacement;
    area_ = shell_size(*base_.solution->discrete).area;
    examine("load", "the load changes the solution by no more than the dual norm of its change", &Continuity::load);
    examine("thickness",
            "a relative change of the stiffness changes the solution by no more than that part of its norm",
            &Continuity::thickness);
    if (!problem_.shell.obstacles.empty())
      examine("height",
              "a shift of the obstacle changes the solution by no more than the softest lifting of the contact zone",
              &Continuity::height);
    report_.table.remarks.push_back(fmt::format("the unchanged solution has the norm |U_1|_a = {:.6g} J^(1/2)", norm_));
    const auto [low, high] = range_of_bounds();
    report_.plot.series.push_back(
        {.label = "the bound itself", .x = {low, high}, .y = {low, high}, .dashed = true, .with_markers = false});
    return std::move(report_);
  }

 private:
  using Measure = std::optional<Change> (Continuity::*)();

  /// Samples of one kind, until one cannot be computed.
  void examine(const std::string& kind, const std::string& statement, Measure measure) {
    Tally tally;
    io::Series series{.label = kind, .x = {}, .y = {}, .with_line = false};
    why_left_out_.clear();
    for (int number = 1; number <= options_.samples; ++number) {
      stage_ = fmt::format("{} {} of {}", kind, number, options_.samples);
      const auto found = (this->*measure)();
      if (!found) break;
      const Verdict verdict = tally.add(*found);
      const double ratio = verdict == Verdict::cannot_be_judged ? NAN : found->change / found->bound;
      report_.table.rows.push_back({static_cast<std::int64_t>(number), kind, found->size, found->change, found->bound,
                                    ratio,
                                    std::string(verdict == Verdict::holds           ? "yes"
                                                : verdict == Verdict::does_not_hold ? "no"
                                                                                    : "noise")});
      series.x.push_back(found->bound);
      series.y.push_back(found->change);
    }
    report_.table.claims.push_back(tally.claim(statement, why_left_out_));
    if (!series.x.empty()) report_.plot.series.push_back(std::move(series));
  }

  /// a(U_2 - U_1, U_2 - U_1) <= (l_2 - l_1)(U_2 - U_1) = a(W, U_2 - U_1), W the linear solution for l_2 - l_1.
  std::optional<Change> load() {
    AreaForce field = random_field(random_, std::sqrt(area_));
    const double amplitude = options_.size * typical_load();
    const energy::AreaLoad extra{.force_function = [field, amplitude](double x, double y) -> Eigen::Vector3d {
      return amplitude * field(x, y);
    }};
    problem::Problem linear = with_loads_scaled(linear_and_homogeneous(problem_), 0);
    linear.shell.loads.on_areas = {extra};
    const computation::Result w = solve_for(linear, "its dual norm");
    if (w.status == Status::singular)
      return leave_out("the load: without contact a rigid motion is free, so no bound is finite");
    if (w.status != Status::solved) return failed(w.status);
    problem::Problem changed = problem_;
    changed.shell.loads.on_areas.push_back(extra);
    const auto solution = solve_changed(changed);
    if (!solution) return {};
    return change_to(*solution, options_.size, std::sqrt(std::max(0.0, w.summary.load_work)));
  }

  /// a_1(U_2 - U_1, U_2 - U_1) <= (a_1 - a_2)(U_2, U_2 - U_1); the face stays where it is, so K does too.
  std::optional<Change> thickness() {
    const double factor = 1 + options_.size * random_();
    problem::Problem changed = with_thickness_scaled(problem_, factor);
    changed.shell.obstacles.face_scale /= factor;
    const auto solution = solve_changed(changed);
    if (!solution) return {};
    const double kappa = std::max(std::abs(factor - 1), std::abs(factor * factor * factor - 1));
    return change_to(*solution, factor - 1, kappa * norm_of(solution->nodal.y));
  }

  /// a(U_2 - U_1, U_2 - U_1) <= a(U_2 - U_1, W) for any W that lifts the nodes in contact before or after by the shift.
  std::optional<Change> height() {
    if (problem_.shell.obstacles.all.size() > 1 || !problem_.shell.obstacles.all.front().is_plane())
      return leave_out("the height: its bound is proved for one half-space");
    const double relative = options_.size * random_();
    const double shift = relative * (largest_ > 0 ? largest_ : base_.solution->discrete->points.front().thickness);
    problem::Problem changed = problem_;
    raise(changed.shell.obstacles.all.front(), shift);
    const auto solution = solve_changed(changed);
    if (!solution) return {};
    std::vector<char> contact(static_cast<std::size_t>(solution->nodal.touching.layout()->owned));
    for (std::size_t i = 0; i < contact.size(); ++i)
      contact[i] = touches(solution->nodal, i) || touches(base_.solution->nodal, i);
    const auto bound = lifting_norm(*base_.solution->discrete, contact, shift);
    if (!bound) return leave_out("the height: the lifting could not be computed");
    return change_to(*solution, relative, *bound);
  }

  using AreaForce = std::function<Eigen::Vector3d(double, double)>;

  computation::Result solve_for(const problem::Problem& problem, const std::string& what) {
    if (observer_.stage) observer_.stage(stage_.empty() ? what : fmt::format("{}: {}", stage_, what));
    return computation::solve(problem, comm_, observer_.solve);
  }

  computation::Result compute(const problem::Problem& problem, const std::string& what) {
    computation::Result result = solve_for(problem, what);
    report_.status = result.status;
    return result;
  }

  /// U_2. Nothing, with the reason, if it is not there.
  std::optional<computation::Solution> solve_changed(const problem::Problem& changed) {
    computation::Result result = solve_for(changed, "changed");
    if (result.status == Status::infeasible) {
      leave_out("the rest of the samples: the support would hold the shell inside the obstacle; try a smaller --size");
      return {};
    }
    if (result.status != Status::solved) {
      failed(result.status);
      return {};
    }
    return std::move(result.solution);
  }

  /// |U_2 - U_1|_a against its bound.
  Change change_to(const computation::Solution& solution, double size, double bound) const {
    const double norm = norm_of(solution.nodal.y);
    const double noise =
        std::max({tolerance * norm_, tolerance * norm, rounding_norm(*base_.solution), rounding_norm(solution)});
    return {.size = size,
            .change = norm_of(difference(solution.nodal.y, base_.solution->nodal.y)),
            .bound = bound,
            .noise = noise};
  }

  std::optional<Change> leave_out(const std::string& why) {
    why_left_out_ = why;
    report_.table.remarks.push_back("left out: " + why);
    return {};
  }
  std::optional<Change> failed(Status status) {
    report_.status = status;
    return leave_out(fmt::format("the rest of the samples: {}", contact::explain(status)));
  }

  /// A force per area that does work like the loads: 2 W over area and largest displacement [Pa].
  double typical_load() const {
    return largest_ > 0 ? norm_ * norm_ / (largest_ * area_) : problem_.shell.sections.softest().shear_modulus() * 1e-6;
  }

  /// |V|_a with the a of the unchanged shell, the form of (M13) or (M14) included [J^{1/2}].
  double norm_of(const algebra::Vector& y) const {
    const assembly::DiscreteShell& discrete = *base_.solution->discrete;
    return std::sqrt(2 * (discrete.shell.energies(y).total() + discrete.energy_of_terms(y, true)));
  }

  std::pair<double, double> range_of_bounds() const {
    double low = INFINITY, high = 0;
    for (const io::Series& s : report_.plot.series)
      for (const double x : s.x)
        if (x > 0) low = std::min(low, x), high = std::max(high, x);
    return {std::min(low, high), high};
  }

  static constexpr double tolerance = 1e-8;  // of the two solutions, relative

  problem::Problem problem_;
  const StudyOptions& options_;
  MPI_Comm comm_;
  const StudyObserver& observer_;
  Random random_;
  Report report_{};
  computation::Result base_{};
  std::string stage_{}, why_left_out_{};
  double norm_ = 0, largest_ = 0, area_ = 0;
};

}  // namespace

std::vector<Variant> continuity_variants(const problem::Problem& problem, const StudyOptions& options) {
  problem::Problem thick = with_thickness_scaled(problem, 1 + options.size);
  thick.shell.obstacles.face_scale /= 1 + options.size;
  return {{fmt::format("{:g} times the thickness", 1 + options.size), thick}};
}

Report continuity(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                  const StudyObserver& observer) {
  return Continuity(problem, options, comm, observer).run();
}

}  // namespace plastron::study
