#include <plastron/meshing/layered_mesh.hpp>

#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/cut_mesh.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <utility>

namespace plastron::meshing {

namespace {

using Eigen::Vector2d;

/// Positions of the lines across [from, to]: the boundaries, the rows' lines and the breaks.
std::vector<double> lines_across(double from, double to, const std::vector<double>& left,
                                 const std::vector<double>& breaks, const std::vector<double>& right) {
  std::vector<double> lines{from};
  for (const double d : left) lines.push_back(from + d);
  lines.insert(lines.end(), breaks.begin(), breaks.end());
  std::transform(right.rbegin(), right.rend(), std::back_inserter(lines), [&](double d) { return to - d; });
  lines.push_back(to);
  if (std::ranges::adjacent_find(lines, std::greater_equal{}) != lines.end())
    throw mesh::DomainError(fmt::format("rows along the boundaries do not fit between {} and {}", from, to));
  return lines;
}

/// Numbers of cells between consecutive lines: one in a row; `inner` between the rows, distributed over the regions.
std::vector<int> parts_across(const std::vector<double>& lines, std::size_t left, std::size_t right, int inner) {
  std::vector<int> parts(lines.size() - 1, 1);
  const double begin = lines[left], end = lines[lines.size() - 1 - right];
  for (std::size_t i = left; i + right < parts.size(); ++i)
    parts[i] = std::max(1, static_cast<int>(std::lround(inner * (lines[i + 1] - lines[i]) / (end - begin))));
  return parts;
}

std::vector<double> smaller(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  std::ranges::transform(a, b, result.begin(), [](double p, double q) { return std::min(p, q); });
  return result;
}

mesh::CoarseMesh layered_rectangle(const domain::Rectangle& r, const Rows& rows) {
  const auto &left = rows.distances[0][0], &right = rows.distances[1][0];
  const auto &bottom = rows.distances[2], &top = rows.distances[3];
  const auto xs = lines_across(r.from[0], r.to[0], left, r.breaks, right);
  const auto columns = parts_across(xs, left.size(), right.size(), rows.inner[0]);
  const auto region_at = [&](double x) {
    return static_cast<std::size_t>(std::ranges::count_if(r.breaks, [&](double b) { return b < x; }));
  };
  // At a break, the narrower one of the rows on both sides.
  const auto before = [&](std::size_t i) { return region_at((xs[i] + xs[i > 0 ? i - 1 : 1]) / 2); };
  const auto after = [&](std::size_t i) { return region_at((xs[i] + xs[i + 1 < xs.size() ? i + 1 : i - 1]) / 2); };
  std::vector<Vector2d> vertices;
  std::vector<std::vector<double>> ys;
  for (std::size_t i = 0; i < xs.size(); ++i)
    ys.push_back(lines_across(r.from[1], r.to[1], smaller(bottom[before(i)], bottom[after(i)]), {},
                              smaller(top[before(i)], top[after(i)])));
  const std::size_t lines = ys.front().size();
  for (std::size_t j = 0; j < lines; ++j)
    for (std::size_t i = 0; i < xs.size(); ++i) vertices.emplace_back(xs[i], ys[i][j]);
  const auto across = parts_across(ys.front(), bottom.front().size(), top.front().size(), rows.inner[1]);
  mesh::CoarseMesh mesh = domain::grid_mesh(std::move(vertices), columns.size());
  mesh.regions = domain::region_names(domain::Domain{r});
  mesh.boundaries = domain::boundary_names(domain::Domain{r});
  std::vector<std::array<int, 2>> parts;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::size_t i = c % columns.size(), j = c / columns.size();
    mesh.cells[c].region = static_cast<int>(region_at((xs[i] + xs[i + 1]) / 2));
    parts.push_back({columns[i], across[j]});
  }
  return fem::subdivided(mesh, parts);
}

mesh::CoarseMesh layered_disk(const domain::Disk& disk, const Rows& rows) {
  const std::vector<double>& distances = rows.distances[0][0];
  std::vector<double> radii{disk.radius};
  for (const double d : distances) radii.push_back(disk.radius - d);
  if (rows.core > 0) radii.push_back(rows.core);
  std::ranges::reverse(radii);
  if (radii.front() <= 0 || std::ranges::adjacent_find(radii, std::greater_equal{}) != radii.end())
    throw mesh::DomainError("rows along the rim do not fit into the disk");
  mesh::CoarseMesh mesh = domain::disk_mesh({disk.centre, radii.front()});
  mesh.edges.clear();
  std::vector<std::array<int, 2>> parts{{rows.inner[0], rows.inner[0]}};
  for (std::size_t k = 0; k < 4; ++k) parts.push_back({rows.inner[1], rows.inner[0]});
  const std::vector<int> first{4, 5, 6, 7};
  const domain::Rings rings{disk.centre, std::numbers::pi / 4, 4};
  domain::add_rings(rings, radii, first, mesh);
  parts.resize(mesh.cells.size(), {1, rows.inner[0]});
  if (rows.core > 0)
    for (std::size_t k = 5; k < 9; ++k) parts[k][0] = rows.rings;
  const int last = static_cast<int>(mesh.vertices.size()) - 4;
  for (int k = 0; k < 4; ++k) mesh.edges.push_back({{last + k, last + (k + 1) % 4}, 0});
  return fem::subdivided(mesh, parts);
}

mesh::CoarseMesh layered_annulus(const domain::Annulus& annulus, const Rows& rows) {
  const auto radii = lines_across(annulus.inner, annulus.outer, rows.distances[0][0], {}, rows.distances[1][0]);
  const auto outwards = parts_across(radii, rows.distances[0][0].size(), rows.distances[1][0].size(), rows.inner[1]);
  const int sectors = rows.inner[0] > 0 ? rows.inner[0] : domain::annulus_sectors(annulus);
  mesh::CoarseMesh mesh = domain::ring_mesh({annulus.centre, 0, sectors}, radii);
  std::vector<std::array<int, 2>> parts;
  for (const int n : outwards) parts.insert(parts.end(), static_cast<std::size_t>(sectors), {n, 1});
  return fem::subdivided(mesh, parts);
}

struct LayeredMesher {
  const Rows& rows;
  mesh::CoarseMesh operator()(const domain::Rectangle& d) const { return layered_rectangle(d, rows); }
  mesh::CoarseMesh operator()(const domain::Disk& d) const { return layered_disk(d, rows); }
  mesh::CoarseMesh operator()(const domain::Annulus& d) const { return layered_annulus(d, rows); }
  mesh::CoarseMesh operator()(const domain::Polygon& d) const { return layered_polygon(d, rows); }
  mesh::CoarseMesh operator()(const domain::MeshFile&) const {
    throw mesh::DomainError("a mesh of a file gets no rows along its boundaries: its cells are what the file says");
  }
};

}  // namespace

mesh::CoarseMesh layered_mesh(const domain::Domain& domain, mesh::Shape shape, const Rows& rows) {
  mesh::CoarseMesh mesh = std::visit(LayeredMesher{rows}, domain);
  return shape == mesh::Shape::triangle ? mesh::cut_crosswise(std::move(mesh)) : mesh;
}

}  // namespace plastron::meshing
