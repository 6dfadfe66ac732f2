// A level during its solution: its shell in the present linearisation, the last contact problem with its factor, and what the
// solution has cost so far.
#pragma once
#include <plastron/algebra/factorisation.hpp>
#include <plastron/computation/level_task.hpp>
#include <plastron/estimation/estimate.hpp>
#include <plastron/estimation/kept_factorisation.hpp>
#include <plastron/finite/newton_step.hpp>

#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace plastron::computation {

/// Matrix, factor and box program of a contact problem. They are kept to the end because error estimates use the
/// factor.
struct LinearAlgebra {
  LinearAlgebra(algebra::Matrix matrix, const std::vector<char>& movable, MPI_Comm comm)
      : A(std::move(matrix)), F(A, movable), kept(F, comm) {}
  algebra::Matrix A;
  algebra::Factorisation F;
  estimation::KeptFactorisation kept;
  std::optional<contact::BoxProblem> box{};
};

/// A level during its solution: its shell in the present linearisation.
class LevelRun {
 public:
  LevelRun(const LevelTask& task, std::unique_ptr<assembly::DiscreteShell> discrete, const Observer& observer)
      : seconds(task.seconds), task_(task), discrete_(std::move(discrete)), observer_(observer) {}

  Seconds seconds;
  int factorisations = 0, linearisations = 0;
  bool has_jumped = false, has_lost_stiffness = false, is_control_blind = false;  ///< see Level
  bool needed_shift = false;  ///< the last Newton step needed a shift: the equilibrium is not stable
  std::vector<contact::Iteration> history{};

  /// Solves the contact problem of the present linearisation, starting from the expected zone; null if there is none.
  contact::BoxSolution solve(const algebra::Vector* zone, bool detect_free_motions);

  /// Prepares dual problems at a solution: with increments, factor and problem of the last step are replaced by those at its end.
  contact::BoxSolution prepare_duals(const contact::BoxSolution& z, const solution::NodalSolution& nodal);

  std::vector<double> values(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                             const solution::Summary& summary) const;

  /// Makes a Newton step from the state of the shell.
  finite::NewtonStep newton_step(const finite::StepStart& start);

  /// Estimates the errors of the solution of the last solve() and of its goals.
  estimation::Estimates estimate(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                                 const solution::Summary& summary);

  std::optional<double> buckling(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                                 const solution::Summary& summary);

  /// Whether only values of goals are needed, to a small part of their errors.
  bool is_for_values() const { return !task_.valued.empty(); }
  bool leaves_unstable() const { return task_.leaves_unstable; }
  bool is_stopped() const { return wants_to_stop(observer_, discrete_->space().layout->comm); }
  void tell(std::string_view phase) const;
  assembly::DiscreteShell& discrete() { return *discrete_; }
  std::unique_ptr<assembly::DiscreteShell> take() { return std::move(discrete_); }

 private:
  estimation::Solved solved(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                            const solution::Summary& summary) const;

  contact::Observer follow() const;

  const LevelTask& task_;
  std::unique_ptr<assembly::DiscreteShell> discrete_;
  std::unique_ptr<LinearAlgebra> last_{};
  const Observer& observer_;
};

/// A solution of a level's contact problem.
struct Found {
  contact::BoxSolution z;
  solution::NodalSolution nodal;
};

/// Whether a support fixes the touching face inside an obstacle, so that K is empty. No bound shows this, because
/// nothing can move there.
bool held_inside_obstacle(const assembly::DiscreteShell& discrete);

}  // namespace plastron::computation
