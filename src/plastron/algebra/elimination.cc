#include "elimination.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>

namespace plastron::algebra {
namespace {

/// Number of blocks in a node's upper row from which nested dissection replaces minimum degree: it then saves more than
/// it costs. Such rows belong to cells with nodes inside (measured at degree 2, 8.5 blocks: a sixth fewer operations
/// for thirty times the time; at degree 4, 18 blocks: 40 % fewer).
constexpr double many_blocks = 12;

using SparsePointer = std::unique_ptr<cholmod_sparse, std::function<void(cholmod_sparse*)>>;

SparsePointer owned(cholmod_sparse* matrix, cholmod_common& common) {
  return {matrix, [&common](cholmod_sparse* m) { cholmod_free_sparse(&m, &common); }};
}

/// A group of unknowns that is eliminated at once: the unknowns of a node that need not come last, or one that must.
struct Vertex {
  std::size_t first;  ///< unknown
  int width;          ///< number of the node's unknowns, without those that come last
  bool is_last;
};

/// Returns the nodes in the given order, then the unknowns that come last.
std::vector<Vertex> vertices_of(const MatrixStorage& A, const std::vector<int>& nodes, std::span<const char> last) {
  const auto m = static_cast<std::size_t>(A.block);
  std::vector<Vertex> vertices, at_end;
  for (const int node : nodes) {
    const std::size_t first = static_cast<std::size_t>(node) * m;
    Vertex vertex{.first = first, .width = A.block, .is_last = false};
    for (std::size_t i = first; !last.empty() && i < first + m; ++i)
      if (last[i]) {
        at_end.push_back({.first = i, .width = 1, .is_last = true});
        --vertex.width;
      }
    if (vertex.width > 0) vertices.push_back(vertex);
  }
  vertices.insert(vertices.end(), at_end.begin(), at_end.end());
  return vertices;
}

/// Vertices of every node, by their places in the order.
struct VerticesOfNodes {
  std::vector<int> start, vertex;

  VerticesOfNodes(const std::vector<Vertex>& vertices, std::size_t block, std::size_t nodes) : start(nodes + 1, 0) {
    for (const Vertex& v : vertices) ++start[v.first / block + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    vertex.resize(vertices.size());
    auto next = start;
    for (std::size_t k = 0; k < vertices.size(); ++k)
      vertex[static_cast<std::size_t>(next[vertices[k].first / block]++)] = static_cast<int>(k);
  }
  std::span<const int> of(std::size_t node) const {
    return {vertex.data() + start[node], vertex.data() + start[node + 1]};
  }
};

/// Calls edge(i, j), i < j, for each pair of coupled vertices. The last `chain` vertices become one chain.
template <class Edge>
void for_edges(const MatrixStorage& A, const VerticesOfNodes& vertices, int count, int chain, const Edge& edge) {
  for (LocalIndex row = 0; row < A.wide->owned; ++row)
    for (std::size_t k = A.row_begin(row); k < A.row_end(row); ++k)
      for (const int i : vertices.of(static_cast<std::size_t>(row)))
        for (const int j : vertices.of(static_cast<std::size_t>(A.column[k])))
          if (row != A.column[k] || i < j) edge(std::min(i, j), std::max(i, j));
  for (int i = count - chain; i + 1 < count; ++i) edge(i, i + 1);
}

/// Returns the pattern above the diagonal, compressed by columns.
SparsePointer upper_pattern(const MatrixStorage& A, const std::vector<Vertex>& order, int chain,
                            cholmod_common& common) {
  const VerticesOfNodes vertices(order, static_cast<std::size_t>(A.block), A.global.size());
  const int count = static_cast<int>(order.size());
  std::vector<int> start(order.size() + 1, 0);
  for_edges(A, vertices, count, chain, [&](int, int j) { ++start[static_cast<std::size_t>(j) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  auto pattern = owned(cholmod_allocate_sparse(order.size(), order.size(), static_cast<std::size_t>(start.back()), 0, 1,
                                               1, CHOLMOD_PATTERN, &common),
                       common);
  cholmod_check(common, "making room for a graph");
  std::ranges::copy(start, static_cast<int*>(pattern->p));
  int* rows = static_cast<int*>(pattern->i);
  for_edges(A, vertices, count, chain, [&](int i, int j) { rows[start[static_cast<std::size_t>(j)]++] = i; });
  return pattern;
}

/// Returns the nodes in an order with little fill-in.
std::vector<int> order_of_nodes(const MatrixStorage& A, cholmod_common& common) {
  std::vector<int> nodes(A.global.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  const auto pattern = upper_pattern(A, vertices_of(A, nodes, {}), 0, common);
  std::vector<int> order(nodes.size()), parent(nodes.size()), member(nodes.size());
  if (static_cast<double>(A.column.size()) > many_blocks * static_cast<double>(nodes.size()))
    cholmod_nested_dissection(pattern.get(), nullptr, 0, order.data(), parent.data(), member.data(), &common);
  else
    cholmod_amd(pattern.get(), nullptr, 0, order.data(), &common);
  cholmod_check(common, "ordering the nodes of a matrix");
  return order;
}

/// Reorders the same elimination: each column is directly before the columns that depend on it, where possible. The
/// last column stays.
void postorder(const MatrixStorage& A, int chain, std::vector<Vertex>& order, cholmod_common& common) {
  const auto pattern = upper_pattern(A, order, chain, common);
  std::vector<int> parent(order.size()), post(order.size());
  cholmod_etree(pattern.get(), parent.data(), &common);
  cholmod_postorder(parent.data(), order.size(), nullptr, post.data(), &common);
  cholmod_check(common, "ordering an elimination tree");
  std::vector<Vertex> next;
  next.reserve(order.size());
  for (const int k : post) next.push_back(order[static_cast<std::size_t>(k)]);
  order = std::move(next);
}

/// Returns CHOLMOD's analysis of the vertices. Columns are merged according to their number of unknowns.
cholmod_factor* analyse(const MatrixStorage& A, const std::vector<Vertex>& order, int chain, cholmod_common& common) {
  const auto pattern = upper_pattern(A, order, chain, common);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NATURAL;
  common.postorder = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  const auto block = static_cast<std::size_t>(A.block);
  const std::array<std::size_t, 3> unknowns{4, 16, 48};  // CHOLMOD's own values
  for (std::size_t k = 0; k < unknowns.size(); ++k) common.nrelax[k] = std::max<std::size_t>(1, unknowns[k] / block);
  cholmod_factor* factor = cholmod_analyze(pattern.get(), &common);
  cholmod_check(common, "analysing the pattern of a matrix");
  return factor;
}

template <class T>
std::span<T> values(void* pointer, std::size_t count) {
  return {static_cast<T*>(pointer), count};
}

/// Returns the supernode of each column.
std::vector<std::size_t> supernodes(const cholmod_factor& L) {
  const auto super = values<const int>(L.super, L.nsuper + 1);
  std::vector<std::size_t> supernode_of(L.n);
  for (std::size_t s = 0; s < L.nsuper; ++s)
    for (int i = super[s]; i < super[s + 1]; ++i) supernode_of[static_cast<std::size_t>(i)] = s;
  return supernode_of;
}

/// Sets CHOLMOD's sizes of the largest blocks that a supernode passes to other supernodes.
void measure_largest_blocks(cholmod_factor& L) {
  const auto super = values<const int>(L.super, L.nsuper + 1), begin = values<const int>(L.pi, L.nsuper + 1),
             rows = values<const int>(L.s, L.ssize);
  const std::vector<std::size_t> supernode_of = supernodes(L);
  L.maxcsize = L.maxesize = 1;
  const auto owner = [&](int p) { return supernode_of[static_cast<std::size_t>(rows[static_cast<std::size_t>(p)])]; };
  for (std::size_t s = 0; s < L.nsuper; ++s) {
    const int end = begin[s + 1];
    int p = begin[s] + super[s + 1] - super[s];
    L.maxesize = std::max(L.maxesize, static_cast<std::size_t>(end - p));
    while (p < end) {
      int q = p;
      while (q < end && owner(q) == owner(p)) ++q;
      L.maxcsize = std::max(L.maxcsize, static_cast<std::size_t>(q - p) * static_cast<std::size_t>(end - p));
      p = q;
    }
  }
}

/// Returns the pattern of unknowns from the pattern of vertices; `start` is the first unknown of each vertex.
cholmod_factor* expand(const cholmod_factor& V, const std::vector<int>& start, cholmod_common& common) {
  const auto at = [&](int vertex) { return start[static_cast<std::size_t>(vertex)]; };
  const auto super = values<const int>(V.super, V.nsuper + 1), begin = values<const int>(V.pi, V.nsuper + 1),
             rows = values<const int>(V.s, V.ssize);
  std::vector<int> pi{0}, px{0}, s;
  std::size_t entries = 0;
  for (std::size_t k = 0; k < V.nsuper; ++k) {
    for (int p = begin[k]; p < begin[k + 1]; ++p)
      for (int i = at(rows[static_cast<std::size_t>(p)]); i < at(rows[static_cast<std::size_t>(p)] + 1); ++i)
        s.push_back(i);
    const std::size_t length = s.size() - static_cast<std::size_t>(pi.back());
    entries += length * static_cast<std::size_t>(at(super[k + 1]) - at(super[k]));
    if (entries > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw std::runtime_error("more entries of a factor than 32-bit indices can number: use several ranks");
    pi.push_back(static_cast<int>(s.size()));
    px.push_back(static_cast<int>(entries));
  }
  cholmod_factor* L = cholmod_allocate_factor(static_cast<std::size_t>(start.back()), &common);
  cholmod_check(common, "making room for the pattern of a factor");
  const auto place = [&](const std::vector<int>& from) {
    int* to = static_cast<int*>(cholmod_malloc(std::max<std::size_t>(1, from.size()), sizeof(int), &common));
    if (to) std::ranges::copy(from, to);
    return to;
  };
  std::vector<int> first;
  for (const int k : super) first.push_back(at(k));
  L->ordering = CHOLMOD_NATURAL;
  L->is_ll = L->is_super = L->is_monotonic = 1;
  L->nsuper = V.nsuper;
  L->ssize = s.size();
  L->xsize = entries;
  L->super = place(first), L->pi = place(pi), L->px = place(px), L->s = place(s);
  if (common.status == CHOLMOD_OK) measure_largest_blocks(*L);
  return L;
}

double mean_entries_of_paths(const cholmod_factor& L) {
  const auto super = values<const int>(L.super, L.nsuper + 1), begin = values<const int>(L.pi, L.nsuper + 1),
             rows = values<const int>(L.s, L.ssize);
  const std::vector<std::size_t> supernode_of = supernodes(L);
  std::vector<double> entries(L.nsuper);
  double sum = 0;
  for (std::size_t k = L.nsuper; k-- > 0;) {
    const int columns = super[k + 1] - super[k], parent = begin[k] + columns;
    entries[k] = columns * (begin[k + 1] - begin[k] - 0.5 * columns);
    if (parent < begin[k + 1])
      entries[k] += entries[supernode_of[static_cast<std::size_t>(rows[static_cast<std::size_t>(parent)])]];
    sum += columns * entries[k];
  }
  return sum / static_cast<double>(L.n);
}

FactorisationCost cost_of(const cholmod_factor& L) {
  const auto super = values<const int>(L.super, L.nsuper + 1), begin = values<const int>(L.pi, L.nsuper + 1);
  FactorisationCost cost;
  for (std::size_t k = 0; k < L.nsuper; ++k)
    for (int column = 0; column < super[k + 1] - super[k]; ++column) {
      const double length = begin[k + 1] - begin[k] - column;
      cost.entries += length;
      cost.operations += length * length;
    }
  cost.entries_of_path = mean_entries_of_paths(L);
  return cost;
}

std::vector<int> places(const MatrixStorage& A, const std::vector<Vertex>& order, std::span<const char> last) {
  std::vector<int> place(A.owned_unknowns());
  int next = 0;
  for (const Vertex& v : order) {
    const auto end = v.is_last ? v.first + 1 : v.first + static_cast<std::size_t>(A.block);
    for (std::size_t i = v.first; i < end; ++i)
      if (v.is_last || last.empty() || !last[i]) place[i] = next++;
  }
  return place;
}

}  // namespace

void cholmod_check(const cholmod_common& common, const char* doing) {
  if (common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (common.status < 0)
    throw std::runtime_error(std::string("CHOLMOD failed while ") + doing + ", status " +
                             std::to_string(common.status));
}

Elimination eliminate(const MatrixStorage& A, std::span<const char> last, cholmod_common& common,
                      cholmod_factor*& factor) {
  auto order = vertices_of(A, order_of_nodes(A, common), last);
  const auto at_end = static_cast<int>(std::ranges::count_if(last, [](char mark) { return mark != 0; }));
  postorder(A, at_end, order, common);
  std::vector<int> start{0};
  for (const Vertex& v : order) start.push_back(start.back() + v.width);
  cholmod_factor* of_vertices = analyse(A, order, at_end, common);
  factor = expand(*of_vertices, start, common);
  cholmod_free_factor(&of_vertices, &common);
  cholmod_check(common, "making room for the pattern of a factor");
  return {.place = places(A, order, last), .last = at_end, .cost = cost_of(*factor)};
}

}  // namespace plastron::algebra
