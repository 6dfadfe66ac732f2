// What the program tells while it computes and when it is done.
#pragma once
#include "status_line.hpp"
#include "time_left.hpp"

#include <plastron/computation/solve.hpp>

#include <optional>
#include <string>

namespace plastron::app {

/// The table of levels on standard output and, on a terminal, one line of progress on standard error with the time that is left; events
/// where they are logged.
class Progress {
 public:
  Progress(const computation::Problem& problem, bool quiet);
  computation::Observer observer();
  /// A line of the table of instants.
  void instant(const computation::HistoryEntry& entry);
  void finish() { status_.clear(); }

 private:
  void phase(int level, std::string_view name);
  void iteration(int level, const contact::Iteration& iteration);
  void level(int level, const computation::Level& record);

  /// What is being computed, and when all of it will be done.
  std::string place(int level) const;
  std::optional<double> end() const { return parts_ ? parts_->end() : meshes_left_.end(); }

  void print_header(const computation::Problem& problem) const;
  void print_goals(int level, const computation::Level& record) const;

  bool has_obstacle_, quiet_, is_by_accuracy_;
  StatusLine status_;
  int meshes_, number_of_parts_, last_level_ = -1;  ///< meshes_ is not known where accuracy is asked for
  double most_missed_ = 0;  ///< of all goals of the last mesh: the estimated error over its tolerance
  MeshesLeft meshes_left_;
  std::optional<PartsLeft> parts_{};  ///< of the steps, once the meshes are done
  int iterations_ = 0;
  bool has_instants_ = false, has_seen_instant_ = false;
};

/// What the computation found, in a few lines.
void print_summary(const computation::Result& result);

}  // namespace plastron::app
