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

struct DualSolution {
  algebra::Vector z{};  ///< with current ghosts
  /// A z - load; with equations A z + B' q - load. Minus the derivatives of J with respect to the values of fixed coordinates.
  algebra::Vector multiplier{};
  /// Motions of the pressed obstacles along their forces, in the order of the problem.
  std::vector<double> positions{};
};

class DualSolver {
 public:
  /// Keeps references to all three arguments; `solution` belongs to `problem` (collective).
  DualSolver(const contact::BoxProblem& problem, const contact::BoxSolution& solution,
             algebra::Preconditioner& preconditioner);

  /// Returns z with a(v, z) = J(v) for all v of the tangent space (collective). Fixed coordinates have the values of
  /// `fixed` plus multiples of the shapes of pressed obstacles. Empty if the solver for linear equations fails.
  std::optional<DualSolution> solve(const DualLoad& dual);
  /// The solution without load, with all fixed coordinates at 0.
  DualSolution zero() const;

 private:
  struct Response {
    std::size_t force;
    DualSolution to_motion;  ///< of the force's obstacle by 1
  };
  std::optional<DualSolution> solve_fixed(const algebra::Vector& load, const algebra::Vector& fixed);
  bool find_responses();
  /// Force on the obstacle of a pressing force, along it.
  double reaction(std::size_t force, const DualSolution& dual) const {
    return algebra::dot(shapes_[force], dual.multiplier);
  }

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
