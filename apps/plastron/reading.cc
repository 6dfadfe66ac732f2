#include "reading.hpp"

#include "terminal.hpp"

#include <plastron/algebra/agreement.hpp>
#include <plastron/fem/coarse_mesh.hpp>
#include <plastron/obstacle/error.hpp>

#include <mpi.h>

#include <utility>

namespace plastron::app {

namespace {

config::Case read_together(const std::function<config::Case()>& read) {
  config::Case c = algebra::in_agreement<RefusedCase>(MPI_COMM_WORLD, [&] {
    try {
      return read();
    } catch (const config::CaseErrors& errors) {
      throw RefusedCase(errors.format());
    }
  });
  set_unit_names(c.problem.output.units);
  c.problem.domain = fem::with_shared_mesh(std::move(c.problem.domain), c.problem.discretisation.cells, MPI_COMM_WORLD);
  return c;
}

// Packs findings so that the first rank can send them: for each a letter for its severity, its text and a zero.
std::string in_one_text(const std::vector<examination::Finding>& findings) {
  std::string all;
  for (const examination::Finding& finding : findings) {
    all += static_cast<char>('0' + static_cast<int>(finding.severity));
    all += finding.text;
    all += '\0';
  }
  return all;
}

std::vector<examination::Finding> from_one_text(const std::string& all) {
  std::vector<examination::Finding> findings;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = all.find('\0', at);
    findings.push_back({static_cast<examination::Severity>(all[at] - '0'), all.substr(at + 1, end - at - 1)});
    at = end + 1;
  }
  return findings;
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
  const auto mine = algebra::in_agreement<fem::DomainError, obstacle::ObstacleError>(
      MPI_COMM_WORLD, [&] { return is_first_rank() ? examination() : std::vector<examination::Finding>{}; });
  return from_one_text(algebra::first_words(in_one_text(mine), MPI_COMM_WORLD));
}

}  // namespace plastron::app
