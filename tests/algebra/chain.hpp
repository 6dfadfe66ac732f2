// Small systems for tests, spread over all ranks in contiguous pieces.
#pragma once
#include <plastron/algebra/matrix.hpp>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

namespace plastron::test {

using algebra::Connectivity;
using algebra::GlobalIndex;
using algebra::Layout;
using algebra::LocalIndex;
using algebra::Matrix;
using algebra::Vector;

inline int rank(MPI_Comm comm = MPI_COMM_WORLD) {
  int value = 0;
  MPI_Comm_rank(comm, &value);
  return value;
}

inline int ranks(MPI_Comm comm = MPI_COMM_WORLD) {
  int value = 1;
  MPI_Comm_size(comm, &value);
  return value;
}

/// Elements given by global nodes: one belongs to the rank that owns its first node.
using Elements = std::vector<std::vector<GlobalIndex>>;

/// n nodes in equal pieces, without ghosts.
inline Layout pieces(GlobalIndex n, MPI_Comm comm) {
  Layout layout{.comm = comm};
  layout.first = n * rank(comm) / ranks(comm);
  layout.owned = static_cast<LocalIndex>(n * (rank(comm) + 1) / ranks(comm) - layout.first);
  layout.global_size = n;
  return layout;
}

inline bool owns(const Layout& layout, GlobalIndex node) {
  return node >= layout.first && node < layout.first + layout.owned;
}

/// With the ghosts that the elements of this rank need, and no others.
inline std::shared_ptr<const Layout> layout_for(GlobalIndex n, const Elements& elements,
                                                MPI_Comm comm = MPI_COMM_WORLD) {
  auto layout = std::make_shared<Layout>(pieces(n, comm));
  for (const auto& element : elements)
    if (owns(*layout, element.front()))
      for (const GlobalIndex node : element)
        if (!owns(*layout, node)) layout->ghosts.push_back(node);
  std::ranges::sort(layout->ghosts);
  layout->ghosts.erase(std::unique(layout->ghosts.begin(), layout->ghosts.end()), layout->ghosts.end());
  return layout;
}

inline std::vector<LocalIndex> local_nodes(const Layout& layout, const std::vector<GlobalIndex>& element) {
  std::vector<LocalIndex> nodes;
  for (const GlobalIndex node : element) {
    if (owns(layout, node)) {
      nodes.push_back(static_cast<LocalIndex>(node - layout.first));
    } else {
      const auto ghost = std::ranges::lower_bound(layout.ghosts, node) - layout.ghosts.begin();
      nodes.push_back(layout.owned + static_cast<LocalIndex>(ghost));
    }
  }
  return nodes;
}

inline Connectivity connectivity(const Layout& layout, const Elements& elements) {
  Connectivity own;
  for (const auto& element : elements) {
    own.nodes_per_element = static_cast<int>(element.size());
    if (!owns(layout, element.front())) continue;
    const auto nodes = local_nodes(layout, element);
    own.nodes.insert(own.nodes.end(), nodes.begin(), nodes.end());
  }
  return own;
}

/// Elements (0,1), (1,2), ...
inline Elements chain(GlobalIndex n) {
  Elements elements;
  for (GlobalIndex i = 0; i + 1 < n; ++i) elements.push_back({i, i + 1});
  return elements;
}

/// Elements for every pair of nodes.
inline Elements all_pairs(GlobalIndex n) {
  Elements elements;
  for (GlobalIndex i = 0; i < n; ++i)
    for (GlobalIndex j = i + 1; j < n; ++j) elements.push_back({i, j});
  return elements;
}

/// value(i) for the global scalar unknown i.
template <class Function>
Vector vector_of(const std::shared_ptr<const Layout>& layout, int block, Function value) {
  Vector v(layout, block);
  for (std::size_t i = 0; i < v.owned().size(); ++i)
    v.owned()[i] = value(layout->first * block + static_cast<GlobalIndex>(i));
  v.update_ghosts();
  return v;
}

/// The owned values of all ranks, on every rank.
inline std::vector<double> gather(const Vector& v) {
  std::vector<double> all(static_cast<std::size_t>(v.layout()->global_size * v.block()), 0.0);
  const auto first = static_cast<std::ptrdiff_t>(v.layout()->first * v.block());
  std::ranges::copy(v.owned(), all.begin() + first);
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, v.layout()->comm);
  return all;
}

}  // namespace plastron::test
