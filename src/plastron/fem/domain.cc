#include <plastron/fem/domain.hpp>

namespace plastron::fem {

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

}  // namespace plastron::fem
