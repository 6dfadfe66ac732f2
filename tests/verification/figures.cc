#include "verification/figures.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace plastron::verification {

namespace {

constexpr double allowed_growth = 3;
constexpr double rounding_floor = 1e-12;
constexpr double least_distance = 0.1;  // elements
constexpr double rate_slack = 0.1;
constexpr double locking_slack = 0.1;  // of the figure
constexpr double last_digit = 1e-7;

bool holds(const std::string& kind, double stored, double measured) {
  if (kind == "error" || kind == "percent")
    return std::abs(measured) <= std::max(allowed_growth * std::abs(stored), rounding_floor);
  if (kind == "locking") return std::abs(measured - stored) <= locking_slack * std::abs(stored);
  if (kind == "elements") return measured >= 0 && measured <= std::max(allowed_growth * stored, least_distance);
  if (kind == "rate") return measured >= stored - rate_slack;
  if (kind == "digits") return std::abs(measured - stored) <= last_digit;
  if (kind == "count") return measured == stored;
  throw std::logic_error("figures.json: no kind of column is called " + kind);
}

/// 1.5e-14 for "1.5e-14", -9.9e-5 for "-9.9e-05".
std::string in_powers_of_ten(double value) {
  const std::string text = fmt::format("{:.1e}", value);
  const std::size_t e = text.find('e');
  return text.substr(0, e) + "e" + std::to_string(std::stoi(text.substr(e + 1)));
}

std::string grouped(std::int64_t count) {
  return count < 10'000 ? std::to_string(count) : fmt::format("{} {:03}", count / 1000, count % 1000);
}

std::string printed(const std::string& kind, const Figures& figure) {
  if (figure.is_null()) return "-";
  if (figure.is_string()) return figure.get<std::string>();
  if (figure.is_array()) {
    std::string text;
    for (const Figures& one : figure) text += (text.empty() ? "" : ", ") + printed(kind, one);
    return text;
  }
  if (kind == "count") return grouped(figure.get<std::int64_t>());
  const double value = figure.get<double>();
  if (kind == "error") return in_powers_of_ten(value);
  if (kind == "percent" || kind == "locking") return fmt::format("{:.1f} %", 100 * value);
  return fmt::format(fmt::runtime(kind == "digits" ? "{:.7f}" : "{:.2f}"), value);
}

/// Four digits are enough for errors. Figures of other kinds keep the digits that they print.
Figures shortened(const std::string& kind, const Figures& measured) {
  if (measured.is_array()) {
    Figures all = Figures::array();
    for (const Figures& one : measured) all.push_back(shortened(kind, one));
    return all;
  }
  if (kind == "count") return measured.get<std::int64_t>();
  const bool is_relative = kind == "error" || kind == "percent" || kind == "locking";
  const auto* format = is_relative ? "{:.3e}" : kind == "digits" ? "{:.7f}" : "{:.2f}";
  return std::stod(fmt::format(fmt::runtime(format), measured.get<double>()));
}

const Figures* find(const Figures& figures, const std::string& table, const std::string& row,
                    const std::string& column) {
  if (!figures.contains(table) || !figures[table]["rows"].contains(row)) return nullptr;
  const Figures& cells = figures[table]["rows"][row];
  return cells.contains(column) ? &cells[column] : nullptr;
}

std::set<std::string>& held_figures() {
  static std::set<std::string> all;
  return all;
}

std::string path_of(const std::string& table, const std::string& row, const std::string& column) {
  return table + " / " + row + " / " + column;
}

}  // namespace

const Figures& stored_figures() {
  static const Figures figures = [] {
    std::ifstream file(PLASTRON_FIGURES_FILE);
    return Figures::parse(file);
  }();
  return figures;
}

std::string objection(const std::string& kind, const Figures& stored, const Figures& measured) {
  if (stored.is_array() != measured.is_array() || (stored.is_array() && stored.size() != measured.size()))
    return fmt::format("{} is not of the shape of {}", measured.dump(), stored.dump());
  for (std::size_t i = 0; stored.is_array() && i < stored.size(); ++i)
    if (std::string one = objection(kind, stored[i], measured[i]); !one.empty()) return one;
  if (stored.is_array()) return "";
  if (!stored.is_number() || !measured.is_number()) return "there is no number to compare";
  if (holds(kind, stored.get<double>(), measured.get<double>())) return "";
  return fmt::format("{} {:.3g} is not held by the stored {:.3g}", kind, measured.get<double>(), stored.get<double>());
}

void expect_figure(const std::string& table, const std::string& row, const std::string& column,
                   const Figures& measured) {
  const std::string path = path_of(table, row, column);
  if (const char* file = std::getenv("PLASTRON_FIGURES"))
    std::ofstream(file, std::ios::app) << Figures{table, row, column, measured}.dump() + "\n";
  const Figures* stored = find(stored_figures(), table, row, column);
  if (stored == nullptr) {
    ADD_FAILURE() << "figures.json has no figure " << path << "; run scripts/refresh-figures";
    return;
  }
  held_figures().insert(path);
  EXPECT_EQ(objection(stored_figures()[table]["columns"][column], *stored, measured), "") << path;
}

void EveryFigureIsHeld::TearDown() {
  const auto& all = *testing::UnitTest::GetInstance();
  if (all.test_to_run_count() != all.total_test_count()) return;
  for (const auto& [name, table] : stored_figures().items()) {
    if (table["program"] != program_) continue;
    for (const auto& [row, cells] : table["rows"].items())
      for (const auto& [column, figure] : cells.items())
        EXPECT_TRUE(figure.is_null() || figure.is_string() || held_figures().contains(path_of(name, row, column)))
            << "no test of " << program_ << " measures " << path_of(name, row, column);
  }
}

Figures refreshed(Figures figures, const std::string& measurements) {
  std::istringstream lines(measurements);
  for (std::string line; std::getline(lines, line);) {
    const Figures measured = Figures::parse(line);
    Figures& table = figures.at(measured[0].get<std::string>());
    const auto column = measured[2].get<std::string>();
    table["rows"][measured[1].get<std::string>()][column] = shortened(table["columns"].at(column), measured[3]);
  }
  return figures;
}

std::string table_text(const Figures& table) {
  std::string text = fmt::format("| {} |", table["rows are"].get<std::string>()), rule = "|---|";
  for (const auto& [column, kind] : table["columns"].items()) {
    text += " " + column + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (const auto& [row, cells] : table["rows"].items()) {
    text += "| " + row + " |";
    for (const auto& [column, kind] : table["columns"].items())
      text += " " + printed(kind, cells.contains(column) ? cells[column] : Figures()) + " |";
    text += "\n";
  }
  return text;
}

}  // namespace plastron::verification
