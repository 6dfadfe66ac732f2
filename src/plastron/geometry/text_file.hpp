// A text file as numbered lines of words, read completely and parsed word by word. For any file, the result is a value
// or a FileError.
#pragma once
#include <plastron/geometry/file_error.hpp>

#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace plastron::geometry {

/// A piece of a file in a form for messages: printable and short.
std::string shown(std::string_view text);

/// Converts a word to a number. Returns false unless the whole word is a number, with or without sign. Uses C's
/// locale always.
template <class Number>
bool parse(std::string_view word, Number& number) {
  if (word.size() > 1 && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc{} && end == word.data() + word.size();
}

/// Whether words may follow on the next line when a line has no more of them.
enum class Lines { end_words, run_on };

class TextFile {
 public:
  /// Reads the file. `kind` names it in messages. Throws if it does not exist, is no regular file, or has more than
  /// 256 MB.
  TextFile(std::string path, const std::string& kind, Lines lines);
  /// Takes the text of a file that is in memory; `path` names it in messages.
  TextFile(std::string path, std::string text, Lines lines, std::in_place_t);

  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }

  /// Moves to the next line that is not blank; returns false at the end of the file.
  bool next_line();
  /// Moves to the next line; refuses the end of the file.
  void expect_line(const char* what);
  std::string_view line() const { return line_; }
  std::size_t line_number() const { return number_; }

  // The words of the current line from left to right. A missing word or an invalid number is refused; `what` says in
  // messages what should stand there.
  bool has_word() const { return !rest_.empty(); }
  std::string_view word(const char* what);
  std::int64_t integer(const char* what);
  int small_integer(const char* what);  ///< in the range of int
  /// Reads a finite number of at most this size.
  double real(const char* what, double largest = std::numeric_limits<double>::max());
  /// Reads a number of items that follow, each of `least` bytes or more. Refuses more than the rest of the file can
  /// contain.
  std::size_t count(const char* what, std::size_t least);
  void expect_end_of_line();
  void skip_rest_of_line() { rest_ = {}; }
  /// Returns the words of the line that are not yet taken, with the blanks between them.
  std::string_view take_rest_of_line() { return std::exchange(rest_, {}); }

  /// Whether no word follows on any line. If one does, moves to its line.
  bool at_end() { return !has_word() && !next_line(); }
  /// Returns the next word without taking it. Precondition: not at_end().
  std::string_view peek() const;
  /// Takes the next word if it is this one.
  bool take(std::string_view word);

  /// Throws FileError with path, line and `what`.
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::string path_, text_;
  Lines lines_;
  std::string_view line_{};  ///< current line without blanks at its ends
  std::string_view rest_{};  ///< words of the line that are not yet taken
  std::size_t next_ = 0;     ///< start of the next line
  std::size_t number_ = 0;
};

}  // namespace plastron::geometry
