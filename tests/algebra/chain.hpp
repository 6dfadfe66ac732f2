// Small systems for tests, distributed over all ranks in contiguous pieces.
#pragma once
#include <plastron/algebra/matrix.hpp>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

namespace plastron::test {

using algebra::Connectivity;
using algebra::Distribution;
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

/// Elements given by global nodes. The rank that owns the first node owns the element.
using Elements = std::vector<std::vector<GlobalIndex>>;

/// n nodes in equal pieces, without ghosts.
inline Distribution pieces(GlobalIndex n, MPI_Comm comm) {
  const GlobalIndex first = n * rank(comm) / ranks(comm);
  return {.comm = comm,
          .first = first,
          .owned = static_cast<LocalIndex>(n * (rank(comm) + 1) / ranks(comm) - first),
          .global_size = n};
}

/// With the ghosts that the elements of this rank need.
inline std::shared_ptr<const Layout> layout_for(GlobalIndex n, const Elements& elements,
                                                MPI_Comm comm = MPI_COMM_WORLD) {
  Distribution mine = pieces(n, comm);
  for (const auto& element : elements)
    if (mine.owns(element.front())) mine.add_ghosts(element);
  return std::make_shared<const Layout>(std::move(mine));
}

inline std::vector<LocalIndex> local_nodes(const Layout& layout, const std::vector<GlobalIndex>& element) {
  std::vector<LocalIndex> nodes;
  for (const GlobalIndex node : element) nodes.push_back(layout.local(node));
  return nodes;
}

inline Connectivity connectivity(const Layout& layout, const Elements& elements) {
  Connectivity own;
  for (const auto& element : elements) {
    own.nodes_per_element = static_cast<int>(element.size());
    if (!layout.owns(element.front())) continue;
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
