// Dual problems on the final active set; their solutions are the sensitivities of functionals. Coordinates at a bound
// or prescribed are fixed, while pressed obstacles remain free to move. Equations are kept. All dual problems use the
// factor of the last contact step.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/subproblem.hpp>

#include <optional>
#include <vector>

namespace plastron::estimation {

/// J(v) = load . v. `fixed` contains minus the weights of reactions at fixed coordinates, `positions` contains
/// J(delta_k).
struct DualLoad {
  algebra::Vector load;
  algebra::Vector fixed;
  std::vector<double> positions{};
};

class DualSolver {
 public:
  /// Keeps references to all three arguments; `solution` belongs to `problem` (collective).
  DualSolver(const contact::BoxProblem& problem, const contact::BoxSolution& solution,
             algebra::Preconditioner& preconditioner);

  /// Returns z with a(v, z) = J(v) for all v of the tangent space, with current ghosts (collective). Fixed
  /// coordinates have the values of `fixed` plus multiples of the shapes of pressed obstacles. Empty if the solver for
  /// linear equations fails.
  std::optional<algebra::Vector> solve(const DualLoad& dual);

 private:
  struct Response {
    std::size_t force;
    algebra::Vector z;
  };
  std::optional<algebra::Vector> solve_fixed(const algebra::Vector& load, const algebra::Vector& fixed);
  bool find_responses();
  double reaction(std::size_t force, const algebra::Vector& load, const algebra::Vector& z) const;

  const contact::BoxProblem& problem_;
  contact::ActiveSet set_;  ///< final active set; all fixed unknowns are marked as prescribed
  std::vector<algebra::Vector> shapes_;
  contact::BoxProblem dual_;
  contact::Settings settings_;
  contact::SubproblemSolver solver_;
  bool is_factorised_ = false;
  std::vector<Response> responses_{};
};

}  // namespace plastron::estimation
