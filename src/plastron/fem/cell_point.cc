#include <plastron/fem/cell_point.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/fem/surface.hpp>

#include <limits>
#include <stdexcept>

namespace plastron::fem {

std::optional<CellPoint> cell_point(const Space& space, const Vector2d& at) {
  const auto location = locate(*space.coarse, at);
  if (!location) throw std::logic_error("a point lies outside of the domain");  // names of points were checked before
  std::optional<CellPoint> point;
  for (std::size_t c = 0; c < space.owned_cells && !point; ++c)
    if (const auto xi = local_coordinates(space.shape(), space.cells[c], *location)) point = CellPoint{c, *xi};
  const int rank = algebra::rank_in(space.layout->comm);
  const double first = algebra::min_over_ranks(point ? rank : std::numeric_limits<double>::max(), space.layout->comm);
  if (first != rank) point.reset();
  return point;
}

}  // namespace plastron::fem
