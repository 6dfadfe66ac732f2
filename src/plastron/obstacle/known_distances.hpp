// Distances that were computed before, by their points. A shell's nodes and the points between them are asked for several times: by the
// gaps, by the next linearisation and by the certificate.
#pragma once
#include <plastron/obstacle/nearest.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <unordered_map>

namespace plastron::obstacle {

class KnownDistances {
 public:
  const Nearest* find(const Vector3d& X) const {
    const auto found = known_.find(key_of(X));
    return found == known_.end() ? nullptr : &found->second;
  }
  void add(const Vector3d& X, const Nearest& nearest) { known_.emplace(key_of(X), nearest); }
  void forget_if_many() {
    constexpr std::size_t most = 1'000'000;
    if (known_.size() > most) known_.clear();
  }

 private:
  using Key = std::array<std::uint64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t h = 0;
      for (const std::uint64_t bits : key) h = (h ^ bits) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
      return h;
    }
  };
  static Key key_of(const Vector3d& X) {
    return {std::bit_cast<std::uint64_t>(X[0]), std::bit_cast<std::uint64_t>(X[1]), std::bit_cast<std::uint64_t>(X[2])};
  }

  std::unordered_map<Key, Nearest, Hash> known_{};
};

}  // namespace plastron::obstacle
