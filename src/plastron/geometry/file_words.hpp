// Words of a text file: conversion to numbers, and their form in messages.
#pragma once
#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

namespace plastron::geometry {

/// A piece of a file in a form for messages: printable and short.
inline std::string shown(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result(text.substr(0, longest));
  std::ranges::replace_if(
      result, [](char c) { return c < ' ' || c > '~'; }, '?');
  return text.size() > longest ? result + "..." : result;
}

/// Converts a word to a number. Returns false unless the whole word is a number, with or without sign. Uses C's
/// locale always.
template <class Number>
bool parse(std::string_view word, Number& number) {
  if (word.size() > 1 && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc{} && end == word.data() + word.size();
}

}  // namespace plastron::geometry
