// Shells for tests of loads, and the sums of loads.
#pragma once
#include "assembly/sample_shells.hpp"

#include <plastron/domain/domain.hpp>
#include <plastron/energy/load_vector.hpp>

namespace plastron::test {

inline Eigen::Matrix<double, 6, 1> total(const algebra::Vector& f) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t i = 0; i < f.owned().size(); ++i) sum[static_cast<Eigen::Index>(i % 6)] += f.owned()[i];
  return sum;
}

/// A plate of 2 x 2 cells times 4^refinements.
inline energy::ShellOperator plate_operator(int degree, mesh::Shape shape, int refinements = 1) {
  const auto m = meshed(domain::Rectangle{.to = {1, 1}, .cells = {2, 2}}, flat, degree, refinements, shape);
  return {m.space, m.surface, steel_of(geometry::Expression(0.1)), true, false};
}

}  // namespace plastron::test
