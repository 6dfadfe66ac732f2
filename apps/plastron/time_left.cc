#include "time_left.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::app {

void MeshesLeft::done(double time) { ends_.push_back(time); }

std::optional<double> MeshesLeft::end() const {
  constexpr double too_short = 0.1;
  const std::size_t done = ends_.size() - 1;
  if (done < 2 || static_cast<int>(done) >= meshes_) return {};
  const double last = ends_[done] - ends_[done - 1], before = ends_[done - 1] - ends_[done - 2];
  if (last < too_short) return {};
  // A mesh has four times the unknowns of the previous one. Factorisations cost up to eight times as much; fewer
  // active-set steps reduce the growth.
  const double growth = std::clamp(last / std::max(before, too_short / 10), 2.0, 8.0);
  double end = ends_[done], length = last;
  for (int mesh = static_cast<int>(done); mesh < meshes_; ++mesh) end += length *= growth;
  return end;
}

void PartsLeft::done(double time) {
  ++done_;
  last_ = time;
}

std::optional<double> PartsLeft::end() const {
  if (done_ == 0 || done_ >= parts_) return {};
  return last_ + (last_ - begin_) / done_ * (parts_ - done_);
}

std::string left_text(double seconds) {
  if (!(seconds >= 2)) return "";
  const auto about = [](double value, const char* unit) { return fmt::format("about {:.0f} {} left", value, unit); };
  if (seconds < 10) return about(std::round(seconds), "s");
  if (seconds < 100) return about(5 * std::round(seconds / 5), "s");
  if (seconds < 100 * 60) return about(std::round(seconds / 60), "min");
  return about(std::round(seconds / 3600), "h");
}

}  // namespace plastron::app
