// Elastic constants in a table: E and nu, or lambda and mu.
#pragma once
#include <plastron/config/table.hpp>
#include <plastron/shell/material.hpp>

#include <string>

namespace plastron::config {

/// Any of the four.
bool has_elastic_constants(const Table& table);

/// Sets the Lame constants to those of the table, if they are there and right. `header`: as messages call the table.
void read_material(Table& table, const std::string& header, shell::Material& material);

}  // namespace plastron::config
