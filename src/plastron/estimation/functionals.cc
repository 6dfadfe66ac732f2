#include <plastron/estimation/functionals.hpp>

namespace plastron::estimation {

namespace {

std::string unit(const Energy& /*energy*/) { return "J"; }
std::string unit(const LoadWork& /*work*/) { return "J"; }
std::string unit(const ObstacleForce& /*force*/) { return "N"; }
std::string unit(const SupportForce& /*force*/) { return "N"; }
std::string unit(const ContactArea& /*area*/) { return "m^2"; }
std::string unit(const PointDisplacement& point) { return point.component < 3 ? "m" : "rad"; }
std::string unit(const PointStress& point) {
  if (point.kind != StressKind::resultant) return "Pa";
  return point.component < 3 || point.component > 5 ? "N/m" : "N";
}
std::string unit(const LargestStress& /*stress*/) { return "Pa"; }
std::string unit(const ObstaclePosition& /*position*/) { return "m"; }

}  // namespace

std::string unit_of(const Functional& functional) {
  return std::visit([](const auto& f) { return unit(f); }, functional);
}

}  // namespace plastron::estimation
