// Tables in the documentation that are made from the code. They stand between two comments of the page.
#pragma once
#include <gtest/gtest.h>

#include <string>

namespace plastron::test {

/// `text` with the content between the markers of a table replaced.
inline std::string with_table(const std::string& text, const std::string& name, const std::string& table) {
  const std::string begin = "<!-- table: " + name + " -->\n", end = "<!-- end of table -->";
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) {
    ADD_FAILURE() << "the page has no line " << begin;
    return text;
  }
  const std::size_t from = at + begin.size(), to = text.find(end, from);
  return text.substr(0, from) + table + text.substr(to);
}

}  // namespace plastron::test
