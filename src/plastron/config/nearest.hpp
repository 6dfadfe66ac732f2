// The known word a mistyped one was probably meant to be.
#pragma once
#include <span>
#include <string>

namespace plastron::config {

/// Least number of insertions, deletions, substitutions and swaps of neighbours that turn a into b, ignoring case.
int edit_distance(const std::string& a, const std::string& b);

/// The candidate nearest to `word`, or "" when none is near: at most one edit, or one in
/// three letters, or one word the beginning of the other.
std::string nearest(const std::string& word, std::span<const std::string> candidates);

/// The advice that goes with it: did you mean "..."?, or "".
std::string did_you_mean(const std::string& word, std::span<const std::string> candidates);

}  // namespace plastron::config
