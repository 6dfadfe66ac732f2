#include <plastron/constraints/map.hpp>

#include <plastron/algebra/assertion.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace plastron::constraints {

namespace {

using algebra::LocalIndex;

/// Calls call(size) with a size that is known at compile time for six values, by far the most frequent: that is faster.
template <class Call>
void with_size(Eigen::Index block, Call&& call) {
  if (block == 6)
    call(std::integral_constant<int, 6>{});
  else
    call(std::integral_constant<int, Eigen::Dynamic>{});
}

void add_once(LocalIndex node, std::vector<LocalIndex>& nodes) {
  if (std::ranges::find(nodes, node) == nodes.end()) nodes.push_back(node);
}

/// Adds the term of an outer map with the inner row of its node in place of the node.
void append(const Term& outer, const Row* inner, std::vector<Term>& terms) {
  if (!inner) {
    terms.push_back(outer);
    return;
  }
  for (Term next : inner->terms) {
    next.weight *= outer.weight;
    if (outer.block && next.block)
      next.block = std::make_shared<const Matrix6>(*outer.block * *next.block);
    else if (outer.block)
      next.block = outer.block;
    terms.push_back(std::move(next));
  }
}

}  // namespace

Term term(LocalIndex node, const Matrix6& block) {
  return {.node = node, .block = std::make_shared<const Matrix6>(block)};
}

Matrix6 Row::own() const {
  Matrix6 sum = Matrix6::Zero();
  for (const Term& term : terms)
    if (term.node == node) sum += term.weight * (term.block ? *term.block : Matrix6::Identity());
  return sum;
}

Map::Map(std::vector<Row> rows, MPI_Comm comm) : rows_(std::move(rows)) {
  std::ranges::sort(rows_, {}, &Row::node);
  is_identity_ = algebra::sum_over_ranks(static_cast<std::int64_t>(rows_.size()), comm) == 0;
  is_read_.resize(rows_.size());
  for (const Row& row : rows_)
    for (const Term& term : row.terms)
      if (const Row* read = find(static_cast<std::size_t>(term.node)); read && read != &row)
        is_read_[static_cast<std::size_t>(read - rows_.data())] = 1;
}

const Row* Map::find(std::size_t node) const {
  const auto number = static_cast<LocalIndex>(node);
  const auto found = std::ranges::lower_bound(rows_, number, {}, &Row::node);
  return found != rows_.end() && found->node == number ? &*found : nullptr;
}

void Map::apply(algebra::Vector& v) const {
  double* values = v.local().data();
  const Eigen::Index block = v.block();
  with_size(block, [&](auto size) {
    using Values = Eigen::Matrix<double, size(), 1>;
    const auto at = [=](LocalIndex node) { return Eigen::Map<Values>(values + node * block, block); };
    const auto sum_of = [&](const Row& row) {
      Values sum = Values::Zero(block);
      for (const Term& term : row.terms) {
        PLASTRON_ASSERT(!term.block || block == 6, block);
        if (term.block)
          sum += term.weight * (*term.block * at(term.node));
        else
          sum += term.weight * at(term.node);
      }
      return sum;
    };
    // Values that other rows read are changed last.
    std::vector<Values> of_read;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (is_read_[i]) of_read.push_back(sum_of(rows_[i]));
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (!is_read_[i]) at(rows_[i].node) = sum_of(rows_[i]);
    auto next = of_read.begin();
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (is_read_[i]) at(rows_[i].node) = *next++;
  });
}

void Map::apply_transposed(algebra::Vector& f) const {
  if (is_identity_) return;
  std::ranges::fill(f.local().subspan(f.owned().size()), 0.0);
  double* values = f.local().data();
  const Eigen::Index block = f.block();
  const LocalIndex owned = f.layout()->owned;
  with_size(block, [&](auto size) {
    using Values = Eigen::Matrix<double, size(), 1>;
    const auto at = [=](LocalIndex node) { return Eigen::Map<Values>(values + node * block, block); };
    const auto take = [&](const Row& row) {
      Values force = at(row.node);
      at(row.node).setZero();
      return force;
    };
    const auto give = [&](const Row& row, const Values& force) {
      for (const Term& term : row.terms)
        if (term.block)
          at(term.node) += term.weight * (term.block->transpose() * force);
        else
          at(term.node) += term.weight * force;
    };
    // Forces at nodes that other rows read are taken before these rows add to them. Those of ghosts are zero.
    std::vector<Values> of_read;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (is_read_[i]) of_read.push_back(take(rows_[i]));
    auto next = of_read.begin();
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (is_read_[i])
        give(rows_[i], *next++);
      else if (rows_[i].node < owned)
        give(rows_[i], take(rows_[i]));
  });
  f.accumulate_ghosts();
}

std::vector<LocalIndex> Map::sources(std::span<const LocalIndex> nodes) const {
  std::vector<LocalIndex> all;
  for (const LocalIndex node : nodes)
    if (const Row* row = find(node))
      for (const Term& term : row->terms) add_once(term.node, all);
    else
      add_once(node, all);
  return all;
}

algebra::Connectivity Map::couplings(const algebra::Connectivity& elements) const {
  if (rows_.empty()) return elements;
  algebra::Connectivity coupled{.nodes_per_element = 0, .nodes = {}, .start = {0}};
  for (std::size_t e = 0; e < elements.elements(); ++e) {
    const auto nodes = sources(elements.element(e));
    coupled.nodes.insert(coupled.nodes.end(), nodes.begin(), nodes.end());
    coupled.start.push_back(coupled.nodes.size());
  }
  return coupled;
}

NodeColumns Map::on_sources(std::span<const LocalIndex> nodes, RowMatrix matrix) const {
  if (rows_.empty() || std::ranges::none_of(nodes, [&](LocalIndex node) { return constrains(node); }))
    return {{nodes.begin(), nodes.end()}, std::move(matrix)};
  const Eigen::Index width = matrix.cols() / static_cast<Eigen::Index>(nodes.size());
  NodeColumns result{.nodes = sources(nodes)};
  result.matrix.setZero(matrix.rows(), width * static_cast<Eigen::Index>(result.nodes.size()));
  with_size(width, [&](auto size) {
    const auto columns = [&](LocalIndex node) {
      const auto place = std::ranges::find(result.nodes, node) - result.nodes.begin();
      return result.matrix.middleCols<size()>(width * place, width);
    };
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto given = matrix.middleCols<size()>(width * static_cast<Eigen::Index>(i), width);
      if (const Row* row = find(static_cast<std::size_t>(nodes[i]))) {
        for (const Term& term : row->terms)
          if (term.block)
            columns(term.node) += given * (term.weight * *term.block);
          else
            columns(term.node) += term.weight * given;
      } else {
        columns(nodes[i]) += given;
      }
    }
  });
  return result;
}

void Map::renumber(const algebra::Distribution& before, const algebra::Distribution& after) {
  const auto renumbered = [&](LocalIndex node) { return after.local(before.global(node)); };
  for (Row& row : rows_) {
    row.node = renumbered(row.node);
    for (Term& term : row.terms) term.node = renumbered(term.node);
  }
}

Map compose(const Map& outer, const Map& inner, MPI_Comm comm) {
  std::vector<Row> rows;
  for (const Row& row : outer.rows()) {
    Row& resolved = rows.emplace_back(Row{.node = row.node});
    for (const Term& term : row.terms) append(term, inner.find(static_cast<std::size_t>(term.node)), resolved.terms);
  }
  for (const Row& row : inner.rows())
    if (!outer.constrains(static_cast<std::size_t>(row.node))) rows.push_back(row);
  return {std::move(rows), comm};
}

}  // namespace plastron::constraints
