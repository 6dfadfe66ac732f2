#include "reading.hpp"

#include <plastron/algebra/agreement.hpp>
#include <plastron/fem/domain.hpp>
#include <plastron/obstacle/error.hpp>

#include <mpi.h>

namespace plastron::app {

config::Case read_case(const std::filesystem::path& path) { return read_case(path, path.parent_path()); }

config::Case read_case(const std::filesystem::path& path, const std::filesystem::path& folder) {
  return algebra::in_agreement<RefusedCase>(MPI_COMM_WORLD, [&] {
    try {
      return config::read_case(path, folder);
    } catch (const config::CaseErrors& errors) {
      throw RefusedCase(errors.format());
    }
  });
}

std::vector<examination::Finding> examine_together(
    const std::function<std::vector<examination::Finding>()>& examination) {
  return algebra::in_agreement<fem::DomainError, obstacle::ObstacleError>(MPI_COMM_WORLD, examination);
}

}  // namespace plastron::app
