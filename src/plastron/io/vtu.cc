#include <plastron/io/vtu.hpp>

#include <plastron/io/fields.hpp>
#include <plastron/io/vtu_piece.hpp>

#include <fmt/format.h>

namespace plastron::io {

namespace {

/// Returns equidistant points of a Lagrange cell of degree k in VTK's order: corners, inner points of each side, points
/// inside.
std::vector<Eigen::Vector2d> cell_points(mesh::Shape shape, int degree) {
  std::vector<Eigen::Vector2d> points;
  if (shape == mesh::Shape::triangle) {
    for (int k = 0; k < 3; ++k) points.push_back(mesh::corner(shape, k));
    for (int side = 0; degree == 2 && side < 3; ++side) points.push_back(mesh::side_point(shape, side, 0.5));
    return points;
  }
  points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& [from, to] : {std::pair{0, 1}, {1, 2}, {3, 2}, {0, 3}})
    for (int i = 1; i < degree; ++i) {
      const double t = static_cast<double>(i) / degree;
      points.emplace_back((1 - t) * points[static_cast<std::size_t>(from)] + t * points[static_cast<std::size_t>(to)]);
    }
  for (const Eigen::Vector2d& xi : mesh::lattice(shape, degree))
    if (xi.minCoeff() > 0 && xi.maxCoeff() < 1) points.push_back(xi);
  return points;
}

std::vector<GridArray> arrays_of(const std::vector<Field>& present, const problem::UnitNames& units) {
  std::vector<GridArray> arrays;
  for (const Field& field : present)
    for (const std::string& name : field.arrays)
      arrays.push_back({.name = name, .unit = units.label(field.unit), .components = field.is_vector() ? 3 : 1});
  return arrays;
}

void add_point(const recovery::PointValues& point, const std::vector<Field>& present, double displacement_scale,
               GridPiece& piece) {
  std::size_t array = 0;
  for (const Field& field : present) {
    const auto values = field.take(point);
    for (int c = 0; c < field.components; ++c) {
      piece.point_arrays[array].values.push_back(values[static_cast<std::size_t>(c)]);
      if (!field.is_vector()) ++array;
    }
    if (field.is_vector()) ++array;
  }
  const Eigen::Vector3d position = point.phi + displacement_scale * point.u;
  piece.points.insert(piece.points.end(), position.begin(), position.end());
}

/// Adds the displacements of modes, one array for each.
void add_modes(const computation::Solution& solution, const std::vector<Eigen::Vector2d>& xi, GridPiece& piece) {
  const energy::ShellOperator& shell = solution.discrete->shell;
  const fem::Space& space = shell.space();
  const element::BasisAt basis = element::basis_at(space.shape(), space.degree, xi);
  for (const computation::Mode& mode : solution.modes) {
    GridArray array{.name = mode.name(), .unit = "1", .components = 3};
    for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
      const element::CellField values = shell.interpolation().values(cell, basis, shell.gather(cell, mode.shape));
      for (Eigen::Index p = 0; p < values.rows(); ++p)
        for (Eigen::Index k = 0; k < 3; ++k) array.values.push_back(values(p, k));
    }
    piece.point_arrays.push_back(std::move(array));
  }
}

}  // namespace

GridPiece surface_piece(const computation::Solution& solution, const VtuChoice& choice) {
  const fem::Space& space = solution.discrete->space();
  const auto xi = cell_points(space.shape(), space.degree);
  GridPiece piece{
      .type = space.shape() == mesh::Shape::triangle ? CellType::lagrange_triangle : CellType::lagrange_quadrilateral,
      .points_per_cell = xi.size()};
  if (space.owned_cells == 0) return piece;
  const auto present =
      fields_of(ingredients_of(*solution.discrete), choice.heights, solution.discrete->shell.sections().most_layers());
  piece.point_arrays = arrays_of(present, choice.units);
  if (solution.cell_errors.size() == space.owned_cells)
    piece.cell_arrays.push_back(
        {.name = "error_indicator", .unit = choice.units.label("J"), .values = solution.cell_errors});
  const recovery::Recovery recovery(*solution.discrete, solution.nodal, xi, solution.recovery);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    for (const recovery::PointValues& point : recovery(cell)) {
      piece.connectivity.push_back(static_cast<std::int64_t>(piece.connectivity.size()));
      add_point(point, present, choice.displacement_scale, piece);
    }
  add_modes(solution, xi, piece);
  return piece;
}

namespace {

std::string pvd_text(const std::vector<DataSet>& sets) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const DataSet& set : sets)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", set.time, set.part, set.file_name);
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace

void add_vtu(const computation::Solution& solution, const std::filesystem::path& path, AtomicFiles& files,
             const VtuChoice& choice) {
  add_grid(
      path, [&] { return surface_piece(solution, choice); }, choice.is_double, files);
}

void add_pvd(const std::vector<DataSet>& sets, const std::filesystem::path& path, AtomicFiles& files) {
  files.add_text(path, [&] { return pvd_text(sets); });
}

}  // namespace plastron::io
