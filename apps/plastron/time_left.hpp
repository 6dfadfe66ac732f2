// Estimates the remaining time of a computation from the times of its parts. Each mesh of a sequence costs a constant
// factor more than the previous one. Parts of steps cost the same. Times are seconds since a common start.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace plastron::app {

/// The meshes of a sequence.
class MeshesLeft {
 public:
  explicit MeshesLeft(int meshes) : meshes_(meshes) {}
  /// Stores the time at which a mesh is finished.
  void done(double time);
  /// Returns the time at which all will be finished. Nothing before two meshes are finished, or if they were too quick
  /// for an estimate.
  std::optional<double> end() const;

 private:
  int meshes_;
  std::vector<double> ends_{0};
};

/// Equal parts.
class PartsLeft {
 public:
  PartsLeft(int parts, double begin) : parts_(parts), begin_(begin) {}
  void done(double time);
  int number_done() const { return done_; }
  int number() const { return parts_; }
  /// Returns the time at which all will be finished; nothing before the first is.
  std::optional<double> end() const;

 private:
  int parts_, done_ = 0;
  double begin_, last_ = 0;
};

/// Returns "about 40 s left", "about 3 min left"; empty below two seconds.
std::string left_text(double seconds);

}  // namespace plastron::app
