// Fields on the same cells at another degree.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/fem/space.hpp>

namespace plastron::fem {

/// The interpolant of a field (values per node of a space of quadrilaterals) in a space of another degree on the same cells in the same order;
/// it is the field itself where that degree is not lower (collective).
algebra::Vector raised(const algebra::Vector& field, const Space& from, const Space& to);

}  // namespace plastron::fem
