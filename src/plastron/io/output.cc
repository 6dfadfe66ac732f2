#include <plastron/io/output.hpp>

#include <plastron/io/atomic_file.hpp>
#include <plastron/io/contact_boundary.hpp>
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
  std::vector<std::string> boundary;
  if (can_be_drawn(result, comm)) {
    provenance.files = add_vtu(*result.solution, directory, base_name, files);
    boundary = add_contact_boundary(result.summary, directory, files);
    provenance.files.insert(provenance.files.end(), boundary.begin(), boundary.end());
  }
  add_results(result, provenance, directory, files);
  files.commit();
  if (boundary.empty()) remove_contact_boundary(directory, comm);
}

}  // namespace plastron::io
