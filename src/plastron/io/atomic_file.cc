#include <plastron/algebra/agreement.hpp>
#include <plastron/io/atomic_file.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace plastron::io {

namespace {

int rank_in(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

/// Does a step of the work on `path` on every rank; if it throws on one, all ranks throw.
template <class Step>
void together(std::string_view what, const std::filesystem::path& path, MPI_Comm comm, const Step& step) {
  std::string reason;
  try {
    step();
  } catch (const std::system_error& e) {
    reason = e.code().message();
  } catch (const std::exception& e) {
    reason = e.what();
    if (reason.empty()) reason = "unknown error";
  }
  reason = algebra::first_words(std::move(reason), comm);
  if (!reason.empty()) throw std::runtime_error(fmt::format("cannot {} \"{}\": {}", what, path.string(), reason));
}

[[noreturn]] void throw_errno() { throw std::system_error(errno, std::generic_category()); }

class OpenFile {
 public:
  OpenFile(const std::filesystem::path& path, int flags) : descriptor_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) throw_errno();
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  void write(std::string_view text, std::int64_t offset) const {
    while (!text.empty()) {
      const ssize_t count = ::pwrite(descriptor_, text.data(), text.size(), offset);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) throw_errno();
      text.remove_prefix(static_cast<std::size_t>(count));
      offset += count;
    }
  }
  void flush() const {
    // Some file systems (pipes, a few network ones) cannot flush and say EINVAL: nothing is lost then.
    if (::fsync(descriptor_) != 0 && errno != EINVAL) throw_errno();
  }
  /// Network file systems report some failed writes only here.
  void close() {
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0 && errno != EINTR) throw_errno();
  }

 private:
  int descriptor_;
};

/// The same on every rank; two runs in one directory do not meet.
std::filesystem::path temporary_name(const std::filesystem::path& path, MPI_Comm comm) {
  auto process = static_cast<std::int64_t>(::getpid());
  MPI_Bcast(&process, 1, MPI_INT64_T, 0, comm);
  return path.parent_path() / fmt::format("{}.{}.partial", path.filename().string(), process);
}

std::int64_t offset_of(std::int64_t size, MPI_Comm comm) {
  std::int64_t offset = 0;
  MPI_Exscan(&size, &offset, 1, MPI_INT64_T, MPI_SUM, comm);
  return rank_in(comm) == 0 ? 0 : offset;  // Exscan leaves rank 0's result undefined
}

void flush_directory_of(const std::filesystem::path& path) {
  const auto directory = path.parent_path();
  OpenFile(directory.empty() ? "." : directory, O_RDONLY | O_DIRECTORY)
      .flush();  // the new name, too, survives a power cut
}

/// Directories that stand in the way are found before the first file is replaced.
void check_replaceable(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) throw std::system_error(std::make_error_code(std::errc::is_a_directory));
}

}  // namespace

void AtomicFiles::add(const std::filesystem::path& path, const Piece& piece) {
  constexpr std::string_view what = "write";
  const bool root = rank_in(comm_) == 0;
  std::string text;
  together(what, path, comm_, [&] { text = piece(); });
  const std::int64_t offset = offset_of(static_cast<std::int64_t>(text.size()), comm_);
  files_.push_back({path, temporary_name(path, comm_)});
  const std::filesystem::path& temporary = files_.back().temporary;
  together(what, path, comm_, [&] {
    if (root) OpenFile(temporary, O_WRONLY | O_CREAT | O_TRUNC).close();
  });
  together(what, path, comm_, [&] {
    OpenFile file(temporary, O_WRONLY);
    file.write(text, offset);
    file.flush();
    file.close();
  });
}

void AtomicFiles::commit() {
  const bool root = rank_in(comm_) == 0;
  for (const File& file : files_)
    together("write", file.path, comm_, [&] {
      if (root) check_replaceable(file.path);
    });
  for (const File& file : files_)
    together("write", file.path, comm_, [&] {
      if (root) std::filesystem::rename(file.temporary, file.path);
    });
  const std::vector<File> done = std::move(files_);
  files_.clear();
  for (const File& file : done)
    together("write", file.path, comm_, [&] {
      if (root) flush_directory_of(file.path);
    });
}

AtomicFiles::~AtomicFiles() {
  std::error_code ignored;  // the first error is the one to tell
  if (rank_in(comm_) == 0)
    for (const File& file : files_) std::filesystem::remove(file.temporary, ignored);
}

void write_atomically(const std::filesystem::path& path, const Piece& piece, MPI_Comm comm) {
  AtomicFiles one(comm);
  one.add(path, piece);
  one.commit();
}

void try_directory(const std::filesystem::path& directory, MPI_Comm comm, std::vector<std::filesystem::path>& made) {
  together("make the directory", directory, comm, [&] {
    for (auto above = directory; !above.empty() && !std::filesystem::exists(above); above = above.parent_path()) {
      made.insert(made.begin(), above);
      if (above == above.parent_path()) break;
    }
  });
  make_directory(directory, comm);
  // Enough to be refused by a disk that is full: one block may lie ready in the directory's own.
  constexpr std::size_t some = 1 << 16;
  {
    AtomicFiles attempt(comm);
    attempt.add(directory / ".plastron-may-write", [&] { return std::string(rank_in(comm) == 0 ? some : 0, '\n'); });
  }
  MPI_Barrier(comm);  // the attempt is gone when any rank returns
}

void remove_empty(const std::vector<std::filesystem::path>& directories, MPI_Comm comm) {
  const std::vector<std::filesystem::path> from_inside(directories.rbegin(), directories.rend());
  if (rank_in(comm) == 0)
    for (const auto& directory : from_inside) ::rmdir(directory.c_str());
  MPI_Barrier(comm);  // they are gone when any rank returns
}

void make_directory(const std::filesystem::path& directory, MPI_Comm comm) {
  together("make the directory", directory, comm, [&] {
    if (rank_in(comm) == 0) std::filesystem::create_directories(directory);
  });
}

void remove_file(const std::filesystem::path& path, MPI_Comm comm) {
  together("remove", path, comm, [&] {
    if (rank_in(comm) == 0) std::filesystem::remove(path);
  });
}

}  // namespace plastron::io
