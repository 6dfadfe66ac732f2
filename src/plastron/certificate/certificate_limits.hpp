// The limit of each row of the certificate beyond which the result counts as inaccurate, and the reason for it.
#pragma once
#include <plastron/certificate/certificate.hpp>
#include <plastron/element/formulation.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace plastron::certificate {

struct CertificateLimit {
  std::string_view row;  ///< name in results.json
  std::string_view unit;
  double value = 0;
  double limit = 0;  ///< largest admissible value, or the smallest if `is_least`
  bool is_least = false;
  std::string_view reason;
  std::string place{};  ///< place of the value in words; empty without one

  /// Returns false also for NaN.
  bool holds() const { return is_least ? value >= limit : value <= limit; }
  /// Returns "stationarity is 3.4e-4, its limit 1e-6", with the place in brackets.
  std::string text() const;
};

/// The smallest accepted gap to an obstacle between nodes where the solution need not be admissible there [m].
double least_gap_allowed(const solution::Summary& summary, const solution::ObstacleContact& obstacle);

/// Returns every row with its limit. Rows without meaning (no contact, no cell near the obstacle) are left out.
std::vector<CertificateLimit> certificate_limits(const Verdict& verdict, element::Formulation formulation);

}  // namespace plastron::certificate
