#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/vector.hpp>
#include <plastron/io/atomic_file.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

namespace plastron::io {

namespace {

/// Runs a step on `path` on every rank. If it throws on one rank, all ranks throw.
template <class Step>
void together(std::string_view what, const std::filesystem::path& path, MPI_Comm comm, const Step& step) {
  std::string reason;
  int refused = 0;
  try {
    step();
  } catch (const std::system_error& e) {
    reason = e.code().message();
    refused = 1;
  } catch (const std::exception& e) {
    reason = e.what();
    if (reason.empty()) reason = "unknown error";
  }
  reason = algebra::first_words(std::move(reason), comm);
  if (reason.empty()) return;
  MPI_Allreduce(MPI_IN_PLACE, &refused, 1, MPI_INT, MPI_MAX, comm);
  const std::string message = fmt::format("cannot {} \"{}\": {}", what, path.string(), reason);
  if (refused != 0) throw WriteError(message);
  throw std::runtime_error(message);
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
    // Some file systems (pipes, a few network ones) cannot flush and return EINVAL: nothing is lost then.
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

constexpr std::string_view temporary_prefix = ".plastron-partial-";

/// An open directory, locked unless another process has the lock. It does not follow a link. Without a lock, the
/// directory does not count as abandoned.
class LockedDirectory {
 public:
  explicit LockedDirectory(const std::filesystem::path& directory)
      : descriptor_(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)) {
    struct stat state {};
    if (descriptor_ < 0) return;
    is_locked_ = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    is_taken_ = (!is_locked_ && errno == EWOULDBLOCK) || ::fstat(descriptor_, &state) != 0 || state.st_nlink == 0;
  }
  LockedDirectory(const LockedDirectory&) = delete;
  LockedDirectory& operator=(const LockedDirectory&) = delete;
  ~LockedDirectory() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  /// Whether its process has died.
  bool is_abandoned() const { return is_locked_ && !is_taken_; }
  /// Returns the descriptor, which stays open and therefore locked.
  int release() { return is_taken_ ? -1 : std::exchange(descriptor_, -1); }

 private:
  int descriptor_;
  bool is_locked_ = false, is_taken_ = false;
};

/// Removes the files in a temporary directory, and the directory. It contains no directories.
void remove_temporary(const std::filesystem::path& directory) {
  std::error_code ignored;  // the caller reports the first error
  for (std::filesystem::directory_iterator entry(directory, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    ::unlink(entry->path().c_str());
  ::rmdir(directory.c_str());
}

void remove_temporaries_of_dead(const std::filesystem::path& directory) {
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(directory, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    if (!entry->path().filename().string().starts_with(temporary_prefix)) continue;
    const LockedDirectory directory_of_dead(entry->path());
    if (directory_of_dead.is_abandoned()) remove_temporary(entry->path());
  }
}

/// Makes a new directory with a unique name, so that two runs in one place do not conflict and no link can exist there.
std::pair<std::filesystem::path, int> new_temporary(const std::filesystem::path& beside) {
  constexpr int most_attempts = 10;  // another process may take a directory that is not yet locked for an abandoned one
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    std::string name = (beside / (std::string(temporary_prefix) + "XXXXXX")).string();
    if (::mkdtemp(name.data()) == nullptr) throw_errno();
    const int lock = LockedDirectory(name).release();
    if (lock >= 0) return {name, lock};
    ::rmdir(name.c_str());
  }
  throw std::runtime_error("another program keeps removing the temporary directory");
}

std::int64_t offset_of(std::int64_t size, MPI_Comm comm) {
  std::int64_t offset = 0;
  MPI_Exscan(&size, &offset, 1, MPI_INT64_T, MPI_SUM, comm);
  return algebra::rank_in(comm) == 0 ? 0 : offset;  // Exscan leaves rank 0's result undefined
}

void flush_directory_of(const std::filesystem::path& path) {
  const auto directory = path.parent_path();
  OpenFile(directory.empty() ? "." : directory, O_RDONLY | O_DIRECTORY)
      .flush();  // the new name also survives a power failure
}

/// Finds directories in place of a file before the first file is replaced.
void check_replaceable(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) throw std::system_error(std::make_error_code(std::errc::is_a_directory));
}

}  // namespace

void AtomicFiles::make_temporary_directory(const std::filesystem::path& first) {
  std::string name;
  together("write", first, comm_, [&] {
    if (algebra::rank_in(comm_) == 0) std::tie(temporary_, lock_) = new_temporary(first.parent_path());
    name = temporary_.string();
  });
  temporary_ = algebra::first_words(name, comm_);
}

void AtomicFiles::remove_temporary_directory() {
  if (algebra::rank_in(comm_) == 0 && !temporary_.empty()) {
    remove_temporary(temporary_);
    ::close(lock_);
  }
  temporary_.clear();
}

void AtomicFiles::add(const std::filesystem::path& path, const Piece& piece) {
  constexpr std::string_view what = "write";
  const bool root = algebra::rank_in(comm_) == 0;
  std::string text;
  together(what, path, comm_, [&] { text = piece(); });
  const std::int64_t offset = offset_of(static_cast<std::int64_t>(text.size()), comm_);
  if (temporary_.empty()) make_temporary_directory(path);
  PLASTRON_ASSERT(path.parent_path() == temporary_.parent_path(), path.string(), temporary_.string());
  files_.push_back({path, temporary_ / path.filename()});
  const std::filesystem::path& temporary = files_.back().temporary;
  together(what, path, comm_, [&] {
    if (root) OpenFile(temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW).close();
  });
  together(what, path, comm_, [&] {
    OpenFile file(temporary, O_WRONLY | O_NOFOLLOW);
    file.write(text, offset);
    file.flush();
    file.close();
  });
}

void AtomicFiles::add_text(const std::filesystem::path& path, const Piece& text) {
  add(path, [&] { return algebra::rank_in(comm_) == 0 ? text() : std::string(); });
}

void AtomicFiles::keep_first(std::size_t count) {
  std::error_code ignored;  // what is left disappears with the temporary directory
  for (std::size_t i = count; i < files_.size() && algebra::rank_in(comm_) == 0; ++i)
    std::filesystem::remove(files_[i].temporary, ignored);
  files_.resize(std::min(count, files_.size()));
  MPI_Barrier(comm_);  // the files are removed when any rank returns
}

void AtomicFiles::commit(std::string_view sign) {
  const auto on_first = [this](const File& file, const auto& step) {
    together("write", file.path, comm_, [&] {
      if (algebra::rank_in(comm_) == 0) step();
    });
  };
  std::stable_partition(files_.begin(), files_.end(), [&](const File& file) { return file.path.filename() != sign; });
  for (const File& file : files_) on_first(file, [&] { check_replaceable(file.path); });
  if (!sign.empty())
    on_first(files_.back(), [&] {
      std::filesystem::remove(files_.back().path);
      flush_directory_of(files_.back().path);
    });
  for (const File& file : files_)
    on_first(file, [&] {
      if (&file == &files_.back()) flush_directory_of(file.path);
      std::filesystem::rename(file.temporary, file.path);
    });
  if (!files_.empty()) on_first(files_.back(), [&] { flush_directory_of(files_.back().path); });
  files_.clear();
  remove_temporary_directory();
}

AtomicFiles::~AtomicFiles() { remove_temporary_directory(); }

void try_directory(const std::filesystem::path& directory, MPI_Comm comm, std::vector<std::filesystem::path>& made) {
  together("make the directory", directory, comm, [&] {
    for (auto above = directory; !above.empty() && !std::filesystem::exists(above); above = above.parent_path()) {
      made.insert(made.begin(), above);
      if (above == above.parent_path()) break;
    }
  });
  make_directory(directory, comm);
  if (algebra::rank_in(comm) == 0) remove_temporaries_of_dead(directory);
  // Large enough to fail on a full disk: one block may already be allocated in the directory.
  constexpr std::size_t some = 1 << 16;
  {
    AtomicFiles attempt(comm);
    attempt.add(directory / ".plastron-may-write",
                [&] { return std::string(algebra::rank_in(comm) == 0 ? some : 0, '\n'); });
  }
  MPI_Barrier(comm);  // the file is removed when any rank returns
}

void remove_empty(const std::vector<std::filesystem::path>& directories, MPI_Comm comm) {
  const std::vector<std::filesystem::path> from_inside(directories.rbegin(), directories.rend());
  if (algebra::rank_in(comm) == 0)
    for (const auto& directory : from_inside) ::rmdir(directory.c_str());
  MPI_Barrier(comm);  // they are removed when any rank returns
}

void make_directory(const std::filesystem::path& directory, MPI_Comm comm) {
  together("make the directory", directory, comm, [&] {
    if (algebra::rank_in(comm) == 0) std::filesystem::create_directories(directory);
  });
}

void remove_file(const std::filesystem::path& path, MPI_Comm comm) {
  together("remove", path, comm, [&] {
    if (algebra::rank_in(comm) == 0) std::filesystem::remove(path);
  });
}

void remove_files(const std::filesystem::path& directory, MPI_Comm comm,
                  const std::function<bool(const std::string&)>& is_chosen) {
  together("remove files from", directory, comm, [&] {
    if (algebra::rank_in(comm) != 0) return;
    std::vector<std::filesystem::path> chosen;
    for (const auto& entry : std::filesystem::directory_iterator(directory))
      if (entry.is_regular_file() && is_chosen(entry.path().filename().string())) chosen.push_back(entry.path());
    for (const auto& path : chosen) std::filesystem::remove(path);
  });
}

}  // namespace plastron::io
