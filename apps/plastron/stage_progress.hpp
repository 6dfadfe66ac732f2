// What a study tells while it computes.
#pragma once
#include "status_line.hpp"

#include <plastron/study/kinds.hpp>

#include <string>

namespace plastron::app {

/// On a terminal, what a study is computing now.
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
