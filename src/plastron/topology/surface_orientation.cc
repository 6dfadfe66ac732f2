#include <plastron/topology/surface_orientation.hpp>
#include <plastron/topology/surface_patch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::topology {

namespace {

/// The cell beyond a side. Neighbours of one orientation run along their common edge in opposite directions.
struct Neighbour {
  std::size_t cell;
  bool is_opposite;
  std::size_t edge;
};

class Orienter {
 public:
  Orienter(const SpaceMesh& mesh, std::span<const mesh::MeshEdge> sides, std::span<const SurfaceEdge> edges,
           const std::optional<Vector3d>& upper)
      : mesh_(mesh),
        edges_(edges),
        upper_(upper),
        neighbours_(mesh.cells.size()),
        is_open_(mesh.cells.size()),
        integrals_(patch_integrals(mesh, centre_of_nodes(mesh))) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto same = sides.subspan(edges[e].first_side, edges[e].side_count);
      if (same.size() == 2) {
        const bool is_opposite = same[0].is_forward != same[1].is_forward;
        neighbours_[same[0].cell].push_back({same[1].cell, is_opposite, e});
        neighbours_[same[1].cell].push_back({same[0].cell, is_opposite, e});
      } else {
        for (const mesh::MeshEdge& side : same) is_open_[side.cell] = true;
      }
    }
  }

  Orientation orient() {
    result_.is_turned.assign(mesh_.cells.size(), false);
    result_.component.assign(mesh_.cells.size(), -1);
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      if (result_.component[c] < 0) orient_component(c);
    return std::move(result_);
  }

 private:
  static Vector3d centre_of_nodes(const SpaceMesh& mesh) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& x : mesh.nodes) sum += x / static_cast<double>(mesh.nodes.size());
    return sum;
  }

  std::vector<std::size_t> connected_cells(std::size_t first) {
    std::vector<std::size_t> cells{first};
    const auto number = static_cast<int>(result_.components.size());
    result_.component[first] = number;
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (const Neighbour& n : neighbours_[cells[i]])
        if (result_.component[n.cell] < 0) {
          result_.component[n.cell] = number;
          cells.push_back(n.cell);
        }
    return cells;
  }

  /// Breadth first, so that the place that the message names is near an edge of the last cells that are reached.
  void turn_like(std::size_t first) {
    std::vector<std::size_t> cells{first};
    std::vector<bool>& is_turned = result_.is_turned;
    is_reached_.resize(mesh_.cells.size());
    is_reached_[first] = true;
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (const Neighbour& n : neighbours_[cells[i]]) {
        const bool must_turn = is_turned[cells[i]] == n.is_opposite;
        if (!is_reached_[n.cell]) {
          is_reached_[n.cell] = true;
          is_turned[n.cell] = must_turn;
          cells.push_back(n.cell);
        } else if (is_turned[n.cell] != must_turn) {
          refuse_one_side(edges_[n.edge]);
        }
      }
  }

  [[noreturn]] void refuse_one_side(const SurfaceEdge& edge) const {
    const Vector3d middle = (mesh_.nodes[edge.ends[0]] + mesh_.nodes[edge.ends[1]]) / 2;
    throw SurfaceError(
        SurfaceError::About::surface,
        fmt::format(
            "the surface has one side only (like a Moebius strip), first noticed at {}; a shell needs an upper and a "
            "lower side: cut the surface there, so that its elements have different nodes",
            place_of(middle)));
  }

  void orient_component(std::size_t first) {
    const std::vector<std::size_t> cells = connected_cells(first);
    turn_like(*std::ranges::max_element(cells, {}, [&](std::size_t c) { return integrals_[c].area; }));
    SurfaceComponent component{.cells = cells.size(), .is_closed = true};
    Vector3d area_vector = Vector3d::Zero();
    double turned_area = 0;
    for (const std::size_t c : cells) {
      const double sign = result_.is_turned[c] ? -1 : 1;
      component.area += integrals_[c].area;
      component.volume += sign * integrals_[c].volume;
      area_vector += sign * integrals_[c].area_vector;
      if (result_.is_turned[c]) turned_area += integrals_[c].area;
      component.is_closed = component.is_closed && !is_open_[c];
    }
    if (!component.is_closed) component.volume = 0;
    if (must_reverse(component, area_vector, turned_area)) {
      for (const std::size_t c : cells) result_.is_turned[c] = !result_.is_turned[c];
      component.volume = -component.volume;
    }
    component.turned =
        static_cast<std::size_t>(std::ranges::count_if(cells, [&](std::size_t c) { return result_.is_turned[c]; }));
    result_.components.push_back(component);
  }

  /// Chooses the rule of the component's sign, and tells whether all its cells must be turned again.
  bool must_reverse(SurfaceComponent& component, const Vector3d& area_vector, double turned_area) const {
    constexpr double negligible = 1e-6, flat = 1e-12;
    const double above = upper_ ? area_vector.dot(upper_->normalized()) : 0;
    if (std::abs(above) > negligible * component.area) {
      component.sign = SignRule::upper;
      return above < 0;
    }
    if (component.is_closed && std::abs(component.volume) > flat * std::pow(component.area, 1.5)) {
      component.sign = SignRule::outward;
      return component.volume < 0;
    }
    return turned_area > (0.5 + negligible) * component.area;
  }

  const SpaceMesh& mesh_;
  std::span<const SurfaceEdge> edges_;
  const std::optional<Vector3d>& upper_;
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<bool> is_open_;  ///< cells with a side at a border or at a branch
  std::vector<PatchIntegrals> integrals_;
  std::vector<bool> is_reached_;
  Orientation result_;
};

}  // namespace

Orientation find_orientation(const SpaceMesh& mesh, std::span<const mesh::MeshEdge> sides,
                             std::span<const SurfaceEdge> edges, const std::optional<Vector3d>& upper) {
  return Orienter(mesh, sides, edges, upper).orient();
}

}  // namespace plastron::topology
