#include "verification/error_norm.hpp"

#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plastron::verification {

namespace {

using energy::CellStrain;

struct FinePoints {
  std::vector<Eigen::Vector2d> xi;
  std::vector<double> weights;
};

FinePoints fine_points(mesh::Shape shape, int degree) {
  if (shape == mesh::Shape::triangle) {
    const mesh::TriangleRule rule = mesh::triangle_rule(2 * degree + 5);
    return {rule.points, rule.weights};
  }
  const mesh::Rule rule = mesh::gauss(degree + 3);
  FinePoints points;
  for (std::size_t j = 0; j < rule.points.size(); ++j)
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      points.xi.emplace_back(rule.points[i], rule.points[j]);
      points.weights.push_back(rule.weights[i] * rule.weights[j]);
    }
  return points;
}

/// Exact strain in the cell's own coordinates, from derivatives along x and y. The chart is (x, y, height), so the
/// first two components of a_alpha are dx/dxi_alpha and dy/dxi_alpha.
shell::Strain<double> exact_strain(const Manufactured& exact, const geometry::Frame& frame, double x, double y) {
  const ExactField u = exact.u(x, y), r = exact.r(x, y);
  const auto along = [&](const ExactField& f, int a) -> Vector3d {
    return f.d[0] * frame.a_cov[a][0] + f.d[1] * frame.a_cov[a][1];
  };
  return shell::strain<double>({{along(u, 0), along(u, 1)}, r.value, {along(r, 0), along(r, 1)}}, frame);
}

double density(const shell::Section& c, const shell::Strain<double>& s) {
  return 2 * shell::total_energy_density(c, s);
}

struct Squares {
  double error = 0, exact = 0;
  double relative() const { return std::sqrt(error / exact); }
};

}  // namespace

double energy_error(const computation::Solution& solution, const Manufactured& exact) {
  const assembly::DiscreteShell& discrete = *solution.discrete;
  const energy::ShellOperator& shell = discrete.shell;
  const FinePoints fine = fine_points(shell.space().shape(), shell.space().degree);
  const auto basis = element::basis_at(shell.space().shape(), shell.space().degree, fine.xi);
  const auto tied = element::tied_interpolation(shell.tables(), fine.xi);
  Squares sum;
  std::vector<geometry::Frame> frames(fine.xi.size());
  std::vector<double> x(frames.size()), y(frames.size());
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const fem::Cell& cell = shell.space().cells[c];
    shell.surface().frames(cell, fine.xi, frames);
    shell.surface().positions(cell, fine.xi, x, y);
    const CellStrain computed = shell.strains_at(c, shell.gather(c, solution.nodal.y), basis, tied, frames);
    for (std::size_t q = 0; q < frames.size(); ++q) {
      const geometry::Frame& frame = frames[q];
      const auto& section = shell.section(c);
      const auto stiffness = shell::section_at(section.material, frame, section.thickness(x[q], y[q]));
      const auto row = computed.row(static_cast<Eigen::Index>(q));
      const shell::Strain<double> e = exact_strain(exact, frame, x[q], y[q]);
      const shell::Strain<double> difference{row.head<3>().transpose() - e.membrane,
                                             row.segment<3>(3).transpose() - e.bending,
                                             row.tail<2>().transpose() - e.shear};
      const double area = frame.sqrt_a * fine.weights[q];
      sum.error += area * density(stiffness, difference);
      sum.exact += area * density(stiffness, e);
    }
  }
  return sum.relative();
}

double l2_error(const computation::Solution& solution, const Manufactured& exact) {
  const energy::ShellOperator& shell = solution.discrete->shell;
  const FinePoints fine = fine_points(shell.space().shape(), shell.space().degree);
  const auto basis = element::basis_at(shell.space().shape(), shell.space().degree, fine.xi);
  Squares sum;
  std::vector<double> x(fine.xi.size()), y(fine.xi.size());
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const fem::Cell& cell = shell.space().cells[c];
    shell.surface().positions(cell, fine.xi, x, y);
    const element::CellField values = basis.value * shell.gather(c, solution.nodal.y);
    for (std::size_t q = 0; q < x.size(); ++q) {
      Eigen::Matrix<double, 1, 6> e;
      e << exact.u(x[q], y[q]).value.transpose(), exact.r(x[q], y[q]).value.transpose();
      const double area = cell.size * cell.size * fine.weights[q];
      sum.error += area * (values.row(static_cast<Eigen::Index>(q)) - e).squaredNorm();
      sum.exact += area * e.squaredNorm();
    }
  }
  return sum.relative();
}

std::vector<double> rates(const std::vector<double>& errors) {
  std::vector<double> all;
  for (std::size_t i = 1; i < errors.size(); ++i) all.push_back(std::log2(errors[i - 1] / errors[i]));
  return all;
}

bool is_solved_at_nodes(const computation::Result& result) {
  if (result.status == contact::Status::solved) return true;
  return result.status == contact::Status::inaccurate &&
         std::ranges::all_of(result.limits, [](const certificate::CertificateLimit& limit) {
           return limit.holds() || limit.row == "min_gap_between";
         });
}

}  // namespace plastron::verification
