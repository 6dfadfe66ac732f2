#include <plastron/computation/evaluation.hpp>
#include <plastron/io/csv_tables.hpp>
#include <plastron/io/fields.hpp>
#include <plastron/io/flat_row.hpp>
#include <plastron/io/results.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::io {

namespace {

std::string line_header(const std::vector<Field>& present, const problem::UnitNames& units) {
  std::string header = fmt::format("s [{}]", units.length);
  for (const Field& field : present)
    for (int c = 0; c < field.components; ++c) {
      const std::string name = field.is_vector() ? fmt::format("{} {}", field.arrays[0], "XYZ"[c])
                                                 : std::string(field.arrays[static_cast<std::size_t>(c)]);
      header += field.unit == "1" || field.unit == "the chart's"
                    ? "," + name
                    : fmt::format(",{} [{}]", name, units.label(field.unit));
    }
  return header + "\n";
}

std::string number_text(double value) { return std::isfinite(value) ? fmt::format("{:.15g}", value) : ""; }

}  // namespace

std::string line_csv(const std::vector<recovery::PointValues>& points, const Ingredients& ingredients,
                     const problem::Output& given) {
  std::size_t layers = 0;
  for (const recovery::PointValues& p : points)
    if (p.laminate) layers = std::max(layers, p.laminate->layer_count());
  const std::vector<Field> present = fields_of(ingredients, given.heights, static_cast<int>(layers));
  std::string text = line_header(present, given.units);
  double length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) length += (points[i].phi - points[i - 1].phi).norm();
    text += number_text(length);
    for (const Field& field : present) {
      const auto values = field.take(points[i]);
      for (int c = 0; c < field.components; ++c) text += "," + number_text(values[static_cast<std::size_t>(c)]);
    }
    text += "\n";
  }
  return text;
}

std::vector<LineTable> line_tables(const computation::Solution& solution, const std::vector<problem::Line>& lines,
                                   const problem::Output& given) {
  const int rank = algebra::rank_in(solution.discrete->space().layout->comm);
  const Ingredients ingredients = ingredients_of(*solution.discrete);
  std::vector<LineTable> tables;
  for (const problem::Line& line : lines) {
    const auto points = computation::values_at(solution, line.points, fmt::format("the line \"{}\"", line.name));
    tables.push_back({line.name, rank == 0 ? line_csv(points, ingredients, given) : std::string()});
  }
  return tables;
}

namespace {

std::string line(const Row& row, std::string Row::value_type::*what) {
  std::string text;
  for (const auto& cell : row) text += (text.empty() ? "" : ",") + csv_cell(cell.*what);
  return text + "\n";
}

}  // namespace

std::string history_csv(const computation::Result& result) {
  std::string text;
  for (const Json& entry : history_json(result)) {
    const Row row = flat_row(entry);
    if (text.empty()) text = line(row, &Row::value_type::first);
    text += line(row, &Row::value_type::second);
  }
  return text;
}

}  // namespace plastron::io
