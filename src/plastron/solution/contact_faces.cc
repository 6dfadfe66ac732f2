#include <plastron/solution/contact_faces.hpp>

#include <plastron/constraints/map.hpp>

namespace plastron::solution {

namespace {

/// Copies the values of deciding nodes to all sides of their folds, and keeps those of the nearest faces.
void keep_nearest(const assembly::DiscreteShell& discrete, algebra::Vector& values) {
  discrete.space().kinks.apply(values);
  const auto nearest = discrete.coordinates.nearest_faces.local();
  for (std::size_t i = 0; i < nearest.size(); ++i) values.local()[i] *= nearest[i];
}

}  // namespace

void give_to_faces(const assembly::DiscreteShell& discrete, algebra::Vector& density) {
  const algebra::Vector& nearest = discrete.coordinates.nearest_faces;
  if (!nearest.layout()) return;
  algebra::Vector areas = nearest;  // of the nearest faces
  const auto block = static_cast<std::size_t>(areas.block());
  for (std::size_t at = 0; at < areas.local().size(); ++at)
    areas.local()[at] *= discrete.points[at / block].side_weight;
  discrete.space().kinks.apply_transposed(areas);
  areas.update_ghosts();
  for (std::size_t at = 0; at < areas.local().size(); ++at)
    if (areas.local()[at] > 0) density.local()[at] *= discrete.points[at / block].weight / areas.local()[at];
  keep_nearest(discrete, density);
}

ContactFaces contact_faces(const assembly::DiscreteShell& discrete, const NodalSolution& solution) {
  ContactFaces faces{.touching = solution.touching, .pressure = solution.pressure};
  if (!discrete.coordinates.nearest_faces.layout()) return faces;
  keep_nearest(discrete, faces.touching);
  give_to_faces(discrete, faces.pressure);
  return faces;
}

}  // namespace plastron::solution
