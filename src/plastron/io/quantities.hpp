// The table of every number in results.json that belongs to no point: its path, unit, meaning and where it comes from.
#pragma once
#include <plastron/computation/result.hpp>

#include <nlohmann/json.hpp>

#include <span>
#include <string_view>

namespace plastron::io {

using Json = nlohmann::ordered_json;

/// What stands in the place of a quantity. Numbers that are not finite are null.
enum class Form { number, integer, text, flag, pair, triple };

/// A number or text of a record.
template <class Record>
struct Quantity {
  std::string_view path;  ///< inside the record, steps separated by '/'
  std::string_view unit;
  std::string_view meaning;
  Json (*take)(const Record&);
  Form form = Form::number;
};

/// JSON has no infinity and no NaN: null.
Json number(double value);

std::span<const Quantity<computation::Result>> result_quantities();
/// Paths inside "singular_places[]".
std::span<const Quantity<certificate::SingularPlace>> singular_place_quantities();
/// Paths inside "supports[]".
std::span<const Quantity<certificate::SupportReaction>> support_quantities();
/// Paths inside "corner_supports[]".
std::span<const Quantity<certificate::CornerReaction>> corner_support_quantities();
/// Paths inside "point_supports[]".
std::span<const Quantity<certificate::PointReaction>> point_support_quantities();
/// Paths inside "rigid_bodies[]".
std::span<const Quantity<certificate::BodyReaction>> rigid_body_quantities();
/// Null as a whole where there is no obstacle; paths inside "contact".
std::span<const Quantity<computation::Result>> contact_quantities();
/// Null as a whole where the case wants no admissible solution; paths inside "contact.admissible".
std::span<const Quantity<computation::Result>> admissible_quantities();
/// Null as a whole where errors were not estimated; paths inside "estimates".
std::span<const Quantity<computation::Result>> estimate_quantities();
/// Paths inside "estimates.goals[]".
std::span<const Quantity<estimation::GoalEstimate>> goal_quantities();
/// Paths inside "obstacles[]".
std::span<const Quantity<certificate::ObstacleContact>> obstacle_quantities();
/// Paths inside "history[]".
std::span<const Quantity<computation::HistoryEntry>> history_quantities();
/// Paths inside "obstacles[]/zones[]".
std::span<const Quantity<certificate::ContactZone>> zone_quantities();
/// Paths inside "certificate".
std::span<const Quantity<certificate::Certificate>> certificate_quantities();
/// Paths inside "levels[]".
std::span<const Quantity<computation::Level>> level_quantities();
/// Paths inside "levels[]/history[]".
std::span<const Quantity<contact::Iteration>> iteration_quantities();

/// The record as the table says.
template <class Record>
Json record_json(std::span<const Quantity<Record>> quantities, const Record& record) {
  Json json = Json::object();
  for (const auto& quantity : quantities)
    json[Json::json_pointer("/" + std::string(quantity.path))] = quantity.take(record);
  return json;
}

}  // namespace plastron::io
