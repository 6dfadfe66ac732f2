// Input and result of a study: problems to compute, an observer, and a report with a table, claims, a plot and pictures of meshes.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/plot.hpp>
#include <plastron/problem/problem.hpp>

#include <Eigen/Geometry>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace plastron::study {

// ---- claims ------------------------------------------------------------------------------------------------------------

enum class Verdict {
  holds,            ///< the measurement bears it out
  does_not_hold,    ///< the measurement speaks against it
  cannot_be_judged  ///< there is no measurement, or it is no more than rounding
};
/// "holds", "does not hold" or "cannot be judged".
constexpr std::string_view to_string(Verdict verdict) {
  return verdict == Verdict::holds ? "holds" : verdict == Verdict::does_not_hold ? "does not hold" : "cannot be judged";
}

/// A statement that can be checked, what was measured, and the verdict.
struct Claim {
  std::string statement, measured;
  Verdict verdict = Verdict::cannot_be_judged;
  std::string reason{};  ///< why it cannot be judged; empty otherwise
};

inline Claim judged(std::string statement, std::string measured, bool holds) {
  return {.statement = std::move(statement),
          .measured = std::move(measured),
          .verdict = holds ? Verdict::holds : Verdict::does_not_hold};
}
inline Claim not_judged(std::string statement, std::string reason) {
  return {.statement = std::move(statement), .measured = "", .reason = std::move(reason)};
}

// ---- the table ---------------------------------------------------------------------------------------------------------

/// A column with the symbol of its quantity (docs/symbols.md) and its unit; "-" for texts, "1" for pure numbers.
struct Column {
  std::string name, symbol, unit;
};

/// NaN where a row has no value, such as the rate of the first mesh.
using Entry = std::variant<double, std::int64_t, std::string>;

/// quantity ~ against^exponent, by least squares of the logarithms; NaN where the values allow no exponent.
struct Fit {
  std::string quantity, against;
  double exponent = 0;
};

/// Numbers in named columns, fitted exponents, and the claims that they were measured for.
struct Table {
  std::string name;   ///< of the study, also of its files
  std::string title;  ///< the question it answers
  std::vector<Column> columns{};
  std::vector<std::vector<Entry>> rows{};  ///< as many entries as columns
  std::vector<Fit> fits{};
  std::vector<Claim> claims{};
  std::vector<std::string> remarks{};  ///< in sentences: conditions, warnings, what was left out and why
};

// ---- pictures of meshes ------------------------------------------------------------------------------------------------

/// Points of Omega; the last one is joined to the first.
using Outline = std::vector<Eigen::Vector2d>;

/// A mesh as plain values to draw, in the plane of the parameters.
struct MeshPicture {
  std::string caption{};
  std::vector<Outline> cells{};
  std::vector<Eigen::Vector2d> hanging{};  ///< vertices in the middle of a neighbour's side
  std::vector<Outline> touching{};         ///< parts of cells all of whose nodes touch one obstacle
};

/// Around outlines.
Eigen::AlignedBox2d box(const std::vector<Outline>& outlines);

/// The outlines of the cells of all ranks, on every rank, without caption. Their order depends on the ranks (collective).
MeshPicture mesh_picture(const computation::Solution& solution);

// ---- the study ---------------------------------------------------------------------------------------------------------

/// A problem that a study computes beside the case, in words and as it is.
struct Variant {
  std::string what;
  problem::Problem problem;
};

struct StudyObserver {
  std::function<void(std::string_view what)> stage{};  ///< the next computation, in words; may be empty
  computation::Observer solve{};                       ///< of each computation
};

/// The result of a study. With a status other than solved the table ends at the computation that failed.
struct Report {
  contact::Status status = contact::Status::solved;
  Table table;
  io::Plot plot;
  std::vector<MeshPicture> meshes{};  ///< where the study is about them
};

}  // namespace plastron::study
