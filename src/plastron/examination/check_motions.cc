// Checks rigid motions that the supports leave free. Nothing resists some of them. The obstacle may fix others if the
// loads press the shell onto it; this is decided here.
#include <plastron/energy/hinge.hpp>
#include <plastron/energy/load_vector.hpp>
#include <plastron/examination/checks.hpp>
#include <plastron/examination/rigid_motions.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/mesh/reference_cell.hpp>
#include <plastron/obstacle/error.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <variant>

namespace plastron::examination {

namespace {

/// What carries and loads the sample mesh.
class Carried {
 public:
  Carried(const Examined& examined, energy::Factors factors)
      : factors_(std::move(factors)),
        shell_(examined.space, examined.surface, examined.problem.shell.sections, false, false),
        loads_(examined.problem.shell.loads) {
    for (const energy::Foundation& foundation : examined.problem.shell.foundations)
      if (auto term = energy::foundation_term(shell_, foundation)) terms_.push_back(std::move(term));
  }

  FreeMotions free_motions(const RigidMotions& motions, const ShellPart& part, const ExaminedNodes& nodes) const {
    return free_rigid_motions(motions, part, nodes.coordinates, shell_, terms_);
  }
  std::vector<RigidMotion> hinge_motions(const ShellPart& part, const std::vector<ShellPart>& pieces,
                                         const ExaminedNodes& nodes) const {
    fem::Space space = shell_.space();
    for (fem::HingeSide& hinge : space.hinges) hinge.stiffness = 1;
    energy::Terms terms = terms_;
    if (auto hinges = energy::hinge_term(space, places_and_directors(space, nodes.points), element::Rotations::small))
      terms.push_back(std::move(hinges));
    return free_hinge_motions(RigidMotions(part.points), pieces, nodes.coordinates, shell_, terms);
  }
  /// The work of loads on rigid motions, to which initial strains do not contribute.
  algebra::Vector load() const {
    algebra::Vector sum(shell_.space().layout, 6);
    for (const energy::LoadPart& part : energy::load_parts(shell_, loads_))
      algebra::axpy(factors_.load(part.factor), part.forces, sum);
    return sum;
  }

 private:
  energy::Factors factors_;
  energy::ShellOperator shell_;  // neither tied nor covariant: rigid motions are Cartesian fields without strain
  const energy::Loads& loads_;
  energy::Terms terms_{};
};

/// Whether natural frequencies are asked of an unloaded shell without obstacles. It is at rest, whatever holds it.
bool vibrates_at_rest(const Examined& examined, const algebra::Vector& load) {
  const problem::Problem& problem = examined.problem;
  return problem.modes.vibration > 0 && problem.shell.obstacles.empty() && algebra::max_abs(load) == 0 &&
         !problem.shell.sections.have_initial_strains();
}

std::string hold_text(const Pressing& pressing, const RigidMotions& motions) {
  const std::string motion = motions.in_words(pressing.motion);
  if (pressing.hold == Hold::pulled_off)
    return fmt::format(
        "nothing stops the shell in the rigid motion: {}; the supports leave it free, it opens the gap, and "
        "the loads drive it on; turn the loads so that they press the shell onto the obstacle, or fix more "
        "components",
        motion);
  return fmt::format(
      "the loads do not press the shell onto the obstacle against the rigid motion: {}; they do no work or "
      "hardly any against it, so the solution need not be unique; press the shell onto the obstacle, or "
      "fix more components",
      motion);
}

/// Contact of the shell with an obstacle: the least distance of its faces, and the obstacle's normal there.
struct Rest {
  double gap = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// Detects a shell that can roll although contact fixes it against a rotation: the linear gap contains the rotation to
/// first order only. The shell is rotated by finite angles and moved into contact again. If the loads then have not
/// lost work, nothing drives the shell back.
class Rolling {
 public:
  Rolling(const Examined& examined, const RigidMotions& motions, const ExaminedNodes& nodes,
          const algebra::Vector& load)
      : examined_(examined), motions_(motions), nodes_(nodes), load_(load) {
    for (std::size_t i = 0; i < nodes.points.size(); ++i) resultant_ += force_at(i).head<3>();
    const std::vector<Eigen::Vector2d> xi = mesh::lattice(examined.space->shape(), 8);
    std::vector<geometry::Frame> frames(xi.size());
    std::vector<double> e(xi.size());
    for (const fem::Cell& cell : examined.space->cells) {
      examined.surface->frames(cell, xi, frames, false);
      examined.surface->evaluate(examined.problem.shell.sections.at(*examined.space->coarse, cell).thickness, cell, xi,
                                 e);
      for (std::size_t p = 0; p < xi.size(); ++p)
        for (const double side : {-0.5, 0.5}) faces_.push_back(frames[p].phi + side * e[p] * frames[p].a3);
    }
  }

  bool is_possible(const RigidMotion& motion) const {
    constexpr double angle = 0.2, hardly = 0.05;  // part of the work that lifts the shell's size by angle^2 / 2
    if (resultant_.isZero(0) || !RigidMotions::is_rotation(motion)) return false;
    const Rest before = rest(motion, 0);
    for (const double turn : {-angle, angle}) {
      const Rest after = rest(motion, turn);
      const double down = after.normal.dot(resultant_);  // < 0: the loads press the shell onto the obstacle
      if (!(down < 0)) return false;
      const double work = work_of(motion, turn) + (before.gap - after.gap) * down;
      if (work < -hardly * resultant_.norm() * motions_.size() * angle * angle / 2) return false;
    }
    return true;
  }

 private:
  Eigen::Matrix<double, 6, 1> force_at(std::size_t node) const {
    return Eigen::Map<const Eigen::Matrix<double, 6, 1>>(load_.owned().data() + 6 * node);
  }

  Rest rest(const RigidMotion& motion, double angle) const {
    Rest lowest;
    for (const Eigen::Vector3d& place : faces_) {
      const Eigen::Vector3d X = motions_.turned(place, motion, angle);
      for (const obstacle::Obstacle& obstacle : examined_.problem.shell.obstacles.all) {
        const obstacle::Nearest nearest = obstacle.nearest(X);
        if (nearest.distance < lowest.gap) lowest = {nearest.distance, nearest.normal};
      }
    }
    return lowest;
  }

  double work_of(const RigidMotion& motion, double angle) const {
    const Eigen::Matrix3d turn = RigidMotions::turn(motion, angle);
    double work = 0;
    for (std::size_t i = 0; i < nodes_.points.size(); ++i) {
      const assembly::NodalPoint& p = nodes_.points[i];
      work += force_at(i).head<3>().dot(motions_.turned(p.phi, motion, angle) - p.phi) +
              force_at(i).tail<3>().dot(turn * p.a3 - p.a3);
    }
    return work;
  }

  const Examined& examined_;
  const RigidMotions& motions_;
  const ExaminedNodes& nodes_;
  const algebra::Vector& load_;
  Eigen::Vector3d resultant_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> faces_{};
};

void check_rolling(Examined& examined, const RigidMotions& motions, const ExaminedNodes& nodes,
                   const std::vector<RigidMotion>& held, const algebra::Vector& load) {
  if (!std::ranges::all_of(examined.problem.shell.obstacles.all, has_fast_distance)) return;
  const Rolling rolling(examined, motions, nodes, load);
  const auto is_possible = [&](const RigidMotion& motion) {
    try {
      return rolling.is_possible(motion);
    } catch (const obstacle::ObstacleError&) {
      return false;  // at the centre of a ball the distance has no direction
    }
  };
  for (const RigidMotion& motion : held)
    if (is_possible(motion))
      examined.add(Severity::warning,
                   "the shell can roll on the obstacle: {}; turned by 11 degrees and set down again, the loads do not "
                   "drive it back, and the linear model does not see that; fix this motion by a support",
                   motions.in_words(motion));
}

std::vector<std::string> in_words(const RigidMotions& motions, const Eigen::MatrixXd& basis) {
  std::vector<std::string> words;
  for (const RigidMotion& motion : readable(basis)) words.push_back(motions.in_words(motion));
  return words;
}

/// Checks the whole shell, which is one part.
void check_one_part(Examined& examined, const ExaminedNodes& nodes, const Carried& carried, const ShellPart& part) {
  const RigidMotions motions(part.points);
  const FreeMotions free = carried.free_motions(motions, part, nodes);
  const bool is_at_rest = free.unheld.cols() > 0 && vibrates_at_rest(examined, carried.load());
  for (const std::string& motion : in_words(motions, free.unheld))
    if (is_at_rest)
      examined.add(Severity::note, "nothing holds the rigid motion: {}; its natural frequency is 0", motion);
    else if (examined.problem.shell.supports.empty())
      examined.add(Severity::error, "there is no [[support]], and a rigid motion is free: {}; add [[support]]s",
                   motion);
    else
      examined.add(Severity::error,
                   "the supports leave a rigid motion free: {}; fix more components, or say on which boundaries",
                   motion);
  if (free.held_by_obstacle.cols() > 0) {
    const algebra::Vector load = carried.load();
    const Pressing found = pressing(motions, free.held_by_obstacle, part, nodes.coordinates, load.owned());
    if (found.hold != Hold::pressed)
      examined.add(found.hold == Hold::pulled_off ? Severity::error : Severity::warning, "{}",
                   hold_text(found, motions));
    const std::vector<RigidMotion> held = readable(free.held_by_obstacle);
    if (found.hold == Hold::pressed) check_rolling(examined, motions, nodes, held, load);
    for (const RigidMotion& motion : held)
      examined.add(Severity::note, "only the obstacle holds the rigid motion: {}{}", motions.in_words(motion),
                   found.hold == Hold::pressed ? "; the loads press the shell onto it" : "");
  } else if (free.unheld.cols() + free.held_by_obstacle.cols() == 0) {
    examined.add(Severity::note, "supports: no rigid motion is left free");
  }
}

/// Returns the place of the node nearest to the middle of a part, with the region if there are several.
std::string place_of_part(const Examined& examined, const ShellPart& part) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const assembly::NodalPoint& p : part.points) middle += p.phi / static_cast<double>(part.points.size());
  const auto nearest = static_cast<std::size_t>(
      std::ranges::min_element(part.points, {}, [&](const auto& p) { return (p.phi - middle).norm(); }) -
      part.points.begin());
  const fem::Space& space = *examined.space;
  std::string text = "at " + examined.place(part.points[nearest].x);
  if (space.coarse->regions.size() < 2) return text;
  for (std::size_t c = 0; c < space.cells.size(); ++c)
    if (std::ranges::count(space.nodes(c), static_cast<algebra::LocalIndex>(part.nodes[nearest])) > 0) {
      const auto coarse = static_cast<std::size_t>(space.cells[c].coarse);
      const auto region = static_cast<std::size_t>(space.coarse->cells[coarse].region);
      return fmt::format("{}, in the region \"{}\"", text, space.coarse->regions[region]);
    }
  return text;
}

/// The finding at one of several parts that are not joined; no text if its supports hold it.
Finding motions_of_part(const Examined& examined, const ExaminedNodes& nodes, const Carried& carried,
                        const ShellPart& part, const algebra::Vector& load) {
  const RigidMotions motions(part.points);
  const FreeMotions free = carried.free_motions(motions, part, nodes);
  if (free.unheld.cols() > 0 && vibrates_at_rest(examined, load))
    return {Severity::note, fmt::format("nothing holds the rigid motions: {}; their natural frequencies are 0",
                                        fmt::join(in_words(motions, free.unheld), "; "))};
  if (free.unheld.cols() > 0)
    return {
        Severity::error,
        fmt::format("the supports leave rigid motions of it free: {}; fix more components, or join it to the others",
                    fmt::join(in_words(motions, free.unheld), "; "))};
  if (free.held_by_obstacle.cols() == 0) return {Severity::note, ""};
  const Pressing found = pressing(motions, free.held_by_obstacle, part, nodes.coordinates, load.owned());
  if (found.hold != Hold::pressed)
    return {found.hold == Hold::pulled_off ? Severity::error : Severity::warning, hold_text(found, motions)};
  return {Severity::note, fmt::format("only the obstacle holds the rigid motions: {}; the loads press the part onto it",
                                      fmt::join(in_words(motions, free.held_by_obstacle), "; "))};
}

/// Checks parts that are not joined, and describes a few of each kind.
void check_parts(Examined& examined, const ExaminedNodes& nodes, const Carried& carried,
                 const std::vector<ShellPart>& parts) {
  constexpr std::size_t described = 3;
  const algebra::Vector load = carried.load();
  std::map<Severity, std::size_t> count;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Finding found = motions_of_part(examined, nodes, carried, parts[k], load);
    if (!found.text.empty() && ++count[found.severity] <= described)
      examined.add(found.severity, "part {} of {}, {}: {}", k + 1, parts.size(), place_of_part(examined, parts[k]),
                   found.text);
  }
  for (const auto& [severity, number] : count)
    if (number > described) examined.add(severity, "{} more parts of the shell are like these", number - described);
  if (count.empty())
    examined.add(Severity::note, "supports: no rigid motion is left free in any of {} parts", parts.size());
}

}  // namespace

bool has_fast_distance(const obstacle::Obstacle& obstacle) {
  return !std::holds_alternative<obstacle::HeightField>(obstacle.shape) &&
         !std::holds_alternative<obstacle::DistanceField>(obstacle.shape) &&
         !std::holds_alternative<obstacle::TriangleSurface>(obstacle.shape);
}

namespace {

/// What carries and loads the shell at a time.
struct Situation {
  std::string where{};
  energy::Factors factors = energy::Factors();
};

/// Returns the situation of the whole case, or those of steps in which factors of their own or supports change.
std::vector<Situation> situations(const problem::Problem& problem) {
  std::vector<Situation> all;
  const auto kind = [](const energy::Factors& factors) {
    std::vector<int> signs(factors.released.begin(), factors.released.end());
    for (const double own : factors.named) signs.push_back(own > 0 ? 1 : own < 0 ? -1 : 0);
    return signs;
  };
  const auto has_own = [](const problem::Step& step) {
    return std::ranges::any_of(step.factors.named, [](double own) { return !std::isnan(own); }) ||
           std::ranges::any_of(step.factors.released, [](char is_released) { return is_released != 0; });
  };
  if (std::ranges::none_of(problem.steps, has_own)) return {Situation{}};
  for (const problem::Step& step : problem.steps)
    if (std::ranges::none_of(all, [&](const Situation& other) { return kind(other.factors) == kind(step.factors); }))
      all.push_back(
          {fmt::format("in the {} \"{}\", ", problem.steps_are_cases ? "load case" : "step", step.name), step.factors});
  return all;
}

/// Checks the motions that hinges leave to the pieces of a part.
void check_hinges(Examined& examined, const ExaminedNodes& nodes, const Carried& carried, const ShellPart& part) {
  std::vector<ShellPart> pieces = parts_of(*examined.space, nodes.points, false);
  std::erase_if(pieces,
                [&](const ShellPart& piece) { return !std::ranges::binary_search(part.nodes, piece.nodes.front()); });
  if (pieces.size() < 2) return;
  const RigidMotions motions(part.points);
  const std::vector<RigidMotion> free = carried.hinge_motions(part, pieces, nodes);
  const bool is_at_rest = !free.empty() && vibrates_at_rest(examined, carried.load());
  for (const RigidMotion& motion : free)
    if (is_at_rest)
      examined.add(Severity::note, "nothing holds the motion at a hinge: {}; its natural frequency is 0",
                   motions.in_words(motion));
    else
      examined.add(Severity::error,
                   "a hinge lets the shells that it joins move against each other: {}; fix more components, or give "
                   "the hinge a stiffness",
                   motions.in_words(motion));
}

void check_situation(Examined& examined, const ExaminedNodes& nodes, const energy::Factors& factors) {
  const std::vector<ShellPart> parts = parts_of(*examined.space, nodes.points);
  const Carried carried(examined, factors);
  if (parts.size() == 1)
    check_one_part(examined, nodes, carried, parts.front());
  else
    check_parts(examined, nodes, carried, parts);
  for (const ShellPart& part : parts) check_hinges(examined, nodes, carried, part);
}

}  // namespace

void check_rigid_motions(Examined& examined, const ExaminedNodes& nodes) {
  for (const Situation& situation : situations(examined.problem)) {
    const std::size_t before = examined.findings.size();
    const bool has_released =
        std::ranges::any_of(situation.factors.released, [](char is_released) { return is_released != 0; });
    check_situation(examined, has_released ? ExaminedNodes(examined, situation.factors) : nodes, situation.factors);
    for (std::size_t k = before; k < examined.findings.size(); ++k)
      if (examined.findings[k].severity != Severity::note)
        examined.findings[k].text = situation.where + examined.findings[k].text;
  }
}

}  // namespace plastron::examination
