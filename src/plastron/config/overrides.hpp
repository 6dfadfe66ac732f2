// `--set key=value`: a case with some keys that differ from its file. The text of the file is edited at the key, or a
// line is added to its section. The result is a normal case file, which can be kept beside the results and verified.
#pragma once
#include <plastron/config/mistakes.hpp>

#include <span>
#include <string>
#include <vector>

namespace plastron::config {

class Overrides {
 public:
  /// Edits the text of a case file. A setting is a key, "=", and a value in TOML: "shell.thickness=0.02",
  /// "obstacle[0].force=[0,0,-2]". Throws CaseErrors that name the wrong settings, or mistakes in the TOML of the text.
  Overrides(std::string text, std::string file_name, std::span<const std::string> settings);

  /// Text of the computed case, with a comment line for each setting at its top.
  const std::string& text() const { return text_; }

  /// Converts mistakes in text() to mistakes of a setting, or of a line of the original file.
  std::vector<Mistake> of_user(std::vector<Mistake> mistakes) const;

 private:
  /// Inserted text; offsets refer to text_.
  struct Edit {
    std::size_t offset, length;
    int lost_lines;      ///< lines of the replaced text
    std::string option;  ///< "--set shell.thickness=0.02"; empty: a comment
  };
  void apply(const std::string& setting);
  void replace(std::size_t offset, std::size_t length, const std::string& by, const std::string& option);

  std::string text_, file_name_;
  std::vector<Edit> edits_{};
};

}  // namespace plastron::config
