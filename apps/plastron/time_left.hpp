// How long a computation will go on, from how long its parts have taken: meshes of a sequence, each so many times as dear as the one
// before, and parts of steps, which are alike. Times are seconds since some beginning.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace plastron::app {

/// The meshes of a sequence.
class MeshesLeft {
 public:
  explicit MeshesLeft(int meshes) : meshes_(meshes) {}
  /// A mesh is done at that time.
  void done(double time);
  /// When all will be done; nothing before two meshes are, or while they took too short a time to tell.
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
  /// When all will be done; nothing before the first is.
  std::optional<double> end() const;

 private:
  int parts_, done_ = 0;
  double begin_, last_ = 0;
};

/// "about 40 s left", "about 3 min left"; empty below two seconds.
std::string left_text(double seconds);

}  // namespace plastron::app
