// The data of the three-dimensional view in report.html, as JSON with base64 arrays of little-endian numbers: the
// shell, obstacles, boundaries of contact zones, supported edges, loads. viewer/src/scene.js reads it.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/fields.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/problem/unit_names.hpp>
#include <plastron/report/drawn_cells.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace plastron::report {

using io::Field, io::Ingredients, io::Json;

/// The deformed surface: all fields at a limited number of points, in single precision.
struct SampledSurface {
  DrawnCells cells;
  std::int64_t points = 0;
  std::vector<Field> fields{};  ///< fields with a meaning here
  std::span<const computation::Mode> modes{};
  /// A row for each component of each field, then of the displacement of each mode, with a value for each point; on the first
  /// rank only.
  std::vector<std::vector<float>> rows{};
  Drawing drawing{};  ///< on the first rank only
};

/// Returns the fields that colours can show: no tangents, no directions, no places except the mid-surface.
std::vector<Field> report_fields(const Ingredients& ingredients);

/// Returns the surface with some fields, modes of the solution (the first ones, if they are too many for a page), and cells in an
/// order that does not depend on the number of ranks (collective). Throws the errors of the chart at points between nodes, on all
/// ranks together.
SampledSurface sampled_surface(const computation::Solution& solution, std::int64_t most_points,
                               std::vector<Field> fields, std::span<const computation::Mode> modes = {});

/// Largest number of points of the shell's surface on a page. The page stays below 12 MB (a field's 4 bytes are 5.3
/// letters, some 60 components).
inline constexpr std::int64_t most_report_points = 26'000;

/// Instants of the steps as frames of the view: u, r and eta at the points of the scene, and the places of obstacles. Instants on
/// other meshes are drawn on the last mesh. Of many instants every second one is kept, or every fourth, and so on.
class SceneFrames {
 public:
  /// Adds an instant (collective).
  void add(const computation::HistoryEntry& entry, const computation::Solution& solution,
           std::int64_t most_points = most_report_points);
  /// Returns the frames before the last solution, on the first rank. Each obstacle of the scene has the rotation (row-major) and
  /// the translation that move it from its place in the scene. `drawn`: the obstacles' numbers in the scene.
  Json json(const computation::Solution& last, std::span<const std::size_t> drawn, const Drawing& drawing) const;

 private:
  struct Frame {
    double time;
    std::string step;
    Drawing drawing;
    std::vector<Field> fields;
    std::vector<std::vector<float>> rows;
    std::vector<obstacle::Placement> obstacles;
  };
  std::vector<Frame> frames_{};
  int seen_ = 0, every_ = 1;
};

/// Returns the scene on the first rank; null on the others, and if the surface is too large (collective). "fields" has
/// the entries of io/fields.hpp and the modes ("is_mode") with "values": for each component a base64 array of floats, or one
/// number if all values are equal. Throws like sampled_surface().
Json scene_json(const computation::Solution& solution, const solution::Summary& summary,
                const problem::UnitNames& units = {}, const SceneFrames& frames = {},
                std::int64_t most_points = most_report_points);

}  // namespace plastron::report
