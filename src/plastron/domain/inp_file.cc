// Reads the mesh of Abaqus and CalculiX input files: shell elements, their regions, boundaries and normals.
//
// An element is in one region. Regions are the sets of elements that sections name. Elements without a section have these regions,
// unless they share elements, where the first wins: the ELSETs of *ELEMENT, the sets of *ELSET (a set of all elements comes last), the
// surfaces of whole sides, and the ELSETs "Surface7" that Gmsh gives to its surfaces. All other elements are the region
// "rest". A note lists the sets that are no regions.
//
// Boundaries are sides of elements. A set of nodes names the border sides that have all of their nodes in it. If no
// border side has, it names the sides between elements that have. A surface names sides by labels. A set of line
// elements names the sides on which the lines lie. A set of nodes that contains no side is a set of points.
#include <plastron/domain/cell_sides.hpp>
#include <plastron/domain/inp_cells.hpp>
#include <plastron/domain/inp_lines.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <span>

namespace plastron::domain {

namespace {

using Indices = InpMembers::Indices;

/// Names in quotes, some of them if they are many.
std::string name_list(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    list += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", geometry::shown(names[i]));
  return names.size() > most ? list + fmt::format(" and {} others", names.size() - most) : list;
}

/// Gmsh gives the name "Surface7" to the elements of its surface 7.
bool is_numbered_surface(std::string_view name) {
  constexpr std::string_view start = "SURFACE";
  const std::string text = capitals(name);
  return text.size() > start.size() && text.starts_with(start) &&
         text.find_first_not_of("0123456789", start.size()) == std::string::npos;
}

/// A unit normal at a node, for one cell. Cell -1: for all cells that have none of their own there.
struct InpNodeNormal {
  std::int64_t node, cell;
  Eigen::Vector3d unit;
};

/// The normal at a node of so many cells, if all cells have the same. `given` ascends by cell.
std::optional<Eigen::Vector3d> common_normal(std::span<const InpNodeNormal> given, int cells) {
  constexpr double negligible = 1e-6;
  int covered = 0;
  for (std::size_t i = 0; i < given.size(); ++i)
    covered += given[i].cell >= 0 && (i == 0 || given[i - 1].cell != given[i].cell);
  const bool has_own = covered == cells;
  if (!has_own && given.front().cell >= 0) return {};  // some cells have no normal
  if (has_own && given.front().cell < 0) given = given.subspan(1);
  for (const InpNodeNormal& g : given)
    if ((g.unit - given.front().unit).norm() > negligible) return {};
  return given.front().unit;
}

/// Converts a deck to a mesh.
class InpMesh {
 public:
  explicit InpMesh(InpDeck deck) : deck_(std::move(deck)), cells_(inp_cells(deck_)), sides_(data_) {}
  MeshData data();

 private:
  struct Candidate {
    int rank;  ///< candidates of low rank become regions first
    std::string name;
    Indices cells;
  };

  [[noreturn]] void refuse(const std::string& what) const { throw mesh::DomainError(deck_.path + ": " + what); }
  void note(std::string text) { data_.notes.push_back(std::move(text)); }

  // In this order.
  void name_regions();
  void name_boundaries();
  void add_lines();
  void add_normals();
  void add_notes();

  std::vector<InpNodeNormal> given_normals();
  std::string name_of(const InpSets& sets, const InpSet& set) const;
  int group(int dimension, const std::string& name);
  void name_sections();
  std::vector<Candidate> candidates();
  void name_rest();
  CellSide* side_of(std::size_t cell, int side);
  int side_count(std::size_t cell) const {
    return element_type(data_.elements[cell].type)->family == ElementFamily::triangle ? 3 : 4;
  }
  void name_sides(const std::string& name, const Indices& nodes);
  void name_lines(const std::string& name, const Indices& elements);
  void read_surface(const InpSurface& surface);
  void read_entry(const InpSurface& surface, const InpSurface::Entry& entry, const InpElement& element,
                  std::int64_t cell);

  InpDeck deck_;
  InpCells cells_;
  MeshData& data_ = cells_.data;
  InpMembers &nodes_ = cells_.nodes, &elements_ = cells_.elements;
  CellSides sides_;
  std::vector<int> region_{};  ///< group by cell, 0 if none
  std::map<std::pair<int, std::string>, int> group_numbers_{};
  std::map<std::string, std::set<std::int64_t>> whole_surfaces_{};  ///< cells of surfaces of whole sides
  std::vector<std::string> partial_sets_{};                         ///< sets of nodes with nodes on none of its sides
  std::vector<std::string> foreign_sets_{};                         ///< sets of nodes without a node of a shell
  std::set<std::int64_t> lines_on_sides_{};                         ///< indices of line elements
};

MeshData InpMesh::data() {
  // Surfaces first: they name regions and boundaries.
  for (const InpSurface& surface : deck_.surfaces) read_surface(surface);
  name_regions();
  name_boundaries();
  add_lines();
  add_normals();
  add_notes();
  return std::move(data_);
}

CellSide* InpMesh::side_of(std::size_t cell, int side) {
  const std::int64_t* nodes = data_.element_nodes.data() + data_.elements[cell].first_node;
  return sides_.between(nodes[side], nodes[(side + 1) % side_count(cell)]);
}

/// The name of a set. That of the part has the instance before it if the assembly has a set of the same name.
std::string InpMesh::name_of(const InpSets& sets, const InpSet& set) const {
  if (set.level == InpLevel::part && sets.number_of.contains({InpLevel::assembly, capitals(set.name)}))
    return (deck_.instance.empty() ? "part" : deck_.instance) + "." + set.name;
  return set.name;
}

int InpMesh::group(int dimension, const std::string& name) {
  const auto [found, is_new] = group_numbers_.try_emplace({dimension, name}, group_numbers_.size() + 1);
  if (is_new) data_.names[{dimension, found->second}] = name;
  return found->second;
}

/// Makes regions of the sets that sections name.
void InpMesh::name_sections() {
  for (const InpUse& use : deck_.sections) {
    const InpSet& set = deck_.element_sets.all[elements_.find(use)];
    const std::string name = name_of(deck_.element_sets, set);
    for (const std::int64_t cell : cells_.among(elements_.of(elements_.find(use)))) {
      const int region = group(2, name);
      if (region_[cell] != 0 && region_[cell] != region)
        refuse(fmt::format("{} lies in the sections of \"{}\" and \"{}\" (line {})", place_of(data_.elements[cell]),
                           data_.names[{2, region_[cell]}], name, use.line));
      region_[cell] = region;
    }
  }
}

/// Sets of cells that may be regions, in the order of their rights.
std::vector<InpMesh::Candidate> InpMesh::candidates() {
  std::vector<Candidate> result;
  for (std::size_t i = 0; i < deck_.element_sets.all.size(); ++i) {
    const InpSet& set = deck_.element_sets.all[i];
    Indices cells = cells_.among(elements_.of(i));
    if (cells.empty() || set.is_internal) continue;
    const bool is_all = cells.size() == data_.elements.size();
    const int rank = is_numbered_surface(set.name) ? 4 : !set.is_listed ? 0 : !is_all ? 1 : 2;
    result.push_back({rank, name_of(deck_.element_sets, set), std::move(cells)});
  }
  for (const auto& [name, cells] : whole_surfaces_) result.push_back({3, name, Indices(cells.begin(), cells.end())});
  std::ranges::stable_sort(result, {}, &Candidate::rank);
  return result;
}

void InpMesh::name_regions() {
  region_.assign(data_.elements.size(), 0);
  name_sections();
  std::vector<std::string> unused;
  for (const Candidate& candidate : candidates()) {
    const auto free = [&](std::int64_t cell) { return region_[cell] == 0; };
    const auto number = group_numbers_.find({2, candidate.name});
    const int own = number == group_numbers_.end() ? 0 : number->second;
    if (std::ranges::all_of(candidate.cells, free))
      for (const std::int64_t cell : candidate.cells) region_[cell] = group(2, candidate.name);
    else if (std::ranges::any_of(candidate.cells, [&](std::int64_t cell) { return region_[cell] != own; }))
      unused.push_back(candidate.name);
  }
  if (!unused.empty())
    note(fmt::format("sets of elements that are no regions, because their elements belong to other regions: {}",
                     name_list(unused)));
  name_rest();
  for (std::size_t c = 0; c < region_.size(); ++c) data_.elements[c].groups = group_set(data_, {region_[c]});
}

void InpMesh::name_rest() {
  const auto count = std::ranges::count(region_, 0);
  if (count == 0 || static_cast<std::size_t>(count) == region_.size()) return;
  std::string name = "rest";
  while (group_numbers_.contains({2, name})) name += "_";
  const int rest = group(2, name);
  std::ranges::replace(region_, 0, rest);
  note(fmt::format("the region \"{}\" has {} that no other region has", name,
                   counted(static_cast<std::size_t>(count), "element")));
}

/// Names the sides that have all of their nodes in a set. Without such a side the nodes are points.
void InpMesh::name_sides(const std::string& name, const Indices& nodes) {
  Indices of_cells;
  for (const std::int64_t node : nodes)
    if (sides_.cells_at(node) > 0) of_cells.push_back(node);
  const std::vector<CellSide*> sides = sides_.within(of_cells);
  if (of_cells.empty())
    foreign_sets_.push_back(name);
  else if (sides.empty())
    data_.point_sets[name] = of_cells;
  else if (sides_.node_count(sides) < of_cells.size())
    partial_sets_.push_back(name);
  if (sides.empty()) return;
  const int boundary = group(1, name);
  for (CellSide* side : sides) side->groups.push_back(boundary);
}

/// Names the sides on which the line elements of a set lie. A line of three nodes may have its middle as second or third
/// node.
void InpMesh::name_lines(const std::string& name, const Indices& elements) {
  for (const std::int64_t element : elements) {
    const InpElement& line = deck_.elements[element];
    if (deck_.types[line.type].type.kind != InpKind::line) continue;
    Indices nodes;
    const auto count = static_cast<std::size_t>(deck_.types[line.type].type.nodes);
    for (std::size_t i = 0; i < std::min(line.nodes, count); ++i) {
      const std::int64_t tag = deck_.element_nodes[line.first_node + i];
      const auto end = data_.nodes.begin() + static_cast<std::ptrdiff_t>(cells_.file_nodes);
      const auto found = std::ranges::lower_bound(data_.nodes.begin(), end, tag, {}, &MeshNode::tag);
      if (found != end && found->tag == tag) nodes.push_back(found - data_.nodes.begin());
    }
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = i + 1; j < nodes.size(); ++j) {
        CellSide* side = sides_.between(nodes[i], nodes[j]);
        if (!side || (side->middle >= 0 && std::ranges::find(nodes, side->middle) == nodes.end())) continue;
        side->groups.push_back(group(1, name));
        lines_on_sides_.insert(element);
      }
  }
}

void InpMesh::name_boundaries() {
  const auto& node_sets = deck_.node_sets.all;
  for (std::size_t i = 0; i < node_sets.size(); ++i) {
    Indices nodes = nodes_.of(i);
    for (const InpUse& use : node_sets[i].nodes_of)
      for (const std::int64_t cell : cells_.among(elements_.of(InpMember{0, use}))) {
        const MeshElement& c = data_.elements[cell];
        for (int k = 0; k < element_type(c.type)->nodes; ++k) {
          const std::int64_t node = data_.element_nodes[c.first_node + k];
          if (node < static_cast<std::int64_t>(cells_.file_nodes)) nodes.push_back(node);
        }
      }
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    name_sides(name_of(deck_.node_sets, node_sets[i]), nodes);
  }
  for (const InpSet& surface : deck_.node_surfaces.all)
    name_sides(name_of(deck_.node_surfaces, surface), nodes_.of(surface));
  const auto& element_sets = deck_.element_sets.all;
  for (std::size_t i = 0; i < element_sets.size(); ++i)
    name_lines(name_of(deck_.element_sets, element_sets[i]), elements_.of(i));
}

void InpMesh::read_surface(const InpSurface& surface) {
  for (const InpSurface::Entry& entry : surface.entries)
    for (const std::int64_t element : elements_.of(entry.elements))
      if (cells_.cell_of[element] >= 0) read_entry(surface, entry, deck_.elements[element], cells_.cell_of[element]);
}

/// Labels of Abaqus are SPOS, SNEG for whole sides and E1, E2, ... for edges. CalculiX has S1, S2 (NEG, POS) and S3, S4,
/// .... Both have S1, S2, ... for the edges of plane elements.
void InpMesh::read_entry(const InpSurface& surface, const InpSurface::Entry& entry, const InpElement& element,
                         std::int64_t cell) {
  const std::string& label = entry.label;
  const bool is_plane = deck_.types[element.type].type.is_plane;
  const int number = label.size() == 2 && label[1] >= '1' && label[1] <= '9' ? label[1] - '0' : 0;
  const int edge = number == 0                                        ? 0
                   : label[0] == 'E' || (label[0] == 'S' && is_plane) ? number
                   : label[0] == 'S'                                  ? std::max(0, number - 2)
                                                                      : 0;
  const bool is_whole = label.empty() || label == "SPOS" || label == "SNEG" || label == "POS" || label == "NEG" ||
                        (!is_plane && (label == "S1" || label == "S2"));
  if (is_whole) {
    whole_surfaces_[surface.name].insert(cell);
  } else if (label == "EDGE") {
    for (int k = 0; k < side_count(cell); ++k)
      if (CellSide* side = side_of(cell, k); side->is_border) side->groups.push_back(group(1, surface.name));
  } else if (edge >= 1 && edge <= side_count(cell)) {
    side_of(cell, edge - 1)->groups.push_back(group(1, surface.name));
  } else {
    refuse(
        fmt::format("line {}: the surface \"{}\" has the label \"{}\" for element {} of type {}; SPOS, SNEG, EDGE, "
                    "E1 to E{} and CalculiX's S1 to S{} are allowed",
                    entry.line, surface.name, geometry::shown(label), element.tag, deck_.types[element.type].name,
                    side_count(cell), side_count(cell) + (is_plane ? 0 : 2)));
  }
}

/// Adds the named sides as lines.
void InpMesh::add_lines() {
  constexpr int straight = 1, with_middle = 8;
  for (const CellSide& side : sides_.all()) {
    if (side.groups.empty()) continue;
    const MeshElement& cell = data_.elements[side.cell];
    data_.elements.push_back({cell.tag, cell.line, side.middle < 0 ? straight : with_middle, data_.element_nodes.size(),
                              group_set(data_, side.groups)});
    data_.element_nodes.insert(data_.element_nodes.end(), side.drawn.begin(), side.drawn.end());
    if (side.middle >= 0) data_.element_nodes.push_back(side.middle);
  }
}

/// Takes a normal at a node if it is the same, up to 1e-6, in all cells there. Else Abaqus has a fold at the node; here the
/// angle between the cells decides.
void InpMesh::add_normals() {
  std::vector<InpNodeNormal> given = given_normals();
  std::ranges::stable_sort(given, {}, [](const InpNodeNormal& g) { return std::pair(g.node, g.cell); });
  std::size_t refused = 0, kept = 0;
  data_.normals.resize(data_.nodes.size());
  for (auto from = given.begin(); from != given.end();) {
    const auto to = std::find_if(from, given.end(), [&](const InpNodeNormal& g) { return g.node != from->node; });
    if (sides_.cells_at(from->node) > 0) {
      data_.normals[from->node] = common_normal({from, to}, sides_.cells_at(from->node));
      ++(data_.normals[from->node] ? kept : refused);
    }
    from = to;
  }
  if (kept == 0) data_.normals.clear();
  if (refused > 0)
    note(
        fmt::format("normals at {} are not used, because the elements there have different ones or some have none; "
                    "the angle between the elements decides whether there is a fold",
                    counted(refused, "node")));
}

/// The normals by *NODE, and by *NORMAL for cells.
std::vector<InpNodeNormal> InpMesh::given_normals() {
  constexpr std::size_t most = 10'000'000;  // 400 MB
  std::vector<InpNodeNormal> given;
  for (const auto& [tag, direction] : deck_.node_normals)
    given.push_back({nodes_.of(InpMember{tag})[0], -1, direction.stableNormalized()});
  for (const InpNormal& normal : deck_.normals) {
    const Indices nodes = nodes_.of(normal.nodes);
    for (const std::int64_t cell : cells_.among(elements_.of(normal.elements)))
      for (int k = 0; k < element_type(data_.elements[cell].type)->nodes; ++k)
        if (const std::int64_t node = data_.element_nodes[data_.elements[cell].first_node + k];
            std::ranges::binary_search(nodes, node))
          given.push_back({node, cell, normal.direction.stableNormalized()});
    if (given.size() > most) refuse(fmt::format("*NORMAL gives more than {} normals to nodes of elements", most));
  }
  return given;
}

void InpMesh::add_notes() {
  const auto is_line = [](InpKind kind) { return kind == InpKind::line; };
  const auto is_other = [](InpKind kind) { return kind == InpKind::volume || kind == InpKind::other; };
  if (const std::string lines = type_list(deck_, is_line); !lines.empty())
    note(fmt::format(
        "not read: {}: they have no stiffness here, and name sides of shells where they lie on them ({} do)", lines,
        lines_on_sides_.size()));
  if (const std::string others = type_list(deck_, is_other); !others.empty())
    note(fmt::format("not read: {}: only shells are read", others));
  if (deck_.assembly_nodes > 0)
    note(fmt::format("not read: {} of the assembly, like reference points", counted(deck_.assembly_nodes, "node")));
  if (!data_.point_sets.empty()) {
    std::vector<std::string> sets;
    for (const auto& [name, nodes] : data_.point_sets) sets.push_back(fmt::format("{} ({})", name, nodes.size()));
    note(fmt::format(
        "sets of nodes that contain no whole side of an element are sets of points, here with their numbers "
        "of nodes: {}",
        name_list(sets)));
  }
  if (!partial_sets_.empty())
    note(fmt::format("sets of nodes with nodes that are on none of their sides, of which only the sides are read: {}",
                     name_list(partial_sets_)));
  if (!foreign_sets_.empty())
    note(fmt::format("sets of nodes without a node of a shell: {}", name_list(foreign_sets_)));
  for (const auto& [members, what] : {std::pair(&nodes_, "node"), std::pair(&elements_, "element")})
    if (members->missing_count() > 0)
      note(fmt::format("sets name {} that the file does not have, first \"{}\"",
                       counted(static_cast<std::size_t>(members->missing_count()), what), members->first_missing()));
  data_.notes.insert(data_.notes.end(), deck_.notes.begin(), deck_.notes.end());
  std::vector<std::string> unread;
  for (const auto& [keyword, count] : deck_.unread) unread.push_back(fmt::format("*{} ({})", keyword, count));
  constexpr std::size_t most = 20;
  const std::size_t others = unread.size() - std::min(unread.size(), most);
  if (others > 0) unread.resize(most);
  if (!unread.empty())
    note(fmt::format("not read: {}{}: write materials, thickness, supports and loads in the case file",
                     fmt::join(unread, ", "), others > 0 ? fmt::format(" and {} others", others) : ""));
}

}  // namespace

MeshData read_inp_file(const std::string& path) {
  try {
    return InpMesh(read_inp_deck(path)).data();
  } catch (const geometry::FileError& error) {
    throw mesh::DomainError(error.what());
  }
}

}  // namespace plastron::domain
