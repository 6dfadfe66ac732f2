#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/io/obstacle_surfaces.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace plastron::io {

namespace {

using Eigen::Vector3d;

std::string data_array(std::string_view attributes, const std::string& values) {
  return fmt::format("        <DataArray {} format=\"ascii\">\n{}        </DataArray>\n", attributes, values);
}

/// The arrays of a file, by obstacle.
struct Triangles {
  std::string points{}, corners{}, ends{}, types{}, owners{};
  std::size_t point_count = 0, count = 0;

  void add(const obstacle::TriangleMesh& mesh, std::size_t owner) {
    constexpr int vtk_triangle = 5;
    for (const Vector3d& p : mesh.points) points += fmt::format("{:.9g} {:.9g} {:.9g}\n", p[0], p[1], p[2]);
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto first = static_cast<long long>(point_count);
      corners += fmt::format("{} {} {}\n", first + a, first + b, first + c);
      ends += fmt::format("{}\n", 3 * ++count);
      types += fmt::format("{}\n", vtk_triangle);
      owners += fmt::format("{}\n", owner);
    }
    point_count += mesh.points.size();
  }
};

}  // namespace

obstacle::Extent surroundings(const computation::Solution& solution) {
  const assembly::DiscreteShell& discrete = *solution.discrete;
  const auto place = [&](std::size_t i) -> Vector3d {
    return discrete.points[i].phi + assembly::node_values(solution.nodal.y, i).head<3>();
  };
  const auto [low, high] = assembly::bounding_box(discrete.points.size(), place, discrete.space().layout->comm);
  const Vector3d margin = Vector3d::Constant((high - low).norm() / 2);
  return {low - margin, high + margin};
}

std::vector<DrawnObstacle> drawn_obstacles(const assembly::RigidObstacles& obstacles, const obstacle::Extent& extent) {
  std::vector<DrawnObstacle> drawn;
  for (std::size_t k = 0; k < obstacles.all.size(); ++k) {
    const bool is_drawn_already = obstacles.all[k].is_for_both && obstacles.all[k].face == obstacle::Face::upper;
    if (!is_drawn_already) drawn.push_back({k, obstacle::surface_mesh(obstacles.now(k), extent)});
  }
  return drawn;
}

std::string obstacle_surfaces_vtu(const assembly::RigidObstacles& obstacles, const obstacle::Extent& extent) {
  Triangles all;
  for (const DrawnObstacle& drawn : drawn_obstacles(obstacles, extent)) all.add(drawn.surface, drawn.number);
  return fmt::format(
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">\n  <UnstructuredGrid>\n"
             "    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
             all.point_count, all.count) +
         "      <Points>\n" + data_array(R"(type="Float64" NumberOfComponents="3")", all.points) +
         "      </Points>\n      <Cells>\n" + data_array(R"(type="Int64" Name="connectivity")", all.corners) +
         data_array(R"(type="Int64" Name="offsets")", all.ends) +
         data_array(R"(type="UInt8" Name="types")", all.types) + "      </Cells>\n      <CellData>\n" +
         data_array(R"(type="Int64" Name="obstacle")", all.owners) +
         "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
}

bool add_obstacle_surfaces(const computation::Solution& solution, const std::filesystem::path& path,
                           AtomicFiles& files) {
  if (solution.discrete->obstacles.empty()) return false;
  const obstacle::Extent extent = surroundings(solution);
  files.add_text(path, [&] { return obstacle_surfaces_vtu(solution.discrete->obstacles, extent); });
  return true;
}

namespace {

using Eigen::Vector3d;
using obstacle::TriangleMesh;

TriangleMesh clustered(const TriangleMesh& surface, const Vector3d& low, double box) {
  TriangleMesh result;
  std::map<std::array<long long, 3>, int> number_of;
  std::vector<int> number;
  for (const Vector3d& p : surface.points) {
    const Vector3d place = (p - low) / box;
    const auto [entry, is_new] = number_of.try_emplace(
        {std::llround(std::floor(place[0])), std::llround(std::floor(place[1])), std::llround(std::floor(place[2]))},
        static_cast<int>(result.points.size()));
    if (is_new) result.points.push_back(p);
    number.push_back(entry->second);
  }
  for (const auto& [a, b, c] : surface.triangles) {
    const std::array<int, 3> corners{number[static_cast<std::size_t>(a)], number[static_cast<std::size_t>(b)],
                                     number[static_cast<std::size_t>(c)]};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace

TriangleMesh thinned_surface(const TriangleMesh& surface, std::size_t most) {
  if (surface.triangles.size() <= most) return surface;
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const Vector3d& p : surface.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  TriangleMesh result;
  for (const int boxes : {96, 48, 24, 12}) {
    result = clustered(surface, low, (high - low).maxCoeff() * (1 + 1e-12) / boxes);
    if (result.triangles.size() <= most) break;
  }
  return result;
}

}  // namespace plastron::io
