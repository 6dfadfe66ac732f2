#include <gtest/gtest.h>
#include <plastron/config/printable.hpp>

namespace plastron::config {
namespace {

TEST(Printable, KeepsTextOfAllLanguages) {
  for (const std::string text : {"", "plain text", "Größe, épaisseur, толщина, 厚さ, 𝜑\tx", "a~b"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, HasNoControlCharacters) {
  EXPECT_EQ(printable("\x1b[31mred\x07"), "?[31mred?");
  EXPECT_EQ(printable(std::string("a\0b\x7f", 4)), "a?b?");
  EXPECT_EQ(printable("\xC2\x9B"), "?");  // the one-byte form of ESC [
  EXPECT_EQ(printable("\xE2\x80\xAE"
                      "abc"),
            "?abc");  // writing from right to left
  EXPECT_EQ(printable("a\r\nb"), "a??b");
  EXPECT_EQ(printable("a\r\nb", LineBreaks::keep), "a?\nb");
}

TEST(Printable, HasNoBytesThatAreNoText) {
  EXPECT_EQ(printable("\x9B\xFF"), "??");
  EXPECT_EQ(printable("\xC3"), "?");
  EXPECT_EQ(printable("\xC0\x9B"), "??");  // ESC in an overlong form
}

}  // namespace
}  // namespace plastron::config
