// The table a study fills: numbers in named columns, fitted exponents, and what they say about the claims examined.
#pragma once
#include <research/study/claim.hpp>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace plastron::study {

/// A column with the symbol of its quantity (docs/symbols.md) and its unit; "-" for texts, "1" for pure numbers.
struct Column {
  std::string name, symbol, unit;
};

/// NaN where a row has no value, such as the rate of the first mesh.
using Entry = std::variant<double, std::int64_t, std::string>;

/// quantity ~ against^exponent, by least squares of the logarithms; NaN where the values allow no exponent.
struct Fit {
  std::string quantity, against;
  double exponent = 0;
};

struct Table {
  std::string name;   ///< of the study, also of its files
  std::string title;  ///< the question it answers
  std::vector<Column> columns{};
  std::vector<std::vector<Entry>> rows{};  ///< as many entries as columns
  std::vector<Fit> fits{};
  std::vector<Claim> claims{};
  std::vector<std::string> remarks{};  ///< in sentences: conditions, warnings, what was left out and why
};

}  // namespace plastron::study
