#include "reading.hpp"

#include <plastron/algebra/agreement.hpp>
#include <plastron/fem/domain.hpp>
#include <plastron/obstacle/error.hpp>

#include <mpi.h>

namespace plastron::app {

namespace {

config::Case read_together(const std::function<config::Case()>& read) {
  return algebra::in_agreement<RefusedCase>(MPI_COMM_WORLD, [&] {
    try {
      return read();
    } catch (const config::CaseErrors& errors) {
      throw RefusedCase(errors.format());
    }
  });
}

}  // namespace

config::Case read_case(const std::filesystem::path& path, std::span<const std::string> settings) {
  return read_together([&] { return config::read_case(path, settings); });
}

config::Case read_case(const std::filesystem::path& path, const std::filesystem::path& folder) {
  return read_together([&] { return config::read_case(path, folder); });
}

std::vector<examination::Finding> examine_together(
    const std::function<std::vector<examination::Finding>()>& examination) {
  return algebra::in_agreement<fem::DomainError, obstacle::ObstacleError>(MPI_COMM_WORLD, examination);
}

}  // namespace plastron::app
