// Damaged mesh files: every .msh file of the tests in some hundred variants, the same in every run. Each is read or refused
// with DomainError, at once. A mesh that is read can be refined.
#include <gtest/gtest.h>
#include <plastron/fem/mesh_sequence.hpp>

#include <algorithm>
#include <chrono>
#include <random>
#include <sstream>

#include "fem/written_mesh.hpp"

namespace plastron::fem {
namespace {

using namespace written;

class Mutator {
 public:
  std::string operator()(std::string text) {
    const int changes = 1 + below(3);
    for (int i = 0; i < changes; ++i) text = changed(std::move(text));
    return text;
  }

 private:
  int below(std::size_t n) { return static_cast<int>(random_() % std::max<std::size_t>(1, n)); }

  std::string changed(std::string text) {
    const auto at = static_cast<std::size_t>(below(text.size()));
    switch (below(6)) {
      case 0:  // a bit of a byte
        if (!text.empty()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        return text;
      case 1:
        return text.substr(0, at);
      case 2:
        return text.insert(at, 1, static_cast<char>(below(256)));
      case 3:
      case 4:
        return with_another_word(std::move(text), at);
      default:
        return with_lines_changed(text);
    }
  }

  /// Mostly in place of a number, since most words are.
  std::string with_another_word(std::string text, std::size_t at) {
    static const char* const words[] = {"-1",
                                        "0",
                                        "1",
                                        "2",
                                        "3",
                                        "4",
                                        "10",
                                        "1e308",
                                        "-1e-308",
                                        "nan",
                                        "inf",
                                        "1000000000",
                                        "9223372036854775807",
                                        "-9223372036854775808",
                                        "99999999999999999999",
                                        "0.5",
                                        "x",
                                        "$Nodes",
                                        ""};
    const char* blanks = " \n\t";
    const std::size_t from = text.find_last_of(blanks, at) + 1;  // 0 if there is none
    const std::size_t to = std::min(text.find_first_of(blanks, from), text.size());
    return text.replace(from, to - from, words[below(std::size(words))]);
  }

  std::string with_lines_changed(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (lines.empty()) return text;
    const auto a = static_cast<std::size_t>(below(lines.size())), b = static_cast<std::size_t>(below(lines.size()));
    switch (below(3)) {
      case 0:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(a));
        break;
      case 1:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(a), std::string(lines[b]));
        break;
      default:
        std::swap(lines[a], lines[b]);
    }
    std::string result;
    for (const std::string& line : lines) result += line + "\n";
    return result;
  }

  std::mt19937 random_{20240607};
};

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
bool is_read(const std::string& text, Shape shape) {
  try {
    MeshSequence meshes(read_text(text, shape), 1, MPI_COMM_SELF);
    meshes.refine({});
    return true;
  } catch (const DomainError& error) {
    EXPECT_LT(std::string(error.what()).size(), 1000u);
    return false;
  }
}

TEST(MeshFuzz, every_mutant_is_read_or_refused_in_no_time) {
  constexpr int mutants_of_a_file = 60;
  Mutator mutate;
  int read = 0, refused = 0;
  const auto files = mesh_files();
  ASSERT_GE(files.size(), 8u);
  for (const auto& file : files) {
    const std::string original = content(file);
    const Shape shape = is_read(original, Shape::quadrilateral) ? Shape::quadrilateral : Shape::triangle;
    ASSERT_TRUE(is_read(original, shape)) << file;
    for (int i = 0; i < mutants_of_a_file; ++i) {
      const std::string mutant = mutate(original);
      const auto begin = std::chrono::steady_clock::now();
      ++(is_read(mutant, i % 5 == 0 ? Shape::triangle : shape) ? read : refused);
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5)) << file << ":\n" << mutant;
    }
  }
  EXPECT_GT(read, 20);  // variants are near enough to meshes to reach every part of the reader
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace plastron::fem
