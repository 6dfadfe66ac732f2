// The manual's reference of the case file, made from the declarations of the reader.
#pragma once
#include <string>

namespace plastron::config {

/// Returns the reference as Markdown; docs/case-file.md is this text.
std::string describe_case_format();

}  // namespace plastron::config
