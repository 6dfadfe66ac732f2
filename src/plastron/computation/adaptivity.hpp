// From estimated errors to the next mesh: what is accurate enough, which cells are to be divided, and when to give up.
#pragma once
#include <plastron/computation/description.hpp>
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>
#include <plastron/computation/stopwatch.hpp>
#include <plastron/fem/mesh_sequence.hpp>

#include <string>
#include <vector>

namespace plastron::computation {

/// Goals of a case as one mesh has them, whose solution the summary is of.
std::vector<GoalRecord> goal_records(const Problem& problem, const estimation::Estimates& estimates,
                                     const certificate::Summary& summary);

/// Marks of the owned cells for fem::MeshSequence::refine: those are divided that make up `share` of all errors, each goal's weighed by
/// what it allows (Doerfler, SIAM J. Numer. Anal. 33, 1996), and those that nothing judges. Cells join again whose part stays negligible
/// then (collective).
std::vector<signed char> marks(const fem::Space& space, const std::vector<GoalRecord>& goals,
                               const estimation::Estimates& estimates, double share);

/// Which goals are not met, and by how much, and whether there are cells that nothing judges, in words; empty if all is well.
std::string shortfall(const std::vector<GoalRecord>& goals, const estimation::Estimates& estimates);

/// How many degrees the witness of a solution has more: one, and two where points are held, for the middle of a cell stays a node then.
int degrees_of_witness(const Problem& problem);

/// Whether the solution at one degree more on the same cells may show that all goals are met (collective).
bool wants_witness(const Problem& problem, const fem::Space& space, const estimation::Estimates& estimates,
                   const certificate::Summary& summary);

/// Whether all cells of a problem with an accuracy are divided or none: it may ask for that, and triangles cannot be divided one by one.
bool is_refined_evenly(const Problem& problem);

/// Mesh after mesh, until all goals are met by two solutions, that on a mesh and the witness at one degree more on its cells; of triangles, whose
/// degree ends at 2, on two meshes in a row without having changed by more than their tolerances. Or until a limit is hit.
class AccuracyLoop {
 public:
  /// The clock runs since the computation began. On the finest mesh `instants_to_come` are solved once more, for which time is kept.
  AccuracyLoop(const Problem& problem, const Stopwatch& since_start, int instants_to_come = 0)
      : problem_(problem),
        since_start_(since_start),
        instants_to_come_(instants_to_come),
        is_uniform_(is_refined_evenly(problem)),
        even_(even_boundaries(problem)),
        may_join_(even_.empty()) {}

  /// Whether the goals are to be found at one degree more before wants_more (collective).
  bool wants_witness(const Result& result, const fem::Space& space) const;
  /// Takes note of the result on a mesh; there are no estimates if its contact problem was not solved. Whether there is to be another (collective).
  bool wants_more(const Result& result, const fem::Space& space);
  /// Of the mesh that was judged last: cuts of its coarse cells (fem::MeshSequence::cut); where there are none, marks of its cells.
  const std::vector<fem::Cuts>& cuts() const { return cuts_; }
  const std::vector<signed char>& marks() const { return marks_; }
  const std::vector<GoalRecord>& goals() const { return goals_; }
  /// Why goals are not met, in words; empty if they are.
  const std::string& missed() const { return missed_; }
  /// Ends the loop though another mesh was wanted; `why` joins missed().
  void give_up(const std::string& why);
  /// Until when meshes may go on, by the level judged last [s since the start]: max_seconds without what the instants to come take.
  double end_of_meshes() const { return problem_.accuracy->max_seconds - seconds_to_come_; }

 private:
  /// Decides on cuts and marks. How many cells they add (collective).
  std::int64_t mark(const fem::Space& space, const std::optional<estimation::Estimates>& estimates);
  void cut(const fem::Space& space, const estimation::Estimates& estimates);
  /// Notes the cells in which the nodes have missed an obstacle, and tells of it in words; empty where none is (collective).
  std::string missed_contact(const Result& result, const fem::Space& space);
  /// To fifteen times the tolerance of the energy, if that is asked for.
  bool edges_are_known(const std::optional<estimation::Estimates>& estimates) const;
  bool is_settled(const std::vector<GoalRecord>& before) const;
  /// Of the goal that is furthest from being met.
  double worst_excess() const;
  double share_to_divide() const;
  /// Of a goal from mesh to mesh, the last one first, as many as there were up to `count`.
  std::vector<double> changes(std::size_t goal, std::size_t count) const;
  /// The level judged last, beside those before.
  void take_note(const Level& level, const fem::Space& space);
  /// Why there is no next mesh with so many cells more, in words; empty if there is one (collective).
  std::string limit_of_meshes(const Level& level, std::int64_t added, const fem::Space& space) const;
  /// That estimates do not fall any more though the mesh grows, in words; empty if they do.
  std::string stalled() const;
  /// Where the goal that is furthest from being met has most of its estimated error, in words (collective).
  std::string place_of_error(const fem::Space& space, const estimation::Estimates& estimates) const;
  /// Which goals that are not met do not settle, none of their last changes below `least_decay` times the one before, in words.
  std::string unsettled(std::size_t count, double least_decay) const;
  /// Which limit stands against a next mesh with so many times the unknowns; empty if none (collective).
  std::string obstacle(const Level& level, double growth, MPI_Comm comm) const;

  const Problem& problem_;
  const Stopwatch& since_start_;
  int instants_to_come_;
  bool is_uniform_;
  fem::MeshSequence::Even even_;
  /// Cells that nothing judged, or errors as large as before, may come back where cells join.
  bool may_join_;
  bool wants_edges_ = false;        ///< the goals are met, and edges of contact zones are not yet where they belong
  bool has_joined_ = false;         ///< on the way to the mesh that was judged last
  double excess_before_ = 0;        ///< of the goal that was furthest from being met there
  double seconds_to_come_ = 0;      ///< of the instants to come, on the mesh judged last
  double largest_solved_ = 0;       ///< unknowns of a mesh or its witness
  std::vector<double> excesses_{};  ///< of the worst goal, mesh by mesh
  std::vector<std::int64_t> unknowns_{};  ///< mesh by mesh
  std::vector<GoalRecord> goals_{};
  std::vector<std::vector<double>> values_{};  ///< of the goals, mesh by mesh
  std::vector<fem::Cuts> cuts_{};
  std::vector<signed char> marks_{};
  std::vector<std::size_t> entered_{};  ///< cells in which the nodes have missed an obstacle
  std::string missed_{};
};

}  // namespace plastron::computation
