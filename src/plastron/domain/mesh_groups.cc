#include <plastron/domain/mesh_groups.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace plastron::domain {

namespace {

[[noreturn]] void refuse(const MeshData& data, const std::string& what) {
  throw mesh::DomainError(data.source + ": " + what);
}

}  // namespace

MeshGroups::MeshGroups(const MeshData& data, Nameless nameless) : data_(data) {
  region_of_ = name_groups(2, nameless, regions_);
  if (regions_.empty()) regions_ = {""};
  boundary_of_ = name_groups(1, nameless, boundaries_);
}

std::string MeshGroups::name_of(int dimension, int group, Nameless nameless) const {
  const auto name = data_.names.find({dimension, group});
  if (name != data_.names.end()) return name->second;
  if (nameless == Nameless::numbered) return fmt::format("{}", group);
  refuse(data_, fmt::format("physical {} {} has no name; name it after its {}", dimension == 2 ? "surface" : "curve",
                            group, dimension == 2 ? "region" : "boundary"));
}

std::map<int, int> MeshGroups::name_groups(int dimension, Nameless nameless, std::vector<std::string>& names) const {
  std::set<int> groups;
  for (const MeshElement& element : data_.elements)
    if (element_type(element.type)->is_cell() == (dimension == 2))
      for (const int group : data_.group_sets[element.groups]) groups.insert(std::abs(group));
  std::map<int, int> number_of;
  for (const int group : groups) {
    const std::string name = name_of(dimension, group, nameless);
    const auto place = std::ranges::find(names, name);
    number_of[group] = static_cast<int>(place - names.begin());
    if (place == names.end()) names.push_back(name);
  }
  return number_of;
}

int MeshGroups::region(const MeshElement& cell) const {
  if (region_of_.empty()) return 0;
  const auto& groups = data_.group_sets[cell.groups];
  if (groups.empty())
    refuse(data_,
           fmt::format("{} lies in no physical surface, though others do; put every cell into one", place_of(cell)));
  const int first = region_of_.at(std::abs(groups.front()));
  for (const int group : groups)
    if (region_of_.at(std::abs(group)) != first)
      refuse(data_, fmt::format("{} lies in two physical surfaces, \"{}\" and \"{}\"", place_of(cell), regions_[first],
                                regions_[region_of_.at(std::abs(group))]));
  return first;
}

void check_cell_type(const MeshData& data, const ElementType& type, mesh::Shape shape) {
  if (shape == mesh::Shape::quadrilateral && (type.shape() == mesh::Shape::triangle || !type.is_complete))
    refuse(data, fmt::format(
                     "it has elements of type \"{}\"; with cells = \"quadrilateral\" only complete quadrilaterals are "
                     "allowed (Recombine Surface, Mesh.SecondOrderIncomplete = 0){}",
                     type.name(),
                     type.shape() == mesh::Shape::triangle ? "; cells = \"triangle\" in [mesh] takes triangles" : ""));
  if (!type.is_complete)
    refuse(data, fmt::format("it has elements of type \"{}\"; only complete triangles and quadrilaterals are allowed "
                             "(Mesh.SecondOrderIncomplete = 0)",
                             type.name()));
}

void refuse_without_cells(const MeshData& data, mesh::Shape shape) {
  refuse(data, shape == mesh::Shape::triangle
                   ? "it has no triangles; mesh the surface, save it with its physical groups"
                   : "it has no quadrilaterals; mesh the surface with Recombine, save it with its physical groups"
                     " (curves and volumes are no shell)");
}

void refuse_line(const MeshData& data, const MeshElement& line, const std::string& boundary) {
  const auto node = [&](std::size_t i) { return data.nodes[data.element_nodes[line.first_node + i]].position; };
  const auto text = [](const Eigen::Vector3d& p) {
    return p[2] == 0 ? fmt::format("({:.6g}, {:.6g})", p[0], p[1])
                     : fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]);
  };
  refuse(data, fmt::format("{}, from {} to {} on the curve \"{}\", is no side of a cell; mesh curve and surface "
                           "together, so that cells have their sides on the curve",
                           place_of(line), text(node(0)), text(node(1)), boundary));
}

}  // namespace plastron::domain
