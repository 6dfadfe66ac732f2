// What the program tells while it computes and when it is done.
#pragma once
#include "terminal.hpp"

#include <plastron/computation/solve.hpp>
#include <plastron/examination/examine.hpp>
#include <plastron/study/kinds.hpp>

#include <string>

namespace plastron::app {

/// A title as it is shown: long ones are cut.
std::string shortened_title(const std::string& title);

/// The findings of an examination, notes only if wanted.
void print_findings(const std::vector<examination::Finding>& findings, const std::string& case_file, bool with_notes);

/// One line of text on standard error that the next one replaces; silent unless that is a terminal.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  void show(const std::string& text);
  void clear();

 private:
  bool on_terminal_;
  std::size_t shown_ = 0;
};

/// The table of levels on standard output and, on a terminal, one line of progress on standard error.
class Progress {
 public:
  Progress(bool has_obstacle, bool quiet);
  computation::Observer observer();
  /// A line of the table of instants.
  void instant(const computation::HistoryEntry& entry);
  void finish() { status_.clear(); }

 private:
  void phase(int level, std::string_view name);
  void iteration(int level, const contact::Iteration& iteration);
  void level(int level, const computation::Level& record);

  bool has_obstacle_, quiet_;
  StatusLine status_;
  int iterations_ = 0;
  bool has_instants_ = false;
};

/// On a terminal, what a study is computing now.
class StageProgress {
 public:
  explicit StageProgress(bool quiet) : status_(quiet) {}
  study::StudyObserver observer();
  void finish() { status_.clear(); }

 private:
  StatusLine status_;
  std::string stage_;
};

/// What the computation found, in a few lines.
void print_summary(const computation::Result& result);

}  // namespace plastron::app
