#include "outcome.hpp"

#include <plastron/io/atomic_file.hpp>
#include <plastron/io/output.hpp>

#include <stdexcept>

namespace plastron::app {

OutputDirectory::OutputDirectory(const std::filesystem::path& directory) {
  try {
    io::try_directory(directory, MPI_COMM_WORLD, made_);
  } catch (const std::runtime_error& error) {
    obstacle_ = error.what();
  }
}

OutputDirectory::OutputDirectory(const std::filesystem::path& directory,
                                 const std::vector<std::filesystem::path>& inputs)
    : OutputDirectory(directory) {
  if (!obstacle_.empty()) return;
  try {
    io::check_replaceable(directory, base_name, inputs, MPI_COMM_WORLD);
  } catch (const std::runtime_error& error) {
    obstacle_ = error.what();
  }
}

OutputDirectory::~OutputDirectory() { io::remove_empty(made_, MPI_COMM_WORLD); }

}  // namespace plastron::app
