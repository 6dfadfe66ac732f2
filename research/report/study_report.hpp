// Writes the results of a study: text for the terminal, KIND.json, the plot KIND.svg and the meshes KIND-meshes.svg.
#pragma once
#include <plastron/io/results.hpp>
#include <research/study/report.hpp>

#include <mpi.h>

#include <filesystem>
#include <span>
#include <string>

namespace plastron::study {

using io::Json;

/// Columns aligned, units below their names, then fits, claims with what was measured, and remarks.
std::string table_text(const Table& table);

/// name, title, status, columns, rows, fits, claims, remarks, plot; and the settings of the case.
Json report_json(const Report& report, const io::Provenance& provenance);

/// Pictures of meshes as a complete SVG file: all at one scale, side by side or below each other, readable on light and dark pages.
/// Empty if there is nothing to draw. Captions are plain text.
std::string svg_of_meshes(std::span<const MeshPicture> pictures);

/// Writes directory/NAME.svg, NAME-meshes.svg and, last, directory/NAME.json (collective). A report without rows has no plot, one without
/// meshes no picture of them. The files of an earlier run stay until the new ones are complete.
/// Throws std::runtime_error.
void write_report(const Report& report, const io::Provenance& provenance, const std::filesystem::path& directory,
                  MPI_Comm comm);

}  // namespace plastron::study
