#include <plastron/meshing/chord_cuts.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/gathered.hpp>
#include <plastron/algebra/vector.hpp>
#include <plastron/fem/cut_mesh.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/meshing/constants.hpp>
#include <plastron/topology/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

namespace plastron::meshing {

namespace {

using Eigen::Vector2d;

struct Chord {
  double cells = 0;
  double share = 0;
  double cut = 0.5;
  double crossed = 0;   ///< number of cells that the edge of a contact zone crosses along the chord
  double unjudged = 0;  ///< bent cells without patches that are longer across the chord
  bool is_cut = false;
  double rate() const { return share / cells; }
};

/// Returns the place that has half of the slices' sum on either side.
double middle(std::span<const double> slices, std::span<const double> widths) {
  const double half = std::accumulate(slices.begin(), slices.end(), 0.0) / 2;
  double sum = 0, at = 0;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    if (sum + slices[i] > half) return at + widths[i] * (half - sum) / slices[i];
    sum += slices[i];
    at += widths[i];
  }
  return 0.5;
}

double cut_near(double middle) {
  if (std::abs(middle - 0.5) < constants.middle_part) return 0.5;
  return std::clamp(middle, constants.least_cut_part, 1 - constants.least_cut_part);
}

/// Sides and widths of the coarse cells on the shell.
class CellShapes {
 public:
  explicit CellShapes(const fem::Surface& surface) : surface_(surface) {}

  /// Returns the size of a cell in a direction.
  double size(std::size_t cell, std::size_t direction) const {
    const auto side = [&](double x) { return at(cell, direction == 0 ? Vector2d(x, 0.5) : Vector2d(0.5, x)).phi; };
    return (side(1) - side(0)).norm();
  }
  /// Returns the direction in which a cell is longer.
  std::size_t longer(std::size_t cell) const { return size(cell, 0) >= size(cell, 1) ? 0 : 1; }

  /// Whether the sides of a part of a cell are nearly straight. Their bend in the tangent plane, where polynomials are
  /// fitted, must be at most `bend` times the width of the part. `from` and `to` limit the part in `direction`.
  bool is_straight(std::size_t cell, std::size_t direction, double from, double to, double bend) const {
    const auto point = [&](double across, double along) {
      return at(cell, direction == 0 ? Vector2d(across, along) : Vector2d(along, across));
    };
    const auto sag = [&](double x) {
      const geometry::Frame middle = point(x, 0.5);
      const Eigen::Vector3d off = middle.phi - (point(x, 0).phi + point(x, 1).phi) / 2;
      return geometry::tangential(off, middle.a3).norm();
    };
    return std::max(sag(from), sag(to)) <= bend * (point(to, 0.5).phi - point(from, 0.5).phi).norm();
  }

 private:
  geometry::Frame at(std::size_t cell, const Vector2d& xi) const {
    return surface_.frame({.coarse = static_cast<int>(cell)}, xi, false);
  }

  const fem::Surface& surface_;
};

/// Judges cuts of chords: the parts of cells are neither too small, too slender nor too bent.
class CutRule {
 public:
  CutRule(const fem::Space& space, const CellShapes& shapes, const Chords& numbers, double most_slender)
      : shapes_(shapes),
        most_slender_(most_slender),
        parts_(fem::cut_cells(*space.coarse)),
        cells_(static_cast<std::size_t>(numbers.count)),
        may_be_bent_(space.degree <= constants.bent_degree) {
    for (std::size_t c = 0; c < numbers.of_cell.size(); ++c)
      for (std::size_t d = 0; d < 2; ++d)
        cells_[static_cast<std::size_t>(numbers.of_cell[c][d])].push_back({c, static_cast<Eigen::Index>(d)});
  }

  /// Whether the cells of a chord have sound parts if they are cut at this place in (0, 1).
  bool has_sound_parts(std::size_t chord, double cut) const {
    return std::ranges::all_of(cells_[chord], [&](const Crossing& at) {
      const auto d = static_cast<std::size_t>(at.direction);
      return shapes_.is_straight(at.cell, d, 0, cut, constants.largest_bend) &&
             shapes_.is_straight(at.cell, d, cut, 1, constants.largest_bend) &&
             shapes_.size(at.cell, 1 - d) <= most_slender_ * shapes_.size(at.cell, d) * std::min(cut, 1 - cut) &&
             parts_[at.cell].size[at.direction] * std::min(cut, 1 - cut) >= constants.smallest_cell;
    });
  }
  /// Whether a chord can be cut there: its parts are sound, and cells of high degree are straight.
  bool allows(std::size_t chord, double cut) const {
    return has_sound_parts(chord, cut) && (may_be_bent_ || std::ranges::all_of(cells_[chord], [&](const Crossing& at) {
                                             return shapes_.is_straight(at.cell, 0, 0, 1, constants.straight_bend) &&
                                                    shapes_.is_straight(at.cell, 1, 0, 1, constants.straight_bend);
                                           }));
  }

 private:
  /// A cell that a chord crosses, and the direction that it cuts.
  struct Crossing {
    std::size_t cell;
    Eigen::Index direction;
  };
  const CellShapes& shapes_;
  double most_slender_;
  std::vector<fem::CutCell> parts_;
  std::vector<std::vector<Crossing>> cells_;  // by chord
  bool may_be_bent_;
};

class ChordChoice {
 public:
  ChordChoice(const fem::Space& space, const fem::Surface& surface, const ChordTask& task)
      : space_(space), shapes_(surface), task_(task), numbers_(chords(*space.coarse)) {
    sum_up();
    place_cuts();
  }

  std::vector<mesh::Cuts> operator()() {
    choose();
    std::vector<mesh::Cuts> cuts;
    bool any = false;
    for (const auto& of_cell : numbers_.of_cell) {
      mesh::Cuts& own = cuts.emplace_back();
      for (std::size_t d = 0; d < 2; ++d) {
        const Chord& chord = chords_[of_cell[d]];
        if (chord.is_cut) own[d] = {chord.cut};
        any = any || chord.is_cut;
      }
    }
    if (!any) cuts.clear();
    return cuts;
  }

 private:
  /// Sums the data of chords over the cells of all ranks.
  void sum_up() {
    const mesh::Rule rule = mesh::gauss(space_.degree + 1);
    const std::size_t slices = rule.weights.size(), width = slices + 3;  // cells, crossed, without patches, slices
    std::vector<double> sums(width * static_cast<std::size_t>(numbers_.count), 0);
    const auto number = [&](std::size_t cell, std::size_t direction) {
      return static_cast<std::size_t>(numbers_.of_cell[space_.cells[cell].coarse][direction]);
    };
    for (std::size_t c = 0; c < space_.owned_cells; ++c)
      for (std::size_t d = 0; d < 2; ++d) {
        double* sum = sums.data() + width * number(c, d);
        sum[0] += 1;
        for (std::size_t i = 0; i < slices; ++i) sum[3 + i] += task_.shares[c] * task_.estimates.profiles[c][d][i];
      }
    // Cells that are both long and bent have no patches; shorter cells have patches. If regions or curves are the
    // reason, cuts do not help.
    for (const std::size_t c : task_.estimates.unjudged) {
      const auto coarse = static_cast<std::size_t>(space_.cells[c].coarse);
      const std::size_t along = shapes_.longer(coarse);
      if (!shapes_.is_straight(coarse, 1 - along, 0, 1, constants.straight_bend))
        sums[width * number(c, along) + 2] += 1;
    }
    for (const estimation::CrossedCell& crossed : task_.estimates.crossed)
      sums[width * number(crossed.cell, static_cast<std::size_t>(crossed.across)) + 1] += 1;
    sums = algebra::sums_over_ranks(sums, space_.layout->comm);
    for (std::size_t i = 0; i < sums.size(); i += width) {
      const std::span<const double> of_slices = std::span(sums).subspan(i + 3, slices);
      const double share = std::accumulate(of_slices.begin(), of_slices.end(), 0.0);
      whole_ += share;
      chords_.push_back({.cells = sums[i],
                         .share = share,
                         .cut = task_.halves_only ? 0.5 : cut_near(middle(of_slices, rule.weights)),
                         .crossed = sums[i + 1],
                         .unjudged = sums[i + 2]});
    }
  }

  void place_cuts() {
    const CutRule rule(space_, shapes_, numbers_, task_.most_slender);
    for (std::size_t i = 0; i < chords_.size(); ++i) {
      double& cut = chords_[i].cut;
      // Moves the cut towards the middle. A chord that cannot even be halved has no worth.
      while (cut != 0.5 && !rule.has_sound_parts(i, cut)) cut = std::abs(cut - 0.5) < 0.02 ? 0.5 : (2 * cut + 0.5) / 3;
      if (!rule.allows(i, cut)) chords_[i].share = 0;
    }
  }

  void choose() {
    if (task_.at_edges)
      choose_at_edges();
    else if (!task_.are_met)
      choose_by_worth();
    for (Chord& chord : chords_)
      chord.is_cut = chord.is_cut || (chord.share > 0 && is_cheaper_cut(chord.cells, chord.unjudged));
  }

  void choose_by_worth() {
    std::vector<std::size_t> ranking(chords_.size());
    std::iota(ranking.begin(), ranking.end(), std::size_t{0});
    std::ranges::sort(ranking, std::greater{}, [&](std::size_t i) { return chords_[i].rate(); });
    const double worth = edges_run_along_chords() ? constants.chord_worth_at_edges : constants.chord_worth;
    const double least =
        std::max(worth * task_.per_cell * whole_, constants.best_chord_part * chords_[ranking.front()].rate());
    double sum = 0, last = 0;
    for (const std::size_t i : ranking) {
      Chord& chord = chords_[i];
      const bool is_enough = sum >= task_.share * whole_ && chord.rate() < constants.alike_chords * last;
      if (is_enough || chord.rate() < least || !(chord.share > 0)) break;
      sum += chord.share;
      last = chord.rate();
      chord.is_cut = true;
    }
  }

  /// Whether cutting chords with this number of cells is cheaper than dividing `of_these` cells, each of which becomes
  /// four.
  static bool is_cheaper_cut(double cells, double of_these) { return of_these > 0 && cells <= 3 * of_these; }

  struct Edges {
    double cells = 0;    ///< number of cells at edges of contact zones
    double chords = 0;   ///< number of cells in the chords through them, across the edges
    bool can_be = true;  ///< whether all these chords can be cut
  };
  Edges edges() const {
    Edges sum;
    for (const Chord& chord : chords_) {
      if (!(chord.crossed > 0)) continue;
      sum.cells += chord.crossed;
      sum.chords += chord.cells;
      sum.can_be = sum.can_be && chord.share > 0;
    }
    return sum;
  }
  bool edges_run_along_chords() const {
    const Edges all = edges();
    return all.cells > 0 && all.chords < constants.edge_chord_cells * all.cells;
  }

  void choose_at_edges() {
    const Edges all = edges();
    if (!all.can_be || !is_cheaper_cut(all.chords, all.cells)) return;
    for (Chord& chord : chords_) chord.is_cut = chord.crossed > 0;
  }

  const fem::Space& space_;
  CellShapes shapes_;
  const ChordTask& task_;
  Chords numbers_;
  std::vector<Chord> chords_{};
  double whole_ = 0;
};

}  // namespace

Chords chords(const mesh::CoarseMesh& mesh) {
  PLASTRON_ASSERT(mesh.shape == mesh::Shape::quadrilateral);
  topology::DisjointSets sets(2 * mesh.cells.size());  // of cell directions that must be divided together
  std::map<std::pair<int, int>, std::size_t> cut;      // sides, each with the cell direction that cuts it
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int side = 0; side < 4; ++side) {
      const auto [from, to] = mesh::side_corners(mesh::Shape::quadrilateral, side);
      const auto ends = std::minmax(mesh.cells[c].vertices[from], mesh.cells[c].vertices[to]);
      const std::size_t direction = 2 * c + (side < 2 ? 1 : 0);
      const auto [other, is_new] = cut.try_emplace(ends, direction);
      if (!is_new) sets.unite(other->second, direction);
    }
  Chords result;
  std::map<std::size_t, int> numbers;
  const auto number = [&](std::size_t direction) {
    return numbers.try_emplace(sets.of(direction), static_cast<int>(numbers.size())).first->second;
  };
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const int first = number(2 * c);
    result.of_cell.push_back({first, number(2 * c + 1)});
  }
  result.count = static_cast<int>(numbers.size());
  return result;
}

namespace {

/// Whether chords can be cut: the mesh has any, no cell is divided, and there are no folds, whose two sides would have to be cut
/// alike.
bool has_whole_chords(const fem::Space& space) {
  return space.shape() == mesh::Shape::quadrilateral &&
         space.global_cells == static_cast<std::int64_t>(space.coarse->cells.size()) && space.coarse->folds.empty();
}

}  // namespace

std::vector<mesh::Cuts> chord_cuts(const fem::Space& space, const fem::Surface& surface, const ChordTask& task) {
  return has_whole_chords(space) ? ChordChoice(space, surface, task)() : std::vector<mesh::Cuts>{};
}

std::vector<mesh::Cuts> cuts_through(const fem::Space& space, const fem::Surface& surface,
                                     std::span<const std::size_t> cells, double most_slender) {
  if (!has_whole_chords(space)) return {};
  const CellShapes shapes(surface);
  const Chords numbers = chords(*space.coarse);
  const auto count = static_cast<std::size_t>(numbers.count);
  const auto number = [&](std::size_t coarse, std::size_t direction) {
    return static_cast<std::size_t>(numbers.of_cell[coarse][direction]);
  };
  std::vector<double> lengths(count, 0), given(count + 1, 0);  // numbers of cells; the last one: of all given cells
  for (const auto& of_cell : numbers.of_cell)
    for (const int chord : of_cell) lengths[static_cast<std::size_t>(chord)] += 1;
  const CutRule rule(space, shapes, numbers, most_slender);
  std::vector<char> can_be_cut;
  for (std::size_t chord = 0; chord < count; ++chord) can_be_cut.push_back(rule.allows(chord, 0.5) ? 1 : 0);
  for (const std::size_t cell : cells) {
    const auto coarse = static_cast<std::size_t>(space.cells[cell].coarse);
    for (std::size_t d = 0; d < 2; ++d) given[number(coarse, d)] += 1;
    given.back() += 1;
  }
  given = algebra::sums_over_ranks(given, space.layout->comm);
  // Each cell is cut along the chord that has more such cells; where both have as many, across its longer side.
  std::vector<double> chosen(count + 1, 0);  // the last one: cells without a chord
  for (const std::size_t cell : cells) {
    const auto coarse = static_cast<std::size_t>(space.cells[cell].coarse);
    const auto part = [&](std::size_t d) {
      const std::size_t chord = number(coarse, d);
      return can_be_cut[chord] != 0 ? given[chord] / lengths[chord] : 0;
    };
    const std::size_t d = part(0) == part(1) ? shapes.longer(coarse) : part(0) > part(1) ? 0 : 1;
    chosen[part(d) > 0 ? number(coarse, d) : count] += 1;
  }
  chosen = algebra::sums_over_ranks(chosen, space.layout->comm);
  double added = 0;
  for (std::size_t i = 0; i < count; ++i) added += chosen[i] > 0 ? lengths[i] : 0;
  if (chosen.back() > 0 || added > 3 * given.back()) return {};
  std::vector<mesh::Cuts> cuts(numbers.of_cell.size());
  for (std::size_t c = 0; c < cuts.size(); ++c)
    for (std::size_t d = 0; d < 2; ++d)
      if (chosen[number(c, d)] > 0) cuts[c][d] = {0.5};
  return cuts;
}

}  // namespace plastron::meshing
