// plastron plot DIR: pictures of results for papers and for use without a browser, as in report.html, and profiles
// along lines.
#include "command_line.hpp"
#include "terminal.hpp"

#include <plastron/io/plot.hpp>
#include <plastron/io/result_plots.hpp>
#include <plastron/io/results.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace plastron::app {

namespace {

namespace fs = std::filesystem;

/// Opens a file that can be read to its end: no pipe, no device.
std::ifstream opened(const fs::path& file) {
  std::error_code error;
  std::ifstream stream;
  if (fs::is_regular_file(file, error)) stream.open(file, std::ios::binary);
  if (!stream.is_open()) throw io::UnusableResults(fmt::format("{} cannot be read", file.string()));
  return stream;
}

std::string text_of_line(const fs::path& file) {
  constexpr std::uintmax_t largest = std::uintmax_t{64} << 20;
  std::ifstream stream = opened(file);
  std::error_code error;
  if (fs::file_size(file, error) > largest)
    throw io::UnusableResults(fmt::format("{} has more than {} bytes, too many for a plot", file.string(), largest));
  std::ostringstream text;
  if (!(text << stream.rdbuf())) throw io::UnusableResults(fmt::format("{} cannot be read", file.string()));
  return std::move(text).str();
}

io::Json read_results(const fs::path& directory) {
  std::error_code error;
  if (!fs::is_directory(directory, error))
    throw io::UnusableResults(
        fmt::format("{} is not a directory; give the directory that plastron run wrote", directory.string()));
  const fs::path file = directory / "results.json";
  if (!fs::exists(file, error))
    throw io::UnusableResults(
        fmt::format("{} has no results.json; give the directory that plastron run wrote", directory.string()));
  std::ifstream stream = opened(file);
  return io::parts_to_plot(stream);
}

/// Returns NAME of "line-NAME.csv", a file beside results.json; empty if it is none.
std::string line_of(const std::string& file) {
  constexpr std::string_view begin = "line-", end = ".csv";
  const bool is_line = file.starts_with(begin) && file.ends_with(end) && file.find('/') == std::string::npos;
  return is_line ? file.substr(begin.size(), file.size() - begin.size() - end.size()) : std::string();
}

std::vector<io::NamedPlot> plots_of(const fs::path& directory) {
  const io::Json results = read_results(directory);
  std::vector<io::NamedPlot> plots = io::result_plots(results);
  for (const io::Json& entry : results.at("files")) {
    const auto file = entry.get<std::string>();
    const std::string name = line_of(file);
    if (name.empty()) continue;
    for (io::NamedPlot& plot : io::line_plots(name, text_of_line(directory / file))) plots.push_back(std::move(plot));
  }
  return plots;
}

/// Makes a file of a new name, so that no link leads elsewhere. It has the access rights of other new files.
int new_file(std::string& name) {
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  constexpr mode_t readable = 0666;
  if (descriptor >= 0) ::fchmod(descriptor, readable & ~mask);
  return descriptor;
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// Writes a picture, which gets its name only when it is complete.
void write_picture(const fs::path& file, const std::string& text) {
  std::string partial = file.string() + ".partial-XXXXXX";
  const int descriptor = new_file(partial);
  const bool is_written = descriptor >= 0 && write_all(descriptor, text);
  const bool is_closed = descriptor >= 0 && ::close(descriptor) == 0;
  std::error_code error;
  if (is_written && is_closed) fs::rename(partial, file, error);
  if (is_written && is_closed && !error) return;
  if (descriptor >= 0) ::unlink(partial.c_str());
  throw io::UnusableResults(fmt::format("{} cannot be written", file.string()));
}

}  // namespace

ExitCode plot(const fs::path& directory) {
  if (!is_first_rank()) return solved;  // one process writes
  try {
    const std::vector<io::NamedPlot> plots = plots_of(directory);
    if (plots.empty())
      throw io::UnusableResults(
          fmt::format("{} has nothing to plot: a single mesh (mesh.refinements = 0), no steps and no [[line]]",
                      directory.string()));
    for (const auto& [name, plot] : plots) {
      const fs::path file = directory / (name + ".svg");
      write_picture(file, io::svg_text(plot));
      print("{}\n", file.string());
    }
    return solved;
  } catch (const io::Json::exception& error) {
    print_error("error: {} does not have the form that plastron run writes: {}\n",
                (directory / "results.json").string(), error.what());
  } catch (const io::UnusableResults& error) {
    print_error("error: {}\n", error.what());
  }
  return bad_input;
}

}  // namespace plastron::app
