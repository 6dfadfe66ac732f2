#include <plastron/domain/facet_mesh.hpp>

#include <plastron/facets/cells.hpp>
#include <plastron/facets/untangle.hpp>
#include <plastron/geometry/file_error.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace plastron::domain {

namespace {

using facets::Facets;

constexpr double default_smooth_angle = std::numbers::pi / 6;  // as of cells of order 1
/// The folds are named. Cells that are larger than the radius of a smooth face meet at large angles all the same.
constexpr double any_smooth_angle = 170 * std::numbers::pi / 180;

/// Sum of the lengths of all sides, those between two triangles counted twice [m].
double length_of_sides(const geometry::TriangleMesh& mesh) {
  double length = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      length += (mesh.points[to] - mesh.points[from]).norm();
  return length;
}

/// Length of all folds, seams and borders [m].
double length_of_curves(const Facets& facets) {
  double length = 0;
  for (const facets::FacetCurve& curve : facets.curves)
    for (const auto& [from, to] : curve.sides) length += (facets.mesh.points[to] - facets.mesh.points[from]).norm();
  return length;
}

/// Sides of about 2000 quadrilaterals, but not longer than a tenth of the diagonal nor shorter than the facets are wide:
/// smaller cells would make a polygon of the part [m]. Needles, like those to a point far outside of the part, do not
/// become millions of cells: the curves have at most 5000 cells, the sides of all facets a million.
double default_size(const Facets& facets) {
  const geometry::TriangleMesh& mesh = facets.mesh;
  constexpr double cells = 2000, parts = 10, along_curves = 5e3, along_sides = 1e6;
  Vector3d low = mesh.points.front(), high = low;
  for (const Vector3d& p : mesh.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double least = std::max(length_of_curves(facets) / along_curves, length_of_sides(mesh) / along_sides);
  return std::min(std::max({std::sqrt(facets::area_of(mesh) / cells), least, facets.width}),
                  (high - low).norm() / parts);
}

/// Throws DomainError if corners at open sides are so near to each other that the gap between them is hardly meant: within a
/// hundredth of the shortest open side. After the remeshing a gap looks wider.
void check_gaps(const std::string& path, const geometry::TriangleMesh& mesh) {
  constexpr double part_of_side = 1e-2;
  const auto sides = geometry::sorted_sides(mesh);
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].is_same(sides[i])) ++end;
    if (end - i == 1) shortest = std::min(shortest, (mesh.points[sides[i].high] - mesh.points[sides[i].low]).norm());
  }
  if (!std::isfinite(shortest)) return;
  geometry::TriangleMesh joined = mesh;
  joined.joined = 0, joined.joined_over = 0;
  join_near_points(joined, part_of_side * shortest);
  if (joined.joined > 0)
    throw mesh::DomainError(
        fmt::format("{}: {} corners at open sides of the facets lie beside others, up to {:.2g} m away, and are not "
                    "joined with them; "
                    "set tolerance = {:.2g} to join them, or slits = true if the gaps are meant",
                    path, joined.joined, joined.joined_over, 1.1 * joined.joined_over));
}

Facets read_facets(const std::string& path, const SpaceReading& reading) {
  geometry::TriangleMesh mesh = geometry::read_triangle_mesh(path);
  for (Vector3d& p : mesh.points) p *= reading.scale;
  mesh.joined_over *= reading.scale;
  if (reading.tolerance) join_near_points(mesh, *reading.tolerance);
  if (!reading.has_slits) check_gaps(path, mesh);
  constexpr std::size_t longest = 127;  // as in .msh files
  for (std::string& name : mesh.groups)
    if (name.size() > longest || !is_printable(name)) name.clear();
  return facets::find_facets(std::move(mesh), reading.smooth_angle.value_or(default_smooth_angle), path);
}

void check_size(const std::string& path, const geometry::TriangleMesh& mesh, double size) {
  constexpr double most_cells = 5e5, most_sides = 1e7;
  const double area = facets::area_of(mesh), length = length_of_sides(mesh);
  if (area <= most_cells * size * size && length <= most_sides * size) return;
  throw mesh::DomainError(fmt::format(
      "{}: with sides of {:.3g} m (size) its {:.4g} m^2 become about {:.2g} cells; at most {:.2g} are allowed; "
      "take size = {:.2g} or more, the cells are refined later",
      path, size, area, std::max(area / (size * size), length / size), most_cells,
      1.1 * std::max(std::sqrt(area / most_cells), length / most_sides)));
}

/// Adds elements of Gmsh's type, each with the group of its face or curve.
template <class Elements, class Nodes, class Group>
void add_elements(int type, const Elements& elements, const Nodes& nodes_of, const Group& group_of, MeshData& data) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    data.elements.push_back({.tag = static_cast<std::int64_t>(data.elements.size()) + 1,
                             .type = type,
                             .first_node = data.element_nodes.size(),
                             .groups = group_set(data, {group_of(i) + 1})});
    for (const int node : nodes_of(elements[i])) data.element_nodes.push_back(node + 1);
  }
}

MeshData data_of(const std::vector<Vector3d>& points, const std::vector<facets::Remeshed::Line>& lines,
                 const Facets& facets) {
  MeshData data;
  for (std::size_t i = 0; i < points.size(); ++i) data.nodes.push_back({static_cast<std::int64_t>(i) + 1, points[i]});
  add_elements(
      1, lines, [](const auto& line) { return line.ends; }, [&](std::size_t i) { return lines[i].curve; }, data);
  for (std::size_t f = 0; f < facets.faces.size(); ++f) data.names[{2, static_cast<int>(f) + 1}] = facets.faces[f];
  for (std::size_t c = 0; c < facets.curves.size(); ++c)
    data.names[{1, static_cast<int>(c) + 1}] = facets.curves[c].name;
  return data;
}

MeshData meshed(const Facets& facets, std::optional<double> size, mesh::Shape shape, const std::string& path) {
  const auto itself = [](const auto& element) { return element; };
  if (shape == mesh::Shape::triangle) {
    facets::Remeshed mesh = size ? facets::remesh(facets, *size, path) : facets::as_they_are(facets);
    if (size) facets::untangle(mesh);
    MeshData data = data_of(mesh.points, mesh.lines, facets);
    add_elements(
        2, mesh.triangles, itself, [&](std::size_t i) { return mesh.face_of[i]; }, data);
    return data;
  }
  const facets::Cells cells = facets::quadrilaterals(facets, size, path);
  MeshData data = data_of(cells.points, cells.lines, facets);
  add_elements(
      3, cells.quadrilaterals, itself, [&](std::size_t i) { return cells.face_of[i]; }, data);
  return data;
}

/// The folds that cells have as sides, and those that the case names. A fold that is shorter than a cell may have none.
std::vector<std::string> folds_of(const MeshData& data, const Facets& facets, std::vector<std::string> folds) {
  std::vector<bool> has_cells(facets.curves.size(), false);
  for (const MeshElement& element : data.elements)
    if (!element_type(element.type)->is_cell())
      has_cells[static_cast<std::size_t>(data.group_sets[element.groups].front()) - 1] = true;
  for (std::size_t c = 0; c < has_cells.size(); ++c)
    if (has_cells[c] && facets.curves[c].kind == facets::CurveKind::fold) folds.push_back(facets.curves[c].name);
  return folds;
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

std::vector<std::string> notes_of(const Facets& facets, std::optional<double> size, mesh::Shape shape) {
  const char* error =
      facets.width > 0
          ? "the result has the error of the facets, which no refinement removes: for more accuracy export "
            "STEP from the CAD program, mesh it by Gmsh with Mesh.ElementOrder = 2 and give the .msh file"
          : "all surfaces are plane, so the facets have no error";
  const char* cells = shape == mesh::Shape::triangle ? "triangles" : "quadrilaterals";
  std::vector<std::string> notes{
      fmt::format("{} facets of {:.6g} m^2 were {}; {}", facets.mesh.triangles.size(), facets::area_of(facets.mesh),
                  size ? fmt::format("remeshed with {} with sides of about {:.3g} m (size)", cells, *size)
                       : fmt::format("divided into {}", cells),
                  error)};
  std::vector<std::string> angles;
  if (facets.width > 0)
    angles.push_back(
        fmt::format("facets of one smooth surface meet at up to {:.3g} degrees and are about {:.3g} m wide",
                    degrees(facets.largest_smooth), facets.width));
  if (facets.least_fold > 0)
    angles.push_back(fmt::format("folds have {:.3g} degrees or more", degrees(facets.least_fold)));
  if (!angles.empty()) notes.push_back(fmt::format("{}", fmt::join(angles, "; ")));
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) notes.push_back(fmt::format("{} {}", count, what));
  };
  if (facets.mesh.joined > 0)
    notes.push_back(fmt::format("{} points at open sides were joined with others, up to {:.2g} m away",
                                facets.mesh.joined, facets.mesh.joined_over));
  add(facets.repeated, "triangles occurred twice and were taken once");
  add(facets.flat, "triangles had no area and were given to their neighbours");
  add(facets.turned, "triangles were turned the other way round than their neighbours");
  return notes;
}

std::vector<std::string> warnings_of(const Facets& facets, double size) {
  constexpr double coarse = 6 * std::numbers::pi / 180, finer = 0.7, near = 2;
  std::vector<std::string> warnings;
  const double limit = facets.smooth_angle;
  const auto doubt = [&](double angle, const char* meaning) {
    warnings.push_back(
        fmt::format("facets that meet at {:.3g} degrees count as {}, and the limit of {:.3g} degrees is near; set "
                    "smooth, if that is "
                    "not meant",
                    degrees(angle), meaning, degrees(limit)));
  };
  if (facets.largest_smooth > limit / near) doubt(facets.largest_smooth, "smooth");
  if (facets.least_fold > 0 && facets.least_fold < limit * near) doubt(facets.least_fold, "a fold");
  if (facets.mean_smooth > coarse)
    warnings.push_back(fmt::format(
        "the facets are coarse: they meet at {:.2g} degrees on the mean; a thin shell needs 2 degrees or less; "
        "export with a smaller angle tolerance",
        degrees(facets.mean_smooth)));
  if (size < finer * facets.width)
    warnings.push_back(fmt::format(
        "the cells are smaller (size {:.3g} m) than the facets are wide (about {:.3g} m across their angles): "
        "the result is that of a part with flat sides; export finer facets, or take size = {:.2g}",
        size, facets.width, facets.width));
  return warnings;
}

}  // namespace

FacetMesh mesh_facets(const std::string& path, const SpaceReading& reading, mesh::Shape shape, double part) {
  try {
    const Facets facets = read_facets(path, reading);
    std::optional<double> size = reading.size;
    if (!size && part > 0) size = part * default_size(facets);
    if (size) check_size(path, facets.mesh, *size);
    FacetMesh mesh{.data = meshed(facets, size, shape, path), .reading = reading};
    mesh.data.source = path;
    mesh.data.notes = notes_of(facets, size, shape);
    mesh.data.warnings = warnings_of(facets, size.value_or(facets.width));
    number_nodes(mesh.data);
    mesh.reading.scale = 1;
    mesh.reading.tolerance.reset();
    mesh.reading.smooth_angle = any_smooth_angle;
    mesh.reading.folds = folds_of(mesh.data, facets, reading.folds);
    return mesh;
  } catch (const geometry::FileError& error) {
    throw mesh::DomainError(error.what());
  }
}

}  // namespace plastron::domain
