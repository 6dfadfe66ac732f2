#include <plastron/constraints/map.hpp>

#include <plastron/algebra/assertion.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace plastron::constraints {

namespace {

using algebra::LocalIndex;
using Vector6 = Eigen::Matrix<double, 6, 1>;

double* values_of(std::span<double> values, LocalIndex node, std::size_t block) {
  return values.data() + static_cast<std::size_t>(node) * block;
}

/// Adds the term's part of v_node: weight block w.
void add(const Term& term, const double* w, std::size_t block, double* v) {
  if (term.block)
    Eigen::Map<Vector6>{v} += term.weight * (*term.block * Eigen::Map<const Vector6>(w));
  else
    for (std::size_t c = 0; c < block; ++c) v[c] += term.weight * w[c];
}

/// Adds the term's part of the force on w: weight block' f.
void add_transposed(const Term& term, const double* f, std::size_t block, double* w) {
  if (term.block)
    Eigen::Map<Vector6>{w} += term.weight * (term.block->transpose() * Eigen::Map<const Vector6>(f));
  else
    for (std::size_t c = 0; c < block; ++c) w[c] += term.weight * f[c];
}

std::size_t index_of(LocalIndex node, std::vector<LocalIndex>& nodes) {
  const auto found = std::ranges::find(nodes, node);
  if (found != nodes.end()) return static_cast<std::size_t>(found - nodes.begin());
  nodes.push_back(node);
  return nodes.size() - 1;
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
}

const Row* Map::find(std::size_t node) const {
  const auto number = static_cast<LocalIndex>(node);
  const auto found = std::ranges::lower_bound(rows_, number, {}, &Row::node);
  return found != rows_.end() && found->node == number ? &*found : nullptr;
}

void Map::apply(algebra::Vector& v) const {
  const auto block = static_cast<std::size_t>(v.block());
  // A term's node may be constrained itself: all values are computed before any is changed.
  std::vector<double> computed(rows_.size() * block, 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (const Term& term : rows_[i].terms) {
      PLASTRON_ASSERT(!term.block || block == 6, block);
      add(term, values_of(v.local(), term.node, block), block, computed.data() + i * block);
    }
  for (std::size_t i = 0; i < rows_.size(); ++i)
    std::copy_n(computed.data() + i * block, block, values_of(v.local(), rows_[i].node, block));
}

void Map::apply_transposed(algebra::Vector& f) const {
  if (is_identity_) return;
  const auto block = static_cast<std::size_t>(f.block());
  const LocalIndex owned = f.layout()->owned;
  const auto values = f.local();
  std::ranges::fill(values.subspan(f.owned().size()), 0.0);
  std::vector<double> forces;
  for (const Row& row : rows_) {
    if (row.node >= owned) break;
    double* at = values_of(values, row.node, block);
    forces.insert(forces.end(), at, at + block);
    std::fill_n(at, block, 0.0);
  }
  for (std::size_t i = 0; i * block < forces.size(); ++i)
    for (const Term& term : rows_[i].terms)
      add_transposed(term, forces.data() + i * block, block, values_of(values, term.node, block));
  f.accumulate_ghosts();
}

std::vector<LocalIndex> Map::sources(std::span<const LocalIndex> nodes) const {
  std::vector<LocalIndex> all;
  for (const LocalIndex node : nodes)
    if (const Row* row = find(node))
      for (const Term& term : row->terms) index_of(term.node, all);
    else
      index_of(node, all);
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
  NodeColumns result{.nodes = sources(nodes)};
  const Eigen::Index width = matrix.cols() / static_cast<Eigen::Index>(nodes.size());
  result.matrix.setZero(matrix.rows(), width * static_cast<Eigen::Index>(result.nodes.size()));
  const auto columns = [&](LocalIndex node) {
    return result.matrix.middleCols(width * static_cast<Eigen::Index>(index_of(node, result.nodes)), width);
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto given = matrix.middleCols(width * static_cast<Eigen::Index>(i), width);
    const Row* row = find(nodes[i]);
    if (!row) {
      columns(nodes[i]) += given;
      continue;
    }
    for (const Term& term : row->terms)
      if (term.block)
        columns(term.node) += given * (term.weight * *term.block);
      else
        columns(term.node) += term.weight * given;
  }
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
