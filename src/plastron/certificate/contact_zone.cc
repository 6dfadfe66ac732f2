#include <plastron/certificate/contact_zone.hpp>

namespace plastron::certificate {

namespace {

double length_of(const ContactZone& zone, bool is_rim) {
  double sum = 0;
  for (const ContactLine& line : zone.lines)
    if (line.is_rim == is_rim) sum += line.length;
  return sum;
}

}  // namespace

double ContactZone::line_length() const { return length_of(*this, false); }
double ContactZone::rim_length() const { return length_of(*this, true); }

std::int64_t ContactZone::line_points() const {
  std::int64_t sum = 0;
  for (const ContactLine& line : lines) sum += static_cast<std::int64_t>(line.points.size());
  return sum;
}

}  // namespace plastron::certificate
