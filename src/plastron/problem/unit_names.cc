#include <plastron/problem/unit_names.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace plastron::problem {

namespace {

constexpr std::array<std::string_view, 4> base_units{"Pa", "N", "J", "m"};

/// Units of force / length^2 and force * length that have their own names.
struct NamedUnits {
  std::string_view force, length, stress, energy;
};
constexpr std::array named_units{NamedUnits{"N", "m", "Pa", "J"},    NamedUnits{"N", "mm", "MPa", "mJ"},
                                 NamedUnits{"kN", "m", "kPa", "kJ"}, NamedUnits{"MN", "m", "MPa", "MJ"},
                                 NamedUnits{"kN", "mm", "GPa", "J"}, NamedUnits{"lbf", "in", "psi", "lbf in"}};

/// A unit of length or force and its value in m or N.
struct SizedUnit {
  std::string_view name;
  double value;
};
constexpr std::array lengths{SizedUnit{"m", 1},       SizedUnit{"mm", 1e-3},  SizedUnit{"cm", 1e-2},
                             SizedUnit{"dm", 0.1},    SizedUnit{"um", 1e-6},  SizedUnit{"km", 1e3},
                             SizedUnit{"in", 0.0254}, SizedUnit{"ft", 0.3048}};
constexpr std::array forces{SizedUnit{"N", 1},           SizedUnit{"mN", 1e-3},      SizedUnit{"daN", 10},
                            SizedUnit{"kN", 1e3},        SizedUnit{"MN", 1e6},       SizedUnit{"kgf", 9.80665},
                            SizedUnit{"lbf", 4.4482216}, SizedUnit{"kip", 4448.2216}};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool goes_on(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/' || c == '^'; }

/// Returns the unit at the beginning of the text without its exponent; empty if there is none.
std::string_view base_unit(std::string_view text) {
  const auto found = std::ranges::find_if(base_units, [&](std::string_view unit) { return text.starts_with(unit); });
  return found == base_units.end() ? std::string_view() : text.substr(0, found->size());
}

/// Returns the length of the unit at the beginning of the text: factors with exponents, joined by blanks and slashes. 0
/// if no unit ends there.
std::size_t length_of_unit(std::string_view text) {
  std::size_t end = 0, length = 0;
  while (true) {
    const std::string_view unit = base_unit(text.substr(end));
    if (unit.empty()) return length;
    end += unit.size();
    if (text.size() > end + 1 && text[end] == '^') end += 2;
    if (end == text.size()) return end;
    if (!goes_on(text[end])) length = end;
    if (text[end] != ' ' && text[end] != '/') return length;
    ++end;
  }
}

/// Whether a unit may begin at `at`: after a number, a vector or a number in HTML.
bool follows_number(std::string_view text, std::size_t at) {
  constexpr std::string_view ends_of_numbers = "0123456789.)>";
  return at >= 2 && text[at - 1] == ' ' && ends_of_numbers.find(text[at - 2]) != std::string_view::npos;
}

bool fills_brackets(std::string_view text, std::size_t at, std::size_t length) {
  return at >= 1 && text[at - 1] == '[' && at + length < text.size() && text[at + length] == ']';
}

}  // namespace

std::optional<double> UnitNames::in_SI(int force_power, int length_power) const {
  const auto* of_force = std::ranges::find(forces, force, &SizedUnit::name);
  const auto* of_length = std::ranges::find(lengths, length, &SizedUnit::name);
  if (of_force == forces.end() || of_length == lengths.end()) return std::nullopt;
  return std::pow(of_force->value, force_power) * std::pow(of_length->value, length_power);
}

std::string UnitNames::label(std::string_view unit) const {
  const auto named = std::ranges::find_if(
      named_units, [&](const NamedUnits& names) { return names.force == force && names.length == length; });
  const std::string stress = named == named_units.end() ? force + "/" + length + "^2" : std::string(named->stress);
  const std::string energy = named == named_units.end() ? force + " " + length : std::string(named->energy);
  const auto name = [&](std::string_view word) {
    return word == "m"    ? length
           : word == "N"  ? force
           : word == "Pa" ? stress
           : word == "J"  ? energy
                          : std::string(word);
  };
  std::string result;
  for (auto at = unit.begin(); at != unit.end();) {
    const auto word = std::find_if_not(at, unit.end(), is_letter);
    result += name({at, word});
    at = std::find_if(word, unit.end(), is_letter);
    result.append(word, at);
  }
  return result;
}

std::string UnitNames::renamed(std::string_view text) const {
  if (!are_named()) return std::string(text);
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = length_of_unit(text.substr(at));
    if (size > 0 && (follows_number(text, at) || fills_brackets(text, at, size))) {
      result += label(text.substr(at, size));
      at += size;
    } else {
      result += text[at++];
    }
  }
  return result;
}

}  // namespace plastron::problem
