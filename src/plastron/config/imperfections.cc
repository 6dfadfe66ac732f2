// Reads [[imperfection]].
#include <plastron/config/sections.hpp>

namespace plastron::config {

namespace {

using geometry::ChartDisplacement;

/// Calls `make`, which throws for an expression without two derivatives. Returns whether it was right.
template <class Make>
bool differentiating(const Table& table, const std::string& key, const Make& make) {
  try {
    make();
    return true;
  } catch (const geometry::NotDifferentiable& error) {
    report_not_differentiable(table.reading(), {*table.value(key), key}, error);
  } catch (const geometry::ExpressionError& error) {
    table.report(key, error.what());
  }
  return false;
}

/// Adds an imperfection to the charts. `all`: those so far.
void displace_charts(const Table& table, const std::string& key, const ChartDisplacement& displacement,
                     std::vector<ChartDisplacement>& all, problem::Problem& problem) {
  all.push_back(displacement);
  const bool is_right = differentiating(table, key, [&] {
    std::map<std::string, geometry::Chart> charts;
    for (const auto& [region, chart] : problem.charts)
      charts.emplace(region, geometry::Chart(chart.components(), table.reading().constants, all));
    problem.charts = std::move(charts);
  });
  if (!is_right) all.pop_back();
}

void read_mode(Table& table, problem::Problem& problem) {
  const auto path = read_path(table, "mode", "file of a mode", "name a file that `plastron modes` writes (.mode)");
  const auto amplitude = table.number("amplitude");
  if (path && amplitude) problem.imperfections.push_back({.mode_file = *path, .amplitude = *amplitude});
}

void read_expression(Table& table, const std::string& key, std::vector<ChartDisplacement>& displacements,
                     problem::Problem& problem) {
  const geometry::Constants& constants = table.reading().constants;
  const bool is_in_space = table.reading().has_mesh_in_space();
  const auto space_function = [&](const geometry::Expression& f) {
    return std::make_shared<const geometry::SpaceFunction>(f.text(), constants);
  };
  if (key == "normal") {
    const auto normal = table.field("normal");
    if (!normal) return;
    if (is_in_space)
      differentiating(table, key, [&] { problem.imperfections.push_back({.normal = space_function(*normal)}); });
    else
      displace_charts(table, key, {.normal = normal->text()}, displacements, problem);
    return;
  }
  const auto displacement = table.field_vector("displacement");
  if (!displacement) return;
  const energy::VectorExpression& d = *displacement;
  if (is_in_space)
    differentiating(table, key, [&] {
      problem.imperfections.push_back(
          {.displacement = {space_function(d[0]), space_function(d[1]), space_function(d[2])}});
    });
  else
    displace_charts(table, key, {.cartesian = {d[0].text(), d[1].text(), d[2].text()}}, displacements, problem);
}

}  // namespace

std::vector<Section> imperfection_sections() {
  return {{"imperfection",
           "[[imperfection]]",
           "A difference of the mid-surface from its ideal shape. The shell is free of stress in the imperfect shape. "
           "Several imperfections add up.",
           {key("normal", Kind::field, {.unit = "m", .example = "\"1e-4*cos(4*x)\""},
                "displacement along the normal a3: an expression of x and y (of X, Y, Z on a mesh in space) with two "
                "derivatives"),
            key("displacement", Kind::field_vector, {.unit = "m"}, "displacement in X, Y, Z: three such expressions"),
            key("mode", Kind::text, {.example = "\"modes/buckling_1.mode\""},
                "file with the shape of a mode, which `plastron modes` writes. Domain and chart must be those of the "
                "computation that found the mode; the mesh may be another one. A mesh in space must be the same file"),
            key("amplitude", Kind::number, {.unit = "m"},
                "largest displacement by the mode. Its sign decides to which side the shell is displaced")},
           {"normal", "displacement", "mode"},
           "",
           {{"mode", "amplitude"}, {"amplitude", "mode"}}}};
}

void read_imperfections(Table& root, problem::Problem& problem) {
  std::vector<ChartDisplacement> displacements;
  root.in_tables("imperfection", [&](Table& table) {
    const auto given = table.shape("normal = \"1e-4*cos(4*x)\"", "write two sections [[imperfection]]");
    if (!given) return;
    if (*given == "mode") {
      table.require("amplitude");
      read_mode(table, problem);
      return;
    }
    if (table.has("amplitude"))
      table.report_key("amplitude", "amplitude belongs to mode", "", "multiply the expression by the number");
    read_expression(table, *given, displacements, problem);
  });
}

}  // namespace plastron::config
