// Numbers without any symmetry, equal on any number of ranks: start values of iterations, numbers that identify sets.
#pragma once
#include <plastron/algebra/vector.hpp>

#include <cstdint>

namespace plastron::algebra {

/// An integer hash that makes neighbouring numbers unrelated: the finaliser of the generator SplitMix64 (Steele, Lea,
/// Flood 2014).
constexpr std::uint64_t hash(std::uint64_t n) {
  n += 0x9e3779b97f4a7c15u;
  n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
  n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
  return n ^ (n >> 31);
}

/// Sets owned values in (-1, 1). Each depends only on `seed` and on the unknown's global number.
inline void fill_with_pseudo_random_values(Vector& v, std::uint64_t seed = 0) {
  const auto first = static_cast<std::uint64_t>(v.layout()->first) * static_cast<std::uint64_t>(v.block());
  const auto values = v.owned();
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<double>(hash(first + i + (seed << 40)) >> 11) * 0x1p-52 - 1;
}

}  // namespace plastron::algebra
