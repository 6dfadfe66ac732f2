#include <plastron/estimation/cell_gaps.hpp>

namespace plastron::estimation {

double opening(const assembly::DiscreteShell& discrete, const obstacle::Gap& gap, const Eigen::Vector3d& a3,
               const assembly::Vector6& motion) {
  return gap.normal.dot(motion.head<3>()) + gap.arm * gap.normal.dot(discrete.turning(motion.tail<3>(), a3));
}

Eigen::VectorXd openings(const Solved& solved, std::size_t cell, const CellGaps& gaps, const element::BasisAt& at,
                         const algebra::Vector& y) {
  const energy::ShellOperator& shell = solved.discrete.shell;
  const element::CellField motion = shell.interpolation().values(cell, at, shell.gather(cell, y));
  Eigen::VectorXd result(motion.rows());
  for (Eigen::Index p = 0; p < result.size(); ++p)
    result[p] = opening(solved.discrete, gaps.rows[static_cast<std::size_t>(p)],
                        gaps.frames[static_cast<std::size_t>(p)].a3, motion.row(p).transpose());
  return result;
}

CellGaps cell_gaps(const Solved& solved, std::size_t cell, std::size_t obstacle, const element::BasisAt& at) {
  const assembly::DiscreteShell& discrete = solved.discrete;
  const energy::ShellOperator& shell = discrete.shell;
  const fem::Cell& place = discrete.space().cells[cell];
  CellGaps result{.rows = {}, .frames = std::vector<geometry::Frame>(at.xi.size())};
  std::vector<double> e(at.xi.size());
  shell.surface().frames(place, at.xi, result.frames, false);
  shell.surface().evaluate(shell.section(cell).thickness, place, at.xi, e);
  const element::CellField moved = discrete.state_values(cell, at);
  for (std::size_t p = 0; p < e.size(); ++p)
    result.rows.push_back(
        discrete.gap(obstacle, discrete.shell_point(result.frames[p].phi, result.frames[p].a3, e[p],
                                                    moved.row(static_cast<Eigen::Index>(p)).transpose())));
  result.values = openings(solved, cell, result, at, solved.nodal.y);
  for (std::size_t p = 0; p < e.size(); ++p) result.values[static_cast<Eigen::Index>(p)] += result.rows[p].initial;
  return result;
}

}  // namespace plastron::estimation
