#include <plastron/domain/domain.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace plastron::domain {

namespace {

struct BoundaryNames {
  std::vector<std::string> operator()(const Rectangle&) const { return {"left", "right", "bottom", "top"}; }
  std::vector<std::string> operator()(const Disk&) const { return {"rim"}; }
  std::vector<std::string> operator()(const Annulus&) const { return {"inner", "outer"}; }
  std::vector<std::string> operator()(const Polygon& polygon) const {
    std::vector<std::string> names;
    for (std::size_t i = 1; i <= polygon.corners.size(); ++i) names.push_back("edge" + std::to_string(i));
    return names;
  }
  std::vector<std::string> operator()(const MeshFile&) const { return {}; }
};

}  // namespace

std::vector<std::string> boundary_names(const Domain& domain) { return std::visit(BoundaryNames{}, domain); }

std::vector<std::string> region_names(const Domain& domain) {
  if (std::holds_alternative<MeshFile>(domain)) return {};
  const auto* rectangle = std::get_if<Rectangle>(&domain);
  return rectangle && !rectangle->regions.empty() ? rectangle->regions : std::vector<std::string>{""};
}

double signed_area(const Polygon& polygon) {
  const auto& p = polygon.corners;
  double area = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector2d& q = p[(i + 1) % p.size()];
    area += (p[i][0] * q[1] - q[0] * p[i][1]) / 2;
  }
  return area;
}

double perimeter(const Polygon& polygon) {
  const auto& p = polygon.corners;
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += (p[(i + 1) % p.size()] - p[i]).norm();
  return sum;
}

double inner_width(const Polygon& polygon) { return 2 * std::abs(signed_area(polygon)) / perimeter(polygon); }

bool is_convex_quadrilateral(const Polygon& polygon) {
  const auto& p = polygon.corners;
  if (p.size() != 4) return false;
  double sign = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d a = p[(i + 1) % 4] - p[i], b = p[(i + 2) % 4] - p[(i + 1) % 4];
    const double turn = a[0] * b[1] - a[1] * b[0];
    if (turn * sign < 0 || std::abs(turn) < 1e-3 * a.norm() * b.norm()) return false;
    sign = turn;
  }
  return true;
}

bool is_cad_file(const std::string& path) {
  std::string end = std::filesystem::path(path).extension().string();
  std::ranges::transform(end, end.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return end == ".step" || end == ".stp" || end == ".brep";
}

}  // namespace plastron::domain
