// The cost of an accuracy on graded and on uniform meshes, and how true estimated errors are (docs/research/adaptivity.md).
#include <plastron/computation/solve.hpp>
#include <research/study/studies.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

namespace plastron::study {

namespace {

/// The reference is so much more accurate than what is asked for.
constexpr double reference_factor = 1.0 / 30;
/// Uniform meshes may have so many times the unknowns of the last graded one.
constexpr double most_uniform = 3;

using Goals = std::vector<problem::Accuracy::Goal>;

struct Meshes {
  std::string name;
  std::vector<computation::Level> levels;
};

/// The values that errors are measured against, goal by goal, and how far they may be off.
struct Reference {
  std::vector<double> values, doubts;
};

struct Ending {
  contact::Status status = contact::Status::solved;
  std::vector<computation::Level> levels{};
};

Ending solved(problem::Problem problem, const problem::Accuracy& accuracy, MPI_Comm comm,
              const computation::Observer& observer) {
  problem.accuracy = accuracy;
  problem.steps.clear();
  computation::Result result = computation::solve(problem, comm, observer);
  const bool ended_well =
      result.status == contact::Status::accuracy_not_reached || result.status == contact::Status::inaccurate;
  std::erase_if(result.levels, [](const computation::Level& level) { return level.goals.empty(); });
  return {ended_well ? contact::Status::solved : result.status, std::move(result.levels)};
}

Table adaptivity_table() {
  return {.name = "adaptivity",
          .title = "What does an accuracy cost, and are estimated errors true?",
          .columns = {{"meshes", "", "-"},
                      {"goal", "", "-"},
                      {"mesh", "", "1"},
                      {"cells", "", "1"},
                      {"unknowns", "", "1"},
                      {"seconds", "", "s"},
                      {"value", "J(U_h)", "-"},
                      {"estimated", "", "1"},
                      {"true", "J(U) - J(U_h)", "1"},
                      {"effectivity", "", "1"}}};
}

/// Relative to the goal's scale, without sign; NaN below what the reference itself may be off.
double true_error(const estimation::GoalRecord& goal, std::size_t g, const Reference& reference) {
  const double error = std::abs(reference.values[g] - goal.value);
  return goal.scale > 0 && error > 2 * reference.doubts[g] ? error / goal.scale : NAN;
}

void add_rows(const Meshes& meshes, std::size_t g, const Reference& reference, Table& table) {
  double seconds = 0;
  std::int64_t number = 0;
  for (const computation::Level& level : meshes.levels) {
    seconds += level.seconds.total();
    const estimation::GoalRecord& goal = level.goals[g];
    const double error = true_error(goal, g, reference);
    table.rows.push_back({meshes.name, goal.name, number++, level.cells, level.unknowns, seconds, goal.value,
                          goal.relative_estimate(), error, goal.relative_estimate() / error});
  }
}

void add_series(const Meshes& meshes, std::size_t g, const Reference& reference, io::Plot& plot) {
  const std::string name = meshes.levels.front().goals[g].name + ", " + meshes.name;
  io::Series truth{.label = name, .x = {}, .y = {}};
  io::Series estimate{.label = name + ", estimated", .x = {}, .y = {}, .dashed = true, .with_markers = false};
  for (const computation::Level& level : meshes.levels) {
    for (io::Series* series : {&truth, &estimate}) series->x.push_back(static_cast<double>(level.unknowns));
    truth.y.push_back(true_error(level.goals[g], g, reference));
    estimate.y.push_back(level.goals[g].relative_estimate());
  }
  plot.series.push_back(std::move(truth));
  plot.series.push_back(std::move(estimate));
}

/// The first mesh from which on the true error stays below the tolerance; null if the last one's does not.
const computation::Level* first_good(const Meshes& meshes, std::size_t g, const Reference& reference) {
  const computation::Level* good = nullptr;
  for (const computation::Level& level : meshes.levels) {
    const double error = true_error(level.goals[g], g, reference);
    const bool is_good = std::isnan(error) || error <= level.goals[g].tolerance;
    good = !is_good ? nullptr : good ? good : &level;
  }
  return good;
}

Claim is_reached(const Meshes& graded, std::size_t g, const Reference& reference) {
  const estimation::GoalRecord& goal = graded.levels.back().goals[g];
  const double error = true_error(goal, g, reference);
  const std::string statement = fmt::format("{}: the true error is at last below {:g}", goal.name, goal.tolerance);
  if (std::isnan(error)) return judged(statement, "less than the reference can tell", true);
  return judged(statement, fmt::format("{:.1e}", error), error <= goal.tolerance);
}

Claim is_cheaper(const Meshes& graded, const Meshes& uniform, std::size_t g, const Reference& reference) {
  const estimation::GoalRecord& goal = graded.levels.back().goals[g];
  const std::string statement =
      fmt::format("{}: graded meshes reach {:g} with fewer unknowns than uniform ones", goal.name, goal.tolerance);
  const computation::Level* with = first_good(graded, g, reference);
  if (!with) return not_judged(statement, "graded meshes do not reach it");
  const computation::Level* without = first_good(uniform, g, reference);
  if (!without)
    return judged(statement, fmt::format("{} instead of more than {}", with->unknowns, uniform.levels.back().unknowns),
                  true);
  return judged(statement, fmt::format("{} instead of {}", with->unknowns, without->unknowns),
                with->unknowns <= without->unknowns);
}

void add(const Meshes& graded, const Meshes& uniform, const Reference& reference, Report& report) {
  for (std::size_t g = 0; g < reference.values.size(); ++g) {
    for (const Meshes* meshes : {&graded, &uniform}) {
      add_rows(*meshes, g, reference, report.table);
      if (!meshes->levels.empty()) add_series(*meshes, g, reference, report.plot);
    }
    report.table.claims.push_back(is_reached(graded, g, reference));
    if (!uniform.levels.empty()) report.table.claims.push_back(is_cheaper(graded, uniform, g, reference));
  }
}

/// Chooses the pictures of the first mesh, one in the middle of the sequence and the last.
std::vector<MeshPicture> first_middle_last(std::vector<MeshPicture> all,
                                           const std::vector<computation::Level>& levels) {
  const std::size_t count = std::min(all.size(), levels.size());
  std::vector<MeshPicture> chosen;
  for (const std::size_t i : std::set<std::size_t>{0, count / 2, count - 1}) {
    if (i >= count) continue;
    all[i].caption = fmt::format("mesh {}: {} cells, {} unknowns", i, levels[i].cells, levels[i].unknowns);
    chosen.push_back(std::move(all[i]));
  }
  return chosen;
}

problem::Accuracy default_accuracy(const problem::Problem& problem) {
  problem::Accuracy accuracy{.goals = {{"energy", 1e-3}}};
  if (!problem.shell.obstacles.empty()) accuracy.goals.push_back({"reaction", 1e-3});
  return accuracy;
}

}  // namespace

Report adaptivity(const problem::Problem& problem, const StudyOptions&, MPI_Comm comm, const StudyObserver& observer) {
  Report report{
      .table = adaptivity_table(),
      .plot = {.title = "Errors of what is asked for", .x = {"unknowns", true}, .y = {"relative error", true}}};
  problem::Problem start = problem;
  if (!problem.accuracy) start.discretisation.refinements = 0;
  const problem::Accuracy asked = problem.accuracy.value_or(default_accuracy(problem));
  const auto run = [&](const char* what, const problem::Accuracy& accuracy,
                       const decltype(computation::Observer::solution)& see = {}) {
    if (observer.stage) observer.stage(what);
    computation::Observer seeing = observer.solve;
    if (see) seeing.solution = see;
    const Ending found = solved(start, accuracy, comm, seeing);
    if (report.status == contact::Status::solved) report.status = found.status;
    return found.levels;
  };
  std::vector<MeshPicture> pictures;
  const auto draw = [&](int, const computation::Solution& solution) { pictures.push_back(mesh_picture(solution)); };
  const Meshes graded{"graded", run("graded meshes", asked, draw)};
  if (report.status != contact::Status::solved || graded.levels.empty()) return report;
  report.meshes = first_middle_last(std::move(pictures), graded.levels);
  problem::Accuracy finer = asked, uniform = asked;
  for (auto& goal : finer.goals) goal.tolerance *= reference_factor;
  const auto best = run("the reference", finer);
  uniform.is_uniform = true;
  uniform.max_unknowns = most_uniform * static_cast<double>(graded.levels.back().unknowns);
  const Meshes even{"uniform", run("uniform meshes", uniform)};
  if (report.status != contact::Status::solved || best.empty()) return report;
  Reference reference;
  for (const estimation::GoalRecord& goal : best.back().goals) {
    reference.values.push_back(goal.value + goal.difference);
    reference.doubts.push_back(goal.error);
  }
  add(graded, even, reference, report);
  report.table.remarks.push_back(
      fmt::format("true errors are distances from values with {} unknowns, corrected by their estimates; none is given "
                  "where that is no more than "
                  "twice the estimate",
                  best.back().unknowns));
  report.table.remarks.emplace_back(
      "errors are relative; seconds are of all meshes up to there, without estimates of uniform ones");
  return report;
}

}  // namespace plastron::study
