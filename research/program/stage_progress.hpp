// Output of a study during its computation.
#pragma once
#include "status_line.hpp"

#include <research/study/kinds.hpp>

#include <string>

namespace plastron::app {

/// Shows the present stage of a study on a terminal.
class StageProgress {
 public:
  explicit StageProgress(bool quiet) : status_(quiet) {}
  study::StudyObserver observer();
  void finish() { status_.clear(); }

 private:
  StatusLine status_;
  std::string stage_{};
};

}  // namespace plastron::app
