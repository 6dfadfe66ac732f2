#include <plastron/fem/surface.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/mesh/cell_map.hpp>
#include <plastron/mesh/surface_patches.hpp>
#include <plastron/mesh/surface_shift.hpp>
#include <plastron/topology/space_mesh.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace plastron::fem {

const geometry::Chart& chart_of_region(const std::map<std::string, geometry::Chart>& charts,
                                       const std::string& region) {
  auto found = charts.find(region);
  if (found == charts.end() && charts.size() == 1 && charts.begin()->first.empty()) found = charts.begin();
  if (found == charts.end())
    throw mesh::DomainError(
        fmt::format("the region \"{}\" has no chart; write chart = {{ {} = [...], ... }}", region, region));
  return found->second;
}

Surface::Surface(std::shared_ptr<const mesh::CoarseMesh> coarse, const std::map<std::string, geometry::Chart>& charts)
    : coarse_(std::move(coarse)) {
  if (has_directors()) return;
  for (const std::string& region : coarse_->regions) charts_.push_back(chart_of_region(charts, region));
  for (const auto& [name, chart] : charts)
    if (!name.empty() && std::ranges::find(coarse_->regions, name) == coarse_->regions.end())
      throw mesh::DomainError(
          fmt::format("there is a chart for the region \"{}\", which the mesh does not have; it has: {}", name,
                      fmt::join(coarse_->regions, ", ")));
}

const geometry::Chart& Surface::chart_of(const Cell& cell) const {
  PLASTRON_ASSERT(cell.coarse >= 0 && static_cast<std::size_t>(cell.coarse) < coarse_->cells.size(), cell.coarse,
                  coarse_->cells.size());
  return charts_[coarse_->cells[cell.coarse].region];
}

geometry::PlaneJet Surface::plane_jet(const Cell& cell, const Vector2d& xi) const {
  PLASTRON_ASSERT(cell.coarse >= 0 && static_cast<std::size_t>(cell.coarse) < coarse_->cells.size(), cell.coarse,
                  coarse_->cells.size());
  geometry::PlaneJet f = coarse_->cells[cell.coarse].map(cell.corner + cell.size * xi);
  for (auto& d : f.d) d *= cell.size;
  for (auto& dd : f.dd) dd *= cell.size * cell.size;
  return f;
}

Vector2d Surface::address(const Cell& cell, const Vector2d& xi) const {
  const Vector2d value = plane_jet(cell, xi).value;
  return has_directors() ? mesh::address_of(coarse_->cells[static_cast<std::size_t>(cell.coarse)].patch, value) : value;
}

void Surface::positions(const Cell& cell, std::span<const Vector2d> xi, std::span<double> x,
                        std::span<double> y) const {
  PLASTRON_ASSERT(x.size() == xi.size() && y.size() == xi.size(), xi.size(), x.size(), y.size());
  for (std::size_t p = 0; p < xi.size(); ++p) {
    const Vector2d position = address(cell, xi[p]);
    x[p] = position[0];
    y[p] = position[1];
  }
}

void Surface::frames_without_shifts(const Cell& cell, std::span<const Vector2d> xi, std::span<geometry::Frame> frames,
                                    bool second_derivatives) const {
  PLASTRON_ASSERT(frames.size() == xi.size(), frames.size(), xi.size());
  if (has_directors()) {
    const int patch = coarse_->cells[static_cast<std::size_t>(cell.coarse)].patch;
    for (std::size_t p = 0; p < xi.size(); ++p) frames[p] = coarse_->patches->frame(patch, plane_jet(cell, xi[p]));
    return;
  }
  std::vector<geometry::SurfaceJet> jets(xi.size());
  std::vector<geometry::PlaneJet> plane(xi.size());
  std::vector<double> x(xi.size()), y(xi.size());
  for (std::size_t p = 0; p < xi.size(); ++p) {
    plane[p] = plane_jet(cell, xi[p]);
    x[p] = plane[p].value[0];
    y[p] = plane[p].value[1];
  }
  chart_of(cell).evaluate(x, y, jets, second_derivatives);
  for (std::size_t p = 0; p < xi.size(); ++p) frames[p] = geometry::frame_at(geometry::compose(jets[p], plane[p]));
}

geometry::Frame Surface::shifted(const Cell& cell, const Vector2d& xi, const geometry::Frame& frame) const {
  constexpr double step = 1e-6;  // towards the centre of the cell: the point then lies in one cell of the shift's mesh
  const geometry::PlaneJet plane = plane_jet(cell, xi);
  const Vector2d point = address(cell, xi), centre = address(cell, mesh::centre(coarse_->shape));
  std::array<geometry::Vector3d, 2> tangents = frame.a_cov, dr{geometry::Vector3d::Zero(), geometry::Vector3d::Zero()};
  geometry::Vector3d phi = frame.phi, director = frame.a3;
  for (const auto& shift : coarse_->shifts) {
    const mesh::SurfaceShift::Jet jet = shift->at(point, point + step * (centre - point));
    phi += jet.u;
    director += jet.r;
    for (std::size_t a = 0; a < 2; ++a) {
      tangents[a] += plane.d[a][0] * jet.du[0] + plane.d[a][1] * jet.du[1];
      dr[a] += plane.d[a][0] * jet.dr[0] + plane.d[a][1] * jet.dr[1];
    }
  }
  const double length = director.norm();
  director /= length;
  for (std::size_t a = 0; a < 2; ++a) {
    const geometry::Vector3d d = (frame.da3[a] + dr[a]) / length;
    dr[a] = d - director.dot(d) * director;
  }
  return geometry::frame_with_director(phi, tangents, director, dr);
}

void Surface::frames(const Cell& cell, std::span<const Vector2d> xi, std::span<geometry::Frame> frames,
                     bool second_derivatives) const {
  frames_without_shifts(cell, xi, frames, second_derivatives);
  if (coarse_->shifts.empty()) return;
  for (std::size_t p = 0; p < xi.size(); ++p) frames[p] = shifted(cell, xi[p], frames[p]);
}

geometry::Frame Surface::frame(const Cell& cell, const Vector2d& xi, bool second_derivatives) const {
  geometry::Frame frame;
  frames(cell, {&xi, 1}, {&frame, 1}, second_derivatives);
  return frame;
}

std::vector<geometry::Place> Surface::places(const Cell& cell, std::span<const Vector2d> xi, bool in_space) const {
  std::vector<geometry::Place> places(xi.size());
  for (std::size_t p = 0; p < xi.size(); ++p) {
    const Vector2d position = address(cell, xi[p]);
    places[p] = {.x = position[0], .y = position[1]};
  }
  if (!in_space) return places;
  std::vector<geometry::Frame> at(xi.size());
  frames(cell, xi, at, false);
  for (std::size_t p = 0; p < xi.size(); ++p)
    places[p] = {places[p].x, places[p].y, at[p].phi[0], at[p].phi[1], at[p].phi[2]};
  return places;
}

void Surface::evaluate(const geometry::Expression& f, const Cell& cell, std::span<const Vector2d> xi,
                       std::span<double> values) const {
  if (f.is_constant())
    std::ranges::fill(values, f({}));
  else
    f.evaluate(places(cell, xi, f.uses_space()), values);
}

void Surface::parameter_jets(const Cell& cell, std::span<const Vector2d> xi,
                             std::span<geometry::SurfaceJet> jets) const {
  PLASTRON_ASSERT(jets.size() == xi.size(), jets.size(), xi.size());
  if (has_directors()) throw mesh::DomainError("a mesh in space has no chart, which the classical formulation needs");
  if (!coarse_->shifts.empty())
    throw mesh::DomainError("a shell with the shape of a mode has no chart, which the classical formulation needs");
  std::vector<double> x(xi.size()), y(xi.size());
  positions(cell, xi, x, y);
  chart_of(cell).evaluate(x, y, jets, true);
}

std::vector<geometry::Vector3d> Surface::first_tangents(const Cell& cell, std::span<const Vector2d> xi,
                                                        std::span<const geometry::Frame> frames) const {
  PLASTRON_ASSERT(frames.size() == xi.size(), frames.size(), xi.size());
  std::vector<geometry::Vector3d> tangents;
  if (has_directors()) {
    for (const geometry::Frame& frame : frames) tangents.push_back(coarse_->patches->first_tangent(frame));
    return tangents;
  }
  std::vector<geometry::SurfaceJet> jets(xi.size());
  std::vector<double> x(xi.size()), y(xi.size());
  positions(cell, xi, x, y);
  chart_of(cell).evaluate(x, y, jets, false);
  for (const geometry::SurfaceJet& jet : jets) tangents.push_back(jet.d[0]);
  return tangents;
}

std::optional<Location> locate(const mesh::CoarseMesh& coarse, const Vector2d& point) {
  const int patch = coarse.patches ? mesh::patch_of(point) : -1;
  const Vector2d in_map = coarse.patches ? Vector2d(point[0] - 2.0 * patch, point[1]) : point;
  for (std::size_t c = 0; c < coarse.cells.size(); ++c)
    if (coarse.cells[c].patch == patch)
      if (const auto xi = mesh::invert_map(coarse.shape, coarse.cells[c].map, in_map))
        return Location{static_cast<int>(c), *xi};
  return std::nullopt;
}

std::string place_text(const Surface& surface, const Vector2d& point) {
  const auto location = surface.has_directors() ? locate(surface.coarse(), point) : std::nullopt;
  if (!location) return fmt::format("x = {:.4g}, y = {:.4g}", point[0], point[1]);
  const geometry::Vector3d phi = surface.frame({.coarse = location->coarse}, location->xi, false).phi;
  return fmt::format("(X, Y, Z) = {}", topology::place_of(phi));
}

std::optional<Vector2d> local_coordinates(mesh::Shape shape, const Cell& cell, const Location& location) {
  if (cell.coarse != location.coarse) return std::nullopt;
  const Vector2d xi = (location.xi - cell.corner) / cell.size;
  if (!mesh::holds(shape, xi, 1e-12)) return std::nullopt;
  return xi;
}

}  // namespace plastron::fem
