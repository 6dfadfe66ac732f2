// The solution under random changes of load, thickness and obstacle, against bounds that follow from the variational
// inequality (M18); proofs in docs/methods/study-continuity.md. Norms are the energy norm of the unchanged shell.
#include <plastron/study/continuity.hpp>

#include <plastron/assembly/tilt.hpp>
#include <plastron/study/lifting.hpp>
#include <plastron/study/random_field.hpp>
#include <plastron/study/solve.hpp>
#include <plastron/study/variations.hpp>

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
};

class Continuity {
 public:
  Continuity(const Problem& problem, const StudyOptions& options, MPI_Comm comm, const StudyObserver& observer)
      : problem_(problem), options_(options), comm_(comm), observer_(observer), random_(options.seed) {
    problem_.probes.clear();
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
    largest_ = largest_displacement();
    examine("load", "the load changes the solution by no more than the dual norm of its change", &Continuity::load);
    examine("thickness",
            "a relative change of the stiffness changes the solution by no more than that part of its norm",
            &Continuity::thickness);
    if (problem_.obstacle)
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
    double worst = 0;
    int number = 0;
    bool all_hold = true;
    Series series{.label = kind, .x = {}, .y = {}, .with_line = false};
    for (; number < options_.samples; ++number) {
      stage_ = fmt::format("{} {} of {}", kind, number + 1, options_.samples);
      const auto found = (this->*measure)();
      if (!found) break;
      const bool holds = found->change <= found->bound * (1 + 1e-6) + rounding * norm_;
      const double ratio = found->bound > 0 ? found->change / found->bound : 0;
      worst = std::max(worst, ratio);
      all_hold = all_hold && holds;
      report_.table.rows.push_back({static_cast<std::int64_t>(number + 1), kind, found->size, found->change,
                                    found->bound, ratio, std::string(holds ? "yes" : "no")});
      series.x.push_back(found->bound);
      series.y.push_back(found->change);
    }
    if (number == 0) return;
    report_.table.claims.push_back(
        {statement, fmt::format("ratio at most {:.4f} in {} samples", worst, number), all_hold});
    report_.plot.series.push_back(std::move(series));
  }

  /// a(U_2 - U_1, U_2 - U_1) <= (l_2 - l_1)(U_2 - U_1) = a(W, U_2 - U_1), W the linear solution for l_2 - l_1.
  std::optional<Change> load() {
    AreaForce field = random_field(random_, std::sqrt(area()));
    const double amplitude = options_.size * typical_load();
    const assembly::AreaLoad extra{.force_function = [field, amplitude](double x, double y) -> Eigen::Vector3d {
      return amplitude * field(x, y);
    }};
    Problem linear = linear_and_homogeneous(problem_);
    linear.area_loads = {extra};
    linear.edge_loads.clear();
    const Result w = solve_for(linear, "its dual norm");
    if (w.status == Status::singular)
      return leave_out("the load: without contact a rigid motion is free, so no bound is finite");
    if (w.status != Status::solved) return failed(w.status);
    Problem changed = problem_;
    changed.area_loads.push_back(extra);
    const auto d = change_of(changed);
    if (!d) return {};
    return Change{options_.size, *d, std::sqrt(std::max(0.0, w.summary.load_work))};
  }

  /// a_1(U_2 - U_1, U_2 - U_1) <= (a_1 - a_2)(U_2, U_2 - U_1); the face stays where it is, so K does too.
  std::optional<Change> thickness() {
    const double factor = 1 + options_.size * random_();
    Problem changed = with_thickness_scaled(problem_, factor);
    if (changed.obstacle) changed.obstacle->face_scale /= factor;
    double norm_of_changed = 0;
    const auto d = change_of(changed, &norm_of_changed);
    if (!d) return {};
    const double kappa = std::max(std::abs(factor - 1), std::abs(factor * factor * factor - 1));
    return Change{factor - 1, *d, kappa * norm_of_changed};
  }

  /// a(U_2 - U_1, U_2 - U_1) <= a(U_2 - U_1, W) for any W that lifts the nodes in contact before or after by the shift.
  std::optional<Change> height() {
    const double relative = options_.size * random_();
    const double shift = relative * (largest_ > 0 ? largest_ : base_.solution->discrete->points.front().thickness);
    Problem changed = problem_;
    changed.obstacle->raised += shift;
    algebra::Vector touching;
    const auto d = change_of(changed, nullptr, &touching);
    if (!d) return {};
    std::vector<char> contact(touching.owned().size());
    for (std::size_t i = 0; i < contact.size(); ++i)
      contact[i] = touching.owned()[i] != 0 || base_.solution->nodal.touching.owned()[i] != 0;
    const auto bound = lifting_norm(*base_.solution->discrete, contact, shift);
    if (!bound) return leave_out("the height: the lifting could not be computed");
    return Change{relative, *d, *bound};
  }

  using AreaForce = std::function<Eigen::Vector3d(double, double)>;

  Result solve_for(const Problem& problem, const std::string& what) {
    if (observer_.stage) observer_.stage(stage_.empty() ? what : fmt::format("{}: {}", stage_, what));
    return solve(problem, comm_, observer_.solve);
  }

  Result compute(const Problem& problem, const std::string& what) {
    Result result = solve_for(problem, what);
    report_.status = result.status;
    return result;
  }

  /// |U_2 - U_1|_a and, on request, |U_2|_a and the nodes in contact. Nothing, with the reason, if U_2 is not there.
  std::optional<double> change_of(const Problem& changed, double* norm = nullptr, algebra::Vector* touching = nullptr) {
    const Result result = solve_for(changed, "changed");
    if (result.status == Status::infeasible) {
      leave_out("the rest of the samples: the support would hold the shell inside the obstacle; try a smaller --size");
      return {};
    }
    if (result.status != Status::solved) {
      failed(result.status);
      return {};
    }
    algebra::Vector difference = result.solution->nodal.y;
    if (norm) *norm = norm_of(difference);
    if (touching) *touching = result.solution->nodal.touching;
    const auto before = base_.solution->nodal.y.local();
    for (std::size_t i = 0; i < before.size(); ++i) difference.local()[i] -= before[i];
    return norm_of(difference);
  }

  std::optional<Change> leave_out(const std::string& why) {
    report_.table.remarks.push_back("left out: " + why);
    return {};
  }
  std::optional<Change> failed(Status status) {
    report_.status = status;
    return leave_out(fmt::format("the rest of the samples: {}", contact::explain(status)));
  }

  /// A force per area that does work like the loads: 2 W over area and largest displacement [Pa].
  double typical_load() const {
    return largest_ > 0 ? norm_ * norm_ / (largest_ * area()) : problem_.material.mu * 1e-6;
  }

  /// |V|_a with the a of the unchanged shell, the form of (M13) or (M14) included [J^{1/2}].
  double norm_of(const algebra::Vector& y) const {
    const assembly::DiscreteShell& discrete = *base_.solution->discrete;
    double energy = discrete.shell.energies(y).total();
    if (discrete.tilt_factor() > 0) energy += assembly::tilt_energy(discrete.shell, discrete.tilt_factor(), y);
    return std::sqrt(2 * energy);
  }

  double area() const {
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(base_.solution->discrete->space().layout->owned); ++i)
      sum += base_.solution->discrete->points[i].weight;
    return algebra::sum_over_ranks(sum, comm_);
  }

  double largest_displacement() const {
    double largest = 0;
    const auto y = base_.solution->nodal.y.owned();
    for (std::size_t i = 0; i + 2 < y.size(); i += 6) largest = std::max(largest, std::hypot(y[i], y[i + 1], y[i + 2]));
    return algebra::max_over_ranks(largest, comm_);
  }

  std::pair<double, double> range_of_bounds() const {
    double low = INFINITY, high = 0;
    for (const Series& s : report_.plot.series)
      for (const double x : s.x)
        if (x > 0) low = std::min(low, x), high = std::max(high, x);
    return {low, high};
  }

  static constexpr double rounding = 1e-8;  // of the two solutions, relative

  Problem problem_;
  const StudyOptions& options_;
  MPI_Comm comm_;
  const StudyObserver& observer_;
  Random random_;
  Report report_{};
  Result base_{};
  std::string stage_{};
  double norm_ = 0, largest_ = 0;
};

}  // namespace

Report continuity(const Problem& problem, const StudyOptions& options, MPI_Comm comm, const StudyObserver& observer) {
  return Continuity(problem, options, comm, observer).run();
}

}  // namespace plastron::study
