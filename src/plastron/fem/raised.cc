#include <plastron/fem/raised.hpp>

#include <plastron/fem/basis.hpp>

#include <Eigen/Core>

namespace plastron::fem {

algebra::Vector raised(const algebra::Vector& field, const Space& from, const Space& to) {
  PLASTRON_ASSERT(from.owned_cells == to.owned_cells, from.owned_cells, to.owned_cells);
  const Eigen::MatrixXd line =
      lagrange_table(gauss_lobatto(from.degree + 1).points, gauss_lobatto(to.degree + 1).points).value;
  const auto n = static_cast<std::size_t>(from.degree) + 1, m = static_cast<std::size_t>(to.degree) + 1;
  const auto block = static_cast<std::size_t>(field.block());
  algebra::Vector result(to.layout, field.block());
  for (std::size_t cell = 0; cell < to.owned_cells; ++cell)
    for (std::size_t k = 0; k < block; ++k) {
      Eigen::MatrixXd values(n, n);  // a row per xi_1
      for (std::size_t i = 0; i < n * n; ++i)
        values(static_cast<Eigen::Index>(i % n), static_cast<Eigen::Index>(i / n)) =
            field.local()[static_cast<std::size_t>(from.nodes(cell)[i]) * block + k];
      const Eigen::MatrixXd raised = line * values * line.transpose();
      for (std::size_t i = 0; i < m * m; ++i) {
        const auto node = static_cast<std::size_t>(to.nodes(cell)[i]);
        if (node < static_cast<std::size_t>(to.layout->owned))
          result.owned()[node * block + k] = raised(static_cast<Eigen::Index>(i % m), static_cast<Eigen::Index>(i / m));
      }
    }
  result.update_ghosts();
  return result;
}

}  // namespace plastron::fem
