#include <plastron/certificate/contact_lines.hpp>

#include <plastron/certificate/place_order.hpp>

#include <algorithm>
#include <map>
#include <tuple>

namespace plastron::certificate {

namespace {

/// A segment as a line runs through it.
struct Step {
  const Segment* segment = nullptr;
  int from = 0;

  const SegmentEnd& start() const { return segment->ends[static_cast<std::size_t>(from)]; }
  const SegmentEnd& end() const { return segment->ends[static_cast<std::size_t>(1 - from)]; }
  Step reversed() const { return {segment, 1 - from}; }
};
using Chain = std::vector<Step>;

bool is_closed(const Chain& chain) { return chain.back().end().names == chain.front().start().names; }

/// Chains segments where their ends have the same name.
class Chaining {
 public:
  explicit Chaining(const std::vector<const Segment*>& segments) {
    for (const Segment* s : segments)
      for (int from = 0; from < 2; ++from) at_[s->ends[static_cast<std::size_t>(from)].names].push_back({s, from});
  }

  /// Those with loose ends first, then the closed ones.
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
      chain.push_back(step);
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
  Chain back(chain.rbegin(), chain.rend());
  for (Step& step : back) step = step.reversed();
  return back;
}

using Places = std::vector<std::array<std::int64_t, 3>>;

Places places_of(const Chain& chain, double size) {
  Places places;
  for (const Step& step : chain) places.push_back(in_units(step.start().point.place, size));
  places.push_back(in_units(chain.back().end().point.place, size));
  return places;
}

/// Of all ways to run through a line the one whose places come first.
Chain in_order(const Chain& chain, double size) {
  std::vector<Chain> ways{chain, reversed(chain)};
  if (is_closed(chain))
    for (Chain& way : ways) {
      const Places places = places_of(way, size);
      const auto first = std::min_element(places.begin(), places.end() - 1);
      std::rotate(way.begin(), way.begin() + (first - places.begin()), way.end());
    }
  return places_of(ways[1], size) < places_of(ways[0], size) ? ways[1] : ways[0];
}

/// Segments that end in a node have no length between them; a line keeps two points all the same.
void drop_repeated(std::vector<BoundaryPoint>& points, double size) {
  constexpr double same = 1e-10;
  const auto is_repeated = [size](const BoundaryPoint& a, const BoundaryPoint& b) {
    return (a.place - b.place).norm() <= same * size && (a.x - b.x).norm() <= same * (1 + a.x.norm());
  };
  const BoundaryPoint last = points.back();
  points.erase(std::unique(points.begin(), points.end(), is_repeated), points.end());
  if (points.size() == 1) points.push_back(last);
}

ContactLine line_of(const Chain& chain, double size) {
  ContactLine line{.is_closed = is_closed(chain), .is_rim = chain.front().segment->is_rim};
  const SegmentEnd* last = nullptr;
  for (const Step& step : chain) {
    // The same place on the other side of a joined edge.
    if (!last || last->nodes != step.start().nodes) line.points.push_back(step.start().point);
    line.points.push_back(step.end().point);
    line.length += (step.end().point.place - step.start().point.place).norm();
    last = &step.end();
  }
  drop_repeated(line.points, size);
  return line;
}

}  // namespace

std::vector<ContactLine> contact_lines(const std::vector<Segment>& segments, double size) {
  std::vector<ContactLine> lines;
  for (const bool rim : {false, true}) {
    std::vector<const Segment*> those;
    for (const Segment& s : segments)
      if (s.is_rim == rim) those.push_back(&s);
    for (const Chain& chain : Chaining(those).chains()) lines.push_back(line_of(in_order(chain, size), size));
  }
  const auto key = [size](const ContactLine& line) {
    return std::tuple(line.is_rim, -in_units(line.length, size), in_units(line.points.front().place, size));
  };
  std::ranges::sort(lines, {}, key);
  return lines;
}

}  // namespace plastron::certificate
