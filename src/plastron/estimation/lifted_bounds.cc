#include <plastron/estimation/lifted_bounds.hpp>

namespace plastron::estimation {

LiftedBounds::LiftedBounds(const Solved& solved)
    : solved_(solved), none_(solved.box.load.layout(), solved.box.load.block()), back_(none_) {
  const assembly::DiscreteShell& discrete = solved.discrete;
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const fem::Space& space = discrete.space();
  if (!discrete.state.is_admissible()) return;
  for (const assembly::ContactRow& row : coordinates.rows) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    if (!row.binds || solved.nodal.touching.at(row.node)[k] == 0) continue;
    back_.owned()[coordinates.at(row.node, row.coordinate)] = -discrete.state.lift(row.node, k) / row.scale;
  }
  any_ = algebra::max_abs(back_) > 0;
  if (!any_) return;
  cells_of_node_ = algebra::Vector(space.layout, 1);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    for (const algebra::LocalIndex node : space.continuity.sources(space.nodes(cell)))
      cells_of_node_.local()[static_cast<std::size_t>(node)] += 1;
  cells_of_node_.accumulate_ghosts();
  cells_of_node_.update_ghosts();
}

std::vector<double> LiftedBounds::shares(const algebra::Vector& multiplier) const {
  const fem::Space& space = solved_.discrete.space();
  std::vector<double> cells(space.owned_cells, 0);
  if (!any_) return cells;
  algebra::Vector at_node(space.layout, 1);
  const auto width = static_cast<std::size_t>(back_.block());
  for (std::size_t i = 0; i < back_.owned().size(); ++i)
    at_node.owned()[i / width] -= multiplier.owned()[i] * back_.owned()[i];
  at_node.update_ghosts();
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    for (const algebra::LocalIndex index : space.continuity.sources(space.nodes(cell))) {
      const auto node = static_cast<std::size_t>(index);
      cells[cell] += at_node.local()[node] / cells_of_node_.local()[node];
    }
  return cells;
}

}  // namespace plastron::estimation
