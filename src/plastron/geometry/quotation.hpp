// Quotation of a user's text in messages: long texts are cut, so that one wrong value does not fill the screen.
#pragma once
#include <string>
#include <string_view>

namespace plastron::geometry {

/// Returns at most `most` characters (code points) of `text`, with "..." at the end if text was omitted.
inline std::string shortened(std::string_view text, std::size_t most = 60) {
  constexpr std::string_view mark = "...";
  std::size_t count = 0, cut = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) == 0x80) continue;
    if (count + mark.size() == most) cut = i;
    if (++count > most) return std::string(text.substr(0, cut)) + std::string(mark);
  }
  return std::string(text);
}

}  // namespace plastron::geometry
