// A preconditioner that remembers its fixed unknowns, so that the factor of the last contact step serves the dual
// problems.
#pragma once
#include <plastron/algebra/preconditioner.hpp>

#include <algorithm>
#include <vector>

namespace plastron::estimation {

class KeptFactorisation : public algebra::Preconditioner {
 public:
  /// Keeps a reference to `inner`. `comm` is the communicator of its matrix.
  KeptFactorisation(algebra::Preconditioner& inner, MPI_Comm comm) : inner_(inner), comm_(comm) {}

  /// After this call, fix() keeps the present factor if only a few unknowns differ from those fixed last.
  void keep() { keeps_ = true; }

  bool fix(std::span<const char> fixed, double shift) override;
  std::vector<char> nearest_fixed(std::span<const char> wanted) const override { return inner_.nearest_fixed(wanted); }
  void apply(const algebra::Vector& r, algebra::Vector& z) const override { inner_.apply(r, z); }
  algebra::SoftestMotion softest_motion(const algebra::Operator& operate, std::span<const char> fixed,
                                        const algebra::Vector& diagonal) const override {
    return inner_.softest_motion(operate, fixed, diagonal);
  }
  algebra::Price price() const override { return inner_.price(); }

 private:
  bool is_near(std::span<const char> fixed, double shift);
  bool fix_anew(std::span<const char> fixed, double shift);

  algebra::Preconditioner& inner_;
  MPI_Comm comm_;
  bool keeps_ = false, is_ready_ = false;
  double shift_ = 0;
  std::vector<char> fixed_{};
};

}  // namespace plastron::estimation
