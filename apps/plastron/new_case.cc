// plastron new: writes a template or a case of the gallery, completely or not at all. Existing files are not changed.
#include "command_line.hpp"
#include "templates.hpp"
#include "terminal.hpp"

#include <plastron/config/nearest.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace plastron::app {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view case_name = "case.toml";

struct NewFile {
  fs::path path;
  std::string_view text;
};

/// Returns the comment or the title in the first line of a case.
std::string_view summary(const EmbeddedFile& file) {
  const std::string_view line = file.text.substr(0, file.text.find('\n'));
  const std::size_t quote = line.find('"') + 1;
  return line.starts_with("title") ? line.substr(quote, line.rfind('"') - quote)
                                   : line.substr(std::min<std::size_t>(2, line.size()));
}

/// Returns a case of that name, or in a directory of that name, with the files that it names; nothing if there is no
/// such example.
std::vector<NewFile> files_of(const std::string& example, const fs::path& name) {
  const bool is_file = name.extension() == ".toml";
  const fs::path folder = is_file ? name.parent_path() : name;
  std::vector<NewFile> files;
  for (const EmbeddedFile& file : example_files())
    if (file.example == example)
      files.push_back({is_file && file.name == case_name ? name : folder / file.name, file.text});
  return files;
}

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

/// Removes the new files and directories unless keep() is called.
class Made {
 public:
  ~Made() {
    std::error_code error;
    std::ranges::reverse(paths_);
    for (const fs::path& path : paths_) fs::remove(path, error);
  }
  /// Makes the directory and its missing parent directories.
  void make_directory(const fs::path& directory) {
    if (directory.empty() || fs::exists(directory)) return;
    make_directory(directory.parent_path());
    if (fs::create_directory(directory)) paths_.push_back(directory);
  }
  void write(const NewFile& file) {
    make_directory(file.path.parent_path());
    std::ofstream stream(file.path, std::ios::binary);
    if (!stream) throw std::runtime_error(file.path.string() + " cannot be written");
    paths_.push_back(file.path);
    stream << file.text;
    stream.close();
    if (!stream) throw std::runtime_error(file.path.string() + " cannot be written completely");
  }
  void keep() { paths_.clear(); }

 private:
  std::vector<fs::path> paths_{};
};

ExitCode refuse_example(const std::string& name) {
  const auto known = example_names();
  const std::string meant = config::did_you_mean(name, known);
  print_error("error: there is no template or case of the gallery \"{}\"; {}the names are {}\n", name,
              meant.empty() ? "" : meant + " ", fmt::join(known, ", "));
  return bad_input;
}

ExitCode list_examples() {
  std::string_view collection;
  for (const EmbeddedFile& file : example_files()) {
    if (file.name != case_name) continue;
    if (std::exchange(collection, file.collection) != file.collection) print("{}:\n", file.collection);
    if (is_first_rank()) print_text(stdout, row(file.example, 21, summary(file)));
  }
  return solved;
}

}  // namespace

std::vector<std::string> example_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : example_files())
    if (file.name == case_name) names.emplace_back(file.example);
  return names;
}

ExitCode new_case(const fs::path& name, const std::string& example, bool is_listing) {
  if (is_listing) return list_examples();
  const std::vector<NewFile> files = files_of(example, name);
  if (files.empty()) return refuse_example(example);
  if (!is_first_rank()) return solved;  // one process writes
  std::vector<fs::path> paths{name};
  for (const NewFile& file : files) paths.push_back(file.path);
  for (const fs::path& path : paths)
    if (is_there(path)) {
      print_error("error: {} exists already and is not overwritten; choose another name\n", path.string());
      return bad_input;
    }
  try {
    Made made;
    for (const NewFile& file : files) made.write(file);
    made.keep();
  } catch (const std::exception& error) {
    print_error("error: {}\n", error.what());
    return bad_input;
  }
  for (const NewFile& file : files) print("{}\n", file.path.string());
  print("\nplastron check {0}\nplastron run {0} --output {1}\n", files[0].path.string(),
        (name.parent_path() / "out" / name.stem()).string());
  return solved;
}

}  // namespace plastron::app
