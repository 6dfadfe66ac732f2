#include <plastron/computation/probes.hpp>

#include <plastron/algebra/agreement.hpp>

#include <fmt/format.h>

#include <limits>

namespace plastron::computation {

namespace {

/// The values on this rank, if one of its cells holds the point.
std::optional<certificate::PointValues> local_values(const Solution& solution, const fem::Location& location) {
  const fem::Space& space = solution.discrete->space();
  for (std::size_t c = 0; c < space.owned_cells; ++c)
    if (const auto xi = fem::local_coordinates(space.shape(), space.cells[c], location))
      return certificate::Recovery(*solution.discrete, solution.nodal, {*xi})(c).front();
  return std::nullopt;
}

}  // namespace

std::vector<ProbeValue> probe(const Solution& solution, const std::vector<Probe>& probes) {
  const fem::Space& space = solution.discrete->space();
  const MPI_Comm comm = space.layout->comm;
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::vector<ProbeValue> values;
  for (const Probe& p : probes) {
    const auto location = fem::locate(*space.coarse, p.at);
    if (!location)
      throw fem::DomainError(
          fmt::format("the probe \"{}\" at ({:g}, {:g}) lies outside of the domain", p.name, p.at[0], p.at[1]));
    auto found = algebra::in_agreement(comm, [&] { return local_values(solution, *location); });
    // The lowest rank that holds the point tells the others. PointValues is all doubles.
    int owner = found ? rank : std::numeric_limits<int>::max();
    MPI_Allreduce(MPI_IN_PLACE, &owner, 1, MPI_INT, MPI_MIN, comm);
    certificate::PointValues shared = found.value_or(certificate::PointValues{});
    MPI_Bcast(&shared, sizeof shared / sizeof(double), MPI_DOUBLE, owner, comm);
    values.push_back({p.name, shared});
  }
  return values;
}

}  // namespace plastron::computation
