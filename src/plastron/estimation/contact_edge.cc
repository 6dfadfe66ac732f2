#include <plastron/estimation/contact_edge.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::estimation {

ContactEdge::ContactEdge(const Solved& solved) : solved_(solved) {
  const assembly::DiscreteShell& discrete = solved.discrete;
  const fem::Space& space = discrete.space();
  const std::size_t obstacles = discrete.obstacles.all.size();
  if (obstacles == 0) return;
  eta_ = densities(solved.z.multiplier);
  reaction_basis_ = element::reaction_basis_at(space.shape(), space.degree, discrete.shell.tables().quadrature.xi);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    for (std::size_t k = 0; k < obstacles; ++k) {
      std::size_t touching = 0, bounded = 0, of_these = 0;
      for (const algebra::LocalIndex node : space.nodes(cell)) {
        const bool touches_it = touches(static_cast<std::size_t>(node), k);
        const bool has_bound = discrete.points[static_cast<std::size_t>(node)].weight > 0;  // it does not hang
        touching += touches_it ? 1 : 0;
        bounded += has_bound ? 1 : 0;
        of_these += touches_it && has_bound ? 1 : 0;
      }
      if (of_these == 0 || of_these == bounded) continue;
      crossed_.push_back(cell);
      touching_nodes_.push_back(touching);
      across_.push_back(direction_across(cell, k));
      break;
    }
}

int ContactEdge::direction_across(std::size_t cell, std::size_t obstacle) const {
  const fem::Space& space = solved_.discrete.space();
  if (space.shape() != fem::Shape::quadrilateral) return 0;
  const auto nodes = space.nodes(cell);
  const auto n = static_cast<std::size_t>(space.degree) + 1;
  const auto differ = [&](std::size_t a, std::size_t b) {
    return touches(static_cast<std::size_t>(nodes[a]), obstacle) !=
                   touches(static_cast<std::size_t>(nodes[b]), obstacle)
               ? 1
               : 0;
  };
  int along_first = 0, along_second = 0;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i + 1 < n; ++i) {
      along_first += differ(j * n + i, j * n + i + 1);
      along_second += differ(i * n + j, (i + 1) * n + j);
    }
  return along_first >= along_second ? 0 : 1;
}

bool ContactEdge::touches(std::size_t node, std::size_t obstacle) const {
  const algebra::Vector& touching = solved_.nodal.touching;
  return touching.local()[node * static_cast<std::size_t>(touching.block()) + obstacle] > 0.5;
}

/// Multipliers of active coordinates as densities that open the gap of their obstacle.
std::vector<double> ContactEdge::densities(const algebra::Vector& multiplier) const {
  const assembly::DiscreteShell& discrete = solved_.discrete;
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const std::size_t obstacles = discrete.obstacles.all.size();
  algebra::Vector all(discrete.space().layout, static_cast<int>(obstacles));
  for (const assembly::ContactRow& row : coordinates.rows) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    if (!row.binds || !touches(row.node, k)) continue;
    all.owned()[row.node * obstacles + k] =
        multiplier.owned()[coordinates.at(row.node, row.coordinate)] / (row.scale * discrete.points[row.node].weight);
  }
  all.update_ghosts();
  return {all.local().begin(), all.local().end()};
}

double ContactEdge::share(std::size_t cell, std::size_t obstacle, const Derivative& derivative,
                          const element::CellField& z, const Reactions& reactions) const {
  const assembly::DiscreteShell& discrete = solved_.discrete;
  const assembly::ShellOperator& shell = discrete.shell;
  const fem::Space& space = discrete.space();
  const element::BasisAt& at = shell.tables().quadrature;
  const std::size_t obstacles = discrete.obstacles.all.size();
  Eigen::MatrixXd densities(space.nodes_per_cell(), 2);
  for (int i = 0; i < space.nodes_per_cell(); ++i) {
    const std::size_t node = static_cast<std::size_t>(space.nodes(cell)[static_cast<std::size_t>(i)]) * obstacles;
    densities.row(i) << reactions.mu[node + obstacle], reactions.eta[node + obstacle];
  }
  const Eigen::MatrixXd density = reaction_basis_ * densities;
  std::vector<geometry::SurfaceJet> jets(at.xi.size());
  shell.surface().jets(space.cells[cell], at.xi, jets, false);
  const element::CellField u = shell.interpolation().values(cell, at, shell.gather(cell, solved_.nodal.y));
  const element::CellField dual = shell.interpolation().values(cell, at, z);
  const element::CellField moved = discrete.state_values(cell, at);
  double penetration = 0, reach = 0;
  for (int q = 0; q < u.rows(); ++q) {
    const assembly::QuadraturePoint& p = shell.point(cell, q);
    const obstacle::Gap gap =
        discrete.gap(obstacle, assembly::shell_point(jets[static_cast<std::size_t>(q)].value, p.frame.a3, p.thickness,
                                                     moved.row(q).transpose()));
    const auto opened = [&](const element::CellField& field) {
      return gap.normal.dot(Eigen::Vector3d(field.row(q).head<3>())) +
             gap.z * gap.normal.dot(geometry::tangential(field.row(q).tail<3>(), p.frame.a3));
    };
    penetration += p.area * density(q, 0) * (gap.initial + opened(u));
    reach += p.area * density(q, 1) * (opened(dual) - derivative.held_at(obstacle, gap));
    if (derivative.weighs_gaps) penetration += p.area * density(q, 1) * (gap.initial + opened(u));
  }
  // The way that a dual moves a pressed obstacle is not known here.
  return std::max(std::abs(penetration), solved_.box.pressing.empty() ? std::abs(reach) : 0.0);
}

std::vector<double> ContactEdge::shares(const Derivative& derivative, const algebra::Vector& z,
                                        const algebra::Vector& y) const {
  std::vector<double> all(crossed_.size(), 0);
  if (eta_.empty()) return all;
  algebra::Vector multiplier(z.layout(), z.block());
  solved_.box.apply(z, multiplier);
  algebra::axpy(-1, derivative.dual.load, multiplier);
  const Reactions reactions{.mu = densities(multiplier), .eta = eta_};
  for (std::size_t i = 0; i < crossed_.size(); ++i) {
    const element::CellField field = solved_.discrete.shell.gather(crossed_[i], y);
    for (std::size_t k = 0; k < solved_.discrete.obstacles.all.size(); ++k)
      all[i] += share(crossed_[i], k, derivative, field, reactions);
  }
  return all;
}

}  // namespace plastron::estimation
