// A distribution of nodes, together with the exchange plan of its ghosts.
#pragma once
#include <plastron/algebra/distribution.hpp>
#include <plastron/algebra/exchange.hpp>

#include <utility>

namespace plastron::algebra {

/// All vectors and matrices on a layout share it and its plan. Another distribution is another layout.
class Layout : public Distribution {
 public:
  /// Makes the plan (collective).
  explicit Layout(Distribution nodes) : Distribution(std::move(nodes)), exchange_(*this) {}

  const Exchange& exchange() const { return exchange_; }

 private:
  Exchange exchange_;
};

}  // namespace plastron::algebra
