#include <plastron/obstacle/bed.hpp>

#include <algorithm>

namespace plastron::obstacle {

Bed::Bed(const std::vector<std::pair<double, double>>& points) {
  double energy = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto [c, p] = points[i];
    const auto [next_c, next_p] = points[i + 1];
    const double stiffness = (next_p - p) / (next_c - c);
    parts_.push_back({c, p, energy, {.stiffness = stiffness, .shift = c - p / stiffness}});
    energy += (next_p + p) * (next_c - c) / 2;
  }
}

const Bed::Part& Bed::part_at(double closure) const {
  const auto after = std::ranges::upper_bound(parts_, closure, {}, &Part::closure);
  return after == parts_.begin() ? parts_.front() : *(after - 1);
}

const Bed::Part& Bed::part_under(double pressure) const {
  const auto after = std::ranges::upper_bound(parts_, pressure, {}, &Part::pressure);
  return after == parts_.begin() ? parts_.front() : *(after - 1);
}

double Bed::pressure(double closure) const {
  const Part& part = part_at(closure);
  return std::max(0.0, part.pressure + part.segment.stiffness * (closure - part.closure));
}

double Bed::closure(double pressure) const {
  const Part& part = part_under(pressure);
  return part.closure + (pressure - part.pressure) / part.segment.stiffness;
}

double Bed::energy(double pressure) const {
  const Part& part = part_under(pressure);
  return part.energy + (pressure - part.pressure) * (pressure + part.pressure) / (2 * part.segment.stiffness);
}

std::pair<double, double> Bed::stiffnesses() const {
  const auto [least, most] = std::ranges::minmax(parts_, {}, [](const Part& part) { return part.segment.stiffness; });
  return {least.segment.stiffness, most.segment.stiffness};
}

}  // namespace plastron::obstacle
