// Case files damaged at random, the same ones every time.
#pragma once
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace plastron::test {

class Mutants {
 public:
  explicit Mutants(std::uint64_t seed) : random_(seed) {}

  /// One to three damages: of bytes, tokens, numbers, keys or brackets.
  std::string operator()(std::string text) {
    for (std::size_t i = 1 + below(3); i > 0; --i) damage(text);
    return text;
  }

 private:
  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : random_() % bound; }

  void damage(std::string& text) {
    switch (below(8)) {
      case 0:
        return byte(text);
      case 1:
        return number(text);
      case 2:
        return line_twice(text);
      case 3:
        return cut(text);
      case 4:
        return nest(text);
      case 5:
        return swap_lines(text);
      case 6:
        return insert(text);
      default:
        return number(text);
    }
  }

  void byte(std::string& text) {
    if (!text.empty()) text[below(text.size())] = static_cast<char>(below(256));
  }

  /// Replaces a number of the text by an extreme one.
  void number(std::string& text) {
    static const std::vector<std::string> hard{"1e308",
                                               "-1e308",
                                               "1e-308",
                                               "nan",
                                               "-nan",
                                               "inf",
                                               "0",
                                               "-1",
                                               "-0.0",
                                               "1e30",
                                               "1e-30",
                                               "9^9^9",
                                               "1/0",
                                               "x",
                                               "\"x\"",
                                               "[]",
                                               "99999999999999999999",
                                               "0.4999999999999999",
                                               "1000000",
                                               "7",
                                               "{}",
                                               "true"};
    const std::size_t from = text.find_first_of("0123456789", below(text.size() + 1));
    if (from == std::string::npos) return;
    const std::size_t to = text.find_first_not_of("0123456789.eE", from);
    text.replace(from, to == std::string::npos ? to : to - from, hard[below(hard.size())]);
  }

  std::pair<std::size_t, std::size_t> line(const std::string& text) {
    const std::size_t at = below(text.size() + 1), before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1, end = text.find('\n', begin);
    return {begin, end == std::string::npos ? text.size() : end + 1};
  }

  void line_twice(std::string& text) {
    const auto [begin, end] = line(text);
    text.insert(end, text.substr(begin, end - begin));
  }

  void swap_lines(std::string& text) {
    const auto [begin, end] = line(text);
    const std::string taken = text.substr(begin, end - begin);
    text.erase(begin, end - begin);
    text.insert(line(text).first, taken);
  }

  void cut(std::string& text) {
    const std::size_t begin = below(text.size() + 1);
    text.erase(begin, below(40));
  }

  void nest(std::string& text) {
    static const std::vector<std::string> deep{"[", "{a=", "(", "sin(", "-", "a.", "2^", "(x+1)*"};
    const std::string& part = deep[below(deep.size())];
    const std::size_t at = below(text.size() + 1);
    std::string many;
    for (std::size_t i = below(2) == 0 ? below(30) : below(8000); i > 0; --i) many += part;
    text.insert(at, many);
  }

  void insert(std::string& text) {
    static const std::vector<std::string> tokens{"\"", "'",  "\"\"\"",  "]", "}",   "=",  "\n[",      "\n[[",
                                                 "#",  "\\", "\x1b[2J", ",", "u.z", "\r", "\xC2\x9B", "{}",
                                                 "..", "x",  "^",       "?", ":",   ")"};
    text.insert(below(text.size() + 1), tokens[below(tokens.size())]);
  }

  std::mt19937_64 random_;  // the same numbers on every machine
};

}  // namespace plastron::test
