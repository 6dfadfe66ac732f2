// What a user got wrong in a case file, and where. All mistakes of a file travel together in one exception.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace plastron::config {

struct Mistake {
  std::string file{};
  int line = 0;    ///< from 1; 0: the file as a whole
  int column = 0;  ///< from 1, in characters
  int length = 1;  ///< characters to underline, to the end of the line at most
  std::string source_line{};
  std::string what{};
  std::string allowed{};  ///< what would have been accepted; may be empty
  std::string advice{};   ///< what to do; may be empty
};

/// One mistake in the style of a compiler's message, ending in a newline.
std::string format(const Mistake& mistake);

/// Thrown for a case file with mistakes; they come in the order of the file.
class CaseErrors : public std::runtime_error {
 public:
  explicit CaseErrors(std::vector<Mistake> mistakes);

  const std::vector<Mistake>& mistakes() const { return mistakes_; }
  std::string format() const { return what(); }

 private:
  std::vector<Mistake> mistakes_;
};

}  // namespace plastron::config
