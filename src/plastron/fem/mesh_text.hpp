// A text file as lines and their numbers, read whole and examined word by word: whatever the file holds, the result is
// a value or a DomainError that names the line.
#pragma once
#include <plastron/geometry/file_words.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace plastron::fem {

using geometry::shown;

class MeshText {
 public:
  /// Throws DomainError for what is not there, no regular file, or too large.
  explicit MeshText(std::string path);

  /// To the next line that is not blank; false at the end of the file.
  bool next_line();
  /// The same where a line must follow.
  void expect_line(const char* what);
  std::string_view line() const { return line_; }
  std::size_t line_number() const { return number_; }

  // The words of the current line from left to right; a word that is missing or no such number is refused.
  bool has_word() const;
  std::string_view word(const char* what);
  std::int64_t integer(const char* what);
  int small_integer(const char* what);  ///< one that an int holds
  double real(const char* what);        ///< finite
  /// How many things follow, each of `least` bytes or more: no more than the rest of the file has room for.
  std::size_t count(const char* what, std::size_t least);
  void expect_end_of_line();

  [[noreturn]] void refuse(const std::string& what) const;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::string text_;
  std::string_view line_{};  ///< without its end
  std::string_view rest_{};  ///< of the line, unread
  std::size_t next_ = 0;     ///< where the next line begins
  std::size_t number_ = 0;
};

}  // namespace plastron::fem
