// The meshes of a computation: uniform refinements, or refinements that follow the estimated errors of each instant until
// an accuracy is reached.
#pragma once
#include <plastron/computation/run.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/topology/surface_comparison.hpp>

#include <memory>
#include <vector>

namespace plastron::computation {

class Meshes {
 public:
  explicit Meshes(Run& run);

  /// Solves the meshes at the first instant. Returns whether the computation continues (collective).
  bool solve();
  /// Where an accuracy is requested, judges the solution at hand and solves its instant on further meshes until the
  /// accuracy is reached or a limit stands. Cells that only earlier instants needed may be joined. Returns whether the
  /// computation continues (collective).
  bool reach_accuracy(const problem::Instant& instant);
  /// Where the shell has jumped, the cells that its former shape needed are of no use: solves the instant again on the start mesh, from
  /// the undeformed shell, if an accuracy is requested and no displacement is controlled. `level` becomes that solution, or stays if there is none (collective).
  void begin_again(const problem::Instant& instant, LevelTask task, LevelResult& level);
  /// Estimates the errors of the solution at hand by the mesh of the mid-surface, if this is a mesh in space and errors
  /// are estimated (collective).
  void judge_geometry();

 private:
  const fem::Space& space() const { return *sequence_.space(); }
  /// Solves an instant on the next mesh. First guess and state come from the previous mesh.
  bool solve_next(const problem::Instant& instant);
  /// Computes the goals at one degree more on the cells of the solution at hand, if that problem can be solved.
  void confirm(const problem::Instant& instant);
  /// Whether the models are compared on the mesh that was just solved, and not on a finer one.
  bool is_fine_enough_to_compare(int number) const;
  void refine(LevelTask& task, assembly::State& start);
  /// Computes the goals at the last instant on another surface of the same cells. Their differences are the errors by
  /// the mesh of the mid-surface.
  void compare_goals(const topology::SurfaceComparison& second);
  /// The zone of the solution's contact, and its displacement if the state is deformed, on another mesh.
  std::vector<algebra::Vector> fields_to_transfer() const;

  Run& run_;
  fem::MeshSequence sequence_;
  std::shared_ptr<const fem::Surface> surface_;
  std::vector<mesh::Cuts> cuts_{};    ///< cuts for the next mesh, where an accuracy is requested
  std::vector<signed char> marks_{};  ///< marks of cells for the next mesh, where there are no cuts
  bool has_lost_stiffness_ = false;   ///< narrow cells may have motions there that lower the energy
  std::size_t judged_ = 0;            ///< number of meshes that were judged
  bool are_ahead_ = false;            ///< whether the clock stopped a mesh after the one of the solution at hand
};

}  // namespace plastron::computation
