#include <plastron/computation/step_control.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace plastron::computation {
namespace {

constexpr Pace chosen_parts{.first = 0.125, .longest = 0.25, .follows_iteration = true};

/// The number of parts of a way on which a part of this length takes so many Newton steps.
int parts_of_way(const std::function<int(double)>& steps) {
  PartLength length(chosen_parts);
  int parts = 0;
  for (double done = 0; done < 1 && parts < 10'000; ++parts) {
    const double part = std::min(length(), 1 - done);
    length.accept(part, steps(part));
    done += part;
  }
  return parts;
}

// With admissible gaps each part of a way took 12 steps, and the parts became shorter for ever.
TEST(PartLength, DoesNotShrinkWhereThatSparesNoSteps) {
  for (int steps = 1; steps <= 60; ++steps) EXPECT_LE(parts_of_way([&](double) { return steps; }), 32) << steps;
}

TEST(PartLength, ShrinksWhereShorterPartsTakeFewerSteps) {
  // Seven steps at a length of 1/50: the way has about 50 parts.
  const int parts = parts_of_way([](double part) { return static_cast<int>(std::ceil(7 * std::sqrt(50 * part))); });
  EXPECT_GT(parts, 30);
  EXPECT_LT(parts, 90);
}

// Rounds that take `idle` steps whatever the length, and steps that fall with it: some parts are long, and all ways end.
TEST(PartLength, EndsWhateverStepsDoNotFall) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0, 40);
  for (int i = 0; i < 200; ++i) {
    const double idle = number(random), part_of_length = number(random);
    const auto steps = [&](double part) { return static_cast<int>(1 + idle + part_of_length * std::sqrt(part)); };
    EXPECT_LE(parts_of_way(steps), 400) << idle << " " << part_of_length;
  }
}

TEST(PartLength, GrowsToTheLongestPart) {
  PartLength length(chosen_parts);
  for (int i = 0; i < 4; ++i) length.accept(length(), 2);
  EXPECT_EQ(length(), chosen_parts.longest);
}

}  // namespace
}  // namespace plastron::computation
