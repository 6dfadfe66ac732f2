#include <plastron/computation/adaptivity.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/algebra/vector.hpp>
#include <plastron/computation/relinearisation.hpp>
#include <plastron/computation/resources.hpp>
#include <plastron/estimation/goal_record.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/meshing/constants.hpp>
#include <plastron/problem/goal_names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace plastron::computation {

namespace {

using meshing::constants;

/// Ratio of the witness's unknowns to the unknowns of a space.
double growth_to_witness(const problem::Problem& problem, const fem::Space& space) {
  return std::pow(1 + static_cast<double>(degrees_of_witness(problem)) / space.degree, 2);
}

/// Returns the owned cells with a node that touches an obstacle, ascending.
std::vector<std::size_t> touching_cells(const Solution& solution) {
  const fem::Space& space = solution.discrete->space();
  const auto block = static_cast<std::size_t>(solution.nodal.touching.block());
  const auto touches = [&](algebra::LocalIndex node) {
    const auto of_node = solution.nodal.touching.local().subspan(static_cast<std::size_t>(node) * block, block);
    return std::ranges::any_of(of_node, [](double touching) { return touching > 0.5; });
  };
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    if (std::ranges::any_of(space.nodes(cell), touches)) cells.push_back(cell);
  return cells;
}

}  // namespace

int degrees_of_witness(const problem::Problem& problem) {
  return std::ranges::any_of(problem.shell.supports, [](const assembly::Support& s) { return s.point.has_value(); })
             ? 2
             : 1;
}

bool wants_witness(const problem::Problem& problem, const fem::Space& space, const estimation::Estimates& estimates,
                   const solution::Summary& summary) {
  if (space.shape() != mesh::Shape::quadrilateral || estimates.unjudged_cells > 0) return false;
  std::vector<estimation::GoalRecord> records =
      estimation::goal_records(problem::estimated_goals(problem), estimates, summary);
  for (std::size_t g = 0; g < records.size(); ++g) records[g].error = estimates.goals[g].least_error();
  return std::ranges::all_of(records, &estimation::GoalRecord::is_met);
}

bool AccuracyLoop::wants_witness(const Result& result, const Level& level, const fem::Space& space) const {
  return result.estimates && computation::wants_witness(problem_, space, *result.estimates, result.summary) &&
         obstacle(level, growth_to_witness(problem_, space), space.layout->comm).empty();
}

bool AccuracyLoop::wants_more(const Result& result, const Level& level, const fem::Space& space) {
  const auto& estimates = result.estimates;
  const std::vector<estimation::GoalRecord> before = std::move(goals_);
  next_.cuts.clear();
  goals_ = estimates ? estimation::goal_records(problem::estimated_goals(problem_), *estimates, result.summary)
                     : std::vector<estimation::GoalRecord>{};
  missed_ = estimates ? estimation::shortfall(goals_, *estimates) : "there are no estimates";
  const std::string missed_contact = this->missed_contact(result, space);
  if (!missed_contact.empty()) missed_ += (missed_.empty() ? "" : "; ") + missed_contact;
  if (estimates)
    std::ranges::transform(goals_, std::back_inserter(values_.emplace_back()), &estimation::GoalRecord::value);
  take_note(level, space);
  // Errors of a state that lacks the contact are no measure for those of later meshes.
  if (!estimates || !missed_contact.empty()) excesses_.back() = std::numeric_limits<double>::infinity();
  const bool has_witness =
      estimates && std::ranges::all_of(estimates->goals, [](const auto& g) { return g.at_higher_degree.has_value(); });
  wants_edges_ = missed_.empty() && !edges_are_known(estimates);
  if (missed_.empty() && !wants_edges_ && (has_witness || is_settled(before))) return false;
  const std::int64_t added = mark(space, estimates);
  if (wants_edges_ && has_witness && !may_grow_for_edges(level, added, space)) return false;
  const std::string limit = limit_of_meshes(level, added, space);
  if (wants_edges_)
    missed_ = fmt::format("edges of contact zones move by {:.2g} of the zones' size at one degree more",
                          *estimates->edge_change);
  if (limit.empty()) return true;
  give_up(limit);
  if (estimates) missed_ += place_of_error(space, *estimates);
  return false;
}

bool AccuracyLoop::may_grow_for_edges(const Level& level, std::int64_t added, const fem::Space& space) {
  const auto unknowns = static_cast<double>(level.unknowns);
  if (accurate_unknowns_ == 0) accurate_unknowns_ = unknowns;
  const double next = unknowns * (1 + static_cast<double>(added) / static_cast<double>(space.global_cells));
  return next <= constants.edge_growth * accurate_unknowns_;
}

void AccuracyLoop::take_note(const Level& level, const fem::Space& space) {
  const Seconds& s = level.seconds;
  has_lost_stiffness_ = has_lost_stiffness_ || level.has_lost_stiffness || level.has_jumped;
  seconds_to_come_ = instants_to_come_ * (s.total() - s.mesh - s.estimates - s.witness);
  excesses_.push_back(worst_excess());
  unknowns_.push_back(level.unknowns);
  const double growth = s.witness > 0 ? growth_to_witness(problem_, space) : 1;
  largest_solved_ = std::max(largest_solved_, growth * static_cast<double>(level.unknowns));
}

std::string AccuracyLoop::limit_of_meshes(const Level& level, std::int64_t added, const fem::Space& space) const {
  if (std::string limit = unsettled(constants.unlimited_changes, constants.unlimited_decay); !limit.empty())
    return limit;
  if (std::string limit = stalled(); !limit.empty()) return limit;
  const bool lacks_the_contact = std::isinf(excesses_.back());  // or estimates
  if (lacks_the_contact && level.max_rotation > meaningless_rotation)
    return "finer meshes do not bring a linear model into contact that turns the shell beyond any sense";
  if (added == 0) return "the cells to divide are as small as can be";
  const bool is_unseen = missed_.empty() && space.shape() == mesh::Shape::quadrilateral;  // witness is missing
  double growth = 1 + static_cast<double>(added) / static_cast<double>(space.global_cells);
  if (is_unseen) growth = std::max(growth, growth_to_witness(problem_, space));
  std::string limit = obstacle(level, growth, space.layout->comm);
  const std::string doubt = limit.empty() ? "" : unsettled(constants.doubtful_changes, constants.doubtful_decay);
  return doubt.empty() ? limit : limit + "; " + doubt;
}

void AccuracyLoop::give_up(const std::string& why) {
  missed_ += fmt::format("{}; {}", missed_.empty() ? "the goals are met by one solution only" : "", why);
}

std::string AccuracyLoop::stalled() const {
  constexpr std::size_t meshes = constants.stalled_meshes;
  if (excesses_.size() <= meshes || excesses_.back() <= 1) return "";
  const auto last = excesses_.end() - meshes;
  const double before = *std::min_element(excesses_.begin(), last), now = *std::min_element(last, excesses_.end());
  if (std::isinf(now)) return "";  // these meshes lack the contact
  const std::int64_t from = *(unknowns_.end() - meshes - 1), to = unknowns_.back();
  if (now < constants.stalled_fall * before ||
      static_cast<double>(to) < constants.stalled_growth * static_cast<double>(from))
    return "";
  return fmt::format("the estimates have not fallen on the last {} meshes, from {} to {} unknowns", meshes, from, to);
}

std::string AccuracyLoop::place_of_error(const fem::Space& space, const estimation::Estimates& estimates) const {
  const auto worst = std::ranges::max_element(goals_, {}, &estimation::GoalRecord::excess);
  if (worst == goals_.end() || !(worst->excess() > 1)) return "";
  const MPI_Comm comm = space.layout->comm;
  std::vector<double> shares = estimates.goals[static_cast<std::size_t>(worst - goals_.begin())].cells;
  for (double& share : shares) share = std::abs(share);
  const double above = meshing::error_threshold(shares, 0.5, comm);
  if (std::isinf(above)) return "";  // no cell has an error: only the next degree shows it
  const std::int64_t mine = std::ranges::count_if(shares, [&](double share) { return share > above; });
  std::vector<std::pair<double, Eigen::Vector3d>> largest;  // on this rank: share and place
  if (const auto most = std::ranges::max_element(shares); most != shares.end()) {
    const fem::Surface surface(space.coarse, problem_.charts);
    const Eigen::Vector2d centre = mesh::centre(space.shape());
    const fem::Cell& cell = space.cells[static_cast<std::size_t>(most - shares.begin())];
    largest.emplace_back(*most, surface.frame(cell, centre, false).phi);
  }
  largest = algebra::gathered(largest, comm);
  const Eigen::Vector3d at = std::ranges::max_element(largest, {}, [](const auto& item) { return item.first; })->second;
  return fmt::format("; half of the estimated error of {} lies in {} of {} cells, most near ({:.3g}, {:.3g}, {:.3g}) m",
                     worst->name, algebra::sum_over_ranks(mine, comm), space.global_cells, at[0], at[1], at[2]);
}

std::vector<double> AccuracyLoop::changes(std::size_t goal, std::size_t count) const {
  std::vector<double> result;
  for (auto mesh = values_.rbegin(); values_.rend() - mesh > 1 && result.size() < count; ++mesh)
    result.push_back(std::abs((*mesh)[goal] - (*(mesh + 1))[goal]));
  return result;
}

// Cells with nodes inside are not counted: these nodes are fixed there, and smaller cells do not help.
std::string AccuracyLoop::missed_contact(const Result& result, const fem::Space& space) {
  entered_.clear();
  const bool has_passed = result.passing && result.passing->cells > 0;
  lacks_contact_ = has_passed || result.status == contact::Status::gap_not_met;
  if (!result.solution || problem_.shell.obstacles.are_linear) return {};
  const Solution& solution = *result.solution;
  if (result.status == contact::Status::gap_not_met) entered_ = touching_cells(solution);
  for (const certificate::CellGap& cell : solution.entered) {
    const double allowed = certificate::least_gap_allowed(result.summary, result.summary.obstacles[cell.obstacle]);
    const auto is_outside = [&](algebra::LocalIndex node) {
      return solution.discrete->nodal_gap(cell.obstacle, static_cast<std::size_t>(node), solution.nodal.y) >= allowed;
    };
    if (cell.gap < allowed && std::ranges::all_of(space.nodes(cell.cell), is_outside)) entered_.push_back(cell.cell);
  }
  if (has_passed) entered_.insert(entered_.end(), solution.crossed.begin(), solution.crossed.end());
  if (algebra::sum_over_ranks(static_cast<std::int64_t>(entered_.size()), space.layout->comm) == 0) return {};
  if (has_passed)
    return fmt::format("{} may have passed through the shell on the path from the start", result.passing->place);
  const auto limits = certificate::certificate_limits({.summary = result.summary, .certificate = result.certificate},
                                                      result.formulation);
  const auto row = std::ranges::find(limits, "min_gap_between", &certificate::CertificateLimit::row);
  return row == limits.end() ? std::string{} : row->text();
}

// A quantity without limit changes by the same amount at each division of its place (a logarithm) or more (a power).
std::string AccuracyLoop::unsettled(std::size_t count, double least_decay) const {
  std::string text;
  for (std::size_t g = 0; g < goals_.size(); ++g) {
    const std::vector<double> last = changes(g, count);
    if (goals_[g].is_met() || last.size() < count || last.front() <= goals_[g].allowed()) continue;
    const auto settles = [&](double now, double before) { return now < least_decay * before; };
    if (std::ranges::adjacent_find(last, settles) != last.end()) continue;
    text += fmt::format(
        "{}{} changed by {:.2g} and by {:.2g} on the last meshes and may have no limit, as displacements "
        "under a point couple and stresses at corners have none",
        text.empty() ? "" : "; ", goals_[g].name, last[1], last[0]);
  }
  return text;
}

std::int64_t AccuracyLoop::mark(const fem::Space& space, const std::optional<estimation::Estimates>& estimates) {
  const double excess = worst_excess();
  const bool follows_errors = estimates && !is_uniform_ && excess > constants.rounding_error;
  if (follows_errors) {
    may_join_ = may_join_ && estimates->unjudged_cells == 0 && !(next_.has_joined && excess >= excess_before_);
    excess_before_ = excess;
  }
  if (is_uniform_) entered_.clear();
  next_ = meshing::next_mesh(problem_, space,
                             {.goals = goals_,
                              .estimates = estimates,
                              .excess = is_slow() ? std::numeric_limits<double>::infinity() : excess,
                              .follows_errors = follows_errors,
                              .may_join = may_join_,
                              .wants_edges = wants_edges_,
                              .entered = entered_,
                              .lacks_contact = lacks_contact_,
                              .has_lost_stiffness = has_lost_stiffness_});
  return next_.added_cells;
}

// The energy hardly depends on the edge of a contact zone, but a user who requests the energy also wants to see the
// zone.
bool AccuracyLoop::edges_are_known(const std::optional<estimation::Estimates>& estimates) const {
  if (!estimates || !estimates->edge_change) return true;
  const auto energy = std::ranges::find(goals_, "energy", &estimation::GoalRecord::name);
  return energy == goals_.end() || *estimates->edge_change <= std::max(constants.edge_tolerance * energy->tolerance,
                                                                       constants.least_edge_tolerance);
}

bool AccuracyLoop::is_settled(const std::vector<estimation::GoalRecord>& before) const {
  if (before.size() != goals_.size()) return false;
  for (std::size_t g = 0; g < goals_.size(); ++g) {
    const double change = std::abs(goals_[g].value - before[g].value);
    if (!before[g].is_met() || !(change <= goals_[g].allowed())) return false;
  }
  return true;
}

double AccuracyLoop::worst_excess() const {
  double worst = 0;
  for (const estimation::GoalRecord& goal : goals_) worst = std::max(worst, goal.excess());
  return worst;
}

bool AccuracyLoop::is_slow() const {
  return excesses_.size() > 2 && excesses_.back() > constants.slow_fall * *(excesses_.end() - 3);
}

std::string AccuracyLoop::obstacle(const Level& level, double growth, MPI_Comm comm) const {
  const double unknowns = growth * static_cast<double>(level.unknowns);
  if (unknowns > problem_.accuracy->max_unknowns)
    return fmt::format("the next mesh would have about {:.2g} unknowns, and max_unknowns = {:g}", unknowns,
                       problem_.accuracy->max_unknowns);
  const double end =
      since_start_.seconds() + std::pow(growth, constants.cost_exponent) * (level.seconds.total() + seconds_to_come_);
  if (algebra::max_over_ranks(end, comm) > problem_.accuracy->max_seconds)
    return fmt::format("the next mesh would end later than max_seconds = {:g}", problem_.accuracy->max_seconds);
  const double largest = std::max(largest_solved_, static_cast<double>(level.unknowns));
  return memory_obstacle(memory_use(comm), unknowns / largest);
}

}  // namespace plastron::computation
