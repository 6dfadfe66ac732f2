// A beam on n + 2 equidistant nodes, by second differences: A = B'B, (B z)_i = z_{i-1} - 2 z_i + z_{i+1}. Its condition
// number grows like n^4. B z does not suffer the cancellation that A z suffers. This is a small model of a thin
// shell.
#pragma once
#include "algebra/chain.hpp"

namespace plastron::test {

/// Elements (0,1,2), (1,2,3), ...
inline Elements triples(GlobalIndex nodes) {
  Elements elements;
  for (GlobalIndex i = 0; i + 2 < nodes; ++i) elements.push_back({i, i + 1, i + 2});
  return elements;
}

struct Beam {
  /// `stiffness_error` is the relative error of the matrix, which also has springs to the ground. The operator has neither.
  explicit Beam(GlobalIndex nodes, double stiffness_error = 0, MPI_Comm comm = MPI_COMM_WORLD, double ground = 0)
      : elements(triples(nodes)),
        layout(layout_for(nodes, elements, comm)),
        own(connectivity(*layout, elements)),
        matrix(layout, 1, own) {
    const double e = 1 + stiffness_error;
    const std::vector<double> values{e, -2 * e, e, -2 * e, 4 * e + ground, -2 * e, e, -2 * e, e};
    for (std::size_t k = 0; k < own.elements(); ++k) matrix.add(own.element(k), values);
    matrix.finish();
  }

  /// y = B'(B z), through the curvatures.
  void apply(const Vector& z, Vector& y) const {
    y.fill(0.0);
    for (std::size_t k = 0; k < own.elements(); ++k) {
      const auto node = own.element(k);
      const auto at = [&](std::size_t a) { return static_cast<std::size_t>(node[a]); };
      const double curvature = (z.local()[at(0)] - z.local()[at(1)]) - (z.local()[at(1)] - z.local()[at(2)]);
      y.local()[at(0)] += curvature;
      y.local()[at(1)] -= 2 * curvature;
      y.local()[at(2)] += curvature;
    }
    y.accumulate_ghosts();
  }

  /// Marks the first and last `count` nodes.
  std::vector<char> ends(GlobalIndex count) const {
    std::vector<char> marks(static_cast<std::size_t>(layout->owned), 0);
    for (LocalIndex i = 0; i < layout->owned; ++i)
      marks[static_cast<std::size_t>(i)] =
          layout->global(i) < count || layout->global(i) >= layout->global_size - count;
    return marks;
  }

  Elements elements;
  std::shared_ptr<const Layout> layout;
  Connectivity own;
  Matrix matrix;
};

}  // namespace plastron::test
