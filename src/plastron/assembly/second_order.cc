#include <plastron/assembly/second_order.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::assembly {

namespace {

using geometry::Vector3d;

/// One row for each quadrature point: 11, 22, 2 x 12.
using MembraneRows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// The field of a cell at the points of each sampling.
using SampledFields = std::vector<element::FieldRows>;

SampledFields sampled_fields(const ShellOperator& shell, std::size_t cell, const element::CellField& field) {
  SampledFields sampled;
  for (const element::Sampling& s : shell.tables().samplings)
    sampled.push_back(
        shell.interpolation().fields(cell, s.basis, shell.interpolation().bases(cell, s.basis.xi), field));
  return sampled;
}

/// Returns 1/2 (d_a v . d_b w + d_b v . d_a w) at the quadrature points, from the values at sampling points.
MembraneRows products(const ShellOperator& shell, const SampledFields& v, const SampledFields& w) {
  MembraneRows at_points = MembraneRows::Zero(shell.tables().points_per_cell(), 3);
  for (std::size_t s = 0; s < v.size(); ++s) {
    const element::Sampling& sampling = shell.tables().samplings[s];
    MembraneRows sampled(v[s].value.rows(), 3);
    for (Eigen::Index t = 0; t < sampled.rows(); ++t)
      sampled.row(t) = shell::membrane_strain(v[s].at(t), w[s].at(t).du);
    for (Eigen::Index q = 0; q < at_points.rows(); ++q)
      for (const auto& [t, weight] : sampling.to_quadrature[static_cast<std::size_t>(q)])
        for (const int m : sampling.membrane) at_points(q, m) += weight * sampled(t, m);
  }
  return at_points;
}

/// Adds the forces of membrane stresses times area that do work on d_a v . d_b w. v is the given field, w the virtual
/// one.
void add_forces_along(const ShellOperator& shell, std::size_t cell, const MembraneRows& stresses,
                      const SampledFields& v, element::CellField& forces) {
  for (std::size_t s = 0; s < v.size(); ++s) {
    const element::Sampling& sampling = shell.tables().samplings[s];
    MembraneRows sampled = MembraneRows::Zero(v[s].value.rows(), 3);
    for (Eigen::Index q = 0; q < stresses.rows(); ++q)
      for (const auto& [t, weight] : sampling.to_quadrature[static_cast<std::size_t>(q)])
        for (const int m : sampling.membrane) sampled(t, m) += weight * stresses(q, m);
    element::FieldRows rows = element::FieldRows::zero(sampled.rows());
    for (Eigen::Index t = 0; t < sampled.rows(); ++t) {
      shell::LocalField<double> dual = shell::zero_field();
      shell::add_membrane_dual(sampled.row(t), v[s].at(t).du, dual);
      rows.add_dual(t, dual);
    }
    shell.interpolation().add_forces(cell, sampling.basis, shell.interpolation().bases(cell, sampling.basis.xi),
                                     std::move(rows), forces);
  }
}

/// Returns the largest principal strain of both faces, by absolute value.
double largest_principal(const QuadraturePoint& p, const CellStrain& strains, Eigen::Index q) {
  double largest = 0;
  for (const double z : {-p.thickness / 2, p.thickness / 2}) {
    const Vector3d s = (strains.row(q).head<3>() + z * strains.row(q).segment<3>(3)).transpose();
    const double half_trace =
        (p.frame.metric_con(0, 0) * s[0] + p.frame.metric_con(1, 1) * s[1] + p.frame.metric_con(0, 1) * s[2]) / 2;
    const double determinant = (s[0] * s[1] - s[2] * s[2] / 4) * p.frame.metric_con.determinant();
    const double principal = std::abs(half_trace) + std::sqrt(std::max(0.0, half_trace * half_trace - determinant));
    if (!(principal <= largest)) largest = principal;
  }
  return largest;
}

/// Returns nodal forces assembled from cells: forces_of(cell, forces) computes them.
template <class ForcesOf>
algebra::Vector assembled(const ShellOperator& shell, const ForcesOf& forces_of) {
  algebra::Vector f(shell.space().layout, 6);
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    element::CellField forces = element::CellField::Zero(shell.tables().nodes_per_cell(), 6);
    forces_of(c, forces);
    shell.scatter(c, forces, f);
  }
  f.accumulate_ghosts();
  return f;
}

/// Returns N^{ab} times area at the quadrature points.
MembraneRows membrane_forces(const ShellOperator& shell, std::size_t cell, const CellStrain& strains,
                             double load_factor) {
  CellStrain stresses = shell.weighted_stresses(cell, strains);
  if (const auto initial = shell.weighted_initial_stresses(cell)) stresses -= load_factor * *initial;
  return stresses.leftCols<3>();
}
MembraneRows membrane_forces(const ShellOperator& shell, std::size_t cell, const element::CellField& field,
                             double load_factor) {
  return membrane_forces(shell, cell, shell.strains(cell, field), load_factor);
}

}  // namespace

SecondOrder second_order(const ShellOperator& shell, const algebra::Vector& y, double load_factor) {
  SecondOrder mine;
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const element::CellField field = shell.gather(c, y);
    const CellStrain strains = shell.strains(c, field);
    const SampledFields v = sampled_fields(shell, c, field);
    const MembraneRows q = products(shell, v, v) / 2, n = membrane_forces(shell, c, strains, load_factor);
    for (Eigen::Index p = 0; p < q.rows(); ++p) {
      const QuadraturePoint point = shell.point(c, static_cast<int>(p));
      mine.work += n.row(p).dot(q.row(p));
      mine.stretch += point.area / 2 * q.row(p).dot(point.section.membrane * q.row(p).transpose());
      const double strain = largest_principal(point, strains, p);
      if (!(strain <= mine.largest_strain)) mine.largest_strain = strain;
    }
  }
  const MPI_Comm comm = shell.space().layout->comm;
  return {.work = algebra::sum_over_ranks(mine.work, comm),
          .stretch = algebra::sum_over_ranks(mine.stretch, comm),
          .largest_strain = algebra::max_over_ranks(mine.largest_strain, comm)};
}

algebra::Vector second_order_forces(const ShellOperator& shell, const algebra::Vector& y, double load_factor) {
  return assembled(shell, [&](std::size_t c, element::CellField& forces) {
    const element::CellField field = shell.gather(c, y);
    const SampledFields v = sampled_fields(shell, c, field);
    CellStrain q = CellStrain::Zero(shell.tables().points_per_cell(), 8);
    q.leftCols<3>() = products(shell, v, v) / 2;
    forces += shell.forces(c, shell.weighted_stresses(c, q));
    add_forces_along(shell, c, membrane_forces(shell, c, field, load_factor), v, forces);
  });
}

algebra::Vector geometric_forces(const ShellOperator& shell, const algebra::Vector& y, const algebra::Vector& v,
                                 double load_factor) {
  return assembled(shell, [&](std::size_t c, element::CellField& forces) {
    add_forces_along(shell, c, membrane_forces(shell, c, shell.gather(c, y), load_factor),
                     sampled_fields(shell, c, shell.gather(c, v)), forces);
  });
}

double stretch_beside(const ShellOperator& shell, const algebra::Vector& y, const algebra::Vector& z,
                      double load_factor) {
  double mine = 0;
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const element::CellField field = shell.gather(c, y), beside = shell.gather(c, z);
    const SampledFields v = sampled_fields(shell, c, field), w = sampled_fields(shell, c, beside);
    const MembraneRows n = membrane_forces(shell, c, field, load_factor), turned = products(shell, v, w);
    CellStrain strains = -shell.strains(c, beside);
    strains.leftCols<3>() += products(shell, v, v) / 2;
    mine += strains.cwiseProduct(shell.weighted_stresses(c, strains)).sum() / 2 - n.cwiseProduct(turned).sum();
  }
  return algebra::sum_over_ranks(mine, shell.space().layout->comm);
}

}  // namespace plastron::assembly
