#include <plastron/contact/settings.hpp>

namespace plastron::contact {

std::string_view to_string(Solver solver) {
  switch (solver) {
    case Solver::active_set:
      return "active-set";
    case Solver::projected:
      return "projected";
    case Solver::tao:
      return "tao";
    case Solver::snesvi:
      return "snesvi";
    case Solver::mprgp:
      return "mprgp";
  }
  return "unknown";
}

}  // namespace plastron::contact
