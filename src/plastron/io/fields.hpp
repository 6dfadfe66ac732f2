// The table of all output fields: their names in both output files, units, meanings and sources.
// A pressure [Pa] and a force [N] never have the same name.
#pragma once
#include <plastron/recovery/recovery.hpp>

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::io {

/// Computations in which a field has a meaning.
enum class Presence { always, with_obstacle, with_multiplier, with_foundation };

/// What a computation has that gives a field its meaning.
struct Ingredients {
  bool obstacle = false;
  bool multiplier = false;  ///< of the mixed formulation
  bool foundation = false;  ///< under an area
};
Ingredients ingredients_of(const assembly::DiscreteShell& discrete);

struct Field {
  std::string key;                  ///< path in a probe of results.json, steps separated by '/'
  std::vector<std::string> arrays;  ///< in the .vtu file: one name for a Cartesian vector, else one for each component
  std::string_view symbol;          ///< symbol as in docs/symbols.md
  std::string_view unit;
  std::string meaning;
  int components;  ///< 1 to 3
  Presence presence;
  std::function<std::array<double, 3>(const recovery::PointValues&)> take;

  bool is_vector() const { return components == 3 && arrays.size() == 1; }
};

std::span<const Field> fields();

/// Whether a field has a meaning in a computation.
bool is_present(const Field& field, const Ingredients& ingredients);
/// Returns the fields with a meaning. `heights`: additional values of z / e for stresses, named "stress_at_0.25" and so
/// on; probes do not have them. `layers`: the largest number of layers of a laminate; each has its own stresses, named
/// "layer_1_lower" and so on, in the layer's axes. They are NaN where there is no such layer.
std::vector<Field> fields_of(const Ingredients& ingredients, std::span<const double> heights = {}, int layers = 0);

}  // namespace plastron::io
