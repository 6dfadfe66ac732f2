// Randomly damaged solutions, the same ones in every run. Each is refused with a message or judged. The sanitizers find every value that is used
// without a check.
#include <plastron/computation/verify.hpp>
#include <plastron/domain/domain.hpp>
#include <plastron/io/claims.hpp>
#include <plastron/io/solution_file.hpp>
#include <plastron/obstacle/error.hpp>

#include <gtest/gtest.h>
#include <io/pressed_plate.hpp>
#include <io/scratch_directory.hpp>

#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

namespace plastron::io {

namespace {

using problem::Problem;

class Damage {
 public:
  explicit Damage(std::uint64_t seed) : random_(seed) {}

  std::string operator()(std::string text) {
    const std::size_t size = text.size();
    switch (below(4)) {
      case 0:
        return flipped(std::move(text), size);
      case 1:
        return flipped(std::move(text), 160);  // the header, the obstacles and the first cell's place
      default:
        return replaced(std::move(text));
    }
  }

 private:
  std::size_t below(std::size_t bound) { return random_() % bound; }

  std::string flipped(std::string text, std::size_t end) {
    text[below(end)] ^= static_cast<char>(1u << below(8));
    return text;
  }

  /// Replaces a number by an extreme one everywhere in the file: a node has one value in all of its cells.
  std::string replaced(std::string text) {
    static const std::array hard{0.0,   -0.0, 6.5e-319, 0.5,  -1.0,  1.0,   2.0,
                                 1e-30, 1e10, 1e30,     1e60, -1e60, 1e308, std::numeric_limits<double>::quiet_NaN()};
    const double now = hard[below(hard.size())];
    std::array<char, sizeof now> old{};
    const std::size_t place = 72 + 8 * below((text.size() - 72) / 8);
    text.copy(old.data(), old.size(), place);
    const bool is_shared = old != std::array<char, sizeof now>{};
    for (std::size_t at = 72; at + 8 <= text.size(); at += 8)
      if (at == place || (is_shared && std::memcmp(text.data() + at, old.data(), old.size()) == 0))
        std::memcpy(text.data() + at, &now, sizeof now);
    return text;
  }

  std::mt19937_64 random_;
};

std::vector<Problem> problems() {
  std::vector<Problem> all{pressed_plate({.refinements = 1}), pressed_plate({.refinements = 1})};
  Problem& over_ball = all.back();
  over_ball.shell.obstacles.all = {obstacle::Obstacle{.shape = obstacle::Ball{.centre = {1, 0.5, -5}, .radius = 5}}};
  over_ball.admissible = true;
  over_ball.shell.tangency.formulation = element::Formulation::mixed;
  return all;
}

/// Returns whether the file was read and judged; false if it was refused.
bool is_judged(const std::filesystem::path& path, const Problem& problem, const Json& claimed) {
  try {
    const computation::FinestMesh mesh = computation::finest_mesh(problem, MPI_COMM_SELF);
    const auto verification = computation::verify(
        problem, mesh,
        read_solution(path, mesh.space,
                      {.obstacles = 1,
                       .has_multiplier = problem.shell.tangency.formulation == element::Formulation::mixed,
                       .has_lifts = problem.admissible}));
    EXPECT_GT(compare_numbers(claimed, verification.result).size(), 50U);
    return true;
  } catch (const UnusableResults&) {
  } catch (const obstacle::ObstacleError&) {
  } catch (const mesh::DomainError&) {
  }
  return false;
}

TEST(DamagedSolution, is_refused_or_judged) {
  if (world_size() > 1) GTEST_SKIP() << "one process reads";
  const ScratchDirectory scratch("damaged-solution");
  const auto path = scratch.path / "solution.plastron";
  Damage damage(20261125);
  for (const Problem& problem : problems()) {
    const computation::Result result = computation::solve(problem, MPI_COMM_SELF);
    const Json claimed = results_json(result, {});
    AtomicFiles files(MPI_COMM_SELF);
    add_solution(*result.solution, path, files);
    files.commit();
    const std::string good = text_of(path);
    int judged = 0, refused = 0;
    for (int k = 0; k < 150; ++k) {
      std::ofstream(path, std::ios::binary) << damage(good);
      ++(is_judged(path, problem, claimed) ? judged : refused);
    }
    EXPECT_GT(judged, 20);
    EXPECT_GT(refused, 20);
  }
}

}  // namespace

}  // namespace plastron::io
