// Springs and foundations (M32), beds (M33), temperatures (M34), factors and load cases (M35) against closed forms: Winkler and Pasternak plates, strips, a rigid
// plate on a one-sided bed, heated plates. Units change by 1e-6 and 1e6, models and cells as the table says.
#include <plastron/computation/solve.hpp>
#include <plastron/config/case.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

namespace plastron::carried_shells {
namespace {

constexpr double pi = std::numbers::pi;

computation::Result solved(const std::string& text) {
  return computation::solve(config::parse_case(text, "carried.toml").problem, MPI_COMM_WORLD);
}

struct Units {
  double length, force;
};
constexpr Units all_units[] = {{1, 1}, {1e3, 1e-6}, {1e-3, 1e6}};

/// Deflection of the middle of a square plate, hard simple support, load q, Winkler stiffness k and shear layer G: Navier's series with
/// shear.
double navier(double a, double D, double S, double k, double G, double q) {
  double w = 0;
  for (int m = 1; m < 400; m += 2)
    for (int n = 1; n < 400; n += 2) {
      const double beta = (m * m + n * n) * pi * pi / (a * a);
      const double plate = D * beta * beta / (1 + D * beta / S);
      const double sign = ((m + n) / 2 - 1) % 2 == 0 ? 1 : -1;
      w += sign * 16 * q / (pi * pi * m * n) / (plate + k + G * beta);
    }
  return w;
}

std::string plate(const Units& u, double e, const std::string& rotations, const std::string& cells, int degree) {
  const double E = 1000 * u.force / (u.length * u.length);
  return fmt::format(R"case([shell]
E = {}
nu = 0.3
thickness = {}
shear_correction = "5/6"
rotations = "{}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [{}, {}], cells = [2, 2] }} }}
chart = ["x", "y", "0"]
[mesh]
cells = "{}"
degree = {}
refinements = 3
[model]
check = false
[[support]]
boundary = ["left", "right"]
fix = ["u.z", "u.y", "r.y"]
[[support]]
boundary = ["bottom", "top"]
fix = ["u.z", "u.x", "r.x"]
[[probe]]
name = "middle"
at = [{}, {}]
)case",
                     E, e * u.length, rotations, u.length, u.length, cells, degree, u.length / 2, u.length / 2);
}

TEST(Winkler, PlateHasNaviersDeflection) {
  for (const auto& u : all_units)
    for (const auto& [stiffness, G, e, rotations, cells, degree] :
         {std::tuple(1000.0, 0.0, 0.1, "small", "quadrilateral", 4),
          std::tuple(100.0, 20.0, 0.1, "finite", "quadrilateral", 4),
          std::tuple(10000.0, 0.0, 0.05, "small", "quadrilateral", 4),
          std::tuple(1000.0, 50.0, 0.1, "small", "triangle", 2)}) {
      const double L = u.length, E = 1000 * u.force / (L * L), h = e * L, D = E * h * h * h / 12 / 0.91,
                   S = 5.0 / 6 * E / 2.6 * h, k = stiffness * D / std::pow(L, 4), layer = G * D / (L * L),
                   q = 1e-5 * D / (L * L * L);
      const auto result =
          solved(plate(u, e, rotations, cells, degree) +
                 fmt::format("[[foundation]]\nnormal = {}\nshear = {}\n[[load]]\nforce = [0, 0, {}]\n", k, layer, -q));
      EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
      const double w = navier(L, D, S, k, layer, q), tolerance = degree == 4 ? 2e-6 : 3e-3;
      EXPECT_NEAR(-result.probes.at(0).values.u[2] / w, 1, tolerance) << stiffness << rotations << cells << u.length;
      const auto& reaction = result.summary.foundations.at(0).reaction.force;
      EXPECT_NEAR((reaction + result.summary.support_reaction.force)[2], q * L * L, 1e-9 * q * L * L);
      EXPECT_LT(result.certificate.force_balance, 1e-9);
    }
}

// Values of the literature for the same plate, to their digits.
TEST(Winkler, SeriesGivesThePublishedValues) {
  const double D = 1 / 0.91 / 12 * 1e-3, S = 5.0 / 6 / 2.6 * 0.1;
  EXPECT_NEAR(navier(1, D, S, 1000 * D, 0, D), 1.0776680e-3, 2e-9);
  EXPECT_NEAR(navier(1, D, S, 100 * D, 0, D), 3.3371198e-3, 2e-9);
}

// A force and a moment on a body that springs hold: d = F / k along each axis, theta = M / c, also for large rotations.
TEST(Spring, HoldsABody) {
  for (const auto& u : all_units)
    for (const auto& [rotations, angle, degree] :
         {std::tuple("small", 2.0, 2), std::tuple("finite", 0.1, 3), std::tuple("finite", 2.0, 2)}) {
      const double L = u.length, F = u.force, c = 3 * F * L;
      const auto result =
          solved(fmt::format(R"case([shell]
E = {}
nu = 0.3
thickness = {}
rotations = "{}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [{}, {}], cells = [2, 2] }} }}
chart = ["x", "y", "0"]
[mesh]
degree = {}
refinements = 1
[[rigid_body]]
name = "frame"
boundary = "left"
reference = [{}, 0, {}]
force = [{}, {}, {}]
moment = [0, {}, 0]
[[spring]]
name = "holder"
body = "frame"
stiffness = [{}, {}, {}]
rotation = [{}, {}, {}]
axes = [[0, 0, 1], [1, 0, 0]]
)case",
                             1e3 * F / (L * L), 0.1 * L, rotations, L, L, degree, 0.2 * L, 0.3 * L, F, 2 * F, 3 * F,
                             angle * c, 30 * F / L, 10 * F / L, 20 * F / L, 5 * c, 7 * c, c));
      EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
      const auto& body = result.summary.body_reactions.at(0);
      const Eigen::Vector3d d = L * Eigen::Vector3d(0.1, 0.1, 0.1);
      EXPECT_LT((body.displacement - d).norm(), 1e-9 * L) << rotations << angle;
      EXPECT_LT((body.rotation - Eigen::Vector3d(0, angle, 0)).norm(), 1e-8) << rotations << angle;
      EXPECT_NEAR(result.summary.energy.foundations / (F * L), (0.1 + 0.2 + 0.3) / 2 + angle * angle * 3 / 2, 1e-7);
      const auto& spring = result.summary.foundations.at(0);
      EXPECT_LT((spring.reaction.force + F * Eigen::Vector3d(1, 2, 3)).norm(), 1e-7 * F);
      EXPECT_LT(result.certificate.force_balance, 1e-8);
      EXPECT_LT(result.certificate.moment_balance, 1e-8);
    }
}

// The first frequency of a stiff plate that moves along the spring alone: omega^2 = k / m.
TEST(Spring, GivesABodyItsFrequency) {
  for (const std::string rotations : {"small", "finite"}) {
    const auto result = solved(fmt::format(R"case([shell]
E = 2e11
nu = 0.3
thickness = 0.2
density = 8000
rotations = "{}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [1, 1], cells = [2, 2] }} }}
chart = ["x", "y", "0"]
[[rigid_body]]
name = "frame"
boundary = ["left", "right", "top", "bottom"]
reference = [0.5, 0.5, 0]
fix = ["theta", "u.x", "u.y"]
[[spring]]
body = "frame"
stiffness = [0, 0, 1e4]
[modes]
vibration = 1
)case",
                                           rotations));
    ASSERT_FALSE(result.modes.empty());
    EXPECT_NEAR(result.modes.at(0).value / (1e4 / 1600), 1, 1e-4) << rotations;
  }
}

// A spring alone carries a plate with a rigid motion; a plate on three springs tilts.
TEST(Spring, CarriesARigidPlate) {
  for (const std::string rotations : {"small", "finite"}) {
    const auto result = solved(fmt::format(R"case([shell]
E = 1e9
nu = 0.3
thickness = 0.1
rotations = "{}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [1, 1], cells = [2, 2] }} }}
chart = ["x", "y", "0"]
[mesh]
refinements = 1
[[spring]]
name = "a"
point = [0, 0]
stiffness = [1e3, 1e3, 1000]
[[spring]]
name = "b"
point = [1, 0]
stiffness = [0, 1e3, 2000]
[[spring]]
name = "c"
point = [0.5, 1]
stiffness = [0, 0, 500]
[[load]]
force = [0, 0, -1]
[[probe]]
name = "a"
at = [0, 0]
[[probe]]
name = "b"
at = [1, 0]
[[probe]]
name = "c"
at = [0.5, 1]
)case",
                                           rotations));
    EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
    // The weight of 1 in the middle: 1/4, 1/4 and 1/2.
    EXPECT_NEAR(result.probes.at(0).values.u[2], -0.25 / 1000, 1e-8);
    EXPECT_NEAR(result.probes.at(1).values.u[2], -0.25 / 2000, 1e-8);
    EXPECT_NEAR(result.probes.at(2).values.u[2], -0.5 / 500, 1e-7);
    ASSERT_EQ(result.summary.foundations.size(), 3u);
    EXPECT_NEAR(result.summary.foundations[2].reaction.force[2], 0.5, 1e-5);
    EXPECT_NEAR(result.summary.energy.foundations, (0.0625 / 1000 + 0.0625 / 2000 + 0.25 / 500) / 2, 1e-3 * 0.25 / 500);
  }
}

// code_aster SSNL130: a rigid plate on a one-sided bed under a pressure 5 (y - 2)^2.
TEST(Bed, CarriesARigidPlateOnOneSide) {
  for (const auto& u : all_units)
    for (const std::string rotations : {"small", "finite"})
      for (const std::string turned : {"no", "yes"}) {
        const double L = u.length, F = u.force;
        const bool is_turned = turned == "yes";  // x, y, z to z, x, y
        const auto v = [&](const std::string& x, const std::string& y, const std::string& z) {
          return is_turned ? fmt::format("[{}, {}, {}]", z, x, y) : fmt::format("[{}, {}, {}]", x, y, z);
        };
        const auto component = [&](int k) { return std::string("u.") + "xyz"[is_turned ? (k + 1) % 3 : k]; };
        const auto result = solved(fmt::format(
            R"case([shell]
E = {E}
nu = 0.3
thickness = {e}
rotations = "{rotations}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [{L}, {twice}], cells = [1, 2] }} }}
chart = {chart}
[mesh]
refinements = 4
[model]
check = false
[[support]]
point = [0, 0]
fix = ["{x}", "{y}"]
[[support]]
point = [{L}, 0]
fix = ["{y}"]
[[obstacle]]
half_space = {{ point = [0, 0, 0], normal = {normal} }}
bed = {bed}
[[load]]
force = {force}
[[probe]]
name = "low"
at = [{half}, 0]
[[probe]]
name = "high"
at = [{half}, {twice}]
)case",
            fmt::arg("E", 2e11 * F / (L * L)), fmt::arg("e", 0.3 * L), fmt::arg("rotations", rotations),
            fmt::arg("L", L), fmt::arg("twice", 2 * L), fmt::arg("half", L / 2),
            fmt::arg("chart", v("\"x\"", "\"y\"", fmt::format("\"{}\"", 0.15 * L))), fmt::arg("x", component(0)),
            fmt::arg("y", component(1)), fmt::arg("normal", v("0", "0", "1")), fmt::arg("bed", 5000 * F / (L * L * L)),
            fmt::arg("force", v("0", "0", fmt::format("\"-{}*(y/{}-2)^2\"", 5 * F / (L * L), L)))));
        EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
        const int up = is_turned ? 0 : 2;
        EXPECT_NEAR(result.probes.at(0).values.u[up] / L, -4.0 / 1125, 2e-5) << rotations << turned << L;
        EXPECT_NEAR(result.probes.at(1).values.u[up] / L, 4.0 / 3375, 2e-5) << rotations << turned << L;
        EXPECT_NEAR(result.summary.contact_area / (L * L), 1.5, 0.05);
        EXPECT_NEAR(result.summary.obstacles.at(0).largest_closure / L, 4.0 / 1125, 2e-5);
      }
}

/// A law of a bed through points, for units of length and force.
struct BedTable {
  std::vector<double> closure, pressure;

  double closure_under(double p) const {
    std::size_t i = 1;
    while (i + 1 < pressure.size() && p > pressure[i]) ++i;
    return closure[i - 1] + (p - pressure[i - 1]) * (closure[i] - closure[i - 1]) / (pressure[i] - pressure[i - 1]);
  }
  /// The area below the law, by trapezoids.
  double energy_under(double p) const {
    double sum = 0;
    std::size_t i = 1;
    for (; i + 1 < pressure.size() && p > pressure[i]; ++i)
      sum += (pressure[i] + pressure[i - 1]) / 2 * (closure[i] - closure[i - 1]);
    return sum + (p + pressure[i - 1]) / 2 * (closure_under(p) - closure[i - 1]);
  }
  std::string text(double length, double force) const {
    const auto list = [](const std::vector<double>& values, double unit) {
      std::string all;
      for (const double value : values) all += fmt::format("{}{}", all.empty() ? "" : ", ", value * unit);
      return all;
    };
    return fmt::format("bed = {{ closure = [{}], pressure = [{}] }}", list(closure, length),
                       list(pressure, force / (length * length)));
  }
};

// Stiffening, softening, and both in one table: there Newton steps alone would cycle.
const BedTable all_tables[] = {{{0, 1e-3, 3e-3}, {0, 2, 10}},
                               {{0, 1e-3, 3e-3}, {0, 8, 10}},
                               {{0, 1e-3, 1.2e-3, 3e-3}, {0, 1, 9, 10}},
                               {{0, 2e-4, 1e-3, 1.1e-3, 4e-3}, {0, 4, 4.5, 9, 9.5}}};

// A rigid plate under an even pressure: the bed has this pressure everywhere, and closes by what its table says.
TEST(BedTable, CarriesARigidPlate) {
  for (const auto& u : all_units)
    for (const std::string rotations : {"small", "finite"})
      for (const BedTable& table : all_tables)
        for (const double q : {0.5, 4.2, 9.2, 14.0})
          for (const double start : {0.0, -1.5e-3}) {
            const double L = u.length, unit = u.force / (L * L), c = table.closure_under(q);
            const auto result = solved(fmt::format(
                R"case([shell]
E = {E}
nu = 0.3
thickness = {e}
rotations = "{rotations}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [{L}, {twice}], cells = [1, 2] }} }}
chart = ["x", "y", "{height}"]
[mesh]
refinements = 1
[model]
check = false
[[support]]
point = [0, 0]
fix = ["u.x", "u.y"]
[[support]]
point = [{L}, 0]
fix = ["u.y"]
[[obstacle]]
half_space = {{}}
{bed}
[[load]]
force = [0, 0, {load}]
[[probe]]
name = "middle"
at = [{half}, {L}]
)case",
                fmt::arg("E", 2e11 * unit), fmt::arg("e", 0.3 * L), fmt::arg("rotations", rotations), fmt::arg("L", L),
                fmt::arg("twice", 2 * L), fmt::arg("half", L / 2), fmt::arg("height", (0.15 + start) * L),
                fmt::arg("bed", table.text(L, u.force)), fmt::arg("load", -q * unit)));
            const auto which = fmt::format("{} {} at {} from {}, units {}", rotations, table.text(1, 1), q, start, L);
            EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits << which;
            const auto& contact = result.summary.obstacles.at(0);
            EXPECT_NEAR(result.certificate.min_pressure / unit, q, 1e-8 * q) << which;
            EXPECT_NEAR(result.summary.max_pressure / unit, q, 1e-8 * q) << which;
            EXPECT_NEAR(contact.largest_closure / L, c, 1e-7 * c) << which;
            EXPECT_NEAR(result.probes.at(0).values.u[2] / L, -start - c, 1e-7 * (c - start)) << which;
            EXPECT_NEAR(contact.bed_energy / (unit * L * L * L), 2 * table.energy_under(q),
                        1e-7 * table.energy_under(q))
                << which;
          }
}

/// A clamped plate pressed on an obstacle with these other keys.
computation::Result pressed_on(const std::string& bed, const std::string& rotations, const std::string& obstacle) {
  return solved(fmt::format(R"case([shell]
E = 2e5
nu = 0.3
thickness = 1
rotations = "{}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [40, 40], cells = [2, 2] }} }}
chart = ["x", "y", "0"]
[mesh]
refinements = 3
[model]
check = false
[[support]]
boundary = ["left", "right", "bottom", "top"]
fix = ["u", "r"]
[[load]]
force = [0, 0, -0.5]
[[obstacle]]
{}
{}
)case",
                            rotations, obstacle, bed));
}

// k -> infinity is the rigid obstacle, at first order in 1/k.
TEST(Bed, ThatGrowsStiffIsRigid) {
  for (const std::string rotations : {"small", "finite"})
    for (const std::string obstacle :
         {"half_space = { point = [0, 0, -0.55] }", "ball = { centre = [20, 20, -30.55], radius = 30 }"}) {
      const double rigid = pressed_on("", rotations, obstacle).summary.energy.total();
      double before = 0;
      for (const double bed : {1e5, 1e6, 1e7}) {
        const auto result = pressed_on(fmt::format("bed = {}", bed), rotations, obstacle);
        EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits << bed << rotations << obstacle;
        const double away = std::abs(result.summary.energy.total() - rigid);
        if (before > 0) {
          EXPECT_NEAR(before / away, 10, 4) << bed << rotations << obstacle;
        }
        before = away;
      }
      EXPECT_LT(before, 1e-2 * rigid);
    }
}

/// A strip that lifts off its bed, along x or y, with a mesh.
struct LiftedStrip {
  std::string bed, rotations = "small", cells = "quadrilateral";
  bool is_turned = false;
  int degree = 6, refinements = 2;
  double unit = 1;  ///< of lengths

  computation::Result solve() const {
    const auto xy = [&](const std::string& x, const std::string& y) {
      return is_turned ? fmt::format("{}, {}", y, x) : fmt::format("{}, {}", x, y);
    };
    return solved(fmt::format(
        R"case([shell]
E = {E}
nu = 0.3
thickness = {e}
rotations = "{rotations}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [{to}], cells = [{cells}] }} }}
chart = ["x", "y", "0"]
[mesh]
cells = "{shape}"
degree = {degree}
refinements = {refinements}
[model]
check = false
[[support]]
boundary = "{begin}"
fix = ["u.{x}", "r.{x}"]
[[support]]
boundary = {sides}
fix = ["u.{y}", "r.{y}"]
[[load]]
force = ["0", "0", "-{load} * exp(-{decay} * {x})"]
[[obstacle]]
half_space = {{ point = [0, 0, {table}] }}
{bed}
)case",
        fmt::arg("E", 2e11 / (unit * unit)), fmt::arg("e", 0.03 * unit), fmt::arg("rotations", rotations),
        fmt::arg("to", xy(fmt::to_string(unit), fmt::to_string(unit / 8))), fmt::arg("cells", xy("8", "1")),
        fmt::arg("shape", cells), fmt::arg("degree", degree), fmt::arg("refinements", refinements),
        fmt::arg("begin", is_turned ? "bottom" : "left"), fmt::arg("x", is_turned ? "y" : "x"),
        fmt::arg("y", is_turned ? "x" : "y"),
        fmt::arg("sides", is_turned ? R"(["left", "right"])" : R"(["bottom", "top"])"),
        fmt::arg("load", 6e5 / (unit * unit)), fmt::arg("decay", 10 / unit), fmt::arg("table", -0.015 * unit),
        fmt::arg("bed", bed)));
  }
};

// The pressure has kinks inside of cells, where the sum over nodes errs far more than the strains do.
TEST(Estimates, ContainTheQuadratureOfABedAtItsKinks) {
  const BedTable stiffening{{0, 0.005, 0.02}, {0, 1e5, 6e5}}, softening{{0, 0.002, 0.02}, {0, 1e5, 3e5}};
  for (const auto& [bed, rotations, unit] :
       {std::tuple(std::string("bed = 2.5e7"), "small", 1.0), std::tuple(stiffening.text(1, 1), "small", 1.0),
        std::tuple(softening.text(1e3, 1), "small", 1e3), std::tuple(std::string("bed = 1e8"), "finite", 1.0),
        std::tuple(stiffening.text(1e-3, 1), "finite", 1e-3)}) {
    const double exact = LiftedStrip{.bed = bed, .rotations = rotations, .unit = unit}.solve().summary.energy.total();
    double before = 0, after = 0;
    bool is_turned = false;
    for (const auto& [cells, degree, refinements] :
         {std::tuple("quadrilateral", 2, 1), std::tuple("quadrilateral", 3, 0), std::tuple("quadrilateral", 4, 0),
          std::tuple("quadrilateral", 5, 0), std::tuple("quadrilateral", 6, 0), std::tuple("triangle", 2, 1)}) {
      is_turned = !is_turned;
      const auto result = LiftedStrip{bed, rotations, cells, is_turned, degree, refinements, unit}.solve();
      const auto which = fmt::format("{} {} {} degree {} unit {}", bed, rotations, cells, degree, unit);
      ASSERT_EQ(result.status, contact::Status::solved) << which << result.missed_limits;
      const auto& goals = result.estimates.value().goals;
      const auto& energy = *std::ranges::find(goals, "energy", &estimation::GoalEstimate::name);
      const double error = exact - energy.value;
      EXPECT_GT(energy.error(), 0.5 * std::abs(error)) << which << " error " << error / exact;
      EXPECT_LT(energy.error(), 5 * std::abs(error) + 1e-4 * exact) << which << " error " << error / exact;
      before += std::abs(error / exact);
      after += std::abs((error - energy.difference()) / exact);
      // Balance alone decides the force of the bed.
      const auto& force = *std::ranges::find(goals, "reaction", &estimation::GoalEstimate::name);
      EXPECT_LT(force.error(), 1e-8 * force.value) << which;
    }
    EXPECT_LT(after, before / 3) << bed << rotations;
  }
}

// A table of equal slopes is one stiffness. Others have the pressure of their table at each node.
TEST(BedTable, CarriesAPlateThatBends) {
  for (const std::string rotations : {"small", "finite"})
    for (const std::string obstacle :
         {"half_space = { point = [0, 0, -0.55] }", "ball = { centre = [20, 20, -30.55], radius = 30 }"}) {
      const auto one = pressed_on("bed = 20", rotations, obstacle);
      const double p = one.summary.max_pressure, exactness = obstacle.starts_with("half") ? 1e-10 : 1e-7;
      const BedTable equal{{0, p / 100, p / 50, p / 25}, {0, p / 5, 2 * p / 5, 4 * p / 5}};
      const auto same = pressed_on(equal.text(1, 1), rotations, obstacle);
      EXPECT_EQ(same.status, contact::Status::solved) << same.missed_limits << rotations << obstacle;
      EXPECT_NEAR(same.summary.energy.total() / one.summary.energy.total(), 1, exactness) << rotations << obstacle;
      EXPECT_NEAR(same.summary.obstacles.at(0).bed_energy / one.summary.obstacles.at(0).bed_energy, 1, exactness);
      for (const BedTable& table :
           {BedTable{{0, 0.02, 0.04}, {0, 0.04, 0.4}}, BedTable{{0, 0.005, 0.05}, {0, 0.2, 0.3}},
            BedTable{{0, 0.02, 0.021, 0.06}, {0, 0.02, 0.3, 0.35}}}) {
        const auto result = pressed_on(table.text(1, 1), rotations, obstacle);
        const auto which = rotations + obstacle + table.text(1, 1);
        EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits << which;
        EXPECT_GE(result.certificate.min_pressure, 0) << which;
        EXPECT_LT(result.certificate.complementarity, 1e-7 * result.summary.max_pressure) << which;
        EXPECT_NEAR(result.summary.obstacles.at(0).largest_closure, table.closure_under(result.summary.max_pressure),
                    1e-9)
            << which;
        EXPECT_LT(result.certificate.force_balance, 1e-8) << which;
      }
    }
}

TEST(Temperature, BendsAClampedPlateNotAtAll) {  // code_aster HSLS01
  for (const std::string rotations : {"small", "finite"}) {
    const auto result = solved(fmt::format(R"case([shell]
E = 2e11
nu = 0.3
thickness = 0.01
expansion = 1e-5
rotations = "{}"
[geometry]
domain = {{ polygon = {{ corners = [[0, 0], [1.2, 0], [1.98, 1.04], [0.78, 1.04]] }} }}
chart = ["x", "y", "0"]
[mesh]
refinements = 2
[[support]]
boundary = ["edge1", "edge2", "edge3", "edge4"]
fix = ["u", "r"]
[[temperature]]
difference = 100
[[probe]]
name = "middle"
at = [0.9, 0.5]
)case",
                                           rotations));
    const auto& middle = result.probes.at(0).values;
    EXPECT_NEAR(middle.M[0], -2380.952, 1e-2);
    EXPECT_NEAR(middle.M[1], -2380.952, 1e-2);
    EXPECT_LT(middle.u.norm(), 1e-12);
  }
}

// A held plate that is heated evenly stays where it is, in compression and in tension.
TEST(Temperature, MovesNoHeldPlate) {
  for (const std::string rotations : {"small", "finite"})
    for (const double mean : {0.5, -1.0, 1e-3}) {
      const auto result = solved(fmt::format(R"case([shell]
E = 2e5
nu = 0.3
thickness = 0.01
expansion = 1e-5
rotations = "{}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [1, 1] }} }}
chart = ["x", "y", "0"]
[mesh]
refinements = 1
[[support]]
boundary = ["left", "right", "bottom", "top"]
fix = ["u", "r"]
[[temperature]]
mean = {}
)case",
                                             rotations, mean));
      EXPECT_EQ(result.status, contact::Status::solved) << rotations << mean << result.missed_limits;
      EXPECT_NEAR(result.summary.energy.total() / (2e5 * 0.01 / 0.7 * 1e-10 * mean * mean), 1, 1e-9);
    }
}

TEST(Temperature, StressesAPlateBetweenWalls) {  // code_aster V4.03.102: sigma_xx = 10 - 10 Y
  for (const auto& u : all_units) {
    const double L = u.length, E = 20000 * u.force / (L * L);
    const auto result = solved(fmt::format(R"case([shell]
E = {E}
nu = 0.3
thickness = {e}
expansion = 1e-5
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [{L}, {L}], cells = [2, 2] }} }}
chart = ["x", "y", "0"]
[mesh]
refinements = 2
[[support]]
boundary = ["left", "right"]
fix = ["u.x", "u.z"]
[[support]]
boundary = "bottom"
fix = ["u.y"]
[[temperature]]
mean = "50*y/{L} - 50"
[[probe]]
name = "quarter"
at = [{half}, {quarter}]
)case",
                                           fmt::arg("E", E), fmt::arg("e", 0.1 * L), fmt::arg("L", L),
                                           fmt::arg("half", L / 2), fmt::arg("quarter", L / 4)));
    const auto f = section_forces(result.probes.at(0).values);
    EXPECT_NEAR(shell::in_plane_stress(f, 0)[0] / E * 20000, 7.5, 1e-9);
    EXPECT_NEAR(shell::in_plane_stress(f, 0)[1] / E * 20000, 0, 1e-9);
  }
}

// ANSYS VM174: a bimetal strip of two layers of 0.05 in, heated by 400 F: 0.900 in; as a true arc 0.890322 in.
TEST(Temperature, CurlsABimetalStrip) {
  for (const auto& [rotations, deflection] : {std::pair("small", 0.9), std::pair("finite", 0.890322)}) {
    const auto result = solved(fmt::format(R"case([[material]]
name = "hot"
E = 1e7
nu = 0
expansion = 14.5e-6
[[material]]
name = "cold"
E = 1e7
nu = 0
expansion = 2.5e-6
[[material]]
name = "bimetal"
layers = [{{ material = "hot", thickness = 1 }}, {{ material = "cold", thickness = 1 }}]
[shell]
material = "bimetal"
thickness = 0.1
rotations = "{}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [5, 0.5], cells = [4, 1] }} }}
chart = ["x", "y", "0"]
[mesh]
degree = 4
refinements = 1
[model]
check = false
[[support]]
boundary = "left"
fix = ["symmetry"]
[[support]]
boundary = "right"
fix = ["u.z"]
[[support]]
boundary = ["bottom", "top"]
fix = ["symmetry"]
[[temperature]]
mean = 400
[[probe]]
name = "middle"
at = [0, 0.25]
)case",
                                           rotations));
    EXPECT_NEAR(std::abs(result.probes.at(0).values.u[2]), deflection, 2e-4 * deflection) << rotations;
  }
}

std::string slab(const std::string& rest, const std::string& rotations = "small") {
  return fmt::format(R"case([shell]
E = 2e5
nu = 0.3
thickness = 2
density = 7.85e-9
expansion = 1.2e-5
rotations = "{}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [100, 100], cells = [2, 2] }} }}
chart = ["x", "y", "2"]
[mesh]
refinements = 2
[model]
check = false
[[support]]
name = "rim"
boundary = ["left", "right"]
fix = ["u", "r"]
[gravity]
name = "weight"
acceleration = [0, 0, -9810]
[[load]]
name = "wind"
pressure = 0.03
[[load]]
name = "snow"
force = [0, 0, -0.3]
[[temperature]]
name = "summer"
mean = "0.1*x"
[[obstacle]]
half_space = {{ point = [0, 0, 0.9] }}
[[probe]]
name = "middle"
at = [50, 50]
{}
)case",
                     rotations, rest);
}

TEST(LoadCases, AreThoseOfFilesOfTheirOwn) {
  for (const std::string rotations : {"small", "finite"}) {
    const auto both = solved(slab(R"case([[case]]
name = "A"
factors = { weight = 1, wind = 1.5 }
[[case]]
name = "B"
factors = { weight = 1.35, snow = 1.5 }
[[case]]
name = "C"
factors = { summer = 1, snow = 0.2 }
)case",
                                  rotations));
    ASSERT_EQ(both.history.size(), 3u);
    int k = 0;
    for (const std::string factors :
         {"weight = 1, wind = 1.5, snow = 0, summer = 0", "weight = 1.35, snow = 1.5, wind = 0, summer = 0",
          "summer = 1, snow = 0.2, weight = 0, wind = 0"}) {
      const auto alone = solved(slab(fmt::format("[[step]]\nfactors = {{ {} }}\n", factors), rotations));
      const auto& in_both = both.history[static_cast<std::size_t>(k++)];
      EXPECT_EQ(in_both.status, contact::Status::solved);
      EXPECT_NEAR(in_both.summary.energy.total() / alone.summary.energy.total(), 1, 1e-7) << factors << rotations;
      EXPECT_NEAR(in_both.probes.at(0).values.u[2], alone.probes.at(0).values.u[2], 1e-7) << factors << rotations;
      EXPECT_NEAR(in_both.summary.contact_area, alone.summary.contact_area, 1e-4 * 1e4) << factors << rotations;
    }
  }
}

// Weight first and snow later, by factors and by hand.
// A strip on a bed under 1.2 times its buckling load, and then bent to 3 % of strain: the warnings name that case in any order.
TEST(LoadCases, AreAllJudged) {
  const std::string rest = "[[case]]\nname = \"rest\"\nfactors = { w = 1 }\n",
                    storm = "[[case]]\nname = \"storm\"\nfactors = { push = 1 }\n",
                    flood = "[[case]]\nname = \"flood\"\nfactors = { w = 1e6 }\n";
  for (const std::string& cases : {rest + storm, storm + rest, flood + storm + rest, rest + flood + storm}) {
    const auto result = solved(R"case([shell]
E = 2.1e11
nu = 0
thickness = 0.01
[geometry]
domain = { rectangle = { to = [1, 0.2], cells = [8, 1] } }
chart = ["x", "y", "0"]
[mesh]
degree = 4
refinements = 0
[[foundation]]
normal = 2e5
[[support]]
boundary = "left"
fix = ["u"]
[[support]]
boundary = "right"
fix = ["u.y", "u.z"]
[[load]]
name = "push"
boundary = "right"
force = [-231578.776, 0, 0]
[[load]]
name = "w"
force = [0, 0, -1]
)case" + cases);
    using testing::AllOf, testing::Contains, testing::HasSubstr, testing::StartsWith;
    EXPECT_THAT(result.warnings,
                Contains(AllOf(StartsWith("in the case \"storm\", the membrane forces are 1.2"), HasSubstr("buckle"))))
        << cases;
    if (cases.find("flood") == std::string::npos) continue;
    EXPECT_THAT(result.warnings, Contains(StartsWith("in the case \"flood\", the largest strain is"))) << cases;
  }
}

TEST(Factors, MakeAHistory) {
  const auto result = solved(slab(R"case([[step]]
factors = { weight = 1, wind = 0, snow = 0, summer = 0 }
[[step]]
factors = { snow = 1 }
parts = 2
)case"));
  ASSERT_EQ(result.history.size(), 3u);
  const auto weight = solved(slab("[[step]]\nfactors = { weight = 1, wind = 0, snow = 0, summer = 0 }\n")),
             half = solved(slab("[[step]]\nfactors = { weight = 1, wind = 0, snow = 0.5, summer = 0 }\n"));
  EXPECT_NEAR(result.history[0].summary.energy.total() / weight.summary.energy.total(), 1, 1e-9);
  EXPECT_NEAR(result.history[1].summary.energy.total() / half.summary.energy.total(), 1, 1e-7);
  EXPECT_NEAR(result.history[1].summary.loads.force[2], -0.15 * 1e4 - 7.85e-9 * 2 * 9810 * 1e4, 1e-6);
}

TEST(Factors, ReleaseSupports) {
  const auto result = solved(slab(R"case([[support]]
name = "prop"
boundary = ["bottom", "top"]
fix = ["u.z"]
[[step]]
factors = { snow = 0.1, summer = 0, wind = 0, weight = 0 }
[[step]]
release = ["prop"]
)case"));
  ASSERT_EQ(result.history.size(), 2u);
  const auto without = solved(slab("[[step]]\nfactors = { snow = 0.1, summer = 0, wind = 0, weight = 0 }\n"));
  EXPECT_NEAR(result.history[1].summary.energy.total() / without.summary.energy.total(), 1, 1e-9);
  EXPECT_GT(result.history[1].summary.energy.total(), 1.5 * result.history[0].summary.energy.total());
}

TEST(Control, FollowsOneLoadWhileOthersStay) {
  const auto text = [](const std::string& step) {
    return fmt::format(R"case([shell]
E = 2e5
nu = 0.3
thickness = 1
rotations = "finite"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [40, 10], cells = [4, 1] }} }}
chart = ["x", "y", "0"]
[mesh]
refinements = 1
[[support]]
boundary = ["left", "right"]
fix = ["u", "r"]
[[load]]
name = "dead"
force = [0, 0, -0.2]
[[load]]
name = "live"
force = [0, 0, -1]
[[probe]]
name = "middle"
at = [20, 5]
{}
)case",
                       step);
  };
  const auto controlled = solved(text(R"case([[step]]
factors = { dead = 1, live = 0 }
[[step]]
control = { probe = "middle", to = -0.4, load = "live" }
)case"));
  ASSERT_EQ(controlled.history.size(), 2u);
  EXPECT_NEAR(controlled.probes.at(0).values.u[2], -0.4, 1e-9);
  const double live = controlled.history.back().factors.named.at(1);
  const auto by_hand = solved(text(fmt::format("[[step]]\nfactors = {{ dead = 1, live = {} }}\n", live)));
  EXPECT_NEAR(by_hand.probes.at(0).values.u[2], -0.4, 1e-7);
}

// (M30): the lowest frequency of a plate on a foundation, omega^2 = (D beta^2 + k) / (rho e) without shear; and the buckling load of a
// long strip on one, 2 sqrt(k D).
TEST(Foundation, RaisesFrequencies) {
  const auto text = [](double k) {
    return fmt::format(R"case([shell]
E = 2e11
nu = 0.3
thickness = 0.01
density = 8000
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [1, 1], cells = [2, 2] }} }}
chart = ["x", "y", "0"]
[mesh]
degree = 4
refinements = 2
[[support]]
boundary = ["left", "right"]
fix = ["u.z", "u.y", "r.y"]
[[support]]
boundary = ["bottom", "top"]
fix = ["u.z", "u.x", "r.x"]
[[foundation]]
normal = {}
[modes]
vibration = 1
)case",
                       k);
  };
  const auto square = [&](double k) {
    const auto result = solved(text(k));
    return result.modes.empty() ? 0 : result.modes.at(0).value;
  };
  const double k = 3e6;
  EXPECT_NEAR((square(k) - square(0)) / (k / 80), 1, 1e-3);
}

TEST(Foundation, HoldsALongStripAgainstBuckling) {
  const double E = 2e5, e = 1, D = E * e * e * e / 12, k = 2, P = 2 * std::sqrt(k * D);
  const auto result = solved(fmt::format(R"case([shell]
E = {}
nu = 0
thickness = {}
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [400, 5], cells = [40, 1] }} }}
chart = ["x", "y", "0"]
[mesh]
degree = 3
refinements = 1
[[support]]
boundary = ["bottom", "top"]
fix = ["symmetry"]
[[support]]
boundary = "left"
fix = ["u.x", "u.z"]
[[support]]
boundary = "right"
fix = ["u.z"]
[[foundation]]
normal = {}
[[load]]
boundary = "right"
force = [-1, 0, 0]
[modes]
buckling = 1
)case",
                                         E, e, k));
  ASSERT_FALSE(result.modes.empty());
  EXPECT_NEAR(result.modes.at(0).value / P, 1, 1e-2);
}

// A plate with all of its scene turned: supports along turned axes, or along a direction, have the same results.
TEST(SkewSupports, AreThoseOfATurnedScene) {
  const auto scene = [](double angle, const std::string& rotations, bool by_direction) {
    const double c = std::cos(angle), s = std::sin(angle);
    const std::string normal = fmt::format("[{}, 0, {}]", -s, c), along = fmt::format("[{}, 0, {}]", c, s);
    const std::string roller = by_direction ? fmt::format("fix = [\"u.d\"]\ndirection = {}", normal)
                                            : fmt::format("fix = [\"u.3\"]\naxes = [{}, [0, 1, 0]]", along);
    return solved(fmt::format(R"case([shell]
E = 2e5
nu = 0.3
thickness = 1
rotations = "{}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [40, 10], cells = [4, 1] }} }}
chart = ["{}*x", "y", "{}*x"]
[mesh]
refinements = 1
[model]
check = false
[[support]]
boundary = "left"
fix = ["u.1", "u.2", "u.3"]
axes = [{}, [0, 1, 0]]
[[support]]
boundary = "right"
{}
[[load]]
force = {}
[[probe]]
name = "middle"
at = [20, 5]
)case",
                              rotations, c, s, along, roller, fmt::format("[{}, 0, {}]", 0.05 * s, -0.05 * c)));
  };
  for (const std::string rotations : {"small", "finite"}) {
    const auto straight = scene(0, rotations, true);
    for (const double angle : {0.3, -1.1, 2.0})
      for (const bool by_direction : {true, false}) {
        const auto turned = scene(angle, rotations, by_direction);
        EXPECT_EQ(turned.status, contact::Status::solved);
        EXPECT_NEAR(turned.summary.energy.total() / straight.summary.energy.total(), 1, 1e-8) << rotations << angle;
        EXPECT_NEAR(turned.probes.at(0).values.u.norm(), straight.probes.at(0).values.u.norm(), 1e-8) << angle;
      }
  }
}

}  // namespace
}  // namespace plastron::carried_shells
