// The contact report of given patterns. Nodes touch where a function of the place is negative; elsewhere the gap opens as in
// bending. So zones, their sums and their boundaries are known. All ranks together must find what one finds alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/certificate/certificate.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/zones/contact_zones.hpp>
#include <plastron/zones/gap_opening.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "assembly/sample_shells.hpp"
#include "larger.hpp"

namespace plastron::certificate::contact_zones_test {
namespace {

using testing::ElementsAre;
using Pattern = std::function<double(const Vector3d&)>;  ///< of phi: negative where the obstacle is touched [m]

constexpr double thickness = 0.1, opening = 0.7;  // gap = opening times s^2 (3 delta + s) [1/m^2]

/// A zone within a circle.
solution::ContactZone round_zone(double radius) {
  constexpr int parts = 200;
  solution::ContactLine line{.is_closed = true};
  for (int i = 0; i <= parts; ++i) {
    const double angle = 2 * std::numbers::pi * i / parts;
    line.points.push_back({.place = {radius * std::cos(angle), radius * std::sin(angle), 1}});
  }
  line.length = 2 * std::numbers::pi * radius;
  solution::ContactZone zone;
  zone.area = std::numbers::pi * radius * radius;
  zone.lines = {line};
  return zone;
}

/// A zone between two straight lines at these x, of length 1. The rim is at their ends.
solution::ContactZone strip_zone(double from, double to) {
  const auto line = [](double x, double y, const Vector3d& way, bool is_rim) {
    const Vector3d begin(x, y, 0);
    return solution::ContactLine{
        .is_rim = is_rim, .length = way.norm(), .points = {{.place = begin}, {.place = begin + way}}};
  };
  const Vector3d along(0, 1, 0), across(to - from, 0, 0);
  solution::ContactZone zone;
  zone.area = to - from;
  zone.lines = {line(from, 0, along, false), line(to, 0, along, false), line(from, 0, across, true),
                line(from, 1, across, true)};
  return zone;
}

TEST(RelativeDistance, IsThatOfEdgesOverTheRadiusOrHalfTheWidth) {
  const std::vector<solution::ContactZone> disk{round_zone(2)}, larger{round_zone(2.02)}, none{};
  EXPECT_NEAR(solution::relative_distance(disk, larger), 0.01, 2e-4);
  EXPECT_NEAR(solution::relative_distance(disk, disk), 0, 1e-15);
  const std::vector<solution::ContactZone> strip{strip_zone(0, 2)}, wider{strip_zone(-0.01, 2.03)};
  EXPECT_NEAR(solution::relative_distance(strip, wider), 0.02, 1e-12);  // the mean of 0.01 and 0.03, over 1
  EXPECT_EQ(solution::relative_distance(none, none), 0);
  EXPECT_EQ(solution::relative_distance(disk, none), std::numeric_limits<double>::infinity());
  EXPECT_EQ(solution::relative_distance(none, disk), std::numeric_limits<double>::infinity());
}

struct Scene {
  domain::Domain domain = domain::Rectangle{.to = {2, 1}, .cells = {16, 8}};
  int refinements = 0;
  std::map<std::string, double> shear_corrections{};  ///< of regions; zones then open differently in each
  std::array<std::string, 3> chart{"x", "y", "0.3"};
  std::vector<obstacle::Obstacle> obstacles{
      {.name = "table", .shape = obstacle::HalfSpace{}, .face = obstacle::Face::lower}};
  std::vector<fem::Join> joins{};
  std::vector<Pattern> patterns{};  ///< of each obstacle
  std::function<double(const Vector3d&)> pressure = [](const Vector3d& phi) { return 2 + phi[0]; };
};

struct Element {
  mesh::Shape shape;
  int degree;
};
void PrintTo(const Element& e, std::ostream* out) {
  *out << mesh::corner_count(e.shape) << " corners, degree " << e.degree;
}

/// A shell, and the solution that the scene defines on it.
struct Given {
  std::unique_ptr<assembly::DiscreteShell> discrete;
  solution::NodalSolution nodal;
};

double opened(double distance, const shell::Material& material) {
  const shell::Section section =
      shell::section_at(material, shell::orthonormal_frame(Vector3d::UnitX(), Vector3d::UnitY()), thickness);
  return opening * distance * distance * (3 * shell::bending_length(section) + distance);
}

energy::CrossSections sections_of(const Scene& scene) {
  energy::CrossSections sections = test::steel_of(geometry::Expression(thickness));
  for (const auto& [region, shear_correction] : scene.shear_corrections)
    sections.regions[region] = {.thickness = geometry::Expression(thickness),
                                .material = shell::Material::from_young_poisson(1.0, 0.3, shear_correction)};
  return sections;
}

std::unique_ptr<assembly::DiscreteShell> shell_of(const Scene& scene, const Element& element, MPI_Comm comm) {
  const auto coarse = domain::coarse_mesh(scene.domain, element.shape);
  std::map<std::string, geometry::Chart> charts;
  for (const std::string& region : coarse.regions) charts.emplace(region, geometry::Chart(scene.chart, {}));
  std::shared_ptr<const fem::Surface> surface;
  fem::MeshSequence meshes(coarse, element.degree, comm, [&](std::shared_ptr<const fem::Space> space) {
    surface = std::make_shared<const fem::Surface>(space->coarse, charts);
    return fem::joined(std::move(space), *surface, scene.joins);
  });
  for (int i = 0; i < scene.refinements; ++i) meshes.refine({});
  return assembly::discretise(meshes.space(), surface,
                              {.sections = sections_of(scene), .obstacles = {.all = scene.obstacles}});
}

/// Value of the region that contains a place.
const shell::Material& material_at(const Scene& scene, const energy::CrossSections& sections, const Vector3d& phi) {
  const auto* rectangle = std::get_if<domain::Rectangle>(&scene.domain);
  if (!rectangle || rectangle->regions.empty()) return sections.common.material;
  const auto right = std::ranges::upper_bound(rectangle->breaks, phi[0]) - rectangle->breaks.begin();
  return sections.regions.at(rectangle->regions[static_cast<std::size_t>(right)]).material;
}

Given given(const Scene& scene, const Element& element, MPI_Comm comm) {
  Given g{.discrete = shell_of(scene, element, comm), .nodal = {}};
  const auto& layout = g.discrete->space().layout;
  const auto block = scene.obstacles.size();
  const energy::CrossSections sections = sections_of(scene);
  g.nodal = {.y = algebra::Vector(layout, 6),
             .pressure = algebra::Vector(layout, static_cast<int>(block)),
             .touching = algebra::Vector(layout, static_cast<int>(block))};
  for (std::size_t i = 0; i < g.discrete->points.size(); ++i) {
    const assembly::NodalPoint& p = g.discrete->points[i];
    Vector3d u = Vector3d::Zero();
    for (std::size_t k = 0; k < block; ++k) {
      const obstacle::Gap& gap = g.discrete->coordinates.gaps[k][i];
      const double distance = scene.patterns[k](p.phi);
      if (k == 0) u = gap.normal * (opened(std::max(distance, 0.0), material_at(scene, sections, p.phi)) - gap.initial);
      if (distance > 0 || p.weight == 0) continue;  // triangles of degree 2 have no bound at their vertices
      g.nodal.touching.local()[block * i + k] = 1;
      g.nodal.pressure.local()[block * i + k] = scene.pressure(p.phi);
    }
    std::copy(u.begin(), u.end(), g.nodal.y.local().begin() + static_cast<std::ptrdiff_t>(6 * i));
  }
  for (algebra::Vector* v : {&g.nodal.y, &g.nodal.pressure, &g.nodal.touching})
    g.discrete->space().continuity.apply(*v);
  return g;
}

void expect_sums(const Given& g, const std::vector<std::vector<solution::ContactZone>>& zones) {
  const solution::Summary summary = certify(*g.discrete, g.nodal).summary;
  ASSERT_EQ(zones.size(), summary.obstacles.size());
  for (std::size_t k = 0; k < zones.size(); ++k) {
    solution::ContactZone sum;
    for (const solution::ContactZone& zone : zones[k]) {
      sum.area += zone.area;
      sum.nodes += zone.nodes;
      sum.reaction.force += zone.reaction.force;
      sum.reaction.moment += zone.reaction.moment;
      EXPECT_GT(zone.nodes, 0);
      EXPECT_LT((zone.centre.cross(zone.reaction.force) - zone.reaction.moment).norm(),
                1e-12 * zone.reaction.moment.norm());  // forces are parallel: one force in the centre
    }
    const solution::ObstacleContact& whole = summary.obstacles[k];
    EXPECT_EQ(sum.nodes, whole.nodes);
    EXPECT_NEAR(sum.area, whole.area, 1e-13 * whole.area);
    EXPECT_LE((sum.reaction.force - whole.reaction.force).norm(), 1e-13 * whole.reaction.force.norm());
    EXPECT_LE((sum.reaction.moment - whole.reaction.moment).norm(), 1e-13 * whole.reaction.moment.norm());
  }
}

void expect_same_lines(const solution::ContactLine& a, const solution::ContactLine& b) {
  EXPECT_EQ(a.is_closed, b.is_closed);
  EXPECT_EQ(a.is_rim, b.is_rim);
  EXPECT_NEAR(a.length, b.length, 1e-9);
  ASSERT_EQ(a.points.size(), b.points.size());
  double difference = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    difference = test::larger(difference, (a.points[i].x - b.points[i].x).norm() +
                                              (a.points[i].place - b.points[i].place).norm() +
                                              (a.points[i].displacement - b.points[i].displacement).norm());
  EXPECT_LT(difference, 1e-9);
}

void expect_same_zones(const solution::ContactZone& a, const solution::ContactZone& b) {
  EXPECT_NEAR(a.area, b.area, 1e-12);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_LT((a.reaction.force - b.reaction.force).norm(), 1e-12);
  EXPECT_LT((a.reaction.moment - b.reaction.moment).norm(), 1e-12);
  EXPECT_LT((a.centre - b.centre).norm(), 1e-12);
  EXPECT_NEAR(a.peak_pressure, b.peak_pressure, 1e-12);
  EXPECT_LT((a.peak_place - b.peak_place).norm() + (a.peak_x - b.peak_x).norm(), 1e-12);
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (std::size_t l = 0; l < a.lines.size(); ++l) expect_same_lines(a.lines[l], b.lines[l]);
}

/// Checks all obstacles: all ranks together find the same as each rank alone.
std::vector<std::vector<solution::ContactZone>> zones_of(const Scene& scene, const Element& element) {
  const Given together = given(scene, element, MPI_COMM_WORLD), alone = given(scene, element, MPI_COMM_SELF);
  auto zones = zones::contact_zones(*together.discrete, together.nodal);
  const auto expected = zones::contact_zones(*alone.discrete, alone.nodal);
  expect_sums(together, zones);
  EXPECT_EQ(zones.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(zones[k].size(), expected[k].size());
    for (std::size_t z = 0; z < std::min(zones[k].size(), expected[k].size()); ++z)
      expect_same_zones(zones[k][z], expected[k][z]);
  }
  return zones;
}

std::vector<solution::ContactZone> zones_of(const Pattern& pattern, const Element& element) {
  Scene scene;
  scene.patterns = {pattern};
  return zones_of(scene, element).front();
}

Pattern disc(double x, double y, double radius) {
  return [=](const Vector3d& phi) { return std::hypot(phi[0] - x, phi[1] - y) - radius; };
}
Pattern either(const Pattern& a, const Pattern& b) {
  return [=](const Vector3d& phi) { return std::min(a(phi), b(phi)); };
}

/// Distance of nodes, the largest in a cell.
double node_distance(const Element& element) { return 0.125 / std::max(1, element.degree - 1); }

/// Largest distance of a line's points from the curve where the pattern changes sign.
double distance_from(const Pattern& pattern, const solution::ContactLine& line) {
  double worst = 0;
  for (const solution::BoundaryPoint& p : line.points) worst = test::larger(worst, std::abs(pattern(p.place)));
  return worst;
}

class ContactZones : public testing::TestWithParam<Element> {};
INSTANTIATE_TEST_SUITE_P(Each, ContactZones,
                         testing::Values(Element{mesh::Shape::quadrilateral, 1}, Element{mesh::Shape::quadrilateral, 2},
                                         Element{mesh::Shape::quadrilateral, 4}, Element{mesh::Shape::triangle, 1},
                                         Element{mesh::Shape::triangle, 2}));

TEST_P(ContactZones, OfTwoDiscsAreTwoWithARoundBoundaryEach) {
  const std::array discs{disc(0.5, 0.5, 0.31), disc(1.5, 0.5, 0.21)};
  const auto zones = zones_of(either(discs[0], discs[1]), GetParam());
  ASSERT_EQ(zones.size(), 2U);
  EXPECT_GT(zones[0].area, zones[1].area);
  for (std::size_t k = 0; k < 2; ++k) {
    const double radius = k == 0 ? 0.31 : 0.21;
    ASSERT_EQ(zones[k].lines.size(), 1U);
    const solution::ContactLine& line = zones[k].lines.front();
    EXPECT_TRUE(line.is_closed);
    EXPECT_FALSE(line.is_rim);
    EXPECT_LT((line.points.front().place - line.points.back().place).norm(), 1e-12);
    const double coarse = GetParam().degree == 1 ? 3 : 1;  // about two nodes per radius
    EXPECT_LT(distance_from(discs[k], line), coarse * 0.15 * node_distance(GetParam()));
    EXPECT_NEAR(line.length, 2 * std::numbers::pi * radius, coarse * 0.3 * radius);
    EXPECT_NEAR(zones[k].area, std::numbers::pi * radius * radius, coarse * 0.5 * node_distance(GetParam()) * radius);
    for (const solution::BoundaryPoint& p : line.points) EXPECT_NEAR(p.place[2], 0.3 - thickness / 2, 1e-14);
    // The pressure grows with x, and so does the place of the peak, up to the end of the disc.
    EXPECT_NEAR(zones[k].peak_pressure, 2 + zones[k].peak_x[0], 1e-12);
    EXPECT_NEAR(zones[k].peak_x[0], 0.5 + static_cast<double>(k) + radius, node_distance(GetParam()));
    EXPECT_GT(zones[k].centre[0], 0.5 + static_cast<double>(k));
  }
}

TEST_P(ContactZones, OfARingIsOneBetweenTwoClosedLines) {
  const Pattern ring = [](const Vector3d& phi) { return std::abs(std::hypot(phi[0] - 1, phi[1] - 0.5) - 0.34) - 0.09; };
  Scene fine;
  fine.domain = domain::Rectangle{.to = {2, 1}, .cells = {32, 16}};
  fine.patterns = {ring};
  const auto zones = zones_of(fine, GetParam()).front();
  ASSERT_EQ(zones.size(), 1U);
  ASSERT_EQ(zones[0].lines.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(zones[0].lines[k].is_closed);
    EXPECT_NEAR(zones[0].lines[k].length, 2 * std::numbers::pi * (k == 0 ? 0.43 : 0.25), 0.15);
    EXPECT_LT(distance_from(ring, zones[0].lines[k]), 0.2 * node_distance(GetParam()));
  }
  EXPECT_EQ(zones[0].rim_length(), 0);
  const double area = std::numbers::pi * (0.43 * 0.43 - 0.25 * 0.25);
  EXPECT_NEAR(zones[0].area, area, (GetParam().degree == 1 ? 0.05 : 0.01) * area);
}

TEST_P(ContactZones, TakeInASingleNodeThatLiftsOffAndShowAHole) {
  const auto hole = [](double radius) {
    return [=](const Vector3d& phi) { return radius - std::hypot(phi[0] - 1, phi[1] - 0.5); };
  };
  const auto lifted = zones_of(hole(0.01), GetParam()), open = zones_of(hole(0.3), GetParam());
  ASSERT_EQ(lifted.size(), 1U);
  ASSERT_EQ(lifted[0].lines.size(), 1U);
  EXPECT_TRUE(lifted[0].lines[0].is_rim);
  ASSERT_EQ(open.size(), 1U);
  ASSERT_EQ(open[0].lines.size(), 2U);
  EXPECT_TRUE(open[0].lines[0].is_closed);
  EXPECT_FALSE(open[0].lines[0].is_rim);
}

TEST_P(ContactZones, OfAWholePlateIsOneWithTheRimAroundIt) {
  const auto zones = zones_of([](const Vector3d&) { return -1.0; }, GetParam());
  ASSERT_EQ(zones.size(), 1U);
  EXPECT_NEAR(zones[0].area, 2, 1e-12);
  ASSERT_EQ(zones[0].lines.size(), 1U);
  EXPECT_TRUE(zones[0].lines[0].is_rim);
  EXPECT_TRUE(zones[0].lines[0].is_closed);
  EXPECT_NEAR(zones[0].rim_length(), 6, 1e-12);
  EXPECT_EQ(zones[0].line_length(), 0);
  EXPECT_EQ(zones[0].peak_x[0], 2);
}

TEST_P(ContactZones, ThatReachTheRimHaveALineAcrossTheShellAndOneAlongTheRim) {
  const double edge = 0.83;
  const auto zones = zones_of([=](const Vector3d& phi) { return phi[0] - edge; }, GetParam());
  ASSERT_EQ(zones.size(), 1U);
  ASSERT_EQ(zones[0].lines.size(), 2U);
  const solution::ContactLine &across = zones[0].lines[0], &rim = zones[0].lines[1];
  EXPECT_FALSE(across.is_rim || across.is_closed || rim.is_closed);
  EXPECT_TRUE(rim.is_rim);
  for (const solution::BoundaryPoint& p : across.points)
    EXPECT_NEAR(p.x[0], edge, 1e-10);  // a straight edge is found exactly
  EXPECT_NEAR(across.length, 1, 1e-10);
  EXPECT_NEAR(rim.length, 1 + 2 * edge, 1e-10);
  EXPECT_LT((across.points.front().x - rim.points.front().x).norm(), 1e-10);
  EXPECT_LT((across.points.back().x - rim.points.back().x).norm(), 1e-10);
}

TEST_P(ContactZones, OfASingleNodeHasALineAroundIt) {
  // The middle of a cell's side, where triangles of degree 2 have a bound, or a corner.
  const Vector3d node = GetParam().degree % 2 == 0 ? Vector3d(0.75 + 0.0625, 0.5, 0.3) : Vector3d(0.75, 0.5, 0.3);
  const auto zones = zones_of([=](const Vector3d& phi) { return (phi - node).norm() - 1e-3; }, GetParam());
  ASSERT_EQ(zones.size(), 1U);
  EXPECT_EQ(zones[0].nodes, 1);
  ASSERT_EQ(zones[0].lines.size(), 1U);
  EXPECT_TRUE(zones[0].lines[0].is_closed);
  EXPECT_LT((zones[0].centre - (node - Vector3d(0, 0, thickness / 2))).norm(), 1e-12);
  for (const solution::BoundaryPoint& p : zones[0].lines[0].points)
    EXPECT_LT((p.place - zones[0].centre).norm(), 2 * node_distance(GetParam()));
}

TEST_P(ContactZones, OfSeveralObstaclesAreApart) {
  Scene scene;
  scene.chart[2] = "0.05";
  scene.obstacles.push_back({.name = "ceiling",
                             .shape = obstacle::HalfSpace{.point = {0, 0, 0.1}, .normal = {0, 0, -1}},
                             .face = obstacle::Face::upper});
  scene.patterns = {either(disc(0.5, 0.5, 0.3), disc(1.5, 0.5, 0.2)), disc(0.5, 0.5, 0.4)};
  const auto zones = zones_of(scene, GetParam());
  ASSERT_EQ(zones.size(), 2U);
  EXPECT_EQ(zones[0].size(), 2U);
  ASSERT_EQ(zones[1].size(), 1U);
  EXPECT_LT(zones[1][0].reaction.force[2], 0);
  EXPECT_NEAR(zones[1][0].centre[2], 0.1, 1e-14);
}

/// A tube of radius 1. A ceiling touches it at its seam.
Scene tube(const Pattern& pattern) {
  Scene scene;
  scene.domain = domain::Rectangle{.to = {2 * std::numbers::pi, 2}, .cells = {40, 16}};
  scene.chart = {"sin(x)", "y", "cos(x)"};
  scene.obstacles = {{.name = "ceiling",
                      .shape = obstacle::HalfSpace{.point = {0, 0, 1.05}, .normal = {0, 0, -1}},
                      .face = obstacle::Face::upper}};
  scene.joins = {{{"left", "right"}}};
  scene.patterns = {pattern};
  return scene;
}

TEST_P(ContactZones, GoOnAcrossAJoinedEdge) {
  const auto arc = [](const Vector3d& phi) { return std::hypot(std::atan2(phi[0], phi[2]), phi[1] - 1) - 0.4; };
  const auto zones = zones_of(tube(arc), GetParam()).front();
  ASSERT_EQ(zones.size(), 1U);
  ASSERT_EQ(zones[0].lines.size(), 1U);
  const solution::ContactLine& line = zones[0].lines[0];
  EXPECT_TRUE(line.is_closed);
  EXPECT_NEAR(zones[0].centre[1], 1, 1e-2);
  EXPECT_LT(distance_from(arc, line), 0.25 * node_distance(GetParam()));
  int crossings = 0;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    EXPECT_LT((line.points[i + 1].place - line.points[i].place).norm(), 0.25);  // whole in space
    if (std::abs(line.points[i + 1].x[0] - line.points[i].x[0]) < 6) continue;
    ++crossings;
    EXPECT_LT((line.points[i + 1].place - line.points[i].place).norm(), 1e-12);
  }
  EXPECT_EQ(crossings, 2);
}

/// On a disk the ends of the line lie on the round rim, and so do all points along it.
TEST_P(ContactZones, MeetACurvedRimOnIt) {
  const double edge = 0.3;
  Scene scene;
  scene.domain = domain::Disk{};
  scene.refinements = 3;
  scene.patterns = {[=](const Vector3d& phi) { return phi[0] - edge; }};
  const auto zones = zones_of(scene, GetParam()).front();
  ASSERT_EQ(zones.size(), 1U);
  ASSERT_EQ(zones[0].lines.size(), 2U);
  const solution::ContactLine &across = zones[0].lines[0], &rim = zones[0].lines[1];
  EXPECT_FALSE(across.is_rim || across.is_closed);
  EXPECT_TRUE(rim.is_rim);
  EXPECT_LT(distance_from(scene.patterns[0], across), 0.003 * node_distance(GetParam()));
  EXPECT_NEAR(across.length, 2 * std::sqrt(1 - edge * edge), 1e-3);
  const double rounding = mesh::corner_count(GetParam().shape) == 4 ? 1e-12 : 1e-9;
  for (const solution::ContactLine& line : zones[0].lines)
    for (const solution::BoundaryPoint& p : {line.points.front(), line.points.back()})
      EXPECT_NEAR(p.x.norm(), 1, rounding);
}

/// A zone opens differently where the shell is softer in shear. An edge across the border of two materials is found on both sides: exactly where
/// no node of the other side matters, and to a tenth of the node distance beside the border.
TEST_P(ContactZones, GoOnAcrossTheBorderOfTwoMaterials) {
  const double edge = 0.46;
  Scene scene;
  scene.domain = domain::Rectangle{.to = {2, 1}, .cells = {16, 8}, .breaks = {1}, .regions = {"stiff", "soft"}};
  scene.shear_corrections = {{"stiff", 5.0 / 6}, {"soft", 0.2}};
  scene.patterns = {[=](const Vector3d& phi) { return phi[1] - edge; }};
  const auto zones = zones_of(scene, GetParam()).front();
  ASSERT_EQ(zones.size(), 1U);
  ASSERT_EQ(zones[0].lines.size(), 2U);
  const solution::ContactLine& across = zones[0].lines[0];
  EXPECT_NEAR(across.length, 2, 0.1);
  for (const solution::BoundaryPoint& p : across.points) {
    const bool is_far = std::abs(p.x[0] - 1) > 5 * node_distance(GetParam());
    EXPECT_NEAR(p.x[1], edge, is_far ? 1e-10 : 0.15 * node_distance(GetParam())) << p.x[0];
  }
}

TEST(ContactZone, OfNothingIsNone) {
  EXPECT_THAT(zones_of([](const Vector3d&) { return 1.0; }, {mesh::Shape::quadrilateral, 2}), testing::IsEmpty());
}

}  // namespace
}  // namespace plastron::certificate::contact_zones_test
