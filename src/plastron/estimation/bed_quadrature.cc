#include <plastron/estimation/bed_quadrature.hpp>

#include <plastron/assembly/box_problem.hpp>
#include <plastron/element/subdivision.hpp>
#include <plastron/estimation/cell_gaps.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plastron::estimation {

namespace {

using obstacle::Bed;

constexpr int halvings = 5;  ///< of a cell with a kink of the pressure

/// Returns the segment at a closure, null where the bed is open.
const Bed::Segment* segment_at(const Bed& bed, double closure) { return closure > 0 ? &bed.segment(closure) : nullptr; }

/// The nodal forces of the pressure of a bed on a part of a cell, by the cell's own rule.
class PressureForces {
 public:
  PressureForces(const Solved& solved, std::size_t cell, std::size_t obstacle)
      : solved_(solved), cell_(cell), obstacle_(obstacle) {}

  element::CellField operator()(const element::CellPart& part) const {
    const assembly::DiscreteShell& discrete = solved_.discrete;
    const energy::ShellOperator& shell = discrete.shell;
    std::vector<Eigen::Vector2d> xi = shell.tables().quadrature.xi;
    for (Eigen::Vector2d& point : xi) point = part.corner + part.size * point;
    const element::BasisAt at = element::basis_at(shell.space().shape(), shell.space().degree, xi);
    const CellGaps gaps = cell_gaps(solved_, cell_, obstacle_, at);
    element::CellField forces(gaps.values.size(), 6);
    for (Eigen::Index q = 0; q < forces.rows(); ++q) {
      const auto p = static_cast<std::size_t>(q);
      const obstacle::Gap& gap = gaps.rows[p];
      const double force = shell.tables().weights[p] * part.size * part.size * gaps.frames[p].sqrt_a *
                           discrete.obstacles.all[obstacle_].bed.pressure(-gaps.values[q]);
      const Eigen::Vector3d couple = gap.arm * discrete.turning(gap.normal, gaps.frames[p].a3);
      forces.row(q) << force * gap.normal.transpose(), force * couple.transpose();
    }
    return shell.interpolation().forces_of(cell_, at, forces);
  }

 private:
  const Solved& solved_;
  std::size_t cell_, obstacle_;
};

}  // namespace

BedQuadrature::BedQuadrature(const Solved& solved) : solved_(solved) {
  const assembly::DiscreteShell& discrete = solved.discrete;
  const auto on_bed = discrete.obstacles.on_bed();
  if (!on_bed) return;
  obstacle_ = *on_bed;
  for (std::size_t cell = 0; cell < discrete.space().owned_cells; ++cell) {
    Pressed pressed{.cell = cell, .nodal = nodal_forces(cell)};
    const PressureForces forces(solved, cell, obstacle_);
    const CellGaps gaps = cell_gaps(solved, cell, obstacle_, discrete.shell.tables().quadrature);
    if (pressed.nodal.empty() && gaps.values.minCoeff() >= 0) continue;
    pressed.has_kink = has_kink(cell, gaps.values);
    if (pressed.has_kink)
      pressed.forces =
          element::Subdivision<element::CellPart, PressureForces>(discrete.space().shape(), forces)(halvings);
    else
      pressed.forces = forces(element::CellPart{});
    pressed.resultant = pressed.forces.leftCols<3>().colwise().sum().transpose();
    for (const NodalForce& force : pressed.nodal)
      pressed.resultant -= force.size * discrete.coordinates.gaps[obstacle_][force.node].normal;
    cells_.push_back(std::move(pressed));
  }
}

// The share of a hanging node acts at its masters, that of a side of a fold at the nearest face.
std::vector<BedQuadrature::NodalForce> BedQuadrature::nodal_forces(std::size_t cell) const {
  const assembly::DiscreteShell& discrete = solved_.discrete;
  const fem::Space& space = discrete.space();
  const element::ElementTables& tables = discrete.shell.tables();
  std::vector<geometry::Frame> frames(tables.nodes.size());
  discrete.shell.surface().frames(space.cells[cell], tables.nodes, frames, false);
  constraints::RowMatrix areas(1, static_cast<Eigen::Index>(frames.size()));
  for (std::size_t i = 0; i < frames.size(); ++i)
    areas(0, static_cast<Eigen::Index>(i)) = tables.nodal_weights[i] * frames[i].sqrt_a;
  const constraints::NodeColumns own = space.continuity.on_sources(space.nodes(cell), areas);
  const constraints::NodeColumns deciding = space.kinks.on_sources(own.nodes, own.matrix);
  std::vector<NodalForce> forces;
  for (std::size_t i = 0; i < deciding.nodes.size(); ++i) {
    const auto node = static_cast<std::size_t>(deciding.nodes[i]);
    if (solved_.nodal.touching.at(node)[obstacle_] != 0)
      forces.push_back(
          {node, deciding.matrix(0, static_cast<Eigen::Index>(i)) * solved_.nodal.pressure.at(node)[obstacle_]});
  }
  return forces;
}

bool BedQuadrature::has_kink(std::size_t cell, const Eigen::VectorXd& gaps) const {
  const Bed& bed = solved_.discrete.obstacles.all[obstacle_].bed;
  const Bed::Segment* first = segment_at(bed, -gaps[0]);
  const auto is_other = [&](double closure) { return segment_at(bed, closure) != first; };
  return std::ranges::any_of(gaps, [&](double gap) { return is_other(-gap); }) ||
         std::ranges::any_of(solved_.discrete.space().nodes(cell), [&](algebra::LocalIndex node) {
           const auto i = static_cast<std::size_t>(node);
           return is_other(-solved_.discrete.nodal_gap(obstacle_, i, solved_.nodal.y));
         });
}

double BedQuadrature::add_shares(const Derivative& derivative, const DualSolution& dual, const algebra::Vector& y,
                                 std::vector<double>& cells) const {
  const assembly::DiscreteShell& discrete = solved_.discrete;
  if (!discrete.obstacles.on_bed()) return 0;
  // B z - w of a point is its opening by z and n . `away`.
  Eigen::Vector3d away = Eigen::Vector3d::Zero();
  if (!derivative.obstacle || *derivative.obstacle == obstacle_) away = derivative.force_direction;
  const std::vector<std::size_t> pressing = assembly::pressed_obstacles(discrete);
  for (std::size_t k = 0; k < pressing.size(); ++k)
    if (pressing[k] == obstacle_) away -= dual.positions.at(k) * discrete.obstacles.all[obstacle_].force.normalized();
  double squares = 0;
  for (const Pressed& pressed : cells_) {
    double exact_less_nodal =
        pressed.forces.cwiseProduct(discrete.shell.gather(pressed.cell, y)).sum() + away.dot(pressed.resultant);
    for (const NodalForce& force : pressed.nodal)
      exact_less_nodal -= force.size * opening(discrete, discrete.coordinates.gaps[obstacle_][force.node],
                                               discrete.points[force.node].a3, assembly::node_values(y, force.node));
    cells[pressed.cell] += exact_less_nodal;
    if (pressed.has_kink) squares += exact_less_nodal * exact_less_nodal;
  }
  return std::sqrt(algebra::sum_over_ranks(squares, discrete.space().layout->comm));
}

}  // namespace plastron::estimation
