#include <plastron/element/formulation.hpp>

namespace plastron::element {

std::string_view to_string(Formulation formulation) {
  switch (formulation) {
    case Formulation::tangent:
      return "tangent";
    case Formulation::penalised:
      return "penalised";
    case Formulation::mixed:
      return "mixed";
    case Formulation::classical:
      break;
  }
  return "classical";
}

}  // namespace plastron::element
