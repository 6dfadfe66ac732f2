// Damaged texts for tests of readers: changed bits, bytes, words and lines.
#pragma once
#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace plastron::domain {

/// Damages texts, in the same way in every run.
class Mutator {
 public:
  /// `keyword` is one of the format, which may replace any word; words stand between `separators`.
  Mutator(const char* keyword, const char* separators) : keyword_(keyword), separators_(separators) {}

  std::string operator()(std::string text) {
    const int changes = 1 + below(3);
    for (int i = 0; i < changes; ++i) text = changed(std::move(text));
    return text;
  }

 private:
  int below(std::size_t n) { return static_cast<int>(random_() % std::max<std::size_t>(1, n)); }

  std::string changed(std::string text) {
    const auto at = static_cast<std::size_t>(below(text.size()));
    switch (below(6)) {
      case 0:  // a bit of a byte
        if (!text.empty()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        return text;
      case 1:
        return text.substr(0, at);
      case 2:
        return text.insert(at, 1, static_cast<char>(below(256)));
      case 3:
      case 4:
        return with_another_word(std::move(text), at);
      default:
        return with_lines_changed(text);
    }
  }

  /// Mostly in place of a number, since most words are.
  std::string with_another_word(std::string text, std::size_t at) {
    const char* const words[] = {"-1",
                                 "0",
                                 "1",
                                 "2",
                                 "3",
                                 "4",
                                 "10",
                                 "1e308",
                                 "-1e-308",
                                 "nan",
                                 "inf",
                                 "1000000000",
                                 "9223372036854775807",
                                 "-9223372036854775808",
                                 "99999999999999999999",
                                 "0.5",
                                 "x",
                                 keyword_,
                                 ""};
    const std::size_t from = text.find_last_of(separators_, at) + 1;  // 0 if there is none
    const std::size_t to = std::min(text.find_first_of(separators_, from), text.size());
    return text.replace(from, to - from, words[below(std::size(words))]);
  }

  std::string with_lines_changed(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (lines.empty()) return text;
    const auto a = static_cast<std::size_t>(below(lines.size())), b = static_cast<std::size_t>(below(lines.size()));
    switch (below(3)) {
      case 0:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(a));
        break;
      case 1:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(a), std::string(lines[b]));
        break;
      default:
        std::swap(lines[a], lines[b]);
    }
    std::string result;
    for (const std::string& line : lines) result += line + "\n";
    return result;
  }

  const char *keyword_, *separators_;
  std::mt19937 random_{20240607};
};

}  // namespace plastron::domain
