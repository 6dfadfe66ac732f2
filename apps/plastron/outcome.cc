#include "outcome.hpp"

#include <plastron/io/atomic_file.hpp>

#include <stdexcept>

namespace plastron::app {

OutputDirectory::OutputDirectory(const std::filesystem::path& directory) {
  try {
    io::try_directory(directory, MPI_COMM_WORLD, made_);
  } catch (const std::runtime_error& error) {
    obstacle_ = error.what();
  }
}

OutputDirectory::~OutputDirectory() { io::remove_empty(made_, MPI_COMM_WORLD); }

}  // namespace plastron::app
