// plastron new: writes a commented case. It is written completely or not at all, and existing files are not changed.
#include "command_line.hpp"
#include "templates.hpp"
#include "terminal.hpp"

#include <plastron/config/nearest.hpp>

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace plastron::app {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view case_ending = ".toml";

struct NewFile {
  fs::path path;
  std::string_view text;
};

/// Returns the first line of the file, which is a comment.
std::string_view summary(const EmbeddedFile& file) {
  const std::string_view line = file.text.substr(0, file.text.find('\n'));
  return line.substr(std::min<std::size_t>(2, line.size()));
}

const EmbeddedFile* find_template(const std::string& name) {
  for (const EmbeddedFile& file : template_files())
    if (file.name == name + std::string(case_ending)) return &file;
  return nullptr;
}

/// Returns a case of that name, or in a directory of that name, with the files that it names.
std::vector<NewFile> files_of(const EmbeddedFile& chosen, const fs::path& name) {
  const bool is_file = name.extension() == case_ending;
  const fs::path folder = is_file ? name.parent_path() : name;
  std::vector<NewFile> files{{is_file ? name : folder / "case.toml", chosen.text}};
  for (const EmbeddedFile& file : template_files())
    if (!file.name.ends_with(case_ending) &&
        chosen.text.find("\"" + std::string(file.name) + "\"") != std::string::npos)
      files.push_back({folder / file.name, file.text});
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

ExitCode refuse_template(const std::string& name) {
  const auto known = template_names();
  const std::string meant = config::did_you_mean(name, known);
  print_error("error: there is no template \"{}\"; {}the templates are {}\n", name, meant.empty() ? "" : meant + " ",
              fmt::join(known, ", "));
  return bad_input;
}

ExitCode list_templates() {
  for (const std::string& name : template_names())
    if (is_first_rank()) print_text(stdout, row(name, 10, summary(*find_template(name))));
  return solved;
}

}  // namespace

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : template_files())
    if (file.name.ends_with(case_ending))
      names.emplace_back(file.name.substr(0, file.name.size() - case_ending.size()));
  return names;
}

ExitCode new_case(const fs::path& name, const std::string& template_name, bool is_listing) {
  if (is_listing) return list_templates();
  const EmbeddedFile* chosen = find_template(template_name);
  if (chosen == nullptr) return refuse_template(template_name);
  if (!is_first_rank()) return solved;  // one process writes
  const std::vector<NewFile> files = files_of(*chosen, name);
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
