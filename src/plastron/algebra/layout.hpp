// A distribution of nodes and, with it, the plan by which its ghosts are exchanged.
#pragma once
#include <plastron/algebra/distribution.hpp>
#include <plastron/algebra/exchange.hpp>

#include <utility>

namespace plastron::algebra {

/// Shared by all vectors and matrices on it, and so is its plan. Another distribution is another layout.
class Layout : public Distribution {
 public:
  /// Makes the plan (collective).
  explicit Layout(Distribution nodes) : Distribution(std::move(nodes)), exchange_(*this) {}

  const Exchange& exchange() const { return exchange_; }

 private:
  Exchange exchange_;
};

}  // namespace plastron::algebra
