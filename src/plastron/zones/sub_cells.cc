#include <plastron/zones/sub_cells.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/topology/disjoint_sets.hpp>

#include <algorithm>

namespace plastron::zones {

namespace {

std::vector<SubCell> sub_squares(int k) {
  const auto node = [k](int i, int j) { return j * (k + 1) + i; };
  std::vector<SubCell> all;
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < k; ++i) all.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
  return all;
}

std::vector<SubCell> sub_triangles(int k) {
  const auto node = [k](int i, int j) { return j * (k + 1) - j * (j - 1) / 2 + i; };
  std::vector<SubCell> all;
  for (int j = 0; j < k; ++j)
    for (int i = 0; i + j < k; ++i) {
      all.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
      if (i + j + 2 <= k) all.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return all;
}

}  // namespace

std::vector<SubCell> sub_cells(mesh::Shape shape, int degree) {
  return shape == mesh::Shape::triangle ? sub_triangles(degree) : sub_squares(degree);
}

namespace {

/// The components connected by this rank's own cells, by local node.
topology::DisjointSets local_components(const fem::Space& space, std::span<const char> inside) {
  topology::DisjointSets sets(static_cast<std::size_t>(space.layout->local_size()));
  const auto subs = sub_cells(space.shape(), space.degree);
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const auto nodes = space.nodes(c);
    for (const SubCell& sub : subs) {
      algebra::LocalIndex first = -1;
      for (const int corner : sub) {
        const algebra::LocalIndex node = nodes[static_cast<std::size_t>(corner)];
        if (!inside[static_cast<std::size_t>(node)]) continue;
        if (first < 0) first = node;
        sets.unite(static_cast<std::size_t>(first), static_cast<std::size_t>(node));
      }
    }
  }
  for (const constraints::Row& row : space.continuity.rows())
    for (const constraints::Term& term : row.terms) {
      const auto i = static_cast<std::size_t>(row.node), j = static_cast<std::size_t>(term.node);
      if (inside[i] && inside[j]) sets.unite(i, j);
    }
  return sets;
}

/// Names of components. Names of the same component are united over all ranks.
struct SameNames {
  std::vector<double> names;  ///< ascending, each once
  topology::DisjointSets sets;

  std::size_t set_of(double name) {
    return sets.of(static_cast<std::size_t>(std::ranges::lower_bound(names, name) - names.begin()));
  }
};

/// Unites pairs of names (collective).
SameNames same_names(std::span<const double> pairs, MPI_Comm comm) {
  const std::vector<double> all = algebra::gathered(pairs, comm);
  std::vector<double> names = all;
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  SameNames same{.names = names, .sets = topology::DisjointSets(names.size())};
  for (std::size_t i = 0; i < all.size(); i += 2) same.sets.unite(same.set_of(all[i]), same.set_of(all[i + 1]));
  return same;
}

}  // namespace

ZoneLabels zone_labels(const fem::Space& space, std::span<const char> inside) {
  const algebra::Layout& layout = *space.layout;
  const auto count = static_cast<std::size_t>(layout.local_size());
  topology::DisjointSets sets = local_components(space, inside);
  // A component is named after one of its nodes. If a rank has another name for a node than its owner, both names
  // mean one component.
  algebra::Vector owners(space.layout, 1);
  std::vector<double> mine(count), pairs;
  for (std::size_t i = 0; i < count; ++i)
    owners.local()[i] = mine[i] = static_cast<double>(layout.global(static_cast<algebra::LocalIndex>(sets.of(i))));
  owners.update_ghosts();
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_ghost = i >= static_cast<std::size_t>(layout.owned);
    if (inside[i] && (is_ghost || sets.of(i) == i)) pairs.insert(pairs.end(), {mine[i], owners.local()[i]});
  }
  SameNames same = same_names(pairs, layout.comm);

  ZoneLabels labels{.count = 0, .of_node = std::vector<int>(count, -1)};
  std::vector<int> number(same.names.size(), -1);
  for (std::size_t k = 0; k < number.size(); ++k)
    if (same.sets.of(k) == k) number[k] = labels.count++;
  for (std::size_t i = 0; i < count; ++i)
    if (inside[i]) labels.of_node[i] = number[same.set_of(mine[i])];
  return labels;
}

}  // namespace plastron::zones
