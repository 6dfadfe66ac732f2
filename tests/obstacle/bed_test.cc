// The law of a bed (M33): pressure and closure are inverse, the pressure is the derivative of the energy, each segment is a line through
// its points. Tables are drawn at random, with slopes that rise and fall by powers of ten.
#include <gtest/gtest.h>
#include <plastron/obstacle/bed.hpp>

#include <cmath>
#include <random>

namespace plastron::obstacle {
namespace {

std::vector<std::pair<double, double>> random_points(std::mt19937& random) {
  std::uniform_real_distribution<double> power(-3, 3);
  std::vector<std::pair<double, double>> points{{0, 0}};
  const auto count = std::uniform_int_distribution<int>(1, 6)(random);
  for (int i = 0; i < count; ++i)
    points.emplace_back(points.back().first + std::pow(10, power(random)),
                        points.back().second + std::pow(10, power(random)));
  return points;
}

TEST(ABed, IsRigidWithoutALaw) {
  EXPECT_TRUE(Bed{}.is_rigid());
  EXPECT_FALSE(Bed{2.0}.is_rigid());
  EXPECT_FALSE(Bed{2.0}.has_segments());
}

TEST(ABed, OfOneStiffnessIsASpring) {
  for (const double k : {5e7, 3e-5, 0.1}) {
    const Bed bed{k};
    for (const double c : {0.0, 0.3, 1.0, 7.1}) {
      EXPECT_EQ(bed.pressure(c), k * c);
      EXPECT_EQ(bed.segment(c).pressure(c), k * c);
      EXPECT_EQ(bed.closure(k * c), k * c / k);
      EXPECT_EQ(bed.energy(k * c), k * c * (k * c) / k / 2);
    }
    EXPECT_EQ(bed.pressure(-1), 0);
    EXPECT_EQ(bed.segment(-1).shift, 0);
    EXPECT_EQ(bed.stiffnesses(), std::pair(k, k));
  }
}

TEST(ABed, PassesThroughThePointsOfItsTable) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const auto points = random_points(random);
    const Bed bed(points);
    double energy = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [c, p] = points[i];
      if (i > 0) energy += (p + points[i - 1].second) / 2 * (c - points[i - 1].first);
      EXPECT_NEAR(bed.pressure(c), p, 1e-9 * p);
      EXPECT_NEAR(bed.closure(p), c, 1e-9 * c);
      EXPECT_NEAR(bed.energy(p), energy, 1e-9 * energy);
    }
    const auto& [c, p] = points.back();
    const double slope = (p - points[points.size() - 2].second) / (c - points[points.size() - 2].first);
    EXPECT_NEAR(bed.pressure(3 * c), p + 2 * c * slope, 1e-9 * (p + 2 * c * slope));
  }
}

TEST(ABed, HasInversesDerivativesAndLines) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const auto points = random_points(random);
    const Bed bed(points);
    EXPECT_EQ(bed.has_segments(), points.size() > 2);
    for (int i = 0; i < 20; ++i) {
      const double c = std::uniform_real_distribution<double>(0, 1.5)(random) * points.back().first;
      const double p = bed.pressure(c);
      EXPECT_NEAR(bed.closure(p), c, 1e-9 * points.back().first);
      const Bed::Segment line = bed.segment(c);
      EXPECT_NEAR(line.pressure(c), p, 1e-9 * bed.pressure(2 * points.back().first));
      EXPECT_GE(line.stiffness, bed.stiffnesses().first);
      EXPECT_LE(line.stiffness, bed.stiffnesses().second);
      // The trapezoidal rule is exact within a segment.
      const double step = 1e-3 * points.back().first;
      if (bed.segment(c + step).stiffness != line.stiffness) continue;
      const double work = (p + bed.pressure(c + step)) / 2 * step;
      EXPECT_NEAR(bed.energy(bed.pressure(c + step)) - bed.energy(p), work,
                  1e-9 * bed.energy(bed.pressure(2 * points.back().first)));
    }
  }
}

}  // namespace
}  // namespace plastron::obstacle
