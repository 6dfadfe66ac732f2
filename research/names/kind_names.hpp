// Names, questions and options of the studies. The command line needs only these, and does not load the libraries that
// the studies compute with.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace plastron::study {

struct KindName {
  std::string_view name, question;
  /// Members of StudyOptions it looks at, as the command line calls them ("steps" are "factors" in other words).
  std::span<const std::string_view> options{};
};

std::span<const KindName> kind_names();
/// Null if there is no study of this name.
const KindName* find_kind_name(std::string_view name);

/// Any kind that has `options`.
template <class AnyKind>
bool takes_option(const AnyKind& kind, std::string_view option) {
  for (const std::string_view taken : kind.options)
    if (taken == option) return true;
  return false;
}
/// The names of the studies that take an option, separated by commas.
std::string kinds_that_take(std::string_view option);

}  // namespace plastron::study
