// Reads elastic constants in a table: E and nu, or lambda and mu.
#pragma once
#include <plastron/config/table.hpp>
#include <plastron/shell/material.hpp>

#include <string>

namespace plastron::config {

/// Whether the table has any of the four.
bool has_elastic_constants(const Table& table);

/// Sets the Lame constants from the table, if they are present and correct. `header`: name of the table in messages.
void read_material(Table& table, const std::string& header, shell::Material& material);

}  // namespace plastron::config
