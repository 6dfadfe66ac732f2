#include <plastron/geometry/piecewise.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace plastron::geometry {

bool is_piecewise(const Expression& f) {
  constexpr std::array<std::string_view, 7> words{"abs", "atan2", "max", "min", "rint", "sign", "step"};
  const auto in_a_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  if (f.is_constant()) return false;
  const std::string_view text = f.text();
  if (text.find_first_of("?<>=!&|") != std::string_view::npos) return true;
  for (auto begin = text.begin(); begin != text.end();) {
    begin = std::find_if(begin, text.end(), in_a_name);
    const auto end = std::find_if_not(begin, text.end(), in_a_name);
    if (std::ranges::find(words, std::string_view(begin, end)) != words.end()) return true;
    begin = end;
  }
  return false;
}

}  // namespace plastron::geometry
