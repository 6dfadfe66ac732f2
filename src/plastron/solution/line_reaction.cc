// The test for line reactions, apart from the computation of EdgeContact: tables of results use it and are read
// without the solver's libraries.
#include <plastron/solution/edge_contact.hpp>

namespace plastron::solution {

bool EdgeContact::is_line() const {
  constexpr double far_above = 3;
  return area > 0 && force > far_above * area * pressure_inside;
}

}  // namespace plastron::solution
