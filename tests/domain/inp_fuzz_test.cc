// Damaged input files of Abaqus and CalculiX, the same in every run. Each is read or refused with DomainError, at once.
#include <gtest/gtest.h>

#include <chrono>

#include "domain/mutator.hpp"
#include "domain/written_deck.hpp"

namespace plastron::domain {
namespace {

using namespace written;

/// Returns whether the text has a mesh of shells. Other exceptions than DomainError end the test.
bool is_deck(const std::string& text) {
  try {
    const MeshData data = deck(text);
    for (const std::int64_t node : data.element_nodes) EXPECT_LT(static_cast<std::size_t>(node), data.nodes.size());
    for (const std::string& note : data.notes) EXPECT_LT(note.size(), 1000u);
    try {
      build_coarse_mesh(data, mesh::Shape::triangle);  // which refuses surfaces that leave the plane
    } catch (const mesh::DomainError&) {
    }
    return true;
  } catch (const mesh::DomainError& error) {
    EXPECT_LT(std::string(error.what()).size(), 1000u);
    return false;
  }
}

TEST(InputFuzz, every_damaged_file_is_read_or_refused_in_no_time) {
  constexpr int mutants_of_a_file = 150;
  Mutator mutate("*ELSET, ELSET=panel", " \n\t,=");
  int read = 0, refused = 0;
  for (const std::string& original : {curved_deck, cae_deck, strip + "*NORMAL\n1,1,0,0,1\n*SURFACE,NAME=s\n1,E1\n"}) {
    ASSERT_TRUE(is_deck(original));
    for (int i = 0; i < mutants_of_a_file; ++i) {
      const std::string mutant = mutate(original);
      const auto begin = std::chrono::steady_clock::now();
      ++(is_deck(mutant) ? read : refused);
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5)) << mutant;
    }
  }
  EXPECT_GT(read, 50);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace plastron::domain
