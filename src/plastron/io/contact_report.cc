#include <plastron/io/contact_report.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace plastron::io {

namespace {

constexpr int poly_line = 4;  // VTK_POLY_LINE
constexpr std::array file_names{"contact-boundary.csv", "contact-boundary.vtu", "contact-forces.csv"};

/// Calls visit(obstacle, zone, line number, line) for every line.
template <class Visit>
void for_lines(const solution::Summary& summary, Visit&& visit) {
  for (std::size_t o = 0; o < summary.obstacles.size(); ++o) {
    const auto& zones = summary.obstacles[o].zones;
    for (std::size_t z = 0; z < zones.size(); ++z)
      for (std::size_t l = 0; l < zones[z].lines.size(); ++l) visit(o, z, l, zones[z].lines[l]);
  }
}

/// Returns an array of a .vtu file from a function that gives the numbers of each point, or of each line, as text.
template <class Text>
std::string data_array(const solution::Summary& summary, std::string_view attributes, bool by_point, Text&& text) {
  std::string all = fmt::format("        <DataArray {} format=\"ascii\">\n", attributes);
  for_lines(summary, [&](std::size_t o, std::size_t z, std::size_t l, const solution::ContactLine& line) {
    const std::size_t count = by_point ? line.points.size() : 1;
    for (std::size_t i = 0; i < count; ++i) all += text(o, z, l, line, i) + "\n";
  });
  return all + "        </DataArray>\n";
}

std::string triple_text(const Eigen::Vector3d& v) { return fmt::format("{:.9g} {:.9g} {:.9g}", v[0], v[1], v[2]); }

std::string point_arrays(const solution::Summary& summary) {
  using solution::ContactLine;
  const auto points = [&](std::string_view attributes, auto&& text) {
    return data_array(summary, attributes, true,
                      [&](auto, auto, auto, const ContactLine& line, std::size_t i) { return text(line.points[i]); });
  };
  using Point = solution::BoundaryPoint;
  return "      <Points>\n" +
         points(R"(type="Float64" NumberOfComponents="3")",
                [](const Point& p) { return triple_text(p.place + p.displacement); }) +
         "      </Points>\n      <PointData>\n" +
         points(R"(type="Float64" Name="reference position" NumberOfComponents="3")",
                [](const Point& p) { return triple_text(p.place); }) +
         points(R"(type="Float64" Name="displacement" NumberOfComponents="3")",
                [](const Point& p) { return triple_text(p.displacement); }) +
         points(R"(type="Float64" Name="x")", [](const Point& p) { return fmt::format("{:.9g}", p.x[0]); }) +
         points(R"(type="Float64" Name="y")", [](const Point& p) { return fmt::format("{:.9g}", p.x[1]); }) +
         "      </PointData>\n";
}

std::string line_arrays(const solution::Summary& summary) {
  using solution::ContactLine;
  const auto lines = [&](std::string_view attributes, auto&& text) {
    return data_array(summary, attributes, false,
                      [&](std::size_t o, std::size_t z, std::size_t l, const ContactLine& line, std::size_t) {
                        return fmt::format("{}", text(o, z, l, line));
                      });
  };
  std::size_t end = 0, next = 0;
  return "      <Cells>\n" +
         data_array(summary, R"(type="Int64" Name="connectivity")", true,
                    [&](auto, auto, auto, const ContactLine&, auto) { return fmt::format("{}", next++); }) +
         lines(R"(type="Int64" Name="offsets")",
               [&](auto, auto, auto, const ContactLine& line) { return end += line.points.size(); }) +
         lines(R"(type="UInt8" Name="types")", [](auto, auto, auto, const ContactLine&) { return poly_line; }) +
         "      </Cells>\n      <CellData>\n" +
         lines(R"(type="Int64" Name="obstacle")", [](std::size_t o, auto, auto, const ContactLine&) { return o; }) +
         lines(R"(type="Int64" Name="zone")", [](auto, std::size_t z, auto, const ContactLine&) { return z; }) +
         lines(R"(type="Int64" Name="line")", [](auto, auto, std::size_t l, const ContactLine&) { return l; }) +
         lines(R"(type="UInt8" Name="rim")",
               [](auto, auto, auto, const ContactLine& line) { return int{line.is_rim}; }) +
         "      </CellData>\n";
}

}  // namespace

std::string contact_boundary_csv(const solution::Summary& summary) {
  std::string text = "obstacle,zone,line,x,y,X,Y,Z,rim\n";
  for_lines(summary, [&](std::size_t o, std::size_t z, std::size_t l, const solution::ContactLine& line) {
    for (const solution::BoundaryPoint& p : line.points)
      text += fmt::format("{},{},{},{:.15g},{:.15g},{:.15g},{:.15g},{:.15g},{}\n", o, z, l, p.x[0], p.x[1], p.place[0],
                          p.place[1], p.place[2], int{line.is_rim});
  });
  return text;
}

std::string contact_boundary_vtu(const solution::Summary& summary) {
  std::size_t points = 0, lines = 0;
  for_lines(summary, [&](auto, auto, auto, const solution::ContactLine& line) {
    points += line.points.size();
    ++lines;
  });
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">\n  <UnstructuredGrid>\n"
      "    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n{}{}    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n",
      points, lines, point_arrays(summary), line_arrays(summary));
}

std::string contact_forces_csv(const std::vector<solution::ContactForce>& forces, bool has_parameters) {
  std::string text = "obstacle,x,y,X,Y,Z,u_X,u_Y,u_Z,F_X,F_Y,F_Z,eta,area\n";
  for (const solution::ContactForce& f : forces) {
    text += has_parameters ? fmt::format("{},{:.15g},{:.15g}", f.obstacle, f.x[0], f.x[1])
                           : fmt::format("{},,", f.obstacle);
    for (const Eigen::Vector3d& v : {f.place, f.displacement, f.force})
      text += fmt::format(",{:.15g},{:.15g},{:.15g}", v[0], v[1], v[2]);
    text += fmt::format(",{:.15g},{:.15g}\n", f.pressure, f.area);
  }
  return text;
}

std::vector<std::string> add_contact_report(const solution::Summary& summary, const computation::Solution& solution,
                                            const std::filesystem::path& directory, AtomicFiles& files) {
  if (std::ranges::all_of(summary.obstacles, [](const auto& o) { return o.zones.empty(); })) return {};
  files.add_text(directory / file_names[0], [&] { return contact_boundary_csv(summary); });
  files.add_text(directory / file_names[1], [&] { return contact_boundary_vtu(summary); });
  const auto forces = solution::contact_forces(*solution.discrete, solution.nodal);
  files.add_text(directory / file_names[2], [&] { return contact_forces_csv(forces, !summary.is_in_space); });
  return {file_names.begin(), file_names.end()};
}

void remove_contact_report(const std::filesystem::path& directory, MPI_Comm comm) {
  for (const char* name : file_names) remove_file(directory / name, comm);
}

}  // namespace plastron::io
