#include "stage_progress.hpp"

#include "console.hpp"
#include "terminal.hpp"

#include <fmt/format.h>

namespace plastron::app {

study::StudyObserver StageProgress::observer() {
  study::StudyObserver observer;
  observer.stage = [this](std::string_view what) {
    log_event("stage", {{"stage", what}});
    stage_ = what;
    status_.show(stage_ + " ...");
  };
  observer.solve.level = [this](int level, const computation::Level& record) {
    log_level(level, record);
    status_.show(fmt::format("{}: level {} done, {} unknowns", stage_, level, record.unknowns));
  };
  observer.solve.stop = is_interrupted;
  return observer;
}

}  // namespace plastron::app
