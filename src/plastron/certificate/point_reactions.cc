#include <plastron/certificate/point_reactions.hpp>

namespace plastron::certificate {

std::vector<std::pair<std::size_t, std::size_t>> point_nodes(const assembly::DiscreteShell& discrete) {
  std::vector<std::pair<std::size_t, std::size_t>> all;
  const auto points = discrete.support_points();
  for (std::size_t k = 0; k < points.size(); ++k)
    for (const auto node : assembly::owned_nodes_at(discrete.space(), discrete.points, points[k]))
      all.emplace_back(k, static_cast<std::size_t>(node));
  return all;
}

std::vector<PointReaction> point_reactions(const assembly::DiscreteShell& discrete,
                                           const std::map<std::size_t, Vector3d>& at_nodes) {
  std::vector<PointReaction> reactions;
  for (const Eigen::Vector2d& x : discrete.support_points()) reactions.push_back({.at = x});
  for (const auto& [support, node] : point_nodes(discrete)) reactions[support].force += at_nodes.at(node);
  for (PointReaction& reaction : reactions)
    for (double& component : reaction.force)
      component = algebra::sum_over_ranks(component, discrete.space().layout->comm);
  return reactions;
}

double load_norms(const assembly::DiscreteShell& discrete, double size) {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> load(discrete.load.local().data() + 6 * i);
    sum += load.head<3>().norm() + load.tail<3>().norm() / size;
  }
  return algebra::sum_over_ranks(sum, discrete.space().layout->comm);
}

}  // namespace plastron::certificate
