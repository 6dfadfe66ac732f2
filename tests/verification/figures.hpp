// The figures of docs/verification.md. figures.json contains them as measured, table by table. Tests measure them
// again and fail if they have grown. The comparison depends on the kind of a column:
//   error     a relative error or a residual, signed: its size is at most three times the figure's. Below 1e-12 there is
//             no limit, because another processor or BLAS rounds differently
//   percent   the same, printed in per cent
//   locking   an error that is meant to be large, in per cent: within a tenth of the figure, on either side
//   elements  a distance in elements: at most three times the figure; a tenth of an element is always permitted,
//             because one node more or less decides
//   rate      at least the figure less 0.1
//   digits    equal to the figure to 7 decimals, as printed
//   count     equal to the figure
//   text      not measured
// PLASTRON_FIGURES=FILE makes tests append what they measure to FILE (scripts/refresh-figures).
#pragma once
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace plastron::verification {

using Figures = nlohmann::ordered_json;

const Figures& stored_figures();

/// The reason why a measured figure, or list of them, differs too much from the stored one; empty if it does not. NaN always differs.
std::string objection(const std::string& kind, const Figures& stored, const Figures& measured);

/// Expects that the figure in a row and column of a table agrees with the measured number or vector of numbers.
void expect_figure(const std::string& table, const std::string& row, const std::string& column,
                   const Figures& measured);

/// Fails a program that ran all its tests but left out a figure of the tables that name it as their program.
class EveryFigureIsHeld : public testing::Environment {
 public:
  explicit EveryFigureIsHeld(std::string program) : program_(std::move(program)) {}
  void TearDown() override;

 private:
  std::string program_;
};

/// The figures, with those that a program wrote to PLASTRON_FIGURES in place of the stored ones.
Figures refreshed(Figures figures, const std::string& measurements);

/// A table as Markdown.
std::string table_text(const Figures& table);

}  // namespace plastron::verification
