// Damaged mesh files: every .msh file of the tests in some hundred variants, the same in every run. Each is read or refused
// with DomainError, at once. A mesh that is read can be refined.
#include <gtest/gtest.h>
#include <plastron/fem/mesh_sequence.hpp>

#include <algorithm>
#include <chrono>
#include <sstream>

#include "domain/mutator.hpp"
#include "domain/written_mesh.hpp"

namespace plastron::domain {
namespace {

using namespace written;

std::vector<std::filesystem::path> mesh_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(PLASTRON_TESTS_DIR))
    if (entry.path().extension() == ".msh") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::string content(const std::filesystem::path& path) {
  std::ostringstream stream;
  stream << std::ifstream(path).rdbuf();
  return stream.str();
}

/// Returns whether the text is a mesh. Other exceptions than DomainError end the test.
bool is_read(const std::string& text, mesh::Shape shape) {
  try {
    fem::MeshSequence meshes(read_text(text, shape), 1, MPI_COMM_SELF);
    meshes.refine({});
    return true;
  } catch (const mesh::DomainError& error) {
    EXPECT_LT(std::string(error.what()).size(), 1000u);
    return false;
  }
}

TEST(MeshFuzz, every_mutant_is_read_or_refused_in_no_time) {
  constexpr int mutants_of_a_file = 60;
  Mutator mutate("$Nodes", " \n\t");
  int read = 0, refused = 0;
  const auto files = mesh_files();
  ASSERT_GE(files.size(), 8u);
  for (const auto& file : files) {
    const std::string original = content(file);
    const mesh::Shape shape =
        is_read(original, mesh::Shape::quadrilateral) ? mesh::Shape::quadrilateral : mesh::Shape::triangle;
    ASSERT_TRUE(is_read(original, shape)) << file;
    for (int i = 0; i < mutants_of_a_file; ++i) {
      const std::string mutant = mutate(original);
      const auto begin = std::chrono::steady_clock::now();
      ++(is_read(mutant, i % 5 == 0 ? mesh::Shape::triangle : shape) ? read : refused);
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5)) << file << ":\n" << mutant;
    }
  }
  EXPECT_GT(read, 20);  // variants are near enough to meshes to reach every part of the reader
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace plastron::domain
