#include "frozen_mesh.hpp"

#include <fmt/format.h>
#include <fmt/os.h>
#include <fmt/ranges.h>

#include <map>
#include <set>

namespace plastron::cad {

namespace {

/// Gmsh's order of the nodes of a square's lattice: corners, sides, then the square inside.
void add_square(int from, int degree, int row, std::vector<int>& places) {
  if (degree < 0) return;
  const int to = from + degree;
  const auto add = [&](int i, int j) { places.push_back(j * row + i); };
  if (degree == 0) return add(from, from);
  add(from, from), add(to, from), add(to, to), add(from, to);
  for (int k = 1; k < degree; ++k) add(from + k, from);
  for (int k = 1; k < degree; ++k) add(to, from + k);
  for (int k = 1; k < degree; ++k) add(to - k, to);
  for (int k = 1; k < degree; ++k) add(from, to - k);
  add_square(from + 1, degree - 2, row, places);
}

int square_type(int degree) { return degree == 1 ? 3 : degree == 2 ? 10 : degree <= 5 ? 33 + degree : 41 + degree; }
int line_type(int degree) { return degree == 1 ? 1 : degree == 2 ? 8 : degree <= 5 ? 23 + degree : 56 + degree; }

/// Groups of names, numbered from 1.
class Groups {
 public:
  int number(const std::string& name) {
    return numbers_.try_emplace(name, static_cast<int>(numbers_.size()) + 1).first->second;
  }
  void write(fmt::ostream& out, int dimension) const {
    for (const auto& [name, number] : numbers_) out.print("{} {} \"{}\"\n", dimension, number, name);
  }
  std::size_t size() const { return numbers_.size(); }

 private:
  std::map<std::string, int> numbers_;
};

/// A name of a file that .msh can hold: without quotation marks and control characters, and not too long.
std::string storable(std::string name) {
  constexpr std::size_t longest = 120;
  for (char& c : name)
    if (c == '"' || static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7f) c = '_';
  for (char& c : name)
    if (static_cast<unsigned char>(c) >= 0x80) c = '_';  // files of CAD programs have many encodings
  return name.substr(0, longest);
}

}  // namespace

void write_mesh(const std::string& path, const SampledMesh& mesh, const PartNames& names, double unit,
                const std::vector<std::string>& notes) {
  Groups curve_groups, face_groups;
  std::map<int, std::vector<const SampledLine*>> lines;
  std::map<int, std::vector<const SampledCell*>> cells;
  for (const SampledLine& line : mesh.lines) lines[line.edge].push_back(&line);
  for (const SampledCell& cell : mesh.cells) cells[cell.face].push_back(&cell);
  std::map<int, std::vector<int>> curves;  // groups by edge
  for (const auto& [edge, unused] : lines)
    for (const std::string& name : names.boundaries[edge - 1])
      curves[edge].push_back(curve_groups.number(storable(name)));
  std::map<int, int> faces;
  for (const auto& [face, unused] : cells) faces[face] = face_groups.number(storable(names.regions[face - 1]));

  auto out = fmt::output_file(path);
  out.print("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
  if (!notes.empty()) out.print("$Notes\n{}\n{}\n$EndNotes\n", notes.size(), fmt::join(notes, "\n"));
  out.print("$PhysicalNames\n{}\n", curve_groups.size() + face_groups.size());
  curve_groups.write(out, 1);
  face_groups.write(out, 2);
  out.print("$EndPhysicalNames\n$Entities\n0 {} {} 0\n", lines.size(), cells.size());
  for (const auto& [edge, groups] : curves)
    out.print("{} 0 0 0 0 0 0 {} {} 0\n", edge, groups.size(), fmt::join(groups, " "));
  for (const auto& [face, group] : faces) out.print("{} 0 0 0 0 0 0 1 {} 0\n", face, group);
  out.print("$EndEntities\n$Nodes\n1 {0} 1 {0}\n2 {1} 0 {0}\n", mesh.nodes.size(), faces.begin()->first);
  for (std::size_t n = 1; n <= mesh.nodes.size(); ++n) out.print("{}\n", n);
  for (const Vector3d& node : mesh.nodes) out.print("{} {} {}\n", node[0] / unit, node[1] / unit, node[2] / unit);
  const std::size_t elements = mesh.lines.size() + mesh.cells.size();
  out.print("$EndNodes\n$Elements\n{} {} 1 {}\n", lines.size() + cells.size(), elements, elements);
  const auto numbers = [](const std::vector<int>& nodes) {
    std::vector<int> tags;
    tags.reserve(nodes.size());
    for (const int node : nodes) tags.push_back(node + 1);
    return fmt::format("{}", fmt::join(tags, " "));
  };
  std::size_t tag = 0;
  for (const auto& [edge, of_edge] : lines) {
    out.print("1 {} {} {}\n", edge, line_type(mesh.degree), of_edge.size());
    for (const SampledLine* line : of_edge) {
      std::vector<int> ordered{line->nodes.front(), line->nodes.back()};
      ordered.insert(ordered.end(), line->nodes.begin() + 1, line->nodes.end() - 1);
      out.print("{} {}\n", ++tag, numbers(ordered));
    }
  }
  std::vector<int> places;
  add_square(0, mesh.degree, mesh.degree + 1, places);
  const std::size_t first_cell = tag + 1;
  for (const auto& [face, of_face] : cells) {
    out.print("2 {} {} {}\n", face, square_type(mesh.degree), of_face.size());
    for (const SampledCell* cell : of_face) {
      std::vector<int> ordered;
      ordered.reserve(places.size());
      for (const int place : places) ordered.push_back(cell->nodes[place]);
      out.print("{} {}\n", ++tag, numbers(ordered));
    }
  }
  out.print("$EndElements\n$ElementNodeData\n1\n\"normal\"\n1\n0\n3\n0\n3\n{}\n", mesh.cells.size());
  tag = first_cell;
  for (const auto& [face, of_face] : cells)
    for (const SampledCell* cell : of_face) {
      out.print("{} {}", tag++, places.size());
      for (const int place : places) {
        const Vector3d& n = cell->normals[place];
        out.print(" {} {} {}", n[0], n[1], n[2]);
      }
      out.print("\n");
    }
  out.print("$EndElementNodeData\n");
}

}  // namespace plastron::cad
