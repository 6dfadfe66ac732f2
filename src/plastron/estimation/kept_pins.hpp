// A preconditioner that remembers its pinned unknowns, so that the factor of the last contact step serves the dual
// problems.
#pragma once
#include <plastron/algebra/preconditioner.hpp>

#include <algorithm>
#include <vector>

namespace plastron::estimation {

class KeptPins : public algebra::Preconditioner {
 public:
  /// Keeps a reference to `inner`. `comm` is the communicator of its matrix.
  KeptPins(algebra::Preconditioner& inner, MPI_Comm comm) : inner_(inner), comm_(comm) {}

  /// After this call, pin() keeps the present factor if only a few unknowns differ from those pinned last.
  void keep() { keeps_ = true; }

  algebra::Pinning pin(std::span<const char> pinned, double shift) override;
  std::vector<char> nearest_pins(std::span<const char> wanted) const override { return inner_.nearest_pins(wanted); }
  void apply(const algebra::Vector& r, algebra::Vector& z) const override { inner_.apply(r, z); }
  bool is_exact() const override { return inner_.is_exact(); }
  algebra::SoftestMotion softest_motion(const algebra::Operator& operate, std::span<const char> pinned,
                                        const algebra::Vector& diagonal) const override {
    return inner_.softest_motion(operate, pinned, diagonal);
  }
  algebra::Price price() const override { return inner_.price(); }

 private:
  bool is_near(std::span<const char> pinned, double shift);
  algebra::Pinning pin_anew(std::span<const char> pinned, double shift);

  algebra::Preconditioner& inner_;
  MPI_Comm comm_;
  bool keeps_ = false, is_ready_ = false;
  double shift_ = 0;
  std::vector<char> pinned_{};
};

}  // namespace plastron::estimation
