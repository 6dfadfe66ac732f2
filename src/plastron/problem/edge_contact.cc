#include <plastron/problem/edge_contact.hpp>

#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/mesh/reference_cell.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/problem/both_faces.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace plastron::problem {

namespace {

/// A point of the undeformed shell.
struct SeenPoint {
  Eigen::Vector3d phi, a3;
  double thickness = 0;
};

/// Returns the corners and the middles of all sides and cells of the coarse mesh.
std::vector<SeenPoint> seen_points(const Problem& problem) {
  const auto coarse =
      std::make_shared<const mesh::CoarseMesh>(domain::coarse_mesh(problem.domain, problem.discretisation.cells));
  const fem::Surface surface(coarse, problem.charts);
  const std::vector<Eigen::Vector2d> xi = mesh::lattice(coarse->shape, 2);
  std::vector<geometry::Frame> frames(xi.size());
  std::vector<double> thickness(xi.size());
  std::vector<SeenPoint> points;
  for (std::size_t i = 0; i < coarse->cells.size(); ++i) {
    const fem::Cell cell{.coarse = static_cast<int>(i)};
    surface.frames(cell, xi, frames, false);
    surface.evaluate(problem.shell.sections.at(*coarse, cell).thickness, cell, xi, thickness);
    for (std::size_t p = 0; p < xi.size(); ++p) points.push_back({frames[p].phi, frames[p].a3, thickness[p]});
  }
  return points;
}

/// Whether the shell is nearest to the obstacle at an edge on which it stands.
bool meets_edge(const obstacle::Obstacle& body, const std::vector<SeenPoint>& points) {
  constexpr double alike = 0.1;  // 6 degrees
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double least = infinity, least_on_edge = infinity, thickness = 0;
  for (const SeenPoint& point : points) {
    const obstacle::Nearest near = body.nearest(point.phi);
    const double facing = std::abs(near.normal.dot(point.a3));
    const double gap = near.distance - point.thickness / 2 * facing;
    if (gap < least) least = gap;
    if (!(facing < alike && gap < least_on_edge)) continue;
    least_on_edge = gap;
    thickness = point.thickness;
  }
  return least_on_edge < least + thickness;
}

/// Puts both faces in the place of an obstacle, also in steps and goals.
void put_both_faces(Problem& problem, std::size_t k) {
  auto& all = problem.shell.obstacles.all;
  const std::string own = "obstacle." + all[k].name + ".";
  auto both = for_both_faces(all[k]);
  const auto place = all.begin() + static_cast<std::ptrdiff_t>(k);
  *place = std::move(both[0]);
  all.insert(place + 1, std::move(both[1]));
  for (Step& step : problem.steps)
    if (!step.factors.forces.empty())
      step.factors.forces.insert(step.factors.forces.begin() + static_cast<std::ptrdiff_t>(k), step.factors.forces[k]);
  if (!problem.accuracy) return;
  std::vector<Accuracy::Goal> goals;
  for (const Accuracy::Goal& goal : problem.accuracy->goals) {
    if (!goal.name.starts_with(own)) {
      goals.push_back(goal);
      continue;
    }
    for (const std::size_t face : {k, k + 1})
      goals.push_back({"obstacle." + all[face].name + "." + goal.name.substr(own.size()), goal.tolerance});
  }
  problem.accuracy->goals = std::move(goals);
}

}  // namespace

void let_both_faces_touch(Problem& problem) {
  const auto& all = problem.shell.obstacles.all;
  const auto may_change = [](const obstacle::Obstacle& body) {
    return body.face == obstacle::Face::nearer && !body.is_pressed() && !body.is_searched() && !body.has_bed();
  };
  if (!std::ranges::any_of(all, may_change)) return;
  const std::vector<SeenPoint> points = seen_points(problem);
  for (std::size_t k = all.size(); k-- > 0;) try {
      if (may_change(all[k]) && meets_edge(all[k], points)) put_both_faces(problem, k);
    } catch (const obstacle::ObstacleError&) {  // the examination and the solution report places without a distance
    }
}

}  // namespace plastron::problem
