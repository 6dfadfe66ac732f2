#include <plastron/workflow/output_directory.hpp>

#include <plastron/workflow/output.hpp>

#include <stdexcept>

namespace plastron::workflow {

OutputDirectory::OutputDirectory(const std::filesystem::path& directory, MPI_Comm comm) : comm_(comm) {
  try {
    io::try_directory(directory, comm, made_);
  } catch (const std::runtime_error& error) {
    obstacle_ = error.what();
  }
}

OutputDirectory::OutputDirectory(const std::filesystem::path& directory,
                                 const std::vector<std::filesystem::path>& inputs, MPI_Comm comm)
    : OutputDirectory(directory, comm) {
  if (!obstacle_.empty()) return;
  try {
    check_replaceable(directory, base_name, inputs, comm);
  } catch (const std::runtime_error& error) {
    obstacle_ = error.what();
  }
}

OutputDirectory::~OutputDirectory() { io::remove_empty(made_, comm_); }

}  // namespace plastron::workflow
