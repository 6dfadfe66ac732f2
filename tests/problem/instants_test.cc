// Instants of drawn steps: they go in equal parts, end with the factors of the steps to the last bit, and lie between each other.
#include <gtest/gtest.h>
#include <plastron/problem/instants.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace plastron::problem::instants_test {
namespace {

using Random = std::mt19937;
constexpr double rounding = 1e-14;

double drawn(Random& random) { return std::uniform_real_distribution<double>(-2, 2)(random); }
int drawn_number(Random& random, int least, int most) {
  return std::uniform_int_distribution<int>(least, most)(random);
}

/// One to five steps with two pressed obstacles and two named factors.
Problem drawn_problem(Random& random, bool chooses) {
  Problem p;
  p.shell.obstacles.all.resize(2);
  p.factor_names = {"wind", "snow"};
  const int steps = drawn_number(random, 1, 5);
  for (int s = 0; s < steps; ++s)
    p.steps.push_back({.name = "step " + std::to_string(s),
                       .factors = {.loads = drawn(random),
                                   .supports = drawn(random),
                                   .forces = {drawn(random), drawn(random)},
                                   .named = {drawn(random), drawn(random)},
                                   .released = {static_cast<char>(drawn_number(random, 0, 1)), 0}},
                       .parts = chooses ? 1 : drawn_number(random, 1, 7),
                       .chooses_parts = chooses});
  return p;
}

std::vector<double> numbers_of(const energy::Factors& f) {
  std::vector<double> all{f.loads, f.supports};
  all.insert(all.end(), f.forces.begin(), f.forces.end());
  all.insert(all.end(), f.named.begin(), f.named.end());
  return all;
}

TEST(Instants, GoInEqualPartsAndEndWithTheFactorsOfTheirSteps) {
  Random random(1);
  for (int draw = 0; draw < 50; ++draw) {
    const Problem p = drawn_problem(random, false);
    const std::vector<Instant> all = instants(p);
    std::size_t at = 0;
    std::vector<double> before(6, 0);
    for (std::size_t s = 0; s < p.steps.size(); ++s) {
      const Step& step = p.steps[s];
      const std::vector<double> goal = numbers_of(step.factors);
      for (int j = 1; j <= step.parts; ++j, ++at) {
        ASSERT_LT(at, all.size());
        EXPECT_EQ(all[at].step, static_cast<int>(s));
        EXPECT_NEAR(all[at].factors.time, static_cast<double>(s) + static_cast<double>(j) / step.parts, rounding);
        EXPECT_NEAR(all[at].part, static_cast<double>(j) / step.parts, rounding);
        EXPECT_EQ(all[at].overlap, 0);
        EXPECT_EQ(all[at].control, nullptr);
        EXPECT_EQ(all[at].factors.released, step.factors.released);
        const std::vector<double> now = numbers_of(all[at].factors);
        ASSERT_EQ(now.size(), goal.size());
        for (std::size_t k = 0; k < goal.size(); ++k)
          EXPECT_NEAR(now[k], before[k] + (goal[k] - before[k]) * j / step.parts, rounding);
      }
      EXPECT_EQ(numbers_of(all[at - 1].factors), goal);
      EXPECT_EQ(all[at - 1].factors.time, static_cast<double>(s + 1));
      before = goal;
    }
    EXPECT_EQ(at, all.size());
  }
}

// A step that chooses its parts has one instant, its end. The first step has a second one at an eighth.
TEST(Instants, OfChosenPartsAreTheEndsAndAFirstPart) {
  Random random(2);
  for (int draw = 0; draw < 10; ++draw) {
    const Problem p = drawn_problem(random, true);
    const std::vector<Instant> all = instants(p);
    ASSERT_EQ(all.size(), p.steps.size() + 1);
    EXPECT_EQ(all[0].factors.time, 0.125);
    for (std::size_t k = 0; k < numbers_of(all[0].factors).size(); ++k)
      EXPECT_NEAR(numbers_of(all[0].factors)[k], numbers_of(p.steps[0].factors)[k] / 8, rounding);
    for (std::size_t s = 0; s < p.steps.size(); ++s) {
      EXPECT_EQ(numbers_of(all[s + 1].factors), numbers_of(p.steps[s].factors));
      EXPECT_TRUE(all[s + 1].chooses_parts);
    }
  }
}

// Half of the way to a part of the way is half of that part; the start has everything at zero and the whole overlap.
TEST(Instants, BetweenTwoLieOnTheWay) {
  Random random(3);
  for (int draw = 0; draw < 30; ++draw) {
    const Problem p = drawn_problem(random, false);
    const Instant from = start(p), to = instants(p).front();
    EXPECT_EQ(from.factors.time, 0);
    EXPECT_EQ(from.factors.load(-1), 0);
    EXPECT_EQ(from.factors.support(-1), 0);
    EXPECT_EQ(from.factors.force(0) + from.factors.force(1), 0);
    EXPECT_EQ(from.overlap, 1);
    const double part = std::abs(drawn(random)) / 2;
    const Instant middle = between(from, to, part), direct = between(from, to, part / 2),
                  twice = between(from, middle, 0.5);
    EXPECT_NEAR(middle.factors.time, part * to.factors.time, rounding);
    EXPECT_NEAR(middle.overlap, 1 - part, rounding);
    EXPECT_NEAR(twice.overlap, direct.overlap, rounding);
    EXPECT_NEAR(middle.part, middle.factors.time - middle.step, rounding);
    for (std::size_t k = 0; k < numbers_of(direct.factors).size(); ++k)
      EXPECT_NEAR(numbers_of(twice.factors)[k], numbers_of(direct.factors)[k], rounding);
    EXPECT_EQ(numbers_of(between(from, to, 1).factors), numbers_of(to.factors));
    EXPECT_EQ(between(from, to, 1).part, to.part);
    EXPECT_EQ(between(from, to, 1).overlap, 0);
  }
}

TEST(Controls, AskForEqualPartsOfTheWayOfTheirProbe) {
  Random random(4);
  Problem p;
  p.probes = {{.name = "other", .at = {9, 9}}, {.name = "tip", .at = {0.25, 0.5}}};
  const Eigen::Vector3d direction(0.6, 0, -0.8);
  p.steps = {{.name = "push",
              .factors = {},
              .control = Control{.probe = "tip", .direction = direction, .to = 0.3, .factor = 1},
              .parts = 4},
             {.name = "rest", .factors = {.loads = 2}}};
  const std::vector<Instant> all = instants(p);
  ASSERT_EQ(all.size(), 5U);
  for (int draw = 0; draw < 5; ++draw) {
    const double start = drawn(random);
    for (std::size_t j = 0; j < 4; ++j) {
      const auto control = control_of(p, all[j], start);
      ASSERT_TRUE(control.has_value());
      EXPECT_EQ(control->at, p.probes[1].at);
      EXPECT_EQ(control->direction, direction);
      EXPECT_EQ(control->factor, 1);
      EXPECT_NEAR(control->displacement, start + (0.3 - start) * static_cast<double>(j + 1) / 4, rounding);
    }
    EXPECT_EQ(control_of(p, all[3], start)->displacement, 0.3);
    EXPECT_FALSE(control_of(p, all[4], start).has_value());
  }
  p.probes.pop_back();
  EXPECT_THROW((void)control_of(p, all[0], 0), std::logic_error);
}

// A factor of its own replaces the common one where it is given; a rate is 1 for the controlled factor alone.
TEST(Factors, AreTheirOwnOrTheCommonOnes) {
  Random random(5);
  for (int draw = 0; draw < 20; ++draw) {
    energy::Factors f{.loads = drawn(random), .supports = drawn(random)};
    const double own = drawn(random);
    f.named = {own, std::numeric_limits<double>::quiet_NaN()};
    for (const int name : {-1, 1, 2, 7}) {
      EXPECT_EQ(f.load(name), f.loads);
      EXPECT_EQ(f.support(name), f.supports);
    }
    EXPECT_EQ(f.load(0), own);
    EXPECT_EQ(f.support(0), own);
    for (const int controlled : {-1, 0}) {
      const energy::Factors rates = f.load_rates(controlled);
      // The load without a factor follows where all do; factor 1 is the common one.
      EXPECT_EQ(rates.load(-1), controlled < 0 ? 1 : 0);
      EXPECT_EQ(rates.load(0), controlled == 0 ? 1 : 0);
      EXPECT_EQ(rates.load(1), controlled < 0 ? 1 : 0);
    }
  }
}

}  // namespace
}  // namespace plastron::problem::instants_test
