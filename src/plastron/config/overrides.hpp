// `--set key=value`: a case with some keys other than in its file. The text of the file is edited where the key stands, or a line is added
// to its section, so that the outcome is a case file like any other, which can be kept beside the results and verified.
#pragma once
#include <plastron/config/mistakes.hpp>

#include <span>
#include <string>
#include <vector>

namespace plastron::config {

class Overrides {
 public:
  /// Edits the text of a case file. A setting is a key, "=", and a value in TOML: "shell.thickness=0.02", "obstacle[0].force=[0,0,-2]".
  /// Throws CaseErrors that name the settings that are wrong, or what is no TOML in the text.
  Overrides(std::string text, std::string file_name, std::span<const std::string> settings);

  /// Of the case as it is computed, with a line of comment for each setting at its top.
  const std::string& text() const { return text_; }

  /// Mistakes found in text() as the user sees them: of a setting, or of a line of the file as it was.
  std::vector<Mistake> of_user(std::vector<Mistake> mistakes) const;

 private:
  /// Text that has been put in; offsets are those of text_.
  struct Edit {
    std::size_t offset, length;
    int lost_lines;      ///< of the text that stood there
    std::string option;  ///< "--set shell.thickness=0.02"; empty: a comment
  };
  void apply(const std::string& setting);
  void replace(std::size_t offset, std::size_t length, const std::string& by, const std::string& option);

  std::string text_, file_name_;
  std::vector<Edit> edits_{};
};

}  // namespace plastron::config
