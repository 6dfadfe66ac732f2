// The findings of an examination, by severity.
#pragma once
#include <plastron/examination/examine.hpp>

#include <string>
#include <vector>

namespace plastron::examination {

inline std::vector<std::string> texts(const problem::Problem& problem, Severity severity) {
  std::vector<std::string> all;
  for (const Finding& f : examine(problem))
    if (f.severity == severity) all.push_back(f.text);
  return all;
}
inline std::vector<std::string> errors(const problem::Problem& problem) { return texts(problem, Severity::error); }
inline std::vector<std::string> warnings(const problem::Problem& problem) { return texts(problem, Severity::warning); }

}  // namespace plastron::examination
