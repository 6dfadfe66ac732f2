#include <plastron/io/mode_file.hpp>

#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/io/binary_file.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/surface_patches.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::io {

namespace {

constexpr std::string_view mode_ending = ".mode";

ModeHeader header_of(const fem::Space& space) {
  return {.corners = static_cast<std::uint32_t>(mesh::corner_count(space.shape())),
          .degree = static_cast<std::uint32_t>(space.degree),
          .patches = static_cast<std::uint32_t>(space.coarse->patches ? space.coarse->patches->patches.size() : 0),
          .cells = space.global_cells};
}

/// Returns the records of this rank's cells.
std::string cells_text(const energy::ShellOperator& shell, const algebra::Vector& shape) {
  const fem::Space& space = shell.space();
  const std::vector<Eigen::Vector2d> xi = mesh::node_points(space.shape(), space.degree);
  std::vector<double> x(xi.size()), y(xi.size());
  std::vector<geometry::Frame> frames(xi.size());
  std::string text;
  text.reserve(space.owned_cells * xi.size() * sizeof(ModeRecord));
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
    shell.surface().positions(space.cells[cell], xi, x, y);
    shell.surface().frames(space.cells[cell], xi, frames, false);
    const auto nodes = space.nodes(cell);
    for (std::size_t i = 0; i < xi.size(); ++i) {
      const geometry::Vector3d& phi = frames[i].phi;
      ModeRecord record{x[i], y[i], phi[0], phi[1], phi[2]};
      const double* values = shape.local().data() + static_cast<std::size_t>(nodes[i]) * 6;
      std::copy_n(values, 6, record.begin() + 5);
      append_bytes(text, &record, sizeof record);
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> add_modes(const computation::Solution& solution, const std::filesystem::path& directory,
                                   AtomicFiles& files) {
  const energy::ShellOperator& shell = solution.discrete->shell;
  const ModeHeader header = header_of(shell.space());
  const int rank = algebra::rank_in(files.comm());
  std::vector<std::string> names;
  for (const computation::Mode& mode : solution.modes) {
    if (mode.kind == computation::Mode::Kind::softest) continue;
    algebra::Vector shape = mode.shape;
    shape.update_ghosts();
    names.push_back(mode.name() + std::string(mode_ending));
    files.add(directory / names.back(), [&] {
      std::string text;
      if (rank == 0) append_bytes(text, &header, sizeof header);
      return text + cells_text(shell, shape);
    });
  }
  return names;
}

bool is_mode_name(std::string_view name) {
  const bool is_ours = name.starts_with("buckling_") || name.starts_with("vibration_");
  if (!is_ours || !name.ends_with(mode_ending)) return false;
  name.remove_prefix(name.find('_') + 1);
  name.remove_suffix(mode_ending.size());
  return !name.empty() && name.find_first_not_of("0123456789") == name.npos;
}

namespace {

/// A file of a mode that is being read.
class ModeFile : public BinaryFile {
 public:
  explicit ModeFile(const std::filesystem::path& path) : BinaryFile(path) {
    if (size() < sizeof header_) refuse("the file is too short to hold a mode");
    read(&header_, sizeof header_);
    check_header();
    constexpr std::int64_t most_cells = std::int64_t{1} << 40;  // prevents overflow of sizes
    const auto cells = static_cast<std::uintmax_t>(std::min(header_.cells, most_cells));
    require_size(sizeof header_ + cells * nodes_per_cell() * sizeof(ModeRecord));
  }

  fem::ShapeField::Cells cells(double amplitude, std::size_t patches) {
    check_patches(patches);
    fem::ShapeField::Cells cells{.shape = shape(), .degree = static_cast<int>(header_.degree)};
    const std::size_t count = static_cast<std::size_t>(header_.cells) * nodes_per_cell();
    cells.points.reserve(count);
    cells.places.reserve(count);
    cells.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      constexpr double largest_value = 1e60;  // no mode has a larger number
      ModeRecord record;
      read(&record, sizeof record);
      if (!std::ranges::all_of(record, [](double value) { return std::abs(value) <= largest_value; }))
        refuse("a value is not finite: the file is damaged");
      cells.points.emplace_back(record[0], record[1]);
      cells.places.emplace_back(record[2], record[3], record[4]);
      cells.values.emplace_back(amplitude * Eigen::Map<const fem::ShapeField::Vector6>(record.data() + 5));
    }
    return cells;
  }

 private:
  void check_header() const {
    const ModeHeader ours;
    if (header_.magic != ours.magic)
      refuse("the file is not a mode of Plastron: `plastron modes` writes such files, for example buckling_1.mode");
    if (header_.version != ours.version)
      refuse(fmt::format("the file has version {} of the format; this program reads version {}", header_.version,
                         ours.version));
    if (!((header_.corners == 3 || header_.corners == 4) && header_.degree >= 1 && header_.degree <= 8 &&
          header_.cells >= 1))
      refuse("the header contains impossible values");
  }
  void check_patches(std::size_t patches) const {
    if (header_.patches == patches) return;
    const auto described = [](std::size_t count) {
      return count == 0 ? "a plane domain" : fmt::format("a mesh in space of {} cells", count);
    };
    refuse(fmt::format("the mode belongs to {}, the case has {}", described(header_.patches), described(patches)));
  }
  mesh::Shape shape() const { return header_.corners == 3 ? mesh::Shape::triangle : mesh::Shape::quadrilateral; }
  std::size_t nodes_per_cell() const {
    return static_cast<std::size_t>(mesh::nodes_per_cell(shape(), static_cast<int>(header_.degree)));
  }

  ModeHeader header_{};
};

}  // namespace

std::shared_ptr<const fem::ShapeField> read_mode(const std::filesystem::path& path, double amplitude,
                                                 std::size_t patches) {
  return std::make_shared<const fem::ShapeField>(ModeFile(path).cells(amplitude, patches));
}

}  // namespace plastron::io
