// Apart from what computes an EdgeContact: tables of results name this, and are read without the solver's libraries.
#include <plastron/certificate/edge_contact.hpp>

namespace plastron::certificate {

bool EdgeContact::is_line() const {
  constexpr double far_above = 3;
  return area > 0 && force > far_above * area * pressure_inside;
}

}  // namespace plastron::certificate
