#include <research/study/lifting.hpp>

#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/contact/solve.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::study {

namespace {

/// Supports at zero, the gap's change prescribed at the marked nodes, all else free; no load.
void prescribe(const assembly::DiscreteShell& discrete, std::span<const char> at, double change,
               contact::BoxProblem& box) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto width = static_cast<std::size_t>(box.load.block());
  for (std::size_t i = 0; i < box.load.owned().size(); ++i) {
    const std::size_t node = i / width;
    const bool is_gap = i % width == 0 && discrete.coordinates.is_touchable(node);
    const bool held = !is_gap && box.lower.owned()[i] == box.upper.owned()[i];
    const bool lifted = is_gap && at[node];
    box.lower.owned()[i] = lifted ? change : held ? 0 : -infinity;
    box.upper.owned()[i] = lifted ? change : held ? 0 : infinity;
    box.load.owned()[i] = 0;
  }
  box.lower.update_ghosts();
  box.upper.update_ghosts();
}

}  // namespace

std::optional<double> lifting_norm(const assembly::DiscreteShell& discrete, std::span<const char> at, double change) {
  std::int64_t marked = 0;
  for (const char mark : at) marked += mark != 0;
  if (algebra::sum_over_ranks(marked, discrete.space().layout->comm) == 0) return 0;
  const algebra::Matrix A = assembly::stiffness_matrix(discrete);
  algebra::Factorisation F(A);
  contact::BoxProblem box = assembly::box_problem(discrete, A);
  prescribe(discrete, at, change, box);
  contact::BoxSolution w = contact::solve_primal_dual_active_set(box, {}, F);
  if (w.status != contact::Status::solved) return {};
  algebra::Vector force(w.z.layout(), w.z.block());
  w.z.update_ghosts();
  box.apply(w.z, force);
  return std::sqrt(std::max(0.0, algebra::dot(w.z, force)));
}

}  // namespace plastron::study
