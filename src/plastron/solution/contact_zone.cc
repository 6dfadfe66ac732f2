#include <plastron/solution/contact_zone.hpp>

#include <algorithm>
#include <limits>

namespace plastron::solution {

namespace {

double length_of(const ContactZone& zone, bool is_rim) {
  double sum = 0;
  for (const ContactLine& line : zone.lines)
    if (line.is_rim == is_rim) sum += line.length;
  return sum;
}

/// Visits the lines inside the shell.
template <class Visit>
void for_lines(std::span<const ContactZone> zones, const Visit& visit) {
  for (const ContactZone& zone : zones)
    for (const ContactLine& line : zone.lines)
      if (!line.is_rim) visit(line);
}

template <class Visit>
void for_segments(std::span<const ContactZone> zones, const Visit& visit) {
  for_lines(zones, [&](const ContactLine& line) {
    for (std::size_t i = 1; i < line.points.size(); ++i) visit(line.points[i - 1].place, line.points[i].place);
  });
}

double distance(const Vector3d& point, const Vector3d& from, const Vector3d& to) {
  const Vector3d way = to - from;
  const double square = way.squaredNorm();
  const double t = square > 0 ? std::clamp(way.dot(point - from) / square, 0.0, 1.0) : 0.0;
  return (from + t * way - point).norm();
}

}  // namespace

double relative_distance(std::span<const ContactZone> zones, std::span<const ContactZone> others) {
  double length = 0, other_length = 0, area = 0, integral = 0;
  for (const ContactZone& zone : zones) area += zone.area;
  for (const ContactZone& zone : zones) length += zone.line_length();
  for (const ContactZone& zone : others) other_length += zone.line_length();
  if (!(length > 0) && !(other_length > 0)) return 0;
  if (!(length > 0) || !(other_length > 0)) return std::numeric_limits<double>::infinity();
  for_segments(zones, [&](const Vector3d& from, const Vector3d& to) {
    double nearest = std::numeric_limits<double>::infinity();
    const Vector3d middle = (from + to) / 2;
    for_segments(others,
                 [&](const Vector3d& a, const Vector3d& b) { nearest = std::min(nearest, distance(middle, a, b)); });
    integral += nearest * (to - from).norm();
  });
  bool all_closed = true;
  for_lines(zones, [&](const ContactLine& line) { all_closed = all_closed && line.is_closed; });
  return integral / ((all_closed ? 2 : 1) * area);  // the mean distance is integral / length
}

// In a zone of one row of nodes the area follows from the opening of gaps on both sides. Where the row represents a
// strip poorly, the area is half of the nodes' own.
bool ContactZone::is_line() const {
  constexpr double narrow = 0.25;
  return reaction.force.norm() > 0 && area < narrow * nodal_area;
}

double ContactZone::line_reaction() const {
  const double way_round = line_length() > 0 ? line_length() : rim_length();
  return way_round > 0 ? reaction.force.norm() / (way_round / 2) : 0;
}

double ContactZone::line_length() const { return length_of(*this, false); }
double ContactZone::rim_length() const { return length_of(*this, true); }

std::int64_t ContactZone::line_points() const {
  std::int64_t sum = 0;
  for (const ContactLine& line : lines) sum += static_cast<std::int64_t>(line.points.size());
  return sum;
}

}  // namespace plastron::solution
