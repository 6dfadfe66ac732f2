#include <plastron/assembly/nodal_geometry.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/geometry/frame.hpp>

#include <algorithm>
#include <utility>

namespace plastron::assembly {

namespace {

// Values of a block: x (2), phi (3), a_3 (3), e, E.
constexpr int block = 10;

/// Sets the largest thickness and modulus at owned nodes, from all cells that meet there, on any rank.
void add_sections(const fem::Space& space, const fem::Surface& surface, const element::ElementTables& tables,
                  const energy::CrossSections& sections, algebra::Vector& data) {
  std::vector<double> e(tables.nodes.size());
  for (std::size_t c = 0; c < space.cells.size(); ++c) {
    const energy::CrossSection& section = sections.at(*space.coarse, space.cells[c]);
    const double young = section.material.young();
    surface.evaluate(section.thickness, space.cells[c], tables.nodes, e);
    const auto nodes = space.nodes(c);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i] >= space.layout->owned) continue;
      double* d = data.local().data() + static_cast<std::size_t>(nodes[i]) * block;
      d[8] = std::max(d[8], e[i]);
      d[9] = std::max(d[9], young);
    }
  }
}

/// A node of a mesh in space has an address in each of its cells. The least one does not depend on the order of cells.
void set_least_addresses(const fem::Space& space, const fem::Surface& surface, const element::ElementTables& tables,
                         algebra::Vector& data) {
  std::vector<double> x(tables.nodes.size()), y(x.size());
  std::vector<char> is_set(static_cast<std::size_t>(space.layout->owned), 0);
  for (std::size_t c = 0; c < space.cells.size(); ++c) {
    surface.positions(space.cells[c], tables.nodes, x, y);
    const auto nodes = space.nodes(c);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i] >= space.layout->owned) continue;
      const auto node = static_cast<std::size_t>(nodes[i]);
      double* d = data.local().data() + node * block;
      if (is_set[node] != 0 && std::pair(d[0], d[1]) <= std::pair(x[i], y[i])) continue;
      is_set[node] = 1;
      d[0] = x[i];
      d[1] = y[i];
    }
  }
}

/// A direction without a node has the distance of its neighbours: only beyond an edge of the shell several of them have no node.
void fill_directions(std::span<double> reach) {
  const std::vector<double> known(reach.begin(), reach.end());
  for (std::size_t k = 0; k < known.size(); ++k)
    if (known[k] == 0) reach[k] = std::min(known[(k + 1) % known.size()], known[(k + known.size() - 1) % known.size()]);
}

}  // namespace

std::vector<NodalPoint> nodal_geometry(const fem::Space& space, const fem::Surface& surface,
                                       const element::ElementTables& tables, const energy::CrossSections& sections) {
  // Owners write and ghosts read, so that ranks agree to the last bit.
  algebra::Vector data(space.layout, block), weights(space.layout, 1);
  std::vector<char> done(static_cast<std::size_t>(space.layout->local_size()), 0);
  std::vector<geometry::Frame> frames(tables.nodes.size());
  std::vector<double> x(frames.size()), y(frames.size());
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const fem::Cell& cell = space.cells[c];
    surface.frames(cell, tables.nodes, frames, false);
    surface.positions(cell, tables.nodes, x, y);
    const auto nodes = space.nodes(c);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto node = static_cast<std::size_t>(nodes[i]);
      weights.local()[node] += tables.nodal_weights[i] * frames[i].sqrt_a;
      if (done[node]) continue;
      done[node] = 1;
      double* d = data.local().data() + node * block;
      d[0] = x[i];
      d[1] = y[i];
      for (int k = 0; k < 3; ++k) {
        d[2 + k] = frames[i].phi[k];
        d[5 + k] = frames[i].a3[k];
      }
    }
  }
  if (surface.has_directors()) set_least_addresses(space, surface, tables, data);
  add_sections(space, surface, tables, sections, data);
  data.update_ghosts();
  weights.accumulate_ghosts();
  // A node whose displacement follows from other nodes is never in contact. These nodes take its share.
  space.continuity.apply_transposed(weights);
  weights.update_ghosts();
  const algebra::Vector side_weights = weights;
  space.kinks.apply_transposed(weights);
  weights.update_ghosts();

  std::vector<NodalPoint> points(done.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double* d = data.local().data() + i * block;
    points[i] = {{d[0], d[1]}, {d[2], d[3], d[4]}, {d[5], d[6], d[7]},     d[8],
                 d[9],         weights.local()[i], side_weights.local()[i]};
    // The share that one hanging node gives to a master may be negative. The sum must not be negative.
    PLASTRON_ASSERT(points[i].weight >= 0, i, points[i].weight);
  }
  return points;
}

algebra::Vector places_and_directors(const fem::Space& space, const std::vector<NodalPoint>& points) {
  algebra::Vector all(space.layout, 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Eigen::Map<Eigen::Vector3d>{all.at(i).data()} = points[i].phi;
    Eigen::Map<Eigen::Vector3d>{all.at(i).data() + 3} = points[i].a3;
  }
  space.continuity.apply(all);
  return all;
}

std::vector<obstacle::Reach> reaches_of(const fem::Space& space, const std::vector<NodalPoint>& points,
                                        const std::vector<obstacle::Obstacle>& obstacles) {
  if (std::ranges::none_of(obstacles, &obstacle::Obstacle::has_edges)) return {};
  algebra::Vector nearest(space.layout, static_cast<int>(obstacle::Reach{}.size()));
  for (std::size_t c = 0; c < space.cells.size(); ++c)
    for (const algebra::LocalIndex i : space.nodes(c)) {
      if (i >= space.layout->owned) continue;
      const auto node = static_cast<std::size_t>(i);
      for (const algebra::LocalIndex other : space.nodes(c)) {
        if (other == i) continue;
        const Vector3d way = points[static_cast<std::size_t>(other)].phi - points[node].phi;
        double& distance = nearest.at(node)[obstacle::reach_direction(points[node].a3, way)];
        if (distance == 0 || way.norm() < distance) distance = way.norm();
      }
    }
  for (algebra::LocalIndex i = 0; i < space.layout->owned; ++i)
    fill_directions(nearest.at(static_cast<std::size_t>(i)));
  nearest.update_ghosts();
  std::vector<obstacle::Reach> reaches(points.size());
  for (std::size_t i = 0; i < reaches.size(); ++i) std::ranges::copy(nearest.at(i), reaches[i].begin());
  return reaches;
}

}  // namespace plastron::assembly
