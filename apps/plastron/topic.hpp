// The topics of `plastron explain`: keys of the case file, fields and numbers of the results, statuses. Each is made
// from the declaration that the program itself uses.
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
  /// Whether the word names the topic: is_called() by the whole name or an alias, ends_with() without the first parts.
  bool is_called(const std::string& word) const;
  bool ends_with(const std::string& word) const { return name.ends_with("." + word); }
};

/// Sections of the case file and their keys.
std::vector<Topic> case_topics();
/// Statuses, fields, and the contents of results.json.
std::vector<Topic> result_topics();

/// The limits of the program.
std::vector<Topic> limit_topics();

/// Returns the topics of each kind, one line for each section or part.
std::string case_overview();
std::string result_overview();
std::string limit_overview();

}  // namespace plastron::app
