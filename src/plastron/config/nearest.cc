#include <plastron/config/nearest.hpp>
#include <plastron/config/schema.hpp>

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace plastron::config {

namespace {

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_abbreviation(const std::string& word, const std::string& of) {
  return word.size() >= 3 && of.starts_with(word);
}

}  // namespace

// distance[i][j] is the distance between the first i characters of a and the first j of b.
int edit_distance(const std::string& first, const std::string& second) {
  const std::string a = lower_case(first), b = lower_case(second);
  std::vector<std::vector<int>> distance(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      int& d = distance[i][j];
      if (i == 0 || j == 0) {
        d = static_cast<int>(i + j);
        continue;
      }
      d = std::min({distance[i - 1][j] + 1, distance[i][j - 1] + 1, distance[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) d = std::min(d, distance[i - 2][j - 2] + 1);
    }
  return distance.back().back();
}

std::vector<std::string> nearest_few(const std::string& word, std::span<const std::string> candidates,
                                     std::size_t most) {
  std::vector<std::pair<int, std::string>> near;
  if (word.size() > longest_name) return {};  // too long for a typing mistake
  for (const std::string& candidate : candidates) {
    const int length = static_cast<int>(std::max(word.size(), candidate.size()));
    const int distance = edit_distance(word, candidate);
    if ((distance < length && distance <= std::max(1, length / 3)) || is_abbreviation(word, candidate) ||
        is_abbreviation(candidate, word))
      near.emplace_back(distance, candidate);
  }
  // Two words may be equally near. The longer one is likelier: "ux" means "u.x" and not "u".
  std::ranges::stable_sort(
      near, {}, [&](const auto& entry) { return std::pair(entry.first, entry.second.size() < word.size()); });
  std::vector<std::string> few;
  for (std::size_t i = 0; i < std::min(most, near.size()); ++i) few.push_back(near[i].second);
  return few;
}

std::string nearest(const std::string& word, std::span<const std::string> candidates) {
  const auto best = nearest_few(word, candidates, 1);
  return best.empty() ? "" : best.front();
}

std::string did_you_mean(const std::string& word, std::span<const std::string> candidates) {
  const std::string best = nearest(word, candidates);
  return best.empty() ? "" : "did you mean \"" + best + "\"?";
}

}  // namespace plastron::config
