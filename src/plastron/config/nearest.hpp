// The known word a mistyped one was probably meant to be.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace plastron::config {

/// Least number of insertions, deletions, substitutions and swaps of neighbours that turn a into b, ignoring case.
int edit_distance(const std::string& a, const std::string& b);

/// The candidates that are near, at most `most`, the nearest first: at most one edit, or one in three letters, or one word the beginning
/// of the other.
std::vector<std::string> nearest_few(const std::string& word, std::span<const std::string> candidates,
                                     std::size_t most);

/// The candidate nearest to `word`, or "" when none is near.
std::string nearest(const std::string& word, std::span<const std::string> candidates);

/// The advice that goes with it: did you mean "..."?, or "".
std::string did_you_mean(const std::string& word, std::span<const std::string> candidates);

}  // namespace plastron::config
