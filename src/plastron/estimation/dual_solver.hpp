// Dual problems on the final active set: what a functional weighs. Coordinates at a bound or prescribed are held, with pressed obstacles
// free to move on; equations are kept. The factor of the last contact step serves all of them.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/subproblem.hpp>

#include <optional>
#include <vector>

namespace plastron::estimation {

/// J(v) = load . v, and with minus the weights of reactions at held coordinates in `held`; J(delta_k) in `positions`.
struct DualLoad {
  algebra::Vector load;
  algebra::Vector held;
  std::vector<double> positions{};
};

class DualSolver {
 public:
  /// Refers to all three; `solution` is one of `problem`. (collective)
  DualSolver(const contact::BoxProblem& problem, const contact::BoxSolution& solution,
             algebra::Preconditioner& preconditioner);

  /// z with a(v, z) = J(v) for all v of the tangent space, and the values of `held` where coordinates are held, shapes of pressed obstacles
  /// added; current ghosts. Nothing if the solver for linear equations fails. (collective)
  std::optional<algebra::Vector> solve(const DualLoad& dual);
  const contact::ActiveSet& held_set() const { return set_; }

 private:
  struct Response {
    std::size_t force;
    algebra::Vector z;
  };
  std::optional<algebra::Vector> solve_held(const algebra::Vector& load, const algebra::Vector& held);
  bool find_responses();
  double reaction(std::size_t force, const algebra::Vector& load, const algebra::Vector& z) const;

  const contact::BoxProblem& problem_;
  contact::ActiveSet set_;  ///< the final one, held unknowns all called prescribed
  std::vector<algebra::Vector> shapes_;
  contact::BoxProblem dual_;
  contact::Settings settings_;
  contact::SubproblemSolver solver_;
  bool is_pinned_ = false;
  std::vector<Response> responses_{};
};

}  // namespace plastron::estimation
