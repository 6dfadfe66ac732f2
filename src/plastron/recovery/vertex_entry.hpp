// The values of a node or vertex in a vector.
#pragma once
#include <plastron/algebra/vector.hpp>

#include <span>

namespace plastron::recovery {

inline std::span<double> entry(algebra::Vector& v, algebra::LocalIndex i) {
  const auto block = static_cast<std::size_t>(v.block());
  return v.local().subspan(static_cast<std::size_t>(i) * block, block);
}
inline std::span<const double> entry(const algebra::Vector& v, algebra::LocalIndex i) {
  const auto block = static_cast<std::size_t>(v.block());
  return v.local().subspan(static_cast<std::size_t>(i) * block, block);
}

}  // namespace plastron::recovery
