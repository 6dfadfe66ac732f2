#include <plastron/fem/surface.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/fem/cell_map.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace plastron::fem {

const geometry::Chart& chart_of_region(const std::map<std::string, geometry::Chart>& charts,
                                       const std::string& region) {
  auto found = charts.find(region);
  if (found == charts.end() && charts.size() == 1 && charts.begin()->first.empty()) found = charts.begin();
  if (found == charts.end())
    throw DomainError(
        fmt::format("the region \"{}\" has no chart; write chart = {{ {} = [...], ... }}", region, region));
  return found->second;
}

Surface::Surface(std::shared_ptr<const CoarseMesh> coarse, const std::map<std::string, geometry::Chart>& charts)
    : coarse_(std::move(coarse)) {
  for (const std::string& region : coarse_->regions) charts_.push_back(chart_of_region(charts, region));
  for (const auto& [name, chart] : charts)
    if (!name.empty() && std::ranges::find(coarse_->regions, name) == coarse_->regions.end())
      throw DomainError(fmt::format("there is a chart for the region \"{}\", which the mesh does not have; it has: {}",
                                    name, fmt::join(coarse_->regions, ", ")));
}

const geometry::Chart& Surface::chart_of(const Cell& cell) const {
  PLASTRON_ASSERT(cell.coarse >= 0 && static_cast<std::size_t>(cell.coarse) < coarse_->cells.size(), cell.coarse,
                  coarse_->cells.size());
  return charts_[coarse_->cells[cell.coarse].region];
}

PlaneJet Surface::plane_jet(const Cell& cell, const Vector2d& xi) const {
  PLASTRON_ASSERT(cell.coarse >= 0 && static_cast<std::size_t>(cell.coarse) < coarse_->cells.size(), cell.coarse,
                  coarse_->cells.size());
  PlaneJet f = coarse_->cells[cell.coarse].map(cell.corner + cell.size * xi);
  for (auto& d : f.d) d *= cell.size;
  for (auto& dd : f.dd) dd *= cell.size * cell.size;
  return f;
}

void Surface::positions(const Cell& cell, std::span<const Vector2d> xi, std::span<double> x,
                        std::span<double> y) const {
  PLASTRON_ASSERT(x.size() == xi.size() && y.size() == xi.size(), xi.size(), x.size(), y.size());
  for (std::size_t p = 0; p < xi.size(); ++p) {
    const Vector2d position = plane_jet(cell, xi[p]).value;
    x[p] = position[0];
    y[p] = position[1];
  }
}

void Surface::jets(const Cell& cell, std::span<const Vector2d> xi, std::span<geometry::SurfaceJet> jets,
                   bool second_derivatives) const {
  PLASTRON_ASSERT(jets.size() == xi.size(), jets.size(), xi.size());
  std::vector<PlaneJet> plane(xi.size());
  std::vector<double> x(xi.size()), y(xi.size());
  for (std::size_t p = 0; p < xi.size(); ++p) {
    plane[p] = plane_jet(cell, xi[p]);
    x[p] = plane[p].value[0];
    y[p] = plane[p].value[1];
  }
  chart_of(cell).evaluate(x, y, jets, second_derivatives);
  for (std::size_t p = 0; p < xi.size(); ++p) jets[p] = geometry::compose(jets[p], plane[p]);
}

void Surface::parameter_jets(const Cell& cell, std::span<const Vector2d> xi,
                             std::span<geometry::SurfaceJet> jets) const {
  PLASTRON_ASSERT(jets.size() == xi.size(), jets.size(), xi.size());
  std::vector<double> x(xi.size()), y(xi.size());
  positions(cell, xi, x, y);
  chart_of(cell).evaluate(x, y, jets, true);
}

std::optional<Location> locate(const CoarseMesh& coarse, const Vector2d& point) {
  for (std::size_t c = 0; c < coarse.cells.size(); ++c)
    if (const auto xi = invert_map(coarse.shape, coarse.cells[c].map, point)) return Location{static_cast<int>(c), *xi};
  return std::nullopt;
}

std::optional<Vector2d> local_coordinates(Shape shape, const Cell& cell, const Location& location) {
  if (cell.coarse != location.coarse) return std::nullopt;
  const Vector2d xi = (location.xi - cell.corner) / cell.size;
  if (!holds(shape, xi, 1e-12)) return std::nullopt;
  return xi;
}

}  // namespace plastron::fem
