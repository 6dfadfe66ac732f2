// Balance: loads, obstacles, supports, foundations and bodies carry each other for drawn loads, each total is the sum of its parts,
// and a scene that is turned by 90 degrees has turned results. Closed forms of works and stiffnesses.
#include <gtest/gtest.h>
#include <plastron/solution/summary.hpp>
#include <plastron/zones/contact_zones.hpp>

#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "estimation/solved_shell.hpp"
#include "solution/scenes.hpp"

namespace plastron::solution::balance_test {
namespace {

using assembly::Vector6;
using namespace plastron::test;

struct Kind {
  std::string name{};
  mesh::Shape shape = quadrilateral;
  int degree = 2;
  element::Formulation formulation = element::Formulation::tangent;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

const domain::Rectangle rectangle{.to = {1.2, 0.9}, .cells = {3, 3}};
const std::array<std::string, 3> bent{"x + 0.1*y", "y", "0.3 + 0.2*x*y + 0.1*x^2"},
    oblique{"x + 0.1*y", "y", "0.3 + 0.05*x - 0.02*y"};  // here interpolated rotations contain those of rigid motions
constexpr double thickness = 0.1;

/// The same scene as it is, and turned.
struct Scene {
  assembly::ShellDescription given{}, turned{};
};

void add_loads(Random& random, Scene& scene) {
  const DrawnVector area = drawn_function(random, 1e-3, {0, 0, -4e-3}), couple = drawn_function(random, 1e-4),
                    edge = drawn_function(random, 1e-3), edge_couple = drawn_function(random, 1e-4);
  const geometry::Expression pressure = linear(1e-3 * drawn(random), 1e-3 * drawn(random), 0);
  const Vector3d gravity = drawn_vector(random, 1e-3);
  scene.given.loads = {.on_areas = {{.force = area.given, .pressure = pressure, .couple = couple.given}},
                       .on_edges = {{.boundary = "right", .force = edge.given, .couple = edge_couple.given}},
                       .gravity = gravity};
  scene.turned.loads = {.on_areas = {{.force = area.turned, .pressure = pressure, .couple = couple.turned}},
                        .on_edges = {{.boundary = "right", .force = edge.turned, .couple = edge_couple.turned}},
                        .gravity = quarter() * gravity};
}

/// A shell with loads of every kind on a table, below a ball and on a foundation, held along two edges and at a point.
Scene drawn_scene(Random& random, const Kind& kind, bool has_contact = true) {
  Scene scene;
  add_loads(random, scene);
  for (assembly::ShellDescription* shell : {&scene.given, &scene.turned}) {
    shell->sections = steel_of(geometry::Expression("0.1 + 0.02*x", {}));
    shell->sections.common.density = 1;
    shell->tangency.formulation = kind.formulation;
    shell->foundations = {{.name = "soil", .normal = geometry::Expression(2e-3), .height = -0.5},
                          {.name = "spring", .point = Eigen::Vector2d(0.8, 0.6), .normal = geometry::Expression(1e-3)}};
  }
  scene.given.foundations[0].tangential = scene.turned.foundations[0].tangential = geometry::Expression(1e-3);
  const unsigned left = drawn_number(random, 30) + 1;
  scene.given.supports = {held("left", left | 7U), held("bottom", 4), held_at({0.8, 0.6}, 1)};
  for (const assembly::Support& support : scene.given.supports) scene.turned.supports.push_back(turned(support));
  if (!has_contact) return scene;
  const Vector3d table(0, 0, 0.3 - thickness / 2 - 1e-3), centre(0.9, 0.5, 1.05);
  scene.given.obstacles.all = {{.name = "table", .shape = obstacle::HalfSpace{.point = table}},
                               {.name = "ball", .shape = obstacle::Ball{.centre = centre, .radius = 0.5}}};
  scene.turned.obstacles.all = {{.name = "table", .shape = obstacle::HalfSpace{.point = table}},
                                {.name = "ball", .shape = obstacle::Ball{.centre = quarter() * centre, .radius = 0.5}}};
  return scene;
}

Summary totals(const SolvedShell& solved) {
  const algebra::Vector r = residual(solved.discrete(), solved.nodal());
  return summarise(solved.discrete(), solved.nodal(), r, body_balance(solved.discrete(), solved.nodal().y, r));
}

void expect_same(const Wrench& a, const Wrench& b, double force, const char* what) {
  EXPECT_LT((a.force - b.force).norm(), 1e-9 * force) << what;
  EXPECT_LT((a.moment - b.moment).norm(), 1e-9 * force) << what;
}

Wrench operator+(Wrench a, const Wrench& b) { return a += b; }

class Balance : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Each, Balance,
                         testing::Values(Kind{"degree 1", quadrilateral, 1}, Kind{"degree 2"},
                                         Kind{"degree 4", quadrilateral, 4}, Kind{"triangles", triangle, 2},
                                         Kind{"mixed", quadrilateral, 2, element::Formulation::mixed},
                                         Kind{"penalised", quadrilateral, 3, element::Formulation::penalised}));

TEST_P(Balance, HoldsForDrawnLoadsAndEveryTotalIsTheSumOfItsParts) {
  Random random(5);
  std::int64_t touching = 0;
  for (int draw = 0; draw < 4; ++draw) {
    const bool is_flat = draw % 2 == 0;  // on curved shells the sum of moments is as good as the mesh
    const SolvedShell solved(meshed(rectangle, is_flat ? oblique : bent, GetParam().degree, 0, GetParam().shape),
                             drawn_scene(random, GetParam()).given);
    const Summary s = totals(solved);
    touching += s.touching_nodes;
    const double scale = s.force_scale();
    EXPECT_GT(scale, 1e-4);
    const Wrench all = s.loads + s.reaction + s.support_reaction + s.foundation_reaction();
    EXPECT_LT(all.force.norm(), 1e-9 * scale);
    EXPECT_LT(all.moment.norm(), (is_flat ? 1e-9 : 0.05) * scale);
    Wrench obstacles, supports, nodes, zones;
    for (const ObstacleContact& obstacle : s.obstacles) obstacles += obstacle.reaction;
    for (const SupportReaction& edge : s.support_reactions) supports += edge.reaction;
    for (const CornerReaction& corner : s.corner_reactions) supports += corner.reaction;
    for (const PointReaction& point : s.point_reactions)
      supports += Wrench{point.force, point.position.cross(point.force)};
    double nodal_area = 0, zone_area = 0;
    for (const ContactForce& force : contact_forces(solved.discrete(), solved.nodal())) {
      nodes += Wrench{force.force, force.place.cross(force.force)};
      nodal_area += force.area;
      EXPECT_NEAR(force.force.norm(), force.pressure * force.area, 1e-12 * scale);
      EXPECT_GE(force.pressure, -1e-9 * s.max_pressure);
    }
    for (const auto& of_obstacle : zones::contact_zones(solved.discrete(), solved.nodal()))
      for (const ContactZone& zone : of_obstacle) {
        zones += zone.reaction;
        zone_area += zone.nodal_area;
      }
    expect_same(obstacles, s.reaction, scale, "obstacles");
    expect_same(supports, s.support_reaction, scale, "supports");
    expect_same(nodes, s.reaction, scale, "nodes");
    expect_same(zones, s.reaction, scale, "zones");
    EXPECT_NEAR(zone_area, nodal_area, 1e-12);
  }
  EXPECT_GT(touching, 0);
}

TEST_P(Balance, TurnsWithTheScene) {
  Random random(6);
  const Kind& kind = GetParam();
  const Scene scene = drawn_scene(random, kind);
  const Summary a = totals({meshed(rectangle, bent, kind.degree, 0, kind.shape), scene.given}),
                b = totals({meshed(rectangle, turned(bent), kind.degree, 0, kind.shape), scene.turned});
  const double scale = a.force_scale();
  const auto expect_turned = [&](const Wrench& before, const Wrench& after, const char* what) {
    expect_same({quarter() * before.force, quarter() * before.moment}, after, scale, what);
  };
  expect_turned(a.loads, b.loads, "loads");
  expect_turned(a.support_reaction, b.support_reaction, "supports");
  expect_turned(a.foundation_reaction(), b.foundation_reaction(), "foundations");
  for (std::size_t k = 0; k < 2; ++k) {
    expect_turned(a.obstacles[k].reaction, b.obstacles[k].reaction, "obstacle");
    EXPECT_EQ(a.obstacles[k].nodes, b.obstacles[k].nodes);
  }
  for (std::size_t k = 0; k < a.support_reactions.size(); ++k)
    expect_turned(a.support_reactions[k].reaction, b.support_reactions[k].reaction, "edge");
  for (const auto& number : {&Summary::load_work, &Summary::max_displacement, &Summary::max_rotation,
                             &Summary::max_pressure, &Summary::max_strain, &Summary::area_modulus, &Summary::size}) {
    EXPECT_NEAR(a.*number, b.*number, 1e-8 * std::abs(a.*number));
    EXPECT_GT(std::abs(a.*number), 0);
  }
  EXPECT_NEAR(a.energy.total(), b.energy.total(), 1e-8 * a.energy.total());
}

// Clapeyron: without contact, and with supports that do not move, the loads have done twice the stored work.
TEST_P(Balance, HasTheWorkOfLoadsTwiceTheEnergyWithoutContact) {
  Random random(7);
  for (int draw = 0; draw < 2; ++draw) {
    const Summary s = totals({meshed(rectangle, bent, GetParam().degree, 0, GetParam().shape),
                              drawn_scene(random, GetParam(), false).given});
    EXPECT_NEAR(s.load_work, 2 * (s.energy.total() + s.tangency_energy), 1e-9 * s.load_work);
    EXPECT_EQ(s.touching_nodes, 0);
  }
}

TEST(Moments, OfASummaryGoToAnyPointAndBack) {
  Random random(8);
  const Summary given = totals({meshed(rectangle, bent, 2, 0), drawn_scene(random, {}).given});
  Summary s = given;
  for (int draw = 0; draw < 5; ++draw) {
    const Vector3d point = draw < 4 ? drawn_vector(random, 3) : Vector3d(Vector3d::Zero());
    take_moments_about(point, s);
    const auto expect_moved = [&](const Wrench& before, const Wrench& now) {
      EXPECT_EQ(now.force, before.force);
      EXPECT_LT((now.moment - (before.moment - point.cross(before.force))).norm(), 1e-13 * (1 + given.force_scale()));
    };
    expect_moved(given.loads, s.loads);
    expect_moved(given.reaction, s.reaction);
    expect_moved(given.support_reaction, s.support_reaction);
    expect_moved(given.foundation_reaction(), s.foundation_reaction());
    expect_moved(given.obstacles.at(0).reaction, s.obstacles.at(0).reaction);
    expect_moved(given.support_reactions.at(0).reaction, s.support_reactions.at(0).reaction);
    expect_moved(given.corner_reactions.at(0).reaction, s.corner_reactions.at(0).reaction);
    EXPECT_EQ(s.moment_point, point);
  }
}

/// The motion of a body on the right edge: all six components are prescribed.
fem::RigidBody holder(const Vector3d& d, const Vector3d& theta) {
  fem::RigidBody body{.name = "holder", .boundaries = {"right"}, .reference = {1, -0.3, 0.8}};
  for (std::size_t k = 0; k < 3; ++k) {
    body.fixed[k] = d[static_cast<Eigen::Index>(k)];
    body.fixed[3 + k] = theta[static_cast<Eigen::Index>(k)];
  }
  return body;
}

TEST(ABody, ThatAloneHoldsAShellMovesItWithoutStrainAndHasTheLoadsAsReaction) {
  Random random(9);
  for (int draw = 0; draw < 3; ++draw) {
    const Vector3d d = drawn_vector(random, 0.1), theta = drawn_vector(random, 0.1);
    const fem::RigidBody body = holder(d, theta);
    assembly::ShellDescription free{.sections = steel_of(geometry::Expression(thickness))};
    Scene loaded;
    add_loads(random, loaded);
    loaded.given.sections = free.sections;
    for (const assembly::ShellDescription& shell : {free, loaded.given}) {
      const SolvedShell solved(meshed_with_bodies(rectangle, oblique, 3, {body}), shell);
      const Summary s = totals(solved);
      const BodyReaction& reaction = s.body_reactions.at(0);
      EXPECT_LT((reaction.displacement - d).norm() + (reaction.rotation - theta).norm(), 1e-12);
      const double scale = std::max(s.force_scale(), 1e-3);
      expect_same(s.loads + reaction.reaction, {}, scale, "balance");
      expect_same(s.support_reaction, reaction.reaction, scale, "supports");
      const Vector3d about_reference = reaction.reaction.moment - body.reference.cross(reaction.reaction.force);
      EXPECT_LT((reaction.moment_at_reference - about_reference).norm(), 1e-10 * scale);
      if (!shell.loads.on_areas.empty()) continue;
      const algebra::Vector rigid =
          rigid_motion(solved.discrete().space(), solved.discrete().points, d - theta.cross(body.reference), theta);
      for (std::size_t i = 0; i < rigid.owned().size(); ++i)
        EXPECT_NEAR(solved.nodal().y.owned()[i], rigid.owned()[i], 1e-9);
      EXPECT_LT(s.energy.total(), 1e-15);
      EXPECT_TRUE(s.is_unstrained);
    }
  }
}

// Maxwell and Betti: component i of the reaction to the unit motion j is that of j to i, and twice the energy is on the diagonal.
TEST(ABody, HasASymmetricStiffness) {
  Matrix6 stiffness;
  for (Eigen::Index j = 0; j < 6; ++j) {
    const Vector6 unit = Vector6::Unit(j);
    const SolvedShell solved(meshed_with_bodies(rectangle, bent, 2, {holder(unit.head<3>(), unit.tail<3>())}),
                             {.sections = steel_of(geometry::Expression(thickness)), .supports = {held("left", 63)}});
    const Summary s = totals(solved);
    stiffness.col(j) << s.body_reactions.at(0).reaction.force, s.body_reactions.at(0).moment_at_reference;
    EXPECT_NEAR(stiffness(j, j), 2 * s.energy.total(), 1e-9 * stiffness(j, j));
    EXPECT_GT(stiffness(j, j), 0);
  }
  EXPECT_LT((stiffness - stiffness.transpose()).norm(), 1e-9 * stiffness.norm());
}

// The work of the forces at nodes in a rigid motion is that of their wrench.
TEST(Wrenches, DoTheWorkOfTheirForces) {
  Random random(10);
  for (int draw = 0; draw < 20; ++draw) {
    const Vector3d c = drawn_vector(random), w = drawn_vector(random), by = drawn_vector(random);
    Wrench sum;
    double work = 0;
    for (int node = 0; node < 5; ++node) {
      const Vector3d phi = drawn_vector(random, 2), a3 = drawn_vector(random).normalized();
      const Vector6 f = Vector6::NullaryExpr([&] { return drawn(random); });
      sum += nodal_wrench(phi, a3, f);
      work += f.head<3>().dot(c + w.cross(phi)) + f.tail<3>().dot(w.cross(a3));
    }
    EXPECT_NEAR(sum.force.dot(c) + sum.moment.dot(w), work, 1e-12);
    sum.move_point(by);
    EXPECT_NEAR(sum.force.dot(c + w.cross(by)) + sum.moment.dot(w), work, 1e-12);
  }
}

}  // namespace
}  // namespace plastron::solution::balance_test
