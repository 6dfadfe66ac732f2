// Where the program prints: rank 0 only, results on standard output, errors and progress on standard error.
#pragma once
#include <plastron/study/examine.hpp>
#include <plastron/study/solve.hpp>

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace plastron::app {

bool is_first_rank();

template <class... Args>
void print(fmt::format_string<Args...> text, Args&&... args) {
  if (is_first_rank()) fmt::print(stdout, text, std::forward<Args>(args)...);
}
template <class... Args>
void print_error(fmt::format_string<Args...> text, Args&&... args) {
  if (is_first_rank()) fmt::print(stderr, text, std::forward<Args>(args)...);
}

/// The findings of an examination, notes only if wanted.
void print_findings(const std::vector<study::Finding>& findings, const std::string& case_file, bool with_notes);

/// The table of levels on standard output and, on a terminal, one line of progress on standard error.
class Progress {
 public:
  Progress(bool has_obstacle, bool quiet);
  study::Observer observer();

 private:
  void phase(int level, std::string_view name);
  void iteration(int level, const contact::Iteration& iteration);
  void level(int level, const study::Level& record);
  void show(const std::string& text);
  void clear();

  bool has_obstacle_, quiet_, on_terminal_;
  int iterations_ = 0;
  std::size_t shown_ = 0;
};

/// What the computation found, in a few lines.
void print_summary(const study::Result& result);

}  // namespace plastron::app
