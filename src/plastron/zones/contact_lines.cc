#include <plastron/zones/boundary_segments.hpp>

#include <plastron/solution/place_order.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace plastron::zones {

namespace {

/// A segment with a direction of travel.
struct Step {
  const Segment* segment = nullptr;
  int from = 0;

  const SegmentEnd& start() const { return segment->ends[static_cast<std::size_t>(from)]; }
  const SegmentEnd& end() const { return segment->ends[static_cast<std::size_t>(1 - from)]; }
  Step reversed() const { return {segment, 1 - from}; }
};

struct Chain {
  std::vector<Step> steps{};
  bool is_mended = false;  ///< true if its loose ends were joined

  const SegmentEnd& start() const { return steps.front().start(); }
  const SegmentEnd& end() const { return steps.back().end(); }
  bool is_closed() const { return is_mended || end().names == start().names; }
};

/// Joins segments whose ends have the same name.
class Chaining {
 public:
  explicit Chaining(const std::vector<const Segment*>& segments) {
    for (const Segment* s : segments)
      for (int from = 0; from < 2; ++from) at_[s->ends[static_cast<std::size_t>(from)].names].push_back({s, from});
  }

  /// Returns chains with loose ends first, then the closed ones.
  std::vector<Chain> chains() {
    std::vector<Chain> all;
    for (const bool loose : {true, false})
      for (const auto& [name, steps] : at_)
        for (const Step& step : steps)
          if (!used_.contains(step.segment) && (!loose || steps.size() % 2 == 1)) all.push_back(chain_from(step));
    return all;
  }

 private:
  Chain chain_from(Step step) {
    Chain chain;
    while (true) {
      chain.steps.push_back(step);
      used_.emplace(step.segment, true);
      const auto& next = at_.at(step.end().names);
      const auto found = std::ranges::find_if(next, [&](const Step& s) { return !used_.contains(s.segment); });
      if (found == next.end()) return chain;
      step = *found;
    }
  }

  std::map<std::array<algebra::GlobalIndex, 2>, std::vector<Step>> at_;
  std::map<const Segment*, bool> used_;
};

Chain reversed(const Chain& chain) {
  Chain back{{chain.steps.rbegin(), chain.steps.rend()}, chain.is_mended};
  for (Step& step : back.steps) step = step.reversed();
  return back;
}

double length_of(const Step& step) { return (step.end().point.place - step.start().point.place).norm(); }

/// Joins the loose ends of lines that cross a side with hanging nodes. There the small cells and the large cell end
/// the line at different points of the side, at most one distance of nodes apart.
class Mending {
 public:
  explicit Mending(std::vector<Chain> chains) : chains_(std::move(chains)) {}

  std::vector<Chain> operator()() {
    while (join_nearest()) {
    }
    return std::move(chains_);
  }

 private:
  /// The start or the end of a chain.
  struct End {
    std::size_t chain;
    bool is_start;
  };

  const SegmentEnd& at(const End& end) const {
    return end.is_start ? chains_[end.chain].start() : chains_[end.chain].end();
  }
  std::vector<End> loose_ends() const {
    std::vector<End> ends;
    for (std::size_t i = 0; i < chains_.size(); ++i)
      for (const bool is_start : {true, false})
        if (!chains_[i].is_closed() && at({i, is_start}).reach > 0) ends.push_back({i, is_start});
    return ends;
  }

  bool join_nearest() {
    const std::vector<End> ends = loose_ends();
    double nearest = std::numeric_limits<double>::infinity();
    std::pair<std::size_t, std::size_t> pair;
    for (std::size_t i = 0; i < ends.size(); ++i)
      for (std::size_t j = i + 1; j < ends.size(); ++j) {
        const double distance = (at(ends[i]).point.place - at(ends[j]).point.place).norm();
        const bool is_short = ends[i].chain == ends[j].chain && chains_[ends[i].chain].steps.size() < 3;
        if (is_short || distance >= nearest || distance > std::max(at(ends[i]).reach, at(ends[j]).reach)) continue;
        nearest = distance;
        pair = {i, j};
      }
    if (!std::isfinite(nearest)) return false;
    join(ends[pair.first], ends[pair.second]);
    return true;
  }

  void join(const End& a, const End& b) {
    if (a.chain == b.chain) {
      chains_[a.chain].is_mended = true;
      return;
    }
    Chain first = a.is_start ? reversed(chains_[a.chain]) : chains_[a.chain];
    const Chain second = b.is_start ? chains_[b.chain] : reversed(chains_[b.chain]);
    first.steps.insert(first.steps.end(), second.steps.begin(), second.steps.end());
    chains_[std::min(a.chain, b.chain)] = std::move(first);
    chains_.erase(chains_.begin() + static_cast<std::ptrdiff_t>(std::max(a.chain, b.chain)));
  }

  std::vector<Chain> chains_;
};

using Places = std::vector<std::array<std::int64_t, 3>>;

Places places_of(const Chain& chain, double size) {
  Places places;
  for (const Step& step : chain.steps) places.push_back(solution::in_units(step.start().point.place, size));
  places.push_back(solution::in_units(chain.end().point.place, size));
  return places;
}

/// Among all ways to traverse a line, returns the one whose places come first.
Chain in_order(const Chain& chain, double size) {
  std::vector<Chain> ways{chain, reversed(chain)};
  if (chain.is_closed())
    for (Chain& way : ways) {
      const Places places = places_of(way, size);
      const auto first = std::min_element(places.begin(), places.end() - 1);
      std::rotate(way.steps.begin(), way.steps.begin() + (first - places.begin()), way.steps.end());
    }
  return places_of(ways[1], size) < places_of(ways[0], size) ? ways[1] : ways[0];
}

/// Removes repeated points. Segments that end in a node have no length between them; a line keeps at least two
/// points.
void drop_repeated(std::vector<solution::BoundaryPoint>& points, double size) {
  constexpr double same = 1e-10;
  const auto is_repeated = [size](const solution::BoundaryPoint& a, const solution::BoundaryPoint& b) {
    return (a.place - b.place).norm() <= same * size && (a.x - b.x).norm() <= same * (1 + a.x.norm());
  };
  const solution::BoundaryPoint last = points.back();
  points.erase(std::unique(points.begin(), points.end(), is_repeated), points.end());
  if (points.size() == 1) points.push_back(last);
}

solution::ContactLine line_of(const Chain& chain, double size) {
  solution::ContactLine line{.is_closed = chain.is_closed(), .is_rim = chain.steps.front().segment->is_rim};
  const SegmentEnd* last = nullptr;
  for (const Step& step : chain.steps) {
    // The same place on the other side of a joined edge, or of a side with hanging nodes.
    if (!last || last->nodes != step.start().nodes) line.points.push_back(step.start().point);
    line.points.push_back(step.end().point);
    line.length += length_of(step);
    last = &step.end();
  }
  if (chain.is_mended) line.points.push_back(line.points.front());
  drop_repeated(line.points, size);
  return line;
}

}  // namespace

std::vector<solution::ContactLine> contact_lines(const std::vector<Segment>& segments, double size) {
  std::vector<solution::ContactLine> lines;
  for (const bool rim : {false, true}) {
    std::vector<const Segment*> those;
    for (const Segment& s : segments)
      if (s.is_rim == rim) those.push_back(&s);
    for (const Chain& chain : Mending(Chaining(those).chains())())
      lines.push_back(line_of(in_order(chain, size), size));
  }
  const auto key = [size](const solution::ContactLine& line) {
    return std::tuple(line.is_rim, -solution::in_units(line.length, size),
                      solution::in_units(line.points.front().place, size));
  };
  std::ranges::sort(lines, {}, key);
  return lines;
}

}  // namespace plastron::zones
