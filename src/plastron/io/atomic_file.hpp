// Files that get their name only when they are complete. They are written in a directory beside their place, flushed to
// the disk, then renamed. Several files that belong together are renamed only when all are complete. A killed run
// leaves at most a directory ".plastron-partial-*", never half a file. On a full disk, earlier files stay. The next run
// in the same place removes the directories of killed runs.
//
// Everything here is collective and fails on all ranks together: one exception with the path and the reason of the
// lowest rank that failed.
#pragma once
#include <mpi.h>

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::io {

/// Refusal by the system: the disk is full, a directory is read-only, a limit is reached. In words for the user.
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Makes the part of a file that this rank contributes.
using Piece = std::function<std::string()>;

/// Files of one directory that together replace the files of an earlier run. Files that were added but not committed
/// are removed again.
class AtomicFiles {
 public:
  explicit AtomicFiles(MPI_Comm comm) : comm_(comm) {}
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;
  ~AtomicFiles();

  /// Writes the pieces of all ranks, in the order of the ranks, into a temporary directory. The ranks must share the
  /// file system.
  void add(const std::filesystem::path& path, const Piece& piece);
  /// Writes a text that the first rank makes.
  void add_text(const std::filesystem::path& path, const Piece& text);
  /// Removes the files that were added after the first `count` ones (collective).
  void keep_first(std::size_t count);
  /// Gives all files their names, in the order of their addition. The file called `sign`, if any, shows that the others
  /// belong together. The `sign` of an earlier run is removed first, the new one is named last.
  void commit(std::string_view sign = {});
  MPI_Comm comm() const { return comm_; }

  struct File {
    std::filesystem::path path, temporary;
  };
  /// The files that were added and not committed. They are complete, under their temporary paths.
  const std::vector<File>& added() const { return files_; }

 private:
  void make_temporary_directory(const std::filesystem::path& first);
  void remove_temporary_directory();

  MPI_Comm comm_;
  std::vector<File> files_{};
  std::filesystem::path temporary_{};  ///< empty before the first file
  int lock_ = -1;  ///< the first rank's lock on the temporary directory; it shows that the process is running
};

/// Makes a directory and its parent directories; no error if it exists.
void make_directory(const std::filesystem::path& directory, MPI_Comm comm);

/// Tests whether files can be written in a directory: makes it and writes one there. Removes the file again, but not
/// the directory. `made` lists the directory and its parents that did not exist before. Removes temporary directories
/// of processes that have died.
void try_directory(const std::filesystem::path& directory, MPI_Comm comm, std::vector<std::filesystem::path>& made);

/// Removes empty directories, the last first; others stay.
void remove_empty(const std::vector<std::filesystem::path>& directories, MPI_Comm comm);

/// Removes a file; no error if it does not exist.
void remove_file(const std::filesystem::path& path, MPI_Comm comm);

/// Removes the files of a directory whose names are chosen; the first rank chooses.
void remove_files(const std::filesystem::path& directory, MPI_Comm comm,
                  const std::function<bool(const std::string&)>& is_chosen);

}  // namespace plastron::io
