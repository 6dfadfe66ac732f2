// Options of a short study, and reading its table in a test.
#pragma once
#include <gtest/gtest.h>
#include <research/names/study_names.hpp>
#include <research/study/report.hpp>

#include <string>
#include <vector>

namespace plastron::study {

inline StudyOptions few_samples(int samples = 2) {
  StudyOptions options;
  options.reference = 1;
  options.samples = samples;
  options.factors = {1, 0.5};
  return options;
}

/// The numbers of a column. With `of`, only from rows that contain this text.
inline std::vector<double> numbers(const Table& table, const std::string& column, const std::string& of = "") {
  std::vector<double> values;
  for (const auto& row : table.rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      bool wanted = of.empty();
      for (const Entry& entry : row) wanted = wanted || (entry.index() == 2 && std::get<std::string>(entry) == of);
      if (wanted && table.columns[c].name == column) values.push_back(std::get<double>(row[c]));
    }
  EXPECT_FALSE(values.empty()) << column << " " << of;
  return values;
}

inline void expect_all_hold(const Table& table) {
  EXPECT_FALSE(table.claims.empty());
  for (const Claim& claim : table.claims)
    EXPECT_EQ(claim.verdict, Verdict::holds) << claim.statement << ": " << claim.measured << claim.reason;
}

/// Expects that no claim is judged, for a reason that contains `reason`.
inline void expect_none_judged(const Table& table, const std::string& reason) {
  EXPECT_FALSE(table.claims.empty());
  for (const Claim& claim : table.claims) {
    EXPECT_EQ(claim.verdict, Verdict::cannot_be_judged) << claim.statement << ": " << claim.measured;
    EXPECT_NE(claim.reason.find(reason), std::string::npos) << claim.statement << ": " << claim.reason;
  }
}

/// The claim whose statement contains `part`.
inline Claim claim_on(const Table& table, const std::string& part) {
  for (const Claim& claim : table.claims)
    if (claim.statement.find(part) != std::string::npos) return claim;
  ADD_FAILURE() << "no claim on " << part;
  return {};
}

}  // namespace plastron::study
