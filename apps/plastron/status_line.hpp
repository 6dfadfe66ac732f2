// One line of text on standard error that the next one replaces; no output unless standard error is a terminal.
#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace plastron::app {

class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Shows a text. If `end` is given, in seconds since this line was made, the remaining time follows the text.
  /// Otherwise the time since the text was set follows, if it is long. Both are updated once a second.
  void show(const std::string& text, std::optional<double> end = {});
  void clear();
  /// Time since this line was made [s].
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;
  void draw();  // the mutex must be locked
  void keep_up_to_date(const std::stop_token& stop);

  bool on_terminal_;
  Clock::time_point begin_ = Clock::now();
  std::mutex mutex_{};
  std::condition_variable_any wake_{};
  std::string text_{}, drawn_{};
  std::optional<double> end_{};
  double shown_at_ = 0;
  std::jthread clock_{};  // the last member: it ends first
};

}  // namespace plastron::app
