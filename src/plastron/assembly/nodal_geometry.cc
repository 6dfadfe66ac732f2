#include <plastron/assembly/nodal_geometry.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/fem/ties.hpp>
#include <plastron/geometry/frame.hpp>

namespace plastron::assembly {

std::vector<NodalPoint> nodal_geometry(const fem::Space& space, const fem::Surface& surface,
                                       const element::ElementTables& tables, const geometry::Expression& thickness) {
  // Block: x (2), phi (3), a_3 (3), e. Owners write, ghosts read, so that ranks agree to the last bit.
  constexpr int block = 9;
  algebra::Vector data(space.layout, block), weights(space.layout, 1);
  std::vector<char> done(static_cast<std::size_t>(space.layout->local_size()), 0);
  std::vector<geometry::SurfaceJet> jets(tables.nodes.size());
  std::vector<double> x(jets.size()), y(jets.size()), e(jets.size());
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const fem::Cell& cell = space.cells[c];
    surface.jets(cell, tables.nodes, jets, false);
    surface.positions(cell, tables.nodes, x, y);
    thickness.evaluate(x, y, e);
    const auto nodes = space.nodes(c);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto node = static_cast<std::size_t>(nodes[i]);
      const Vector3d normal = jets[i].d[0].cross(jets[i].d[1]);
      weights.local()[node] += tables.nodal_weights[i] * normal.norm();
      if (done[node]) continue;
      done[node] = 1;
      const Vector3d a3 = normal.normalized();
      double* d = data.local().data() + node * block;
      d[0] = x[i];
      d[1] = y[i];
      for (int k = 0; k < 3; ++k) {
        d[2 + k] = jets[i].value[k];
        d[5 + k] = a3[k];
      }
      d[8] = e[i];
    }
  }
  data.update_ghosts();
  weights.accumulate_ghosts();
  fem::collect(space, weights);  // a tied node is never in contact; others answer for its share
  weights.update_ghosts();

  std::vector<NodalPoint> points(done.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double* d = data.local().data() + i * block;
    points[i] = {{d[0], d[1]}, {d[2], d[3], d[4]}, {d[5], d[6], d[7]}, d[8], weights.local()[i]};
    // The share that one hanging node hands to a master may be negative, the sum must not be.
    PLASTRON_ASSERT(points[i].weight >= 0, i, points[i].weight);
  }
  return points;
}

}  // namespace plastron::assembly
