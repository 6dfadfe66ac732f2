// All output files of a computation, in the order that makes results.json the sign of completeness.
#pragma once
#include <plastron/io/results.hpp>

namespace plastron::io {

/// Makes the directory and writes base_name.vtu and .pvd (unless there is no finite solution to draw), contact-boundary.csv and .vtu
/// (where there is contact; those of an earlier run are removed where there is none) and results.json;
/// those of an earlier run stay until all are complete, results.json is replaced last; provenance.files is filled here
/// (collective). Throws std::runtime_error.
void write_output(const computation::Result& result, Provenance provenance, const std::filesystem::path& directory,
                  const std::string& base_name, MPI_Comm comm);

}  // namespace plastron::io
