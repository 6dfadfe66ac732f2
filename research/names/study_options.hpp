// The options of studies on the command line.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

namespace plastron::study {

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
