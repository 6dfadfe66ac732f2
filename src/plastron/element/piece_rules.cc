#include <plastron/element/piece_rules.hpp>

#include <plastron/element/subdivision.hpp>
#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plastron::element {

namespace {

/// Thrown where a rule would need too many borders or too much work.
struct TooMany {};

/// Two numbers closer than this are one border. Such a small part of a cell has no weight.
constexpr double smallest = 1e-12;
constexpr std::size_t most_borders = 200;
constexpr int most_looks = 400'000;

std::vector<double> with_ends(std::vector<double> inner) {
  inner.insert(inner.begin(), 0);
  inner.push_back(1);
  return inner;
}

/// Borders of pieces in the square of s and t. `place` maps this square to the cell.
class Borders {
 public:
  using Place = std::function<Vector2d(double s, double t)>;
  Borders(const PiecesOfAll& functions, Place place, const Places& places)
      : functions_(functions), place_(std::move(place)), places_(places) {}

  bool are_none(double s0, double s1, double t0, double t1) const {
    if (++looks_ > most_looks) throw TooMany();
    const auto sides = box(s0, s1, t0, t1);
    return std::ranges::all_of(functions_, [&](const geometry::Pieces* f) { return f->is_one_over(sides); });
  }

  /// Returns the places where borders cross the line of s, ascending.
  std::vector<double> on_line(double s) const {
    std::vector<double> all;
    Run run;
    find(s, smallest, 1 - smallest, all, run);
    return all;
  }

  /// Returns the values of s where the borders on lines begin, end, turn or have corners, ascending.
  std::vector<double> events() const {
    std::vector<double> all;
    Run run;
    find_events(smallest, on_line(smallest), 1 - smallest, on_line(1 - smallest), all, run);
    return all;
  }

  /// Returns the cuts, and further cuts until the rule in s integrates the widths of all pieces on lines.
  std::vector<double> cuts(const mesh::Rule& rule) const {
    const std::vector<double> all = with_ends(events());
    std::vector<double> finer{0};
    for (std::size_t i = 1; i < all.size(); ++i)
      divide(all[i - 1], all[i], widths(all[i - 1], all[i], rule), rule, finer);
    return finer;
  }

 private:
  /// Returns intervals around the variables: the values at corners and middles, extended by the difference between the
  /// middles and the linear interpolation of the corners.
  geometry::Box box(double s0, double s1, double t0, double t1) const {
    std::array<Vector2d, 9> points;
    std::size_t n = 0;
    const std::size_t across = s0 == s1 ? 1 : 3, along = t0 == t1 ? 1 : 3;
    for (std::size_t i = 0; i < across; ++i)
      for (std::size_t k = 0; k < along; ++k)
        points[n++] =
            place_(s0 + 0.5 * static_cast<double>(i) * (s1 - s0), t0 + 0.5 * static_cast<double>(k) * (t1 - t0));
    const std::vector<geometry::Place> places = places_(std::span(points).first(n));
    const auto enclosed = [&](double geometry::Place::*variable) {
      const auto at = [&](std::size_t i, std::size_t k) {
        return places[std::min(i, across - 1) * along + std::min(k, along - 1)].*variable;
      };
      double bend = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        bend = std::max(bend, across == 1 ? 0 : std::abs(at(1, k) - 0.5 * (at(0, k) + at(2, k))));
        bend = std::max(bend, along == 1 ? 0 : std::abs(at(k, 1) - 0.5 * (at(k, 0) + at(k, 2))));
      }
      const auto [lowest, highest] = std::ranges::minmax(places, {}, variable);
      const double low = lowest.*variable, high = highest.*variable;
      const double rounding = 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(low), std::abs(high));
      return geometry::Interval{low - bend - rounding, high + bend + rounding};
    };
    using geometry::Place;
    return {enclosed(&Place::x), enclosed(&Place::y), enclosed(&Place::X), enclosed(&Place::Y), enclosed(&Place::Z)};
  }

  /// The interval that arithmetic cannot separate from the last border. Where a border runs along a line, this interval is long, and
  /// the search goes on behind it in steps of 1/32 of its length: the smallest steps would be millions. Larger steps could pass
  /// over the next border, because boxes around oblique steps touch a border from some lengths away.
  struct Run {
    double begin = -1, end = -1;

    bool goes_on_at(double t) const { return t - end < smallest; }
    /// Adds an interval; returns whether it begins a run.
    bool add(double from, double to) {
      const bool is_new = !goes_on_at(from);
      if (is_new) begin = from;
      end = to;
      return is_new;
    }
    /// Length of intervals from t on that are not divided.
    double step_at(double t, double first, double next) const {
      constexpr double part = 1.0 / 32;
      return goes_on_at(t) ? std::max(next, part * (end - begin)) : first;
    }
  };

  /// Adds the crossings of the line of s between t0 and t1 to `all`.
  void find(double s, double t0, double t1, std::vector<double>& all, Run& run) const {
    if (are_none(s, s, t0, t1)) return;
    if (t1 - t0 < run.step_at(t0, 0.1 * smallest, 1e-9)) {
      if (run.add(t0, t1)) all.push_back(0.5 * (t0 + t1));
      if (all.size() > most_borders) throw TooMany();
      return;
    }
    const double middle = 0.5 * (t0 + t1);
    find(s, t0, middle, all, run);
    find(s, middle, t1, all, run);
  }

  /// Returns the integrals over s of the widths of pieces between a and b; nothing if the number of pieces changes.
  std::vector<double> widths(double a, double b, const mesh::Rule& rule) const {
    std::vector<double> sums;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const std::vector<double> on = with_ends(on_line(a + rule.points[q] * (b - a)));
      if (q == 0) sums.assign(on.size() - 1, 0);
      if (on.size() != sums.size() + 1) return {};
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += rule.weights[q] * (b - a) * (on[i + 1] - on[i]);
    }
    return sums;
  }

  void divide(double a, double b, const std::vector<double>& whole, const mesh::Rule& rule,
              std::vector<double>& all) const {
    const double middle = 0.5 * (a + b);
    const std::vector<double> first = widths(a, middle, rule), second = widths(middle, b, rule);
    bool is_enough = whole.size() == first.size() && whole.size() == second.size();
    for (std::size_t i = 0; i < whole.size() && is_enough; ++i)
      is_enough = std::abs(first[i] + second[i] - whole[i]) < 1e-8 * whole[i] + smallest * (b - a) + 0.1 * smallest;
    if (is_enough || b - a < 1e-9) {
      all.push_back(b);
      return;
    }
    divide(a, middle, first, rule, all);
    divide(middle, b, second, rule, all);
  }

  void find_events(double a, const std::vector<double>& on_a, double b, const std::vector<double>& on_b,
                   std::vector<double>& all, Run& run) const {
    // A border often runs along the exact middle of a cell. All points of a line there are crossings.
    constexpr double nearly_half = 0.49;
    const double middle = a + nearly_half * (b - a);
    if (b - a < run.step_at(a, smallest, 1e-8)) {
      if (run.add(a, b)) all.push_back(middle);
      if (all.size() > most_borders) throw TooMany();
      return;
    }
    const std::vector<double> between = on_line(middle);
    if (are_curves(a, on_a, between, b, on_b)) return;
    find_events(a, on_a, middle, between, all, run);
    find_events(middle, between, b, on_b, all, run);
  }

  /// Whether the crossings at a, at b and between them belong to smooth curves, with no other crossings between a and
  /// b.
  bool are_curves(double a, const std::vector<double>& on_a, const std::vector<double>& between, double b,
                  const std::vector<double>& on_b) const {
    if (on_a.size() != between.size() || on_b.size() != between.size()) return false;
    constexpr double margin = 0.02, bend = 0.1;
    double end = smallest;
    for (std::size_t i = 0; i < on_a.size(); ++i) {
      const auto [low, high] = std::minmax({on_a[i], between[i], on_b[i]});
      if (std::abs(between[i] - 0.5 * (on_a[i] + on_b[i])) >
          margin * (b - a) + bend * std::abs(on_b[i] - on_a[i]) + smallest)
        return false;
      const double off = 0.5 * (high - low) + margin * (b - a) + smallest;
      if (low - off > end && !is_empty(a, b, end, low - off)) return false;
      end = high + off;
    }
    return end >= 1 - smallest || is_empty(a, b, end, 1 - smallest);
  }

  struct Budget {
    int last_look;
    bool is_empty_beyond;
  };
  /// Whether no border crosses the box. The test divides the box into smaller boxes, down to a part of its width and up
  /// to a limited number. Boxes of x and y around oblique boxes of s and t touch a curve early. Near a place where a
  /// curve runs along the lines, hundreds of boxes are needed. If they are too many, a narrow box counts as empty.
  bool is_empty(double s0, double s1, double t0, double t1) const {
    constexpr int enough = 300;
    constexpr double narrow = 1e-6;
    return is_empty(s0, s1, t0, t1, 12 + std::max(0, std::ilogb((t1 - t0) / (s1 - s0))),
                    {looks_ + enough, s1 - s0 < narrow});
  }
  bool is_empty(double s0, double s1, double t0, double t1, int depth, const Budget& budget) const {
    if (are_none(s0, s1, t0, t1)) return true;
    if (depth == 0) return false;
    if (looks_ > budget.last_look) return budget.is_empty_beyond;
    if (t1 - t0 > s1 - s0) {
      const double t = 0.5 * (t0 + t1);
      return is_empty(s0, s1, t0, t, depth - 1, budget) && is_empty(s0, s1, t, t1, depth - 1, budget);
    }
    const double s = 0.5 * (s0 + s1);
    return is_empty(s0, s, t0, t1, depth - 1, budget) && is_empty(s, s1, t0, t1, depth - 1, budget);
  }

  const PiecesOfAll& functions_;
  Place place_;
  const Places& places_;
  mutable int looks_ = 0;
};

/// Returns the map of the square to a cell. For a triangle, the square's side s = 1 has no length.
Borders::Place place_on(mesh::Shape shape) {
  if (shape == mesh::Shape::triangle) return [](double s, double t) { return Vector2d(s, t * (1 - s)); };
  return [](double s, double t) { return Vector2d(s, t); };
}

/// Calls visit(point, weight) for the points of a Gauss rule between each pair of cuts.
template <class Visit>
void between(const std::vector<double>& cuts, const mesh::Rule& rule, const Visit& visit) {
  for (std::size_t i = 1; i < cuts.size(); ++i)
    for (std::size_t q = 0; q < rule.points.size(); ++q)
      visit(cuts[i - 1] + rule.points[q] * (cuts[i] - cuts[i - 1]), rule.weights[q] * (cuts[i] - cuts[i - 1]));
}

/// Returns a rule for functions with roots at both ends.
mesh::Rule with_roots_at_ends(int points) {
  mesh::Rule rule = mesh::gauss(points);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const double u = rule.points[q];
    rule.points[q] = u * u * (3 - 2 * u);
    rule.weights[q] *= 6 * u * (1 - u);
  }
  return rule;
}

}  // namespace

bool are_one_piece(const PiecesOfAll& functions, mesh::Shape shape, const Places& places) {
  return Borders(functions, place_on(shape), places).are_none(smallest, 1 - smallest, smallest, 1 - smallest);
}

std::optional<PieceRule> rule_between_borders(const PiecesOfAll& functions, mesh::Shape shape, int degree,
                                              const Places& places) {
  const auto place = place_on(shape);
  const Borders borders(functions, place, places);
  PieceRule rule;
  try {
    const mesh::Rule across = with_roots_at_ends(degree + 8), along = mesh::gauss(degree + 2);
    between(borders.cuts(across), across, [&](double s, double weight) {
      const double length = shape == mesh::Shape::triangle ? 1 - s : 1;
      between(with_ends(borders.on_line(s)), along, [&](double t, double part) {
        rule.xi.push_back(place(s, t));
        rule.weights.push_back(weight * part * length);
      });
    });
  } catch (const TooMany&) {
    return {};
  }
  return rule;
}

PieceRule rule_of_parts(const PiecesOfAll& functions, mesh::Shape shape, const PieceRule& of_cell, const Places& places,
                        std::size_t most_parts) {
  constexpr int most_divisions = 30;
  constexpr double small = 1.0 / 64;  // shape functions are nearly linear over such a part: one point is enough
  PieceRule rule;
  const double area = shape == mesh::Shape::triangle ? 0.5 : 1;
  const Vector2d centre = shape == mesh::Shape::triangle ? Vector2d(1.0 / 3, 1.0 / 3) : Vector2d(0.5, 0.5);
  const auto add = [&](const CellPart& part) {
    if (std::abs(part.size) < small) {
      rule.xi.push_back(part.corner + part.size * centre);
      rule.weights.push_back(part.size * part.size * area);
      return;
    }
    for (std::size_t q = 0; q < of_cell.xi.size(); ++q) {
      rule.xi.push_back(part.corner + part.size * of_cell.xi[q]);
      rule.weights.push_back(part.size * part.size * of_cell.weights[q]);
    }
  };
  std::vector<CellPart> crossed{CellPart{}}, quarters;
  std::vector<Vector2d> points;
  for (int division = 0; division < most_divisions && !crossed.empty() && crossed.size() < most_parts; ++division) {
    quarters.clear();
    for (const CellPart& part : crossed)
      for (const CellPart& quarter : divided(shape, part)) {
        const Places in_quarter = [&](std::span<const Vector2d> xi) {
          points.clear();
          for (const Vector2d& point : xi) points.push_back(quarter.corner + quarter.size * point);
          return places(points);
        };
        if (are_one_piece(functions, shape, in_quarter))
          add(quarter);
        else
          quarters.push_back(quarter);
      }
    std::swap(crossed, quarters);
  }
  for (const CellPart& part : crossed) add(part);
  return rule;
}

std::optional<PieceRule> rule_between_borders(const PiecesOfAll& functions, mesh::Shape shape, int side, int degree,
                                              const Places& places) {
  const auto place = [&](double, double t) { return mesh::side_point(shape, side, t); };
  const Borders borders(functions, place, places);
  PieceRule rule;
  try {
    between(with_ends(borders.on_line(0)), mesh::gauss(degree + 2), [&](double t, double weight) {
      rule.xi.push_back(place(0, t));
      rule.weights.push_back(weight);
    });
  } catch (const TooMany&) {
    return {};
  }
  return rule;
}

}  // namespace plastron::element
