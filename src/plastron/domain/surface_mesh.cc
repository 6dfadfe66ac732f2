#include <plastron/domain/surface_mesh.hpp>

#include <plastron/domain/cad_mesh.hpp>
#include <plastron/domain/facet_mesh.hpp>
#include <plastron/domain/mesh_groups.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>
#include <plastron/geometry/triangle_mesh.hpp>
#include <plastron/mesh/surface_patches.hpp>
#include <plastron/topology/disjoint_sets.hpp>
#include <plastron/topology/surface_flaws.hpp>
#include <plastron/topology/surface_patch.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace plastron::domain {

namespace {

using About = topology::SurfaceError::About;

/// The cells of a file and its groups.
class SpaceCells {
 public:
  SpaceCells(const MeshData& data, std::optional<mesh::Shape> shape, double scale)
      : data_(data), groups_(data, MeshGroups::Nameless::numbered), shape_(shape) {
    for (const MeshNode& node : data.nodes) mesh_.nodes.push_back(scale * node.position);
    mesh_.normals = data.normals;
    mesh_.shape = shape_of_file();
    for (const MeshElement& element : data.elements)
      if (const ElementType type = *element_type(element.type); type.is_cell()) add_cell(element, type);
  }

  topology::SpaceMesh take() { return std::move(mesh_); }
  const MeshGroups& groups() const { return groups_; }

 private:
  /// Triangles of a file stay triangles; quadrilaterals are cut later if triangles are wanted.
  mesh::Shape shape_of_file() const {
    bool has_triangles = false, has_quadrilaterals = false;
    for (const MeshElement& element : data_.elements) {
      const ElementType type = *element_type(element.type);
      if (!type.is_cell()) continue;
      check_cell_type(data_, type, shape_.value_or(type.shape()));
      (type.shape() == mesh::Shape::triangle ? has_triangles : has_quadrilaterals) = true;
    }
    if (!has_triangles && !has_quadrilaterals) refuse_without_cells(data_, shape_.value_or(mesh::Shape::quadrilateral));
    if (has_triangles && has_quadrilaterals)
      throw mesh::DomainError(fmt::format(
          "{}: it has triangles and quadrilaterals; a mesh in space has one kind of cells: mesh with Recombine and "
          "Mesh.SubdivisionAlgorithm = 1 for quadrilaterals alone, or without Recombine for triangles",
          data_.source));
    return has_triangles ? mesh::Shape::triangle : mesh::Shape::quadrilateral;
  }

  void add_cell(const MeshElement& element, const ElementType& type) {
    const auto places = lattice_places(type.shape(), type.order);
    topology::SurfaceCell cell{.nodes = std::vector<std::int32_t>(places.size()),
                               .order = type.order,
                               .region = groups_.region(element),
                               .tag = element.tag,
                               .line = element.line};
    for (std::size_t i = 0; i < places.size(); ++i)
      cell.nodes[places[i]] = static_cast<std::int32_t>(data_.element_nodes[element.first_node + i]);
    if (!data_.element_normals.empty() && !data_.element_normals[element.first_node].isZero(0)) {
      cell.normals.resize(places.size());
      for (std::size_t i = 0; i < places.size(); ++i)
        cell.normals[places[i]] = data_.element_normals[element.first_node + i];
    }
    mesh_.cells.push_back(std::move(cell));
  }

  const MeshData& data_;
  MeshGroups groups_;
  std::optional<mesh::Shape> shape_;
  topology::SpaceMesh mesh_{};
};

std::array<int, 2> ascending(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<std::string> messages_of(const std::vector<topology::Flaw>& flaws) {
  std::vector<std::string> messages;
  messages.reserve(flaws.size());
  for (const topology::Flaw& flaw : flaws) messages.push_back(flaw.message);
  return messages;
}

topology::SurfaceError error_of(const std::vector<topology::Flaw>& flaws) {
  const bool has_gaps = std::ranges::count(flaws, About::border, &topology::Flaw::about) > 0;
  return {has_gaps ? About::border : About::cells, fmt::format("{}", fmt::join(messages_of(flaws), "; also: "))};
}

/// Returns the mesh whose nodes are moved along the directors by parts of the thickness. Throws SurfaceError where there
/// are folds, or two thicknesses at a node.
topology::SpaceMesh moved_by(const Offset& offset, const topology::SurfaceTopology& topology,
                             const std::vector<std::string>& regions) {
  const topology::SpaceMesh& mesh = topology.mesh;
  for (const topology::SurfaceEdge& edge : topology.edges)
    if (edge.kind == topology::EdgeKind::fold || edge.kind == topology::EdgeKind::branch)
      throw topology::SurfaceError(
          About::surface,
          fmt::format(
              "the surface has a fold at {}, where an offset would tear it; mesh the mid-surface of a part with folds",
              topology::place_of(mesh.nodes[static_cast<std::size_t>(edge.ends[0])])));
  topology::SpaceMesh moved = mesh;
  std::vector<double> distance(mesh.nodes.size(), 0);
  std::vector<bool> is_set(mesh.nodes.size(), false);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (std::size_t i = 0; i < mesh.cells[c].nodes.size(); ++i) {
      const auto node = static_cast<std::size_t>(mesh.cells[c].nodes[i]);
      const Vector3d& at = mesh.nodes[node];
      const std::string& region = regions[static_cast<std::size_t>(mesh.cells[c].region)];
      const double e = offset.thickness_of(region)(geometry::Place{0, 0, at[0], at[1], at[2]});
      constexpr double rounding = 1e-9;
      if (is_set[node] && std::abs(distance[node] - offset.part * e) > rounding * std::abs(distance[node]))
        throw topology::SurfaceError(
            About::surface, fmt::format("at {} two regions of different thickness meet, where an offset would tear the "
                                        "surface; let the thickness be continuous, or mesh the mid-surface",
                                        topology::place_of(at)));
      distance[node] = offset.part * e;
      is_set[node] = true;
      const auto copy = static_cast<std::size_t>(topology.cell_director_nodes[c][i]);
      moved.nodes[node] = at + distance[node] * topology.director_nodes[copy].director;
      if (!offset.thickness_of(region).is_constant()) moved.cells[c].normals.clear();  // those of the face
    }
  return moved;
}

/// The director nodes on a named curve and the plane in which they lie.
class CurveInPlane {
 public:
  CurveInPlane(int boundary, const FileSurface& surface)
      : topology_(surface.topology), tables_(topology_.mesh.shape, [shape = topology_.mesh.shape](int order) {
          return mesh::lattice(shape, order);
        }) {
    for (const NamedEdge& named : surface.named_edges) {
      if (named.boundary != boundary) continue;
      const topology::SurfaceEdge& edge = topology_.edges[named.edge];
      for (std::size_t k = 0; k < edge.side_count; ++k) add(topology_.sides[edge.first_side + k]);
    }
  }

  const std::set<std::int32_t>& nodes() const { return nodes_; }

  /// How well the mesh knows a direction on the curve: FileSurface::symmetry_accuracy. An angle of more than a degree is no error of a
  /// mesh that could be computed with.
  double accuracy() const {
    constexpr double most = 0.02;
    return std::clamp(largest_angle_, digits, most);
  }

  /// The unit normal of the plane of the nodes; for a straight curve, of the plane of the curve and its mean director.
  /// Empty if a chord leaves the plane at a larger angle than the accuracy.
  std::optional<Vector3d> normal() const {
    Vector3d mean = Vector3d::Zero(), director = Vector3d::Zero();
    for (const std::int32_t node : nodes_) {
      mean += place(node) / static_cast<double>(nodes_.size());
      director += topology_.director_nodes[static_cast<std::size_t>(node)].director;
    }
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const std::int32_t node : nodes_) moments += (place(node) - mean) * (place(node) - mean).transpose();
    const auto eigen = geometry::symmetric_eigen(moments);
    const Vector3d along = eigen.vectors.col(2), across = along.cross(director);
    // Two parallel edges under one name are no straight curve: their nodes spread across it, too.
    const bool is_on_line = std::sqrt(std::max(0.0, eigen.values[1])) <= digits * std::sqrt(eigen.values[2]);
    const bool is_straight = is_on_line && std::ranges::all_of(chords_, [&](const Vector3d& chord) {
                               return chord.cross(along).norm() <= digits;
                             });
    const Vector3d n = is_straight ? across : Vector3d(eigen.vectors.col(0));
    if (!(n.norm() > 0)) return {};
    const Vector3d unit = n.normalized();
    const bool is_plane =
        std::ranges::all_of(chords_, [&](const Vector3d& chord) { return std::abs(chord.dot(unit)) <= accuracy(); });
    return is_plane ? std::optional(unit) : std::nullopt;
  }

 private:
  void add(const mesh::MeshEdge& side) {
    const topology::SurfaceCell& cell = topology_.mesh.cells[side.cell];
    const topology::PatchPoints points = topology::patch_points(tables_(cell.order), topology_.mesh, cell);
    std::int32_t last = -1;
    for (const int at : topology::ascending_places(topology_.mesh, side)) {
      const std::int32_t node = topology_.cell_director_nodes[side.cell][static_cast<std::size_t>(at)];
      nodes_.insert(node);
      const Vector3d& director = topology_.director_nodes[static_cast<std::size_t>(node)].director;
      largest_angle_ = std::max(largest_angle_, topology::angle_between(director, points.normal(at)));
      if (last >= 0) chords_.push_back((place(node) - place(last)).normalized());
      last = node;
    }
  }
  const Vector3d& place(std::int32_t node) const {
    return topology_.mesh
        .nodes[static_cast<std::size_t>(topology_.director_nodes[static_cast<std::size_t>(node)].node)];
  }

  static constexpr double digits = 1e-3;  ///< angle that the digits of a file may cause [rad]

  const topology::SurfaceTopology& topology_;
  topology::PatchTables<std::function<std::vector<Eigen::Vector2d>(int)>> tables_;
  std::set<std::int32_t> nodes_{};
  std::vector<Vector3d> chords_{};  ///< directions between neighbouring nodes
  double largest_angle_ = 0;        ///< between a director and the normal of a cell there [rad]
};

/// Makes the topology of a file's cells and finds its named edges.
class SurfaceReader {
 public:
  SurfaceReader(const MeshData& data, const SpaceReading& reading, std::optional<mesh::Shape> shape)
      : data_(data), reading_(reading), cells_(data, shape, reading.scale) {}

  FileSurface operator()() {
    check_folds();
    topology::SpaceMesh mesh = cells_.take();
    const double tolerance = reading_.tolerance.value_or(topology::merge_tolerance(mesh));
    topology::MergedMesh merged = topology::merge_nodes(std::move(mesh), tolerance);
    new_number_ = std::move(merged.new_number);
    const topology::SurfaceFlaws flaws =
        topology::find_flaws(merged.mesh, reading_.has_slits ? topology::FlawLimits{.gap = 0} : topology::FlawLimits{});
    if (!flaws.errors.empty()) throw error_of(flaws.errors);
    const topology::SurfaceOptions options{
        .smooth_angle = reading_.smooth_angle, .upper = reading_.upper, .folds = named_folds()};
    FileSurface surface = named(topology::surface_topology(std::move(merged.mesh), options));
    if (reading_.offset.part != 0)  // along directors that lie in the planes of symmetry
      surface =
          named(topology::surface_topology(moved_by(reading_.offset, surface.topology, surface.regions), options));
    surface.merged_nodes = merged.merged;
    surface.notes = data_.notes;
    surface.warnings = messages_of(flaws.warnings);
    surface.has_upper = reading_.upper.has_value();
    std::ranges::copy(data_.warnings, std::back_inserter(surface.warnings));
    return surface;
  }

 private:
  /// The surface with its named edges, and directors in the planes of symmetry.
  FileSurface named(topology::SurfaceTopology topology) const {
    FileSurface surface{
        .topology = std::move(topology), .regions = cells_.groups().regions(), .boundaries = boundaries()};
    name_edges(surface);
    for (const std::string& boundary : reading_.symmetric) put_into_plane(boundary, surface);
    return surface;
  }

  const std::vector<std::string>& boundaries() const { return cells_.groups().boundaries(); }
  bool is_fold(const std::string& boundary) const {
    return std::ranges::find(reading_.folds, boundary) != reading_.folds.end();
  }

  void check_folds() const {
    for (const std::string& fold : reading_.folds)
      if (std::ranges::find(boundaries(), fold) == boundaries().end())
        throw topology::SurfaceError(
            About::surface, fmt::format("there is no curve \"{}\" that could be a fold; the file has: {}", fold,
                                        fmt::join(boundaries(), ", ")));
  }

  /// Calls visit(line element, its ends after merging, group) for each line in a group.
  template <class Visit>
  void for_each_line(const Visit& visit) const {
    for (const MeshElement& element : data_.elements) {
      if (element_type(element.type)->is_cell()) continue;
      const auto node = [&](std::size_t i) { return new_number_[data_.element_nodes[element.first_node + i]]; };
      for (const int group : data_.group_sets[element.groups]) visit(element, std::array{node(0), node(1)}, group);
    }
  }

  std::set<std::array<int, 2>> named_folds() const {
    std::set<std::array<int, 2>> folds;
    for_each_line([&](const MeshElement&, const std::array<int, 2>& ends, int group) {
      if (is_fold(boundaries()[cells_.groups().boundary(group)])) folds.insert(ascending(ends[0], ends[1]));
    });
    return folds;
  }

  void name_edges(FileSurface& surface) const {
    std::set<std::pair<std::size_t, int>> known;
    for_each_line([&](const MeshElement& line, const std::array<int, 2>& ends, int group) {
      const int boundary = cells_.groups().boundary(group);
      const topology::SurfaceEdge* edge = topology::find_edge(surface.topology, ascending(ends[0], ends[1]));
      if (!edge) refuse_line(data_, line, boundaries()[boundary]);
      const auto index = static_cast<std::size_t>(edge - surface.topology.edges.data());
      if (known.insert({index, boundary}).second)
        surface.named_edges.push_back({index, boundary, (ends[0] < ends[1]) == (group > 0)});
    });
  }

  const MeshData& data_;
  const SpaceReading& reading_;
  SpaceCells cells_;
  std::vector<std::int32_t> new_number_{};  ///< of each node of the file
};

/// Makes the coarse mesh of a topology.
class SurfaceMesher {
 public:
  explicit SurfaceMesher(const FileSurface& surface) : surface_(surface), topology_(surface.topology) {
    mesh_.shape = topology_.mesh.shape;
    mesh_.regions = surface.regions;
    mesh_.boundaries = surface.boundaries;
  }

  mesh::CoarseMesh build() {
    add_patches();
    for (const std::int32_t node : topology_.vertex_director_nodes)
      mesh_.vertices.push_back(mesh_.patches->positions[static_cast<std::size_t>(node)].head<2>());
    for (std::size_t c = 0; c < topology_.mesh.cells.size(); ++c)
      mesh_.cells.push_back(
          {topology_.cell_vertices[c], topology_.mesh.cells[c].region, {whole_reference_cell()}, static_cast<int>(c)});
    for (const NamedEdge& named : surface_.named_edges) {
      // A curve along a fold is listed for one of its sides.
      const auto [low, high] = drawn(topology_.sides[topology_.edges[named.edge].first_side]);
      mesh_.edges.push_back({named.is_ascending ? std::array{low, high} : std::array{high, low}, named.boundary});
    }
    add_folds();
    return std::move(mesh_);
  }

 private:
  void add_patches() {
    auto patches = std::make_shared<mesh::SurfacePatches>();
    patches->shape = topology_.mesh.shape;
    for (const topology::DirectorNode& node : topology_.director_nodes) {
      patches->positions.push_back(topology_.mesh.nodes[static_cast<std::size_t>(node.node)]);
      patches->directors.push_back(node.director);
    }
    for (std::size_t c = 0; c < topology_.mesh.cells.size(); ++c)
      patches->patches.push_back({topology_.mesh.cells[c].order, topology_.cell_director_nodes[c]});
    mesh::choose_axes(*patches);
    mesh_.patches = std::move(patches);
  }

  mesh::ExactMap whole_reference_cell() const {
    if (mesh_.shape == mesh::Shape::triangle) return mesh::TriangleLagrangeMap{1, mesh::lattice(mesh_.shape, 1)};
    return mesh::LagrangeMap{1, mesh::lattice(mesh_.shape, 1)};
  }

  /// The vertices of a cell's side, from its lower node to its higher one.
  std::array<int, 2> drawn(const mesh::MeshEdge& side) const {
    const auto [from, to] = mesh::anticlockwise_corners(mesh_.shape, side.side);
    const auto& vertices = topology_.cell_vertices[side.cell];
    return side.is_forward ? std::array{vertices[from], vertices[to]} : std::array{vertices[to], vertices[from]};
  }

  void add_folds() {
    topology::DisjointSets connected(topology_.mesh.nodes.size());
    std::vector<const topology::SurfaceEdge*> folds;
    for (const topology::SurfaceEdge& edge : topology_.edges) {
      if (!is_cut(edge)) continue;
      folds.push_back(&edge);
      connected.unite(static_cast<std::size_t>(edge.ends[0]), static_cast<std::size_t>(edge.ends[1]));
    }
    std::map<std::size_t, int> boundary_of;  // by representative, in the order of the edges
    for (const topology::SurfaceEdge* fold : folds) {
      const auto [found, is_new] = boundary_of.try_emplace(connected.of(static_cast<std::size_t>(fold->ends[0])),
                                                           static_cast<int>(mesh_.boundaries.size()));
      if (is_new) {
        mesh_.fold_boundaries.push_back(fmt::format("fold {}", boundary_of.size()));
        mesh_.boundaries.push_back(mesh_.fold_boundaries.back());
      }
      add_fold(*fold, found->second);
    }
  }

  static bool is_cut(const topology::SurfaceEdge& edge) {
    return edge.kind == topology::EdgeKind::branch || (edge.kind == topology::EdgeKind::fold && !edge.is_lone_fold);
  }

  void add_fold(const topology::SurfaceEdge& edge, int boundary) {
    const auto first = drawn(topology_.sides[edge.first_side]);
    for (std::size_t k = 0; k < edge.side_count; ++k) {
      const auto side = drawn(topology_.sides[edge.first_side + k]);
      mesh_.edges.push_back({side, boundary});
      if (k > 0) mesh_.folds.push_back({{ascending(first[0], first[1]), ascending(side[0], side[1])}});
    }
  }

  const FileSurface& surface_;
  const topology::SurfaceTopology& topology_;
  mesh::CoarseMesh mesh_{};
};

/// Adds the name of the file to errors of its surface.
FileSurface surface_of(const MeshData& data, const SpaceReading& reading, std::optional<mesh::Shape> shape) {
  try {
    return SurfaceReader(data, reading, shape)();
  } catch (const topology::SurfaceError& error) {
    throw topology::SurfaceError(error.about, fmt::format("{}: {}", data.source, error.what()));
  }
}

/// Meshes facets. Where cells of the usual size fold at small features, smaller ones are tried, and the facets themselves at last.
FileSurface surface_of_facets(const MeshFile& file, std::optional<mesh::Shape> shape) {
  const SpaceReading& reading = *file.in_space;
  constexpr std::size_t many = 10000;  // cells: smaller ones are not tried
  std::string message;
  std::size_t elements = 0;
  for (const double part : {1.0, 0.7, 0.5, 0.35, 0.0}) {
    if (part > 0 && elements > many) continue;
    try {
      const FacetMesh mesh = mesh_facets(file.path, reading, shape.value_or(mesh::Shape::quadrilateral), part);
      elements = mesh.data.elements.size();
      FileSurface surface = surface_of(mesh.data, mesh.reading, shape);
      surface.is_remeshed = true;
      if (part < 1)
        surface.notes.emplace_back("larger cells fold at small features of the part; to choose their sides, set size");
      return surface;
    } catch (const topology::SurfaceError& error) {
      if (part == 1 && error.about == About::surface) throw;
      if (part == 1) message = error.what();
      if (reading.size || error.about == About::border) break;
    } catch (const mesh::DomainError&) {  // of the facets
      if (part == 1) throw;
    }
  }
  // The numbers are those of cells that the file does not have.
  throw mesh::DomainError(message +
                          "; the elements are cells that were made from the facets: repair the facets at these places" +
                          (reading.size ? ", or take another size" : ""));
}

/// The mesh of a CAD file already has the lengths and the cells of the case.
FileSurface surface_of_part(const MeshFile& file, std::optional<mesh::Shape> shape) {
  SpaceReading reading = *file.in_space;
  reading.scale = 1;
  reading.tolerance.reset();
  const FrozenMesh frozen = file.frozen ? *file.frozen : frozen_mesh(file);
  if (!frozen.failure.empty()) throw mesh::DomainError(frozen.failure);
  return surface_of(read_msh_text(file.path, frozen.text), reading, shape);
}

}  // namespace

void put_into_plane(const std::string& boundary, FileSurface& surface) {
  const auto found = std::ranges::find(surface.boundaries, boundary);
  if (found == surface.boundaries.end()) return;  // the support's own check reports the name
  const CurveInPlane curve(static_cast<int>(found - surface.boundaries.begin()), surface);
  surface.symmetry_accuracy[boundary] = curve.accuracy();
  const std::optional<Vector3d> normal = curve.normal();
  if (!normal) return;  // the check of symmetry reports it
  for (const std::int32_t node : curve.nodes()) {
    Vector3d& director = surface.topology.director_nodes[static_cast<std::size_t>(node)].director;
    const Vector3d in_plane = geometry::tangential(director, *normal);
    constexpr double most_sine = 0.2;  // a shell that meets the plane obliquely is no symmetric one
    if (in_plane.norm() < std::sqrt(1 - most_sine * most_sine)) continue;
    surface.symmetry_turn = std::max(surface.symmetry_turn, std::acos(std::min(1.0, in_plane.norm())));
    director = in_plane.normalized();
  }
}

FileSurface read_surface(const MeshFile& file, std::optional<mesh::Shape> shape) {
  if (geometry::is_triangle_file(file.path)) return surface_of_facets(file, shape);
  if (is_cad_file(file.path)) return surface_of_part(file, shape);
  const MeshData data = file.path.ends_with(".inp") ? read_inp_file(file.path) : read_msh_file(file.path);
  return surface_of(data, *file.in_space, shape);
}

mesh::CoarseMesh surface_mesh(const FileSurface& surface, mesh::Shape shape) {
  mesh::CoarseMesh mesh = SurfaceMesher(surface).build();
  return mesh.shape == shape ? mesh : mesh::cut_crosswise(std::move(mesh));
}

}  // namespace plastron::domain
