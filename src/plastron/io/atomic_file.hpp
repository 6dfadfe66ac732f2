// Files that appear under their name only when they are complete: written under another name in the same directory,
// flushed to the disk, then renamed; several files that belong together only when all are complete. A killed run leaves at
// most "*.partial" files, never half a result, and a disk that is full costs nothing of what was there before.
//
// Everything here is collective and fails alike on all ranks: one std::runtime_error with the path and the reason of
// the lowest rank that failed.
#pragma once
#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace plastron::io {

/// Makes the part of a file that this rank contributes.
using Piece = std::function<std::string()>;

/// Files that replace those of an earlier run together. What was added but not committed is removed again.
class AtomicFiles {
 public:
  explicit AtomicFiles(MPI_Comm comm) : comm_(comm) {}
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;
  ~AtomicFiles();

  /// Writes the pieces of all ranks, in the order of the ranks, under a temporary name. The ranks must share the file system.
  void add(const std::filesystem::path& path, const Piece& piece);
  /// Gives all files their names, in the order they were added.
  void commit();
  MPI_Comm comm() const { return comm_; }

 private:
  struct File {
    std::filesystem::path path, temporary;
  };
  MPI_Comm comm_;
  std::vector<File> files_{};
};

/// One file alone.
void write_atomically(const std::filesystem::path& path, const Piece& piece, MPI_Comm comm);

/// Makes a directory and those above it; no error if it is there.
void make_directory(const std::filesystem::path& directory, MPI_Comm comm);

/// Tries whether files can be written in a directory: makes it and writes one there. Leaves the directory behind, which
/// `made` lists with those above it that were not there before, but not the file.
void try_directory(const std::filesystem::path& directory, MPI_Comm comm, std::vector<std::filesystem::path>& made);

/// Removes directories that are empty, the last first; those that are not stay.
void remove_empty(const std::vector<std::filesystem::path>& directories, MPI_Comm comm);

/// Removes a file; no error if it is not there.
void remove_file(const std::filesystem::path& path, MPI_Comm comm);

}  // namespace plastron::io
