// An integer hash that makes neighbouring numbers unrelated: the finaliser of the generator SplitMix64 (Steele, Lea,
// Flood 2014).
#pragma once
#include <cstdint>

namespace plastron::algebra {

constexpr std::uint64_t hash(std::uint64_t n) {
  n += 0x9e3779b97f4a7c15u;
  n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
  n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
  return n ^ (n >> 31);
}

}  // namespace plastron::algebra
