#include <plastron/io/envelopes.hpp>

#include <plastron/algebra/vector.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plastron::io {

namespace {

/// Entries that tell how a case was computed.
constexpr std::array not_physical{"time",           "iterations", "factorisations", "load_factor",
                                  "support_factor", "cells",      "nodes",          "unknowns"};

/// Widens the range of a number by its value in a case.
void widen(const std::string& load_case, double value, Json& range) {
  if (range.is_null())
    range = {{"least", value}, {"least_case", load_case}, {"largest", value}, {"largest_case", load_case}};
  if (value < range["least"].get<double>()) {
    range["least"] = value;
    range["least_case"] = load_case;
  }
  if (value > range["largest"].get<double>()) {
    range["largest"] = value;
    range["largest_case"] = load_case;
  }
}

/// Widens the ranges of all numbers in a record; `path` leads to it.
void widen_all(const std::string& load_case, const std::string& path, const Json& record, Json& ranges) {
  if (record.is_number()) return widen(load_case, record.get<double>(), ranges[path]);
  if (!record.is_structured()) return;
  std::size_t k = 0;
  for (const auto& item : record.items()) {
    const std::string key = record.is_array() ? std::to_string(k++) : item.key();
    if (key == "estimates" || key == "factors" ||
        std::ranges::find(not_physical, std::string_view(key)) != not_physical.end())
      continue;
    widen_all(load_case, path.empty() ? key : fmt::format("{}/{}", path, key), item.value(), ranges);
  }
}

/// Returns the mesh with arrays for extreme values of the fields, which have none yet.
GridPiece without_values(const GridPiece& fields) {
  GridPiece piece{.type = fields.type,
                  .points_per_cell = fields.points_per_cell,
                  .points = fields.points,
                  .connectivity = fields.connectivity};
  for (const GridArray& array : fields.point_arrays)
    for (const char* extreme : {"_least", "_largest"}) {
      GridArray values{.name = array.name + extreme, .unit = array.unit, .components = array.components};
      values.values.assign(array.values.size(), std::numeric_limits<double>::quiet_NaN());
      GridArray cases{.name = values.name + "_case", .unit = "1", .components = array.components};
      cases.values.assign(array.values.size(), -1);
      cases.are_integers = true;
      piece.point_arrays.push_back(std::move(values));
      piece.point_arrays.push_back(std::move(cases));
    }
  return piece;
}

/// Replaces extreme values by those of a case that lie beyond them.
void widen(const std::vector<double>& fresh, double load_case, bool is_least, std::vector<double>& values,
           std::vector<double>& cases) {
  for (std::size_t i = 0; i < fresh.size(); ++i)
    if ((is_least ? fresh[i] < values[i] : fresh[i] > values[i]) || (std::isnan(values[i]) && !std::isnan(fresh[i]))) {
      values[i] = fresh[i];
      cases[i] = load_case;
    }
}

}  // namespace

Json envelopes_json(const Json& history, const Json& envelopes) {
  Json list = Json::array();
  for (const Json& envelope : envelopes) {
    Json numbers = Json::object();
    for (const Json& record : history)
      if (std::ranges::find(envelope["cases"], record["step"]) != envelope["cases"].end())
        widen_all(record["step"], "", record, numbers);
    list.push_back({{"name", envelope["name"]}, {"cases", envelope["cases"]}, {"numbers", std::move(numbers)}});
  }
  return list;
}

GridPiece case_piece(const computation::Solution& solution, VtuChoice choice) {
  constexpr std::array without_extremes{
      "x",  "y",  "reference position", "lower face", "upper face", "N direction", "M direction", "t1",
      "t2", "a3", "thickness",          "kappa_1",    "kappa_2"};
  choice.displacement_scale = 0;
  GridPiece piece = surface_piece(solution, choice);
  piece.cell_arrays.clear();
  std::erase_if(piece.point_arrays, [&](const GridArray& array) {
    return std::ranges::find(without_extremes, array.name) != without_extremes.end() ||
           std::ranges::any_of(solution.modes, [&](const auto& mode) { return mode.name() == array.name; });
  });
  return piece;
}

void EnvelopeFields::add(const std::string& load_case, const GridPiece& fields, MPI_Comm comm) {
  const auto found = std::ranges::find(envelope_.cases, load_case);
  if (found == envelope_.cases.end()) return;
  if (added_++ == 0) piece_ = without_values(fields);
  const bool is_same = fields.points == piece_.points && 4 * fields.point_arrays.size() == piece_.point_arrays.size();
  has_one_mesh_ = algebra::sum_over_ranks(static_cast<std::int64_t>(is_same ? 0 : 1), comm) == 0 && has_one_mesh_;
  if (!has_one_mesh_) return;
  const auto place = static_cast<double>(found - envelope_.cases.begin());
  for (std::size_t k = 0; k < piece_.point_arrays.size(); k += 2)
    widen(fields.point_arrays[k / 4].values, place, k % 4 == 0, piece_.point_arrays[k].values,
          piece_.point_arrays[k + 1].values);
}

}  // namespace plastron::io
