// Estimates of the remaining time from known times.
#include <gtest/gtest.h>

#include <time_left.hpp>

namespace plastron::app {
namespace {

TEST(MeshesLeft, GrowAsTheyHaveGrown) {
  MeshesLeft meshes(4);
  meshes.done(1);
  EXPECT_FALSE(meshes.end()) << "one mesh does not tell how they grow";
  meshes.done(1 + 4);
  EXPECT_DOUBLE_EQ(meshes.end().value(), 5 + 16 + 64);
  meshes.done(5 + 20);
  EXPECT_DOUBLE_EQ(meshes.end().value(), 25 + 100);
  meshes.done(125);
  EXPECT_FALSE(meshes.end()) << "nothing is left";
}

TEST(MeshesLeft, SayNothingAfterMomentsAndNothingWild) {
  MeshesLeft quick(5), uneven(3);
  quick.done(0.001);
  quick.done(0.002);
  EXPECT_FALSE(quick.end());
  uneven.done(0);
  uneven.done(1);
  EXPECT_DOUBLE_EQ(uneven.end().value(), 1 + 8);
}

TEST(PartsLeft, AreAlike) {
  PartsLeft parts(4, 10);
  EXPECT_FALSE(parts.end());
  parts.done(12);
  EXPECT_DOUBLE_EQ(parts.end().value(), 18);
  parts.done(16);
  EXPECT_DOUBLE_EQ(parts.end().value(), 22);
  parts.done(19);
  parts.done(22);
  EXPECT_FALSE(parts.end());
}

TEST(TimesLeft, AreRounded) {
  EXPECT_EQ(left_text(1), "");
  EXPECT_EQ(left_text(-5), "");
  EXPECT_EQ(left_text(7.4), "about 7 s left");
  EXPECT_EQ(left_text(43), "about 45 s left");
  EXPECT_EQ(left_text(200), "about 3 min left");
  EXPECT_EQ(left_text(7000), "about 2 h left");
}

}  // namespace
}  // namespace plastron::app
