// A text file as numbered lines, read completely and parsed word by word. For any file, the result is a value or a
// DomainError that names the line.
#pragma once
#include <plastron/geometry/file_words.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace plastron::fem {

using geometry::shown;

class MeshText {
 public:
  /// Reads the file. Throws DomainError if it does not exist, is no regular file, or is too large.
  explicit MeshText(std::string path);

  /// Moves to the next line that is not blank; returns false at the end of the file.
  bool next_line();
  /// Moves to the next line; refuses the end of the file.
  void expect_line(const char* what);
  std::string_view line() const { return line_; }
  std::size_t line_number() const { return number_; }

  // Read the words of the current line from left to right. They refuse a missing word or an invalid number.
  bool has_word() const;
  std::string_view word(const char* what);
  std::int64_t integer(const char* what);
  int small_integer(const char* what);  ///< in the range of int
  double real(const char* what);        ///< a finite number
  /// Reads a number of items that follow, each of `least` bytes or more. Refuses more than the rest of the file can
  /// contain.
  std::size_t count(const char* what, std::size_t least);
  void expect_end_of_line();

  [[noreturn]] void refuse(const std::string& what) const;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::string text_;
  std::string_view line_{};  ///< without the end of line
  std::string_view rest_{};  ///< unread part of the line
  std::size_t next_ = 0;     ///< start of the next line
  std::size_t number_ = 0;
};

}  // namespace plastron::fem
