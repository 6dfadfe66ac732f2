#include <plastron/io/vtu.hpp>

#include <plastron/io/fields.hpp>

#include <deal.II/base/data_out_base.h>
#include <fmt/format.h>

#include <sstream>

namespace plastron::io {

namespace {

using Patch = dealii::DataOutBase::Patch<2, 3>;
using Range = std::tuple<unsigned int, unsigned int, std::string,
                         dealii::DataComponentInterpretation::DataComponentInterpretation>;

/// What deal.II wants to know of the rows of a patch's data.
struct Rows {
  std::vector<std::string> names;  ///< of every row; the rows of a vector share a range
  std::vector<Range> vectors;
  std::map<std::string, std::string> units;
};

Rows rows_of(const std::vector<Field>& present) {
  Rows rows;
  for (const Field& field : present) {
    const auto first = static_cast<unsigned int>(rows.names.size());
    for (int c = 0; c < field.components; ++c)
      rows.names.emplace_back(field.arrays[field.is_vector() ? 0 : static_cast<std::size_t>(c)]);
    if (field.is_vector())
      rows.vectors.emplace_back(first, first + 2, field.arrays.front(),
                                dealii::DataComponentInterpretation::component_is_part_of_vector);
    for (const auto name : field.arrays) rows.units.emplace(name, field.unit);
  }
  return rows;
}

/// Equidistant points of a Lagrange cell of degree k. deal.II takes those of the square with xi_1 fastest and puts them
/// in VTK's order; those of the triangle it writes as they come: corners, then the middles of the sides.
std::vector<Eigen::Vector2d> cell_points(fem::Shape shape, int degree) {
  if (shape == fem::Shape::quadrilateral) return fem::lattice(shape, degree);
  std::vector<Eigen::Vector2d> points;
  points.reserve(6);
  for (int k = 0; k < 3; ++k) points.push_back(fem::corner(shape, k));
  for (int side = 0; degree == 2 && side < 3; ++side) points.push_back(fem::side_point(shape, side, 0.5));
  return points;
}

Patch patch_of(const std::vector<recovery::PointValues>& points, const std::vector<Field>& present, std::size_t rows,
               const fem::Space& space, double displacement_scale) {
  Patch patch;
  patch.n_subdivisions = static_cast<unsigned int>(space.degree);
  patch.points_are_available = true;
  patch.reference_cell =
      space.shape() == fem::Shape::triangle ? dealii::ReferenceCells::Triangle : dealii::ReferenceCells::Quadrilateral;
  patch.data.reinit(rows + 3, points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    std::size_t row = 0;
    for (const Field& field : present) {
      const auto values = field.take(points[p]);
      for (int c = 0; c < field.components; ++c)
        patch.data(row++, p) = static_cast<float>(values[static_cast<std::size_t>(c)]);
    }
    const Eigen::Vector3d position = points[p].phi + displacement_scale * points[p].u;
    for (int d = 0; d < 3; ++d) patch.data(row++, p) = static_cast<float>(position[d]);
  }
  return patch;
}

/// The <Piece> of the cells that this rank owns.
void write_piece(const computation::Solution& solution, double displacement_scale,
                 const dealii::DataOutBase::VtkFlags& flags, const std::vector<Field>& present, std::ostream& out) {
  const fem::Space& space = solution.discrete->space();
  if (space.owned_cells == 0) return;
  const recovery::Recovery recovery(*solution.discrete, solution.nodal, cell_points(space.shape(), space.degree),
                                    solution.recovery);
  const Rows rows = rows_of(present);
  std::vector<Patch> patches;
  patches.reserve(space.owned_cells);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
    patches.push_back(patch_of(recovery(cell), present, rows.names.size(), space, displacement_scale));
    patches.back().patch_index = static_cast<unsigned int>(cell);
  }
  dealii::DataOutBase::write_vtu_main(patches, rows.names, rows.vectors, flags, out);
}

dealii::DataOutBase::VtkFlags flags_of(const std::vector<Field>& present) {
  dealii::DataOutBase::VtkFlags flags;
  flags.print_date_and_time = false;  // equal solutions make equal files
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  flags.write_higher_order_cells = true;
  flags.physical_units = rows_of(present).units;
  return flags;
}

std::string pvd_text(const std::vector<DataSet>& sets) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const DataSet& set : sets)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", set.time, set.part, set.file_name);
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace

void add_vtu(const computation::Solution& solution, const std::filesystem::path& path, AtomicFiles& files,
             double displacement_scale) {
  const MPI_Comm comm = files.comm();
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  const std::vector<Field> present = fields_of(!solution.discrete->obstacles.empty(),
                                               solution.discrete->tangency.formulation == element::Formulation::mixed);
  const auto flags = flags_of(present);
  const auto piece = [&] {
    std::ostringstream out;
    if (rank == 0) dealii::DataOutBase::write_vtu_header(out, flags);
    write_piece(solution, displacement_scale, flags, present, out);
    if (rank == ranks - 1) dealii::DataOutBase::write_vtu_footer(out);
    return std::move(out).str();
  };
  files.add(path, piece);
}

void add_pvd(const std::vector<DataSet>& sets, const std::filesystem::path& path, AtomicFiles& files) {
  int rank = 0;
  MPI_Comm_rank(files.comm(), &rank);
  files.add(path, [&] { return rank == 0 ? pvd_text(sets) : std::string(); });
}

std::vector<std::string> write_vtu(const computation::Solution& solution, const std::filesystem::path& directory,
                                   const std::string& base_name, double displacement_scale) {
  AtomicFiles files(solution.discrete->space().layout->comm);
  std::vector<std::string> names{base_name + ".vtu", base_name + ".pvd"};
  add_vtu(solution, directory / names[0], files, displacement_scale);
  add_pvd({{0, names[0]}}, directory / names[1], files);
  files.commit();
  return names;
}

}  // namespace plastron::io
