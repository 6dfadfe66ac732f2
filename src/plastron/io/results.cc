#include <plastron/io/results.hpp>

#include <plastron/fem/quadrilateral_sequence.hpp>
#include <plastron/io/envelopes.hpp>
#include <plastron/io/fields.hpp>
#include <plastron/io/results_schema.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plastron::io {

namespace {

Ingredients ingredients_of(const computation::Result& result) {
  if (result.solution && result.solution->discrete) return io::ingredients_of(*result.solution->discrete);
  return {.obstacle = result.has_obstacle, .multiplier = result.formulation == element::Formulation::mixed};
}

Json probe_json(const recovery::PointValues& values, const computation::Result& result) {
  Json json = Json::object();
  for (const Field& field : fields()) {
    const auto taken = field.take(values);
    Json value = Json::array();
    for (int c = 0; c < field.components; ++c) value.push_back(number(taken[static_cast<std::size_t>(c)]));
    if (field.components == 1) value = Json(value.front());
    if (!is_present(field, ingredients_of(result))) value = nullptr;
    json[Json::json_pointer("/" + std::string(field.key))] = std::move(value);
  }
  return json;
}

template <class Record>
Json records_json(std::span<const Quantity<Record>> quantities, const std::vector<Record>& records) {
  Json list = Json::array();
  for (const Record& record : records) list.push_back(record_json(quantities, record));
  return list;
}

/// Returns row -> its limit, whether it is kept, and the reason for the limit.
Json limits_json(const computation::Result& result) {
  Json json = Json::object();
  for (const auto& limit : result.limits)
    json[std::string(limit.row)] = {{limit.is_least ? "at_least" : "at_most", number(limit.limit)},
                                    {"unit", limit.unit},
                                    {"holds", limit.holds()},
                                    {"reason", limit.reason}};
  return json;
}

Json obstacle_json(const solution::ObstacleContact& contact) {
  Json json = record_json(obstacle_quantities(), contact);
  json["zones"] = records_json(zone_quantities(), contact.zones);
  return json;
}

/// Returns the total action of the obstacles on the shell.
Json contact_json(const computation::Result& result) {
  if (!result.has_obstacle) return nullptr;
  Json json = record_json(contact_quantities(), result);
  json["admissible"] =
      result.summary.is_admissible_wanted ? record_json(admissible_quantities(), result) : Json(nullptr);
  return json;
}

Json estimates_json(const computation::Result& result) {
  if (!result.estimates) return nullptr;
  Json json = record_json(estimate_quantities(), result);
  json["goals"] = records_json(goal_quantities(), result.estimates->goals);
  const auto& geometry = result.estimates->geometry;
  json["geometry"] = geometry ? record_json(geometry_quantities(), *geometry) : Json(nullptr);
  return json;
}

Json level_json(const computation::Level& level) {
  Json json = record_json(level_quantities(), level);
  json["history"] = records_json(iteration_quantities(), level.history);
  return json;
}

Json probes_json(const std::vector<computation::ProbeValue>& probes, const computation::Result& result) {
  Json json = Json::object();
  for (const computation::ProbeValue& p : probes) json[p.name] = probe_json(p.values, result);
  return json;
}

std::string compiler() {
#ifdef __clang__
  return __VERSION__;  // "Clang 14.0.6"
#else
  return fmt::format("g++ {}", __VERSION__);
#endif
}

Json versions_json() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING + 1> mpi{};
  int length = 0;  // in some libraries the length includes the closing zero
  MPI_Get_library_version(mpi.data(), &length);
  return Json{{"plastron", version},
              {"compiler", compiler()},
              {"deal.II", fem::deal_ii_version()},
              {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
              {"MPI", std::string(mpi.data())}};
}

/// Returns path -> unit of every number, so that a reader needs no manual.
Json units_json() {
  Json units = Json::object();
  for (const Part& part : parts())
    for (const Entry& entry : part.entries)
      if (entry.unit != "-") units[part.place + std::string(entry.path)] = entry.unit;
  return units;
}

/// Renames units in texts for people: under "unit", in "units", and after numbers in sentences.
void rename_units(Json& json, const problem::UnitNames& units, bool are_names = false) {
  for (auto& [key, value] : json.items()) {
    const bool is_name = are_names || key == "unit";
    if (value.is_string()) {
      const auto& text = value.get_ref<const std::string&>();
      value = is_name ? units.label(text) : units.renamed(text);
    } else if (value.is_structured()) {
      rename_units(value, units, is_name || key == "units");
    }
  }
}

/// Returns {"bytes": ..., "sha256": ...}.
Json checksum_json(const Checksum& checksum) { return {{"bytes", checksum.bytes}, {"sha256", checksum.hash}}; }

/// Returns path, copy, set, bytes, sha256, and files with their names and checksums.
Json case_source_json(const CaseSource& source, const std::string& copy) {
  Json json{{"path", source.path.string()}, {"copy", copy}, {"set", source.settings}};
  json.update(checksum_json(checksum_of_text(source.text)));
  json["files"] = Json::array();
  for (const SourceFile& file : source.files) {
    Json entry{{"name", file.name}};
    entry.update(checksum_json(file.checksum));
    json["files"].push_back(std::move(entry));
  }
  return json;
}

/// Returns the data, besides the numbers, that `plastron verify` reads.
Json verification_json(const Provenance& provenance) {
  const auto or_null = [](const std::string& name) { return name.empty() ? Json(nullptr) : Json(name); };
  return {{"solution", or_null(provenance.solution)},
          {"case", provenance.source ? case_source_json(*provenance.source, provenance.case_copy) : Json(nullptr)}};
}

/// Returns the arrays of the .vtu file.
Json fields_json(const computation::Result& result, const std::vector<double>& heights) {
  Json list = Json::array();
  const int layers = result.solution ? result.solution->discrete->shell.sections().most_layers() : 0;
  for (const Field& f : fields_of(ingredients_of(result), heights, layers))
    list.push_back(
        {{"key", f.key}, {"arrays", f.arrays}, {"symbol", f.symbol}, {"unit", f.unit}, {"meaning", f.meaning}});
  for (const computation::Mode& mode : result.solution ? result.solution->modes : result.modes)
    list.push_back(field_json(mode));
  if (result.estimates)
    list.push_back({{"key", "error_indicator"},
                    {"arrays", {"error_indicator"}},
                    {"symbol", "a(e, e)"},
                    {"unit", "J"},
                    {"meaning", "estimated contribution of a cell to the squared error in the energy norm"}});
  return list;
}

}  // namespace

CaseSource case_source(const std::filesystem::path& case_file, std::string text,
                       const std::vector<std::pair<std::string, std::filesystem::path>>& files) {
  CaseSource source{.path = std::filesystem::absolute(case_file).lexically_normal(), .text = std::move(text)};
  for (const auto& [name, path] : files)
    if (std::ranges::find(source.files, name, &SourceFile::name) == source.files.end())
      source.files.push_back({.name = name, .checksum = checksum_of_file(path)});
  return source;
}

namespace {

/// Returns the factors of names that have their own.
Json factors_json(const computation::HistoryEntry& entry) {
  Json json = Json::object();
  for (std::size_t k = 0; k < entry.factors.named.size() && k < entry.factor_names.size(); ++k)
    if (!std::isnan(entry.factors.named[k])) json[entry.factor_names[k]] = number(entry.factors.named[k]);
  return json;
}

}  // namespace

Json history_json(const computation::Result& result) {
  Json list = Json::array();
  for (const computation::HistoryEntry& entry : result.history) {
    list.push_back(record_json(history_quantities(), entry));
    list.back()["factors"] = factors_json(entry);
    list.back()["obstacles"] = records_json(obstacle_quantities(), entry.summary.obstacles);
    list.back()["probes"] = probes_json(entry.probes, result);
    list.back()["estimates"] = records_json(goal_record_quantities(), entry.level.goals);
  }
  return list;
}

namespace {

/// A point of a mesh in space has no parameters: its place in space says where it is.
void clear_parameters(Json& json) {
  for (auto& [key, value] : json.items())
    if ((key == "x" || key == "at") && value.is_array() && value.size() == 2)
      value = Json::array({nullptr, nullptr});
    else if (value.is_structured())
      clear_parameters(value);
}

}  // namespace

Json results_json(const computation::Result& result, const Provenance& provenance) {
  Json json{{"title", provenance.title}};
  json.update(record_json(result_quantities(), result));
  json["warnings"] = result.warnings;
  json["linearity"]["quantities"] = records_json(
      model_quantities(), result.model ? result.model->quantities : std::vector<computation::ModelQuantity>{});
  json["modes"] = records_json(mode_quantities(), result.modes);
  json["singular_places"] = records_json(singular_place_quantities(), result.singular_places);
  json["layers"] = records_json(layer_quantities(), result.layers);
  json["supports"] = records_json(support_quantities(), result.summary.support_reactions);
  json["corner_supports"] = records_json(corner_support_quantities(), result.summary.corner_reactions);
  json["point_supports"] = records_json(point_support_quantities(), result.summary.point_reactions);
  json["rigid_bodies"] = records_json(rigid_body_quantities(), result.summary.body_reactions);
  for (const bool are_springs : {false, true}) {
    std::vector<solution::FoundationReaction> alike;
    std::ranges::copy_if(result.summary.foundations, std::back_inserter(alike),
                         [&](const auto& one) { return one.is_spring == are_springs; });
    json[are_springs ? "springs" : "foundations"] = records_json(foundation_quantities(), alike);
  }
  json["contact"] = contact_json(result);
  json["obstacles"] = Json::array();
  for (const auto& contact : result.summary.obstacles) json["obstacles"].push_back(obstacle_json(contact));
  json["probes"] = probes_json(result.probes, result);
  json["history"] = history_json(result);
  json["envelopes"] = envelopes_json(json["history"], provenance.settings.is_object()
                                                          ? provenance.settings.value("envelope", Json::array())
                                                          : Json::array());
  json["estimates"] = estimates_json(result);
  json["certificate"] = record_json(certificate_quantities(), result.certificate);
  json["certificate_limits"] = limits_json(result);
  json["levels"] = Json::array();
  for (const computation::Level& level : result.levels) json["levels"].push_back(level_json(level));
  if (result.summary.is_in_space) clear_parameters(json);
  json["settings"] = provenance.settings;
  json["versions"] = versions_json();
  json["files"] = provenance.files;
  json["verification"] = verification_json(provenance);
  json["fields"] = fields_json(result, provenance.heights);
  json["units"] = units_json();
  if (provenance.units.are_named()) {
    rename_units(json, provenance.units);
    json["title"] = provenance.title;
    if (result.summary.is_in_space) clear_parameters(json);
    json["settings"] = provenance.settings;
  }
  json["unit_names"] = {{"length", provenance.units.length}, {"force", provenance.units.force}};
  return json;
}

void add_results(const computation::Result& result, const Provenance& provenance,
                 const std::filesystem::path& directory, AtomicFiles& files) {
  // A title with invalid UTF-8 must not cause the loss of the results.
  files.add_text(directory / results_name, [&] {
    return results_json(result, provenance).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  });
}

}  // namespace plastron::io
