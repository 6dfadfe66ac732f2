// Decides from estimated errors on the next mesh: whether the accuracy is sufficient, which cells to divide, and when
// to stop.
#pragma once
#include <plastron/computation/resources.hpp>
#include <plastron/computation/result.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/meshing/marks.hpp>
#include <plastron/meshing/sequence.hpp>
#include <plastron/meshing/start_mesh.hpp>
#include <plastron/problem/problem.hpp>

#include <string>
#include <vector>

namespace plastron::computation {

/// Number of additional degrees of a solution's witness: one, or two where points are fixed, because the middle of a
/// cell then stays a node.
int degrees_of_witness(const problem::Problem& problem);

/// Whether the solution at one degree more on the same cells may confirm that all goals are met (collective).
bool wants_witness(const problem::Problem& problem, const fem::Space& space, const estimation::Estimates& estimates,
                   const solution::Summary& summary);

/// Loop over meshes until two solutions meet all goals: the one on a mesh and the witness at one degree more on its
/// cells. For triangles, whose degree ends at 2, these are solutions on two successive meshes that differ by less than
/// the goals' tolerances. The loop also ends at a limit.
class AccuracyLoop {
 public:
  /// The clock runs since the start of the computation. `instants_to_come` will be solved on the finest mesh; time is
  /// reserved for them.
  AccuracyLoop(const problem::Problem& problem, const Stopwatch& since_start, int instants_to_come = 0,
               bool has_lost_stiffness = false)
      : problem_(problem),
        since_start_(since_start),
        instants_to_come_(instants_to_come),
        has_lost_stiffness_(has_lost_stiffness),
        is_uniform_(meshing::is_refined_evenly(problem)),
        may_join_(meshing::even_boundaries(problem).empty()) {}

  /// Whether the goals must be computed at one degree more before wants_more (collective).
  bool wants_witness(const Result& result, const Level& level, const fem::Space& space) const;
  /// Stores the result on a mesh, found as `level` tells, and returns whether another mesh is needed (collective). There are no estimates if the
  /// contact problem of the mesh was not solved.
  bool wants_more(const Result& result, const Level& level, const fem::Space& space);
  /// Cuts of the coarse cells of the mesh judged last (fem::MeshSequence::cut). If this is empty, marks() has the marks
  /// of its cells.
  const std::vector<mesh::Cuts>& cuts() const { return next_.cuts; }
  const std::vector<signed char>& marks() const { return next_.marks; }
  const std::vector<estimation::GoalRecord>& goals() const { return goals_; }
  /// Returns a text with the reasons why goals are not met; empty if they are met.
  const std::string& missed() const { return missed_; }
  /// Whether some motion has lost its stiffness on a mesh of this loop, or before it.
  bool has_lost_stiffness() const { return has_lost_stiffness_; }
  /// Ends the loop although another mesh is needed; `why` is added to missed().
  void give_up(const std::string& why);
  /// Time until which meshes may be computed, estimated from the last level [s since the start]: max_seconds minus the
  /// time for the remaining instants.
  double end_of_meshes() const { return problem_.accuracy->max_seconds - seconds_to_come_; }

 private:
  /// Decides on cuts and marks. Returns the number of cells that they add (collective).
  std::int64_t mark(const fem::Space& space, const std::optional<estimation::Estimates>& estimates);
  /// Stores the cells in which the nodes have missed an obstacle. Returns a text on them; empty if no cell is entered
  /// (collective).
  std::string missed_contact(const Result& result, const fem::Space& space);
  /// Whether contact edges are known to fifteen times the tolerance of the energy, if that is a goal.
  bool edges_are_known(const std::optional<estimation::Estimates>& estimates) const;
  bool is_settled(const std::vector<estimation::GoalRecord>& before) const;
  /// Excess of the goal that is furthest from being met.
  double worst_excess() const;
  /// Whether the excess is nearly as large as it was two meshes before.
  bool is_slow() const;
  /// Changes of a goal from mesh to mesh, the last one first, at most `count`.
  std::vector<double> changes(std::size_t goal, std::size_t count) const;
  /// Whether the next mesh is small enough to be solved for the edges of contact zones alone.
  bool may_grow_for_edges(const Level& level, std::int64_t added, const fem::Space& space);
  /// Stores the data of the level judged last.
  void take_note(const Level& level, const fem::Space& space);
  /// Returns the reason why no next mesh with `added` more cells is possible; empty if it is possible (collective).
  std::string limit_of_meshes(const Level& level, std::int64_t added, const fem::Space& space) const;
  /// Returns a text if estimates no longer decrease though the mesh grows; empty if they decrease.
  std::string stalled() const;
  /// Returns a text on the place that contains most of the estimated error of the goal furthest from being met
  /// (collective).
  std::string place_of_error(const fem::Space& space, const estimation::Estimates& estimates) const;
  /// Returns a text on goals that are not met and do not settle: none of their last changes is below `least_decay`
  /// times the one before.
  std::string unsettled(std::size_t count, double least_decay) const;
  /// Returns the limit that prevents a next mesh with `growth` times the unknowns; empty if there is none (collective).
  std::string obstacle(const Level& level, double growth, MPI_Comm comm) const;

  const problem::Problem& problem_;
  const Stopwatch& since_start_;
  int instants_to_come_;
  bool has_lost_stiffness_;
  bool is_uniform_;
  /// Whether cells may join. Joined cells may bring back unjudged cells, or errors as large as before.
  bool may_join_;
  bool wants_edges_ = false;              ///< the goals are met, but edges of contact zones are not yet accurate
  double accurate_unknowns_ = 0;          ///< unknowns of the first mesh on which the goals are met
  double excess_before_ = 0;              ///< excess of the worst goal on the mesh before
  double seconds_to_come_ = 0;            ///< time for the remaining instants, estimated on the mesh judged last
  double largest_solved_ = 0;             ///< largest number of unknowns of a mesh or its witness
  std::vector<double> excesses_{};        ///< excess of the worst goal on each mesh
  std::vector<std::int64_t> unknowns_{};  ///< unknowns of each mesh
  std::vector<estimation::GoalRecord> goals_{};
  std::vector<std::vector<double>> values_{};  ///< values of the goals on each mesh
  meshing::NextMesh next_{};
  std::vector<std::size_t> entered_{};  ///< cells in which the nodes have missed an obstacle
  bool lacks_contact_ = false;          ///< the shell has passed an obstacle, or found no place beside it
  std::string missed_{};
};

}  // namespace plastron::computation
