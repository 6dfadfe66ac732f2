// Mistakes of the user in a case file, with their places. One exception contains all mistakes of a file.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace plastron::config {

struct Mistake {
  std::string file{};
  int line = 0;    ///< from 1; 0: the file as a whole
  int column = 0;  ///< from 1, in characters
  int length = 1;  ///< number of characters to underline, at most to the end of the line
  std::string source_line{};
  std::string what{};
  std::string allowed{};  ///< accepted values; may be empty
  std::string advice{};   ///< advice to the user; may be empty
};

/// Returns one mistake in the style of a compiler's message, ending in a newline.
std::string format(const Mistake& mistake);

/// Thrown for a case file with mistakes. The mistakes are in the order of the file.
class CaseErrors : public std::runtime_error {
 public:
  explicit CaseErrors(std::vector<Mistake> mistakes);

  const std::vector<Mistake>& mistakes() const { return mistakes_; }
  std::string format() const { return what(); }

 private:
  std::vector<Mistake> mistakes_;
};

}  // namespace plastron::config
