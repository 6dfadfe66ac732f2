// plastron plot DIR: pictures of results for papers and for those without a browser, as report.html has them, and profiles along lines.
#include "inquiries.hpp"
#include "terminal.hpp"

#include <plastron/io/line_plots.hpp>
#include <plastron/io/plot.hpp>
#include <plastron/io/unusable_results.hpp>

#include <fstream>
#include <sstream>

namespace plastron::app {

namespace {

namespace fs = std::filesystem;

std::string text_of_results(const fs::path& file) {
  std::error_code error;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !fs::is_regular_file(file, error) || !(text << stream.rdbuf()))
    throw io::UnusableResults(fmt::format("{} cannot be read", file.string()));
  return std::move(text).str();
}

io::Json read_results(const fs::path& directory) {
  std::error_code error;
  if (!fs::is_directory(directory, error))
    throw io::UnusableResults(
        fmt::format("{} is no directory; name one that plastron run wrote to", directory.string()));
  const fs::path file = directory / "results.json";
  if (!fs::exists(file, error))
    throw io::UnusableResults(
        fmt::format("{} has no results.json; name a directory that plastron run wrote to", directory.string()));
  return io::Json::parse(text_of_results(file));
}

/// NAME of "line-NAME.csv", a file beside results.json; empty where it is none.
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
    for (io::NamedPlot& plot : io::line_plots(name, text_of_results(directory / file)))
      plots.push_back(std::move(plot));
  }
  return plots;
}

/// Under its name only when it is complete.
void write_picture(const fs::path& file, const std::string& text) {
  const fs::path partial = file.string() + ".partial";
  std::ofstream stream(partial, std::ios::binary);
  stream << text;
  stream.close();
  std::error_code error;
  if (stream) fs::rename(partial, file, error);
  if (stream && !error) return;
  fs::remove(partial, error);
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
    print_error("error: {} is not as plastron run writes it: {}\n", (directory / "results.json").string(),
                error.what());
  } catch (const io::UnusableResults& error) {
    print_error("error: {}\n", error.what());
  }
  return bad_input;
}

}  // namespace plastron::app
