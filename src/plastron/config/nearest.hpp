// Finds the known word that a mistyped word probably means.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace plastron::config {

/// Returns the least number of insertions, deletions, substitutions and swaps of neighbours that change a into b,
/// ignoring case.
int edit_distance(const std::string& a, const std::string& b);

/// Returns the near candidates, at most `most`, the nearest first. Near means: at most one edit, or one edit in three
/// letters, or one word begins with the other.
std::vector<std::string> nearest_few(const std::string& word, std::span<const std::string> candidates,
                                     std::size_t most);

/// Returns the candidate nearest to `word`, or "" when none is near.
std::string nearest(const std::string& word, std::span<const std::string> candidates);

/// Returns the advice: did you mean "..."?, or "".
std::string did_you_mean(const std::string& word, std::span<const std::string> candidates);

}  // namespace plastron::config
