// The manual's reference of the case file, from the declarations the reader uses.
#pragma once
#include <string>

namespace plastron::config {

/// Markdown; docs/case-file.md is this text.
std::string describe_case_format();

}  // namespace plastron::config
