#include <plastron/io/output.hpp>

#include <plastron/io/atomic_file.hpp>
#include <plastron/io/solution_file.hpp>
#include <plastron/io/vtu.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::io {

namespace {

/// A singular system leaves displacements that no viewer can show.
bool can_be_drawn(const computation::Result& result, MPI_Comm comm) {
  if (!result.solution) return false;
  const auto y = result.solution->nodal.y.owned();
  const bool finite = std::all_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); });
  return algebra::sum_over_ranks(static_cast<std::int64_t>(finite ? 0 : 1), comm) == 0;
}

}  // namespace

void write_output(const computation::Result& result, Provenance provenance, const std::filesystem::path& directory,
                  const std::string& base_name, MPI_Comm comm) {
  make_directory(directory, comm);
  AtomicFiles files(comm);
  provenance.files.clear();
  if (can_be_drawn(result, comm)) {
    provenance.files = add_vtu(*result.solution, directory, base_name, files);
    provenance.solution = base_name + ".plastron";
    provenance.files.push_back(provenance.solution);
    add_solution(*result.solution, directory / provenance.solution, files);
  }
  if (provenance.source) {
    provenance.case_copy = base_name + ".case.toml";
    provenance.files.push_back(provenance.case_copy);
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    files.add(directory / provenance.case_copy, [&] { return rank == 0 ? provenance.source->text : std::string(); });
  }
  add_results(result, provenance, directory, files);
  files.commit();
}

}  // namespace plastron::io
