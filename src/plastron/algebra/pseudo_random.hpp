// Start values of an iteration: values without any symmetry, equal on any number of ranks.
#pragma once
#include <plastron/algebra/hash.hpp>
#include <plastron/algebra/vector.hpp>

namespace plastron::algebra {

/// Sets owned values in (-1, 1). Each depends only on `seed` and on the unknown's global number.
inline void fill_with_pseudo_random_values(Vector& v, std::uint64_t seed = 0) {
  const auto first = static_cast<std::uint64_t>(v.layout()->first) * static_cast<std::uint64_t>(v.block());
  const auto values = v.owned();
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<double>(hash(first + i + (seed << 40)) >> 11) * 0x1p-52 - 1;
}

}  // namespace plastron::algebra
