// The content of an obstacle's file, within limits of size, and its words in sequence.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace plastron::obstacle {

inline constexpr std::size_t largest_obstacle_file = std::size_t{256} << 20;  ///< bytes

/// Reads a file. Throws ObstacleError: no such file, no regular file, too large, not readable.
std::string file_content(const std::string& path);

/// Larger coordinates are refused, because computations would overflow.
inline constexpr double largest_coordinate = 1e50;

class Words {
 public:
  explicit Words(const std::string& path) : Words(path, file_content(path)) {}
  Words(std::string path, std::string text) : path_(std::move(path)), text_(std::move(text)) { skip_blanks(); }

  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }
  std::size_t offset() const { return at_; }

  bool at_end() const { return at_ >= text_.size(); }
  /// Returns the next word without taking it. Precondition: not at the end.
  std::string_view peek() const;
  /// Takes the next word; refuses the end of the file.
  std::string_view next();
  bool take(std::string_view word);
  /// Returns the rest of the line of the last word taken; empty if that word ended the line.
  std::string_view rest_of_line();
  /// Takes a number, which must be finite and at most largest_coordinate; `what` is for the message.
  double number(const char* what);
  long integer(const char* what);

  /// Throws ObstacleError with path, line and `what`.
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  void skip_blanks();
  std::string path_, text_;
  std::size_t at_ = 0, last_end_ = 0;
};

}  // namespace plastron::obstacle
