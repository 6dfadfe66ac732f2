// The members of an input file's sets as indices of nodes and elements.
#pragma once
#include <plastron/domain/inp_deck.hpp>

namespace plastron::domain {

/// Sets of one kind, nodes or elements, whose members may be other sets of the same kind. A set is resolved at its first
/// use. Throws DomainError for a set that does not exist, contains itself, or is nested more than 100 deep.
class InpMembers {
 public:
  using Indices = std::vector<std::int64_t>;

  /// `tags` are the numbers that exist, ascending: an index is a place among them.
  InpMembers(const InpSets& sets, std::string source, const char* what, Indices tags)
      : sets_(sets), source_(std::move(source)), what_(what), tags_(std::move(tags)), resolved_(sets.all.size()) {}

  /// Members of a set without duplicates, ascending.
  const Indices& of(std::size_t set);
  /// Members of a set that is no part of `sets`, for example a surface of nodes. Its sets are.
  Indices of(const InpSet& set);
  /// The index of a number, or the members of a set.
  Indices of(const InpMember& member);
  std::size_t find(const InpUse& use, std::size_t but_not = npos) const;

  /// Numbers in sets that do not exist: how many, and the name of the first set that has one.
  std::int64_t missing_count() const { return missing_count_; }
  const std::string& first_missing() const { return first_missing_; }

  static constexpr auto npos = static_cast<std::size_t>(-1);

 private:
  Indices united(const InpSet& set, std::size_t number);
  void add_range(const InpRange& range, const InpSet& set, Indices& indices);
  std::int64_t index(std::int64_t tag) const;
  void spend(std::size_t work);
  [[noreturn]] void refuse(const InpUse& use, const std::string& what) const;

  const InpSets& sets_;
  std::string source_;
  const char* what_;
  Indices tags_;
  std::vector<std::optional<Indices>> resolved_;
  std::vector<std::size_t> open_{};  ///< sets that are being resolved, each a member of the one before
  std::int64_t missing_count_ = 0;
  std::string first_missing_{};
  std::size_t work_ = 0;
};

}  // namespace plastron::domain
