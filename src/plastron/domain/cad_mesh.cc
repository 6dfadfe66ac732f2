#include <plastron/domain/cad_mesh.hpp>

#include <plastron/geometry/text_file.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

namespace plastron::domain {

namespace {

namespace fs = std::filesystem;

/// A new folder for files that are gone when it is destroyed.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "plastron-cad-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::system_error(errno, std::generic_category(), "no folder for the mesh of the part can be made");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string program() {
  if (const char* given = std::getenv("PLASTRON_CAD"); given != nullptr && *given != '\0') return given;
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  const fs::path beside = self.parent_path(), prefix = beside.parent_path();
  for (const fs::path& folder : {beside, prefix / "libexec" / "plastron", fs::path("/usr/libexec/plastron")})
    if (fs::is_regular_file(folder / "plastron-cad", error)) return (folder / "plastron-cad").string();
  return "plastron-cad";  // on the PATH
}

/// Runs the program, with its messages in a file. Returns the status of waitpid(), or nothing if there is no such program.
std::optional<int> run(std::vector<std::string> words, const std::string& messages) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t process = 0;
  const int error = posix_spawnp(&process, arguments[0], &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) return {};
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return {};
  constexpr int not_found = 127;  // of a spawned process that could not begin
  if (WIFEXITED(status) && WEXITSTATUS(status) == not_found) return {};
  return status;
}

/// The message of plastron-cad, without characters that a terminal would obey.
std::string message_in(const std::string& path) {
  std::ifstream file(path);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::erase_if(text, [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; });
  constexpr std::size_t longest = 1000;
  return text.substr(0, longest);
}

}  // namespace

FrozenMesh frozen_mesh(const MeshFile& file) {
  const auto failed = [&](std::string why) { return FrozenMesh{.failure = fmt::format("{}: {}", file.path, why)}; };
  try {
    const TemporaryFolder folder;
    const std::string mesh = folder.file("part.msh"), messages = folder.file("messages");
    const auto status = run({program(), file.path, mesh, file.cad_job}, messages);
    if (!status)
      return failed(
          "CAD files are read by the program plastron-cad, which is not there: this build of Plastron has no Open "
          "CASCADE; mesh the part with Gmsh (gmsh -2 -order 2) and give the .msh file");
    if (WIFSIGNALED(*status) && WTERMSIG(*status) == SIGALRM)
      return failed("reading and meshing the part took more than a minute; choose fewer faces or a larger size");
    if (WIFSIGNALED(*status))
      return failed(fmt::format("the CAD library ended at it (signal {}): the part is damaged; export it again",
                                WTERMSIG(*status)));
    if (WEXITSTATUS(*status) != 0) {
      const std::string message = message_in(messages);
      return failed(message.empty() ? "plastron-cad cannot mesh it and does not say why" : message);
    }
    return {.text = geometry::TextFile(mesh, "mesh of the part", geometry::Lines::end_words).text()};
  } catch (const std::exception& error) {  // of the file system
    return failed(error.what());
  }
}

}  // namespace plastron::domain
