#include <plastron/io/vtu.hpp>

#include <plastron/io/vtu_piece.hpp>

#include <algorithm>

namespace plastron::io {

namespace {

using Eigen::Vector3d;
using recovery::PointValues;

/// A point inside the shell: values on its normal, and the place on it.
struct SolidPoint {
  const PointValues& at;
  double part;  ///< z / e, exactly -1/2 and 1/2 on the faces
  double z() const { return part * at.thickness; }
};

/// An array of the file. Unlike in solution.vtu, shear_stress_1 and shear_stress_2 follow from equilibrium at z.
struct SolidField {
  std::string name, unit;
  bool of_contact;
  std::vector<double> (*take)(const SolidPoint&);
};

std::vector<double> list(const Vector3d& v) { return {v[0], v[1], v[2]}; }

/// Returns the stress in space, XX, YY, ZZ, XY, YZ, XZ: sigma^ab at z, with the shear stress of equilibrium.
std::vector<double> stress_in_space(const SolidPoint& p) {
  const shell::SectionForces f = section_forces(p.at);
  const Vector3d s = shell::in_plane_stress(f, p.z());
  const Eigen::Vector2d q = shell::shear_stress(f, p.z());
  Eigen::Matrix3d local, axes;
  local << s[0], s[2], q[0], s[2], s[1], q[1], q[0], q[1], 0;
  axes << p.at.t1, p.at.t2, p.at.a3;
  const Eigen::Matrix3d t = axes * local * axes.transpose();
  return {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2)};
}

/// Returns the value of the face that contains the point; 0 inside.
double on_face(const SolidPoint& p, const Eigen::Vector2d& of_faces) {
  return p.part == -0.5 ? of_faces[0] : p.part == 0.5 ? of_faces[1] : 0;
}

const std::vector<SolidField>& solid_fields() {
  static const std::vector<SolidField> all{
      {"displacement", "m", false, [](const SolidPoint& p) { return list(p.at.u + p.z() * p.at.r); }},
      {"reference position", "m", false, [](const SolidPoint& p) { return list(p.at.phi + p.z() * p.at.a3); }},
      {"z", "m", false, [](const SolidPoint& p) { return std::vector{p.z()}; }},
      {"stress", "Pa", false, stress_in_space},
      {"stress_11", "Pa", false,
       [](const SolidPoint& p) { return std::vector{shell::in_plane_stress(section_forces(p.at), p.z())[0]}; }},
      {"stress_22", "Pa", false,
       [](const SolidPoint& p) { return std::vector{shell::in_plane_stress(section_forces(p.at), p.z())[1]}; }},
      {"stress_12", "Pa", false,
       [](const SolidPoint& p) { return std::vector{shell::in_plane_stress(section_forces(p.at), p.z())[2]}; }},
      {"shear_stress_1", "Pa", false,
       [](const SolidPoint& p) { return std::vector{shell::shear_stress(section_forces(p.at), p.z())[0]}; }},
      {"shear_stress_2", "Pa", false,
       [](const SolidPoint& p) { return std::vector{shell::shear_stress(section_forces(p.at), p.z())[1]}; }},
      {"von_mises", "Pa", false,
       [](const SolidPoint& p) { return std::vector{shell::von_mises_at(section_forces(p.at), p.z())}; }},
      {"contact", "1", true,
       [](const SolidPoint& p) { return std::vector{std::clamp(on_face(p, p.at.face_touching), 0.0, 1.0)}; }},
      {"eta", "Pa", true, [](const SolidPoint& p) { return std::vector{on_face(p, p.at.face_pressure)}; }},
      {"t1", "1", false, [](const SolidPoint& p) { return list(p.at.t1); }},
      {"a3", "1", false, [](const SolidPoint& p) { return list(p.at.a3); }},
  };
  return all;
}

/// Returns points of the lattice at the corners of each of its squares or triangles, anticlockwise.
std::vector<std::vector<std::int64_t>> lattice_cells(mesh::Shape shape, int n) {
  const bool is_triangle = shape == mesh::Shape::triangle;
  const auto at = [&](int i, int j) {  // xi_1 fastest
    return std::int64_t{is_triangle ? j * (n + 1) - j * (j - 1) / 2 + i : j * (n + 1) + i};
  };
  std::vector<std::vector<std::int64_t>> cells;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < (is_triangle ? n - j : n); ++i) {
      if (!is_triangle) cells.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      if (is_triangle) cells.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (is_triangle && i + j + 1 < n) cells.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return cells;
}

void add_solid_point(const SolidPoint& p, const std::vector<SolidField>& present, GridPiece& piece) {
  const Vector3d place = p.at.phi + p.at.u + p.z() * (p.at.a3 + p.at.r);
  piece.points.insert(piece.points.end(), place.begin(), place.end());
  for (std::size_t k = 0; k < present.size(); ++k) {
    const auto values = present[k].take(p);
    GridArray& array = piece.point_arrays[k];
    array.components = static_cast<int>(values.size());
    array.values.insert(array.values.end(), values.begin(), values.end());
  }
}

/// Adds the layers of a cell: points from the lower to the upper face, then the solid cells between two sheets of
/// points. VTK requires the base of a hexahedron anticlockwise seen from above, and the base of a wedge clockwise.
void add_solid_cell(const std::vector<PointValues>& points, const std::vector<std::vector<std::int64_t>>& bases,
                    int layers, const std::vector<SolidField>& present, GridPiece& piece) {
  const auto first = static_cast<std::int64_t>(piece.points.size() / 3),
             sheet = static_cast<std::int64_t>(points.size());
  for (int layer = 0; layer <= layers; ++layer)
    for (const PointValues& at : points)
      add_solid_point({at, static_cast<double>(layer) / layers - 0.5}, present, piece);
  for (int layer = 0; layer < layers; ++layer)
    for (std::vector<std::int64_t> base : bases) {
      if (base.size() == 3) std::ranges::reverse(base);
      for (const int up : {0, 1})
        for (const std::int64_t corner : base) piece.connectivity.push_back(first + (layer + up) * sheet + corner);
    }
}

GridPiece solid_piece(const computation::Solution& solution, int layers, const problem::UnitNames& units) {
  const fem::Space& space = solution.discrete->space();
  const bool is_triangle = space.shape() == mesh::Shape::triangle;
  GridPiece piece{.type = is_triangle ? CellType::wedge : CellType::hexahedron,
                  .points_per_cell = is_triangle ? std::size_t{6} : std::size_t{8}};
  if (space.owned_cells == 0) return piece;
  std::vector<SolidField> present = solid_fields();
  if (solution.discrete->obstacles.empty()) std::erase_if(present, [](const SolidField& f) { return f.of_contact; });
  for (const SolidField& field : present)
    piece.point_arrays.push_back({.name = field.name, .unit = units.label(field.unit)});
  const recovery::Recovery recovery(*solution.discrete, solution.nodal, mesh::lattice(space.shape(), space.degree),
                                    solution.recovery);
  const auto bases = lattice_cells(space.shape(), space.degree);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    add_solid_cell(recovery(cell), bases, layers, present, piece);
  return piece;
}

}  // namespace

void add_solid(const computation::Solution& solution, int layers, const std::filesystem::path& path, AtomicFiles& files,
               const VtuChoice& choice) {
  add_grid(
      path, [&] { return solid_piece(solution, layers, choice.units); }, choice.is_double, files);
}

}  // namespace plastron::io
