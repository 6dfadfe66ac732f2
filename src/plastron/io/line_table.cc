#include <plastron/io/line_table.hpp>

#include <plastron/computation/probes.hpp>
#include <plastron/io/fields.hpp>

#include <fmt/format.h>

#include <cmath>

namespace plastron::io {

namespace {

std::string line_header(const std::vector<Field>& present) {
  std::string header = "s [m]";
  for (const Field& field : present)
    for (int c = 0; c < field.components; ++c) {
      const std::string name = field.is_vector() ? fmt::format("{} {}", field.arrays[0], "XYZ"[c])
                                                 : std::string(field.arrays[static_cast<std::size_t>(c)]);
      header +=
          field.unit == "1" || field.unit == "the chart's" ? "," + name : fmt::format(",{} [{}]", name, field.unit);
    }
  return header + "\n";
}

std::string number_text(double value) { return std::isfinite(value) ? fmt::format("{:.15g}", value) : ""; }

}  // namespace

std::string line_csv(const std::vector<recovery::PointValues>& points, bool has_obstacle, bool has_multiplier,
                     std::span<const double> heights) {
  const std::vector<Field> present = fields_of(has_obstacle, has_multiplier, heights);
  std::string text = line_header(present);
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

std::vector<std::string> add_lines(const computation::Solution& solution, const std::vector<computation::Line>& lines,
                                   std::span<const double> heights, const std::filesystem::path& directory,
                                   AtomicFiles& files) {
  int rank = 0;
  MPI_Comm_rank(files.comm(), &rank);
  const bool has_obstacle = !solution.discrete->obstacles.empty();
  const bool has_multiplier = solution.discrete->tangency.formulation == element::Formulation::mixed;
  std::vector<std::string> names;
  for (const computation::Line& line : lines) {
    const auto points = computation::values_at(solution, line.points, fmt::format("the line \"{}\"", line.name));
    names.push_back(fmt::format("line-{}.csv", line.name));
    files.add(directory / names.back(),
              [&] { return rank == 0 ? line_csv(points, has_obstacle, has_multiplier, heights) : std::string(); });
  }
  return names;
}

}  // namespace plastron::io
