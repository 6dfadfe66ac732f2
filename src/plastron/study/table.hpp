// The table a study fills: numbers in named columns, fitted exponents, and what they say about the claims examined.
#pragma once
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

/// quantity ~ against^exponent, by least squares of the logarithms.
struct Fit {
  std::string quantity, against;
  double exponent = 0;
};

/// A statement that can be checked, what was measured, and whether the measurement bears it out.
struct Claim {
  std::string statement, measured;
  bool holds = false;
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
