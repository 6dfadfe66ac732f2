#include "frozen_mesh.hpp"

#include <plastron/domain/mesh_data.hpp>

#include <fmt/format.h>
#include <fmt/os.h>
#include <fmt/ranges.h>

#include <map>

namespace plastron::cad {

namespace {

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

}  // namespace

void write_mesh(const std::string& path, const SampledMesh& mesh, const PartNames& names, double unit,
                const std::vector<std::string>& notes) {
  Groups curve_groups, face_groups;
  std::map<int, std::vector<const SampledLine*>> lines;
  std::map<int, std::vector<const topology::SurfaceCell*>> cells;
  for (const SampledLine& line : mesh.lines) lines[line.edge].push_back(&line);
  for (const topology::SurfaceCell& cell : mesh.surface.cells) cells[cell.region].push_back(&cell);
  std::map<int, std::vector<int>> curves;  // groups by edge
  for (const auto& [edge, unused] : lines)
    for (const std::string& name : names.boundaries[edge - 1]) curves[edge].push_back(curve_groups.number(name));
  std::map<int, int> faces;
  for (const auto& [face, unused] : cells) faces[face] = face_groups.number(names.regions[face - 1]);

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
  out.print("$EndEntities\n$Nodes\n1 {0} 1 {0}\n2 {1} 0 {0}\n", mesh.surface.nodes.size(), faces.begin()->first);
  for (std::size_t n = 1; n <= mesh.surface.nodes.size(); ++n) out.print("{}\n", n);
  for (const Vector3d& node : mesh.surface.nodes)
    out.print("{} {} {}\n", node[0] / unit, node[1] / unit, node[2] / unit);
  const std::size_t elements = mesh.lines.size() + mesh.surface.cells.size();
  out.print("$EndNodes\n$Elements\n{} {} 1 {}\n", lines.size() + cells.size(), elements, elements);
  const auto numbers = [](const std::vector<std::int32_t>& nodes) {
    std::vector<int> tags;
    tags.reserve(nodes.size());
    for (const std::int32_t node : nodes) tags.push_back(node + 1);
    return fmt::format("{}", fmt::join(tags, " "));
  };
  std::size_t tag = 0;
  for (const auto& [edge, of_edge] : lines) {
    out.print("1 {} {} {}\n", edge, domain::element_number(domain::ElementFamily::line, mesh.degree), of_edge.size());
    for (const SampledLine* line : of_edge) {
      std::vector<std::int32_t> ordered{line->nodes.front(), line->nodes.back()};
      ordered.insert(ordered.end(), line->nodes.begin() + 1, line->nodes.end() - 1);
      out.print("{} {}\n", ++tag, numbers(ordered));
    }
  }
  const std::vector<std::size_t> places = domain::lattice_places(mesh::Shape::quadrilateral, mesh.degree);
  const std::size_t first_cell = tag + 1;
  for (const auto& [face, of_face] : cells) {
    out.print("2 {} {} {}\n", face, domain::element_number(domain::ElementFamily::quadrilateral, mesh.degree),
              of_face.size());
    for (const topology::SurfaceCell* cell : of_face) {
      std::vector<std::int32_t> ordered;
      ordered.reserve(places.size());
      for (const std::size_t place : places) ordered.push_back(cell->nodes[place]);
      out.print("{} {}\n", ++tag, numbers(ordered));
    }
  }
  out.print("$EndElements\n$ElementNodeData\n1\n\"normal\"\n1\n0\n3\n0\n3\n{}\n", mesh.surface.cells.size());
  tag = first_cell;
  for (const auto& [face, of_face] : cells)
    for (const topology::SurfaceCell* cell : of_face) {
      out.print("{} {}", tag++, places.size());
      for (const std::size_t place : places) {
        const Vector3d& n = cell->normals[place];
        out.print(" {} {} {}", n[0], n[1], n[2]);
      }
      out.print("\n");
    }
  out.print("$EndElementNodeData\n");
}

}  // namespace plastron::cad
