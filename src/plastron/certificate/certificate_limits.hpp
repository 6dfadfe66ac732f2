// What each row of the certificate may be before the result counts as inaccurate, and why.
#pragma once
#include <plastron/certificate/certificate.hpp>
#include <plastron/element/formulation.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace plastron::certificate {

struct CertificateLimit {
  std::string_view row;  ///< as in results.json
  std::string_view unit;
  double value = 0;
  double limit = 0;  ///< largest value, or smallest
  bool is_least = false;
  std::string_view reason;
  std::string place{};  ///< of the value, in words; empty where it has none

  /// False for NaN, too.
  bool holds() const { return is_least ? value >= limit : value <= limit; }
  /// "stationarity is 3.4e-4, its limit 1e-6"; the place in brackets.
  std::string text() const;
};

/// How small the gap to an obstacle may be between nodes where the solution need not be admissible there [m].
double least_gap_allowed(const Summary& summary, const ObstacleContact& obstacle);

/// Every row with its limit. Rows that nothing can be asked of (no contact, no cell near the obstacle) are left out.
std::vector<CertificateLimit> certificate_limits(const Verdict& verdict, element::Formulation formulation);

}  // namespace plastron::certificate
