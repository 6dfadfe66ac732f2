// Output of the program during the computation and at its end.
#pragma once
#include "status_line.hpp"
#include "time_left.hpp"

#include <plastron/computation/solve.hpp>

#include <optional>
#include <string>

namespace plastron::app {

/// Prints the table of levels on standard output. On a terminal it shows one line of progress on standard error with
/// the remaining time. It logs events if requested.
class Progress {
 public:
  Progress(const problem::Problem& problem, bool quiet);
  computation::Observer observer();
  /// Prints a line of the table of instants.
  void instant(const computation::HistoryEntry& entry);
  void finish() { status_.clear(); }

 private:
  void phase(int level, std::string_view name);
  void iteration(int level, const contact::Iteration& iteration);
  void level(int level, const computation::Level& record);

  /// Returns a text on the present part of the computation, and its place in the whole.
  std::string place(int level) const;
  std::optional<double> end() const { return parts_ ? parts_->end() : meshes_left_.end(); }

  void print_header(const problem::Problem& problem) const;
  void print_goals(int level, const computation::Level& record) const;

  bool has_obstacle_, quiet_, is_by_accuracy_;
  StatusLine status_;
  int meshes_, number_of_parts_, last_level_ = -1;  ///< meshes_ is not known if an accuracy is requested
  bool chooses_parts_;                              ///< number_of_parts_ is not known
  double most_missed_ = 0;  ///< largest ratio of estimated error to tolerance, of all goals on the last mesh
  MeshesLeft meshes_left_;
  std::optional<PartsLeft> parts_{};  ///< parts of the steps, once the meshes are finished
  int iterations_ = 0;
  bool has_instants_ = false, has_seen_instant_ = false;
};

/// Prints the results of the computation in a few lines.
void print_summary(const computation::Result& result);

}  // namespace plastron::app
