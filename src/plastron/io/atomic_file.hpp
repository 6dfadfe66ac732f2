// Files that appear under their name only when they are complete: written in a directory beside it, flushed to the disk, then renamed; several
// files that belong together only when all are complete. A killed run leaves at most a directory ".plastron-partial-*", never half a file, and
// a disk that is full costs nothing of what was there before. The next run in the same place removes what a killed one has left.
//
// Everything here is collective and fails alike on all ranks: one exception with the path and the reason of the lowest rank that failed.
#pragma once
#include <mpi.h>

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::io {

/// The system refused: the disk is full, a directory is read-only, a limit is reached. In words for the user.
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Makes the part of a file that this rank contributes.
using Piece = std::function<std::string()>;

/// Files of one directory that replace those of an earlier run together. Files that were added but not committed are removed again.
class AtomicFiles {
 public:
  explicit AtomicFiles(MPI_Comm comm) : comm_(comm) {}
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;
  ~AtomicFiles();

  /// Writes the pieces of all ranks, in the order of the ranks, into a temporary directory. The ranks must share the file system.
  void add(const std::filesystem::path& path, const Piece& piece);
  /// Gives all files their names, in the order they were added. The file called `sign`, if any, says that the others belong together: the one of
  /// an earlier run goes first, the new one comes last.
  void commit(std::string_view sign = {});
  MPI_Comm comm() const { return comm_; }

  struct File {
    std::filesystem::path path, temporary;
  };
  /// The files that were added and not committed. Complete, under their temporary paths.
  const std::vector<File>& added() const { return files_; }

 private:
  void make_temporary_directory(const std::filesystem::path& first);
  void remove_temporary_directory();

  MPI_Comm comm_;
  std::vector<File> files_{};
  std::filesystem::path temporary_{};  ///< empty before the first file
  int lock_ = -1;                      ///< on the temporary directory, of the first rank: its process lives
};

/// One file alone.
void write_atomically(const std::filesystem::path& path, const Piece& piece, MPI_Comm comm);

/// Makes a directory and those above it; no error if it is there.
void make_directory(const std::filesystem::path& directory, MPI_Comm comm);

/// Tries whether files can be written in a directory: makes it and writes one there. Leaves the directory behind, which
/// `made` lists with those above it that were not there before, but not the file. Removes temporary directories of processes that have died.
void try_directory(const std::filesystem::path& directory, MPI_Comm comm, std::vector<std::filesystem::path>& made);

/// Removes directories that are empty, the last first; those that are not stay.
void remove_empty(const std::vector<std::filesystem::path>& directories, MPI_Comm comm);

/// Removes a file; no error if it is not there.
void remove_file(const std::filesystem::path& path, MPI_Comm comm);

}  // namespace plastron::io
