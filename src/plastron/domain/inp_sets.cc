#include <plastron/domain/inp_sets.hpp>

#include <plastron/domain/inp_lines.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace plastron::domain {

namespace {

constexpr std::size_t deepest_nesting = 100;
constexpr std::size_t most_members = 50'000'000;  ///< of all sets of a file: some seconds and 400 MB

void sort_without_duplicates(std::vector<std::int64_t>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

void InpMembers::refuse(const InpUse& use, const std::string& what) const {
  throw mesh::DomainError(fmt::format("{}: line {}: {}", source_, use.line, what));
}

std::size_t InpMembers::find(const InpUse& use, std::size_t but_not) const {
  for (const InpLevel level : {use.level, InpLevel::part})
    if (const auto found = sets_.number_of.find({level, use.name});
        found != sets_.number_of.end() && found->second != but_not)
      return found->second;
  if (sets_.number_of.contains({use.level, use.name}))
    refuse(use, fmt::format("the set of {}s \"{}\" contains itself", what_, geometry::shown(use.name)));
  refuse(use, fmt::format("\"{}\" is neither a whole number nor the name of a set of {}s in this file",
                          geometry::shown(use.name), what_));
}

void InpMembers::spend(std::size_t work) {
  work_ += work;
  if (work_ > most_members)
    throw mesh::DomainError(
        fmt::format("{}: the sets of {}s have more than {} members in all", source_, what_, most_members));
}

std::int64_t InpMembers::index(std::int64_t tag) const {
  const auto found = std::ranges::lower_bound(tags_, tag);
  return found != tags_.end() && *found == tag ? found - tags_.begin() : -1;
}

void InpMembers::add_range(const InpRange& range, const InpSet& set, Indices& indices) {
  const auto from = std::ranges::lower_bound(tags_, range.first), to = std::ranges::upper_bound(tags_, range.last);
  const std::int64_t wanted = (range.last - range.first) / range.step + 1;
  const std::size_t before = indices.size();
  spend(static_cast<std::size_t>(std::min<std::int64_t>(wanted, std::max<std::int64_t>(to - from, 0))) + 1);
  if (wanted <= to - from) {
    for (std::int64_t tag = range.first, k = 0; k < wanted; tag += range.step, ++k)
      if (const std::int64_t i = index(tag); i >= 0) indices.push_back(i);
  } else {
    for (auto tag = from; tag < to; ++tag)
      if ((*tag - range.first) % range.step == 0) indices.push_back(tag - tags_.begin());
  }
  const std::int64_t missing = wanted - static_cast<std::int64_t>(indices.size() - before);
  if (missing > 0 && missing_count_ == 0) first_missing_ = set.name;
  missing_count_ = std::min(missing_count_ + missing, largest_label);
}

InpMembers::Indices InpMembers::united(const InpSet& set, std::size_t number) {
  Indices result;
  for (const InpRange& range : set.ranges) add_range(range, set, result);
  for (const InpUse& use : set.sets) {
    const std::size_t member = find(use, number);
    if (std::ranges::find(open_, member) != open_.end())
      refuse(use, fmt::format("the set of {}s \"{}\" contains itself", what_, geometry::shown(use.name)));
    if (open_.size() > deepest_nesting) refuse(use, fmt::format("sets are nested more than {} deep", deepest_nesting));
    const Indices& inner = of(member);
    spend(inner.size() + 1);
    result.insert(result.end(), inner.begin(), inner.end());
  }
  sort_without_duplicates(result);
  return result;
}

const InpMembers::Indices& InpMembers::of(std::size_t set) {
  if (!resolved_[set]) {
    open_.push_back(set);
    Indices members = united(sets_.all[set], set);
    open_.pop_back();
    resolved_[set] = std::move(members);
  }
  return *resolved_[set];
}

InpMembers::Indices InpMembers::of(const InpSet& set) { return united(set, npos); }

InpMembers::Indices InpMembers::of(const InpMember& member) {
  if (member.number == 0) {
    const Indices& members = of(find(member.set));
    spend(members.size());
    return members;
  }
  const std::int64_t i = index(member.number);
  if (i < 0) refuse(member.set, fmt::format("there is no {} {}", what_, member.number));
  return {i};
}

}  // namespace plastron::domain
