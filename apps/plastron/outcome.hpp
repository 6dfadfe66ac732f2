// How a command ends: where it may write, and with which exit code.
#pragma once
#include "exit_codes.hpp"

#include <plastron/contact/problem.hpp>

#include <filesystem>
#include <string>

namespace plastron::app {

/// Why results cannot be written to `directory`; empty if they can. Makes nothing.
std::string obstacle_to_writing(const std::filesystem::path& directory);

ExitCode exit_code(contact::Status status);

}  // namespace plastron::app
