// Files that appear under their name only when they are complete: written under another name in the same directory,
// flushed to the disk, then renamed. A killed run leaves at most a "*.partial" file, never half a result.
//
// Everything here is collective and fails alike on all ranks: one std::runtime_error with the path and the reason of
// the lowest rank that failed.
#pragma once
#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>

namespace plastron::io {

/// Makes the part of a file that this rank contributes.
using Piece = std::function<std::string()>;

/// Writes the pieces of all ranks, in the order of the ranks, as one file. The ranks must share the file system.
void write_atomically(const std::filesystem::path& path, const Piece& piece, MPI_Comm comm);

/// Makes a directory and those above it; no error if it is there.
void make_directory(const std::filesystem::path& directory, MPI_Comm comm);

/// Removes a file; no error if it is not there.
void remove_file(const std::filesystem::path& path, MPI_Comm comm);

}  // namespace plastron::io
