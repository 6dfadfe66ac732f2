// Names, questions and options of the studies. The command line needs only these, and does not load the libraries that
// the studies compute with.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::study {

struct KindName {
  std::string_view name, question;
  /// The options that it takes, as the command line calls them ("steps" are "factors" in other words).
  std::span<const std::string_view> options{};
};

std::span<const KindName> kind_names();
/// Null if there is no study of this name.
const KindName* find_kind_name(std::string_view name);

bool takes_option(const KindName& kind, std::string_view option);
/// The names of the studies that take an option, separated by commas.
std::string kinds_that_take(std::string_view option);

/// The options of all studies. Each study reads only its own.
struct StudyOptions {
  int reference = 2;  ///< convergence: levels between the finest mesh and the reference
  std::vector<double>
      factors{};  ///< thickness, stability: multiples of the case's e, descending; empty: the study's own
  std::optional<double> load_exponent{};  ///< thickness: loads ~ e^exponent; empty: 0 without, 3 with obstacle
  int samples = 10;                       ///< continuity: perturbations of each kind
  double size = 0.05;                     ///< continuity: largest relative perturbation
  std::uint64_t seed = 1;                 ///< continuity: of the random numbers
};

}  // namespace plastron::study
