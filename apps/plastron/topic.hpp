// What `plastron explain` can tell of: keys of the case file, fields and numbers of the results, statuses. Each is made from the
// declaration that the program itself works with.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace plastron::app {

struct Topic {
  std::string name;                    ///< "shell.thickness"
  std::string what;                    ///< "key of the case file"
  std::vector<std::string> aliases{};  ///< other words for it
  std::function<std::string()> text{};
  /// How the word names it: with no part of the name left out, or with the first ones.
  bool is_called(const std::string& word) const;
  bool ends_with(const std::string& word) const { return name.ends_with("." + word); }
};

/// Sections of the case file and their keys.
std::vector<Topic> case_topics();
/// Statuses, fields, and what stands in results.json.
std::vector<Topic> result_topics();

/// What the program cannot do.
std::vector<Topic> limit_topics();

/// What there is in each, a line a section or a part.
std::string case_overview();
std::string result_overview();
std::string limit_overview();

}  // namespace plastron::app
