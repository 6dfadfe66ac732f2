#include <plastron/io/envelopes.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

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
    widen_all(load_case, path.empty() ? key : path + "/" + key, item.value(), ranges);
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

}  // namespace plastron::io
