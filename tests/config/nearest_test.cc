#include <gtest/gtest.h>
#include <plastron/config/nearest.hpp>

#include <vector>

namespace plastron::config {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("thicknes", "thickness"), 1);
  EXPECT_EQ(edit_distance("thicckness", "thickness"), 1);
  EXPECT_EQ(edit_distance("lfet", "left"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(EditDistance, IsSymmetricAndIgnoresCase) {
  EXPECT_EQ(edit_distance("sunday", "Saturday"), edit_distance("saturday", "sunday"));
  EXPECT_EQ(edit_distance("NU", "nu"), 0);
}

TEST(Nearest, NamesAWordOnlyIfItIsNear) {
  const std::vector<std::string> known{"E", "nu", "thickness", "left", "lower"};
  EXPECT_EQ(nearest("thikness", known), "thickness");
  EXPECT_EQ(nearest("e", known), "E");
  EXPECT_EQ(nearest("thick", known), "thickness");
  EXPECT_EQ(nearest("lefthand", known), "left");
  EXPECT_EQ(nearest("q", known), "");
  EXPECT_EQ(nearest("density", known), "");
  EXPECT_EQ(nearest("", known), "");
}

TEST(Nearest, PrefersTheNearer) {
  const std::vector<std::string> known{"edge12", "edge1", "edge2"};
  EXPECT_EQ(nearest("edeg1", known), "edge1");
  EXPECT_EQ(did_you_mean("egde2", known), "did you mean \"edge2\"?");
}

}  // namespace
}  // namespace plastron::config
