// Fields on the same cells at another degree.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/fem/space.hpp>

namespace plastron::fem {

/// Interpolates a field in a space of another degree on the same cells in the same order (collective). The field has
/// values per node of a space of quadrilaterals. The field does not change if the degree is not lower.
algebra::Vector raised(const algebra::Vector& field, const Space& from, const Space& to);

}  // namespace plastron::fem
