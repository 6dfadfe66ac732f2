// Limits of a case file. Cases written by hand are smaller. Larger ones would take minutes to read, or exhaust memory
// or the stack.
#pragma once
#include <plastron/config/source.hpp>

namespace plastron::config {

inline constexpr std::size_t largest_file = 1 << 18;  ///< bytes
inline constexpr std::size_t deepest_nesting = 20;    ///< levels of lists, tables in braces and the parts of a key
inline constexpr std::size_t most_entries = 500;      ///< in a list or a table; also number of sections with one name
inline constexpr std::size_t most_mistakes = 50;      ///< reported for a file
inline constexpr std::size_t longest_name = 60;       ///< bytes of a name the user chooses
inline constexpr double most_cells = 1e6;             ///< cells of the coarsest mesh

/// Throws CaseErrors at the first place of the text that is nested deeper than deepest_nesting or begins too many
/// entries or sections. The reason: the parser recurses into lists, tables in braces and keys with dots until the stack
/// is full. It takes minutes for tables with thousands of entries.
void check_shape(const Source& source);

/// Throws CaseErrors at a list or table of more than most_entries entries.
void check_counts(const Source& source, const toml::value& value);

}  // namespace plastron::config
