// The table of all numbers in results.json that do not belong to a point: paths, units, meanings and sources.
#pragma once
#include <plastron/computation/result.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

namespace plastron::io {

using Json = nlohmann::ordered_json;

/// Form of a quantity's value. Numbers that are not finite are null.
enum class Form { number, integer, text, flag, pair, triple };

/// Returns null for infinity and NaN, which JSON does not have. A zero gets no sign: two runs of a case may have different ones.
Json number(double value);
Json triple(const Eigen::Vector3d& v);
Json pair(const Eigen::Vector2d& v);

/// A number or text of a record.
template <class Record>
struct Quantity {
  std::string_view path;  ///< inside the record, steps separated by '/'
  std::string_view unit;
  std::string_view meaning;
  Json (*take)(const Record&);
  Form form;

  /// `value` has no captures and returns a value of the record, whose type gives the form; an optional without value is null.
  template <class Value>
  Quantity(std::string_view inside, std::string_view of_value, std::string_view in_words, Value)
      : path(inside),
        unit(of_value),
        meaning(in_words),
        take([](const Record& record) { return json_of(Value{}(record)); }),
        form(form_of(std::invoke_result_t<Value, const Record&>{})) {}

 private:
  static Json json_of(double value) { return number(value); }
  static Json json_of(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }
  static Json json_of(const Eigen::Vector2d& value) { return pair(value); }
  static Json json_of(const Eigen::Vector3d& value) { return triple(value); }
  template <class Other>
  static Json json_of(const Other& value) {
    return Json(value);
  }
  template <class Type>
  static constexpr Form form_of(const Type&) {
    if constexpr (std::is_same_v<Type, Eigen::Vector2d>) return Form::pair;
    if constexpr (std::is_same_v<Type, Eigen::Vector3d> || std::is_same_v<Type, std::array<double, 3>>)
      return Form::triple;
    if constexpr (std::is_same_v<Type, bool>) return Form::flag;
    if constexpr (std::is_integral_v<Type>) return Form::integer;
    if constexpr (std::is_same_v<Type, double> || std::is_same_v<Type, std::optional<double>>) return Form::number;
    return Form::text;
  }
};

std::span<const Quantity<computation::Result>> result_quantities();
/// Paths inside "linearity.quantities[]".
std::span<const Quantity<computation::ModelQuantity>> model_quantities();
/// Paths inside "modes[]".
std::span<const Quantity<computation::Mode>> mode_quantities();
/// Returns the description of its field in solution.vtu: key, arrays, symbol, unit, meaning.
Json field_json(const computation::Mode& mode);
/// Paths inside "singular_places[]".
std::span<const Quantity<recovery::SingularPlace>> singular_place_quantities();
/// Paths inside "layers[]".
std::span<const Quantity<recovery::LayerStress>> layer_quantities();
/// Paths inside "supports[]".
std::span<const Quantity<solution::SupportReaction>> support_quantities();
/// Paths inside "corner_supports[]".
std::span<const Quantity<solution::CornerReaction>> corner_support_quantities();
/// Paths inside "point_supports[]".
std::span<const Quantity<solution::PointReaction>> point_support_quantities();
/// Paths inside "rigid_bodies[]".
std::span<const Quantity<solution::BodyReaction>> rigid_body_quantities();
/// Paths inside "foundations[]" and "springs[]".
std::span<const Quantity<solution::FoundationReaction>> foundation_quantities();
/// Paths inside "contact". Null as a whole without obstacle.
std::span<const Quantity<computation::Result>> contact_quantities();
/// Paths inside "contact.admissible". Null as a whole if the case requests no admissible solution.
std::span<const Quantity<computation::Result>> admissible_quantities();
/// Paths inside "estimates". Null as a whole if errors were not estimated.
std::span<const Quantity<computation::Result>> estimate_quantities();
/// Paths inside "estimates.goals[]".
std::span<const Quantity<estimation::GoalEstimate>> goal_quantities();
/// Paths inside "geometry".
std::span<const Quantity<estimation::GeometryDeviation>> geometry_quantities();
/// Paths inside "obstacles[]".
std::span<const Quantity<solution::ObstacleContact>> obstacle_quantities();
/// Paths inside "history[]".
std::span<const Quantity<computation::HistoryEntry>> history_quantities();
/// Paths inside "history[]/estimates[]".
std::span<const Quantity<estimation::GoalRecord>> goal_record_quantities();
/// Paths inside "obstacles[]/zones[]".
std::span<const Quantity<solution::ContactZone>> zone_quantities();
/// Paths inside "certificate".
std::span<const Quantity<certificate::Certificate>> certificate_quantities();
/// Paths inside "levels[]".
std::span<const Quantity<computation::Level>> level_quantities();
/// Paths inside "levels[]/history[]".
std::span<const Quantity<contact::Iteration>> iteration_quantities();

/// Returns the record in the form of the table.
template <class Record>
Json record_json(std::span<const Quantity<Record>> quantities, const Record& record) {
  Json json = Json::object();
  for (const auto& quantity : quantities)
    json[Json::json_pointer("/" + std::string(quantity.path))] = quantity.take(record);
  return json;
}

}  // namespace plastron::io
