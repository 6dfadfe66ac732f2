#include <plastron/io/obstacle_surfaces.hpp>

#include <plastron/assembly/nodal_geometry.hpp>

#include <fmt/format.h>

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
  int rank = 0;
  MPI_Comm_rank(files.comm(), &rank);
  const obstacle::Extent extent = surroundings(solution);
  files.add(path,
            [&] { return rank == 0 ? obstacle_surfaces_vtu(solution.discrete->obstacles, extent) : std::string(); });
  return true;
}

}  // namespace plastron::io
