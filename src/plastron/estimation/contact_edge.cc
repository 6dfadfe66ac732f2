#include <plastron/estimation/contact_edge.hpp>

#include <plastron/assembly/box_problem.hpp>
#include <plastron/estimation/cell_gaps.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/reference_cell.hpp>
#include <plastron/solution/contact_faces.hpp>

namespace plastron::estimation {

namespace {

constexpr int samples = 5;  ///< number of points between two nodes

/// Points on each line of nodes along a direction, `samples` between neighbours, line after line.
element::BasisAt between_nodes(const fem::Space& space, int direction) {
  const std::vector<double> line = mesh::gauss_lobatto(space.degree + 1).points;
  std::vector<Eigen::Vector2d> points;
  for (const double beside : line)
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      for (int s = 1; s <= samples; ++s) {
        Eigen::Vector2d xi(beside, beside);
        xi[direction] = line[i] + (line[i + 1] - line[i]) * s / (samples + 1);
        points.push_back(xi);
      }
  return element::basis_at(space.shape(), space.degree, points);
}

/// Lifts of bounds at points of a cell, interpolated from the nodes on which the cell depends.
Eigen::VectorXd interpolated_lifts(const assembly::DiscreteShell& discrete, std::size_t cell, std::size_t obstacle,
                                   const element::BasisAt& at) {
  if (!discrete.state.is_admissible()) return Eigen::VectorXd::Zero(at.value.rows());
  const fem::Space& space = discrete.space();
  const auto [nodes, basis] = space.continuity.on_sources(space.nodes(cell), at.value);
  Eigen::VectorXd lifts(static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    lifts[static_cast<Eigen::Index>(i)] = discrete.state.lift(static_cast<std::size_t>(nodes[i]), obstacle);
  return basis * lifts;
}

}  // namespace

ContactEdge::ContactEdge(const Solved& solved) : solved_(solved) {
  const assembly::DiscreteShell& discrete = solved.discrete;
  const fem::Space& space = discrete.space();
  const std::size_t obstacles = discrete.obstacles.all.size();
  if (obstacles == 0) return;
  width_.emplace(discrete, solution::contact_faces(discrete, solved.nodal).touching);
  if (solution::edge_contact(discrete, solved.nodal).is_line()) find_rim();
  eta_ = densities(solved.z.multiplier);
  is_pressed_.assign(obstacles, 0);
  for (const std::size_t k : assembly::pressed_obstacles(discrete)) is_pressed_[k] = 1;
  find_held();
  reaction_basis_ = element::reaction_basis_at(space.shape(), space.degree, discrete.shell.tables().quadrature.xi);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    for (std::size_t k = 0; k < obstacles; ++k) {
      std::size_t touching = 0, bounded = 0, of_these = 0;
      for (const algebra::LocalIndex node : space.nodes(cell)) {
        const bool touches_it = touches(static_cast<std::size_t>(node), k);
        const bool has_bound =
            discrete.points[static_cast<std::size_t>(node)].side_weight > 0;  // false for hanging nodes
        touching += touches_it ? 1 : 0;
        bounded += has_bound ? 1 : 0;
        of_these += touches_it && has_bound ? 1 : 0;
      }
      if (of_these == 0 || of_these == bounded) continue;
      if (stands_on_rim(cell, k) && !has_end_of_line(cell, k)) continue;
      crossed_.push_back(cell);
      touching_nodes_.push_back(touching);
      across_.push_back(width_->direction_across(cell, k));
      at_support_.push_back(place_at_support(cell, k, across_.back()));
      break;
    }
  find_sharp_edges();
  find_deepest();
}

void ContactEdge::find_held() {
  const assembly::DiscreteShell& discrete = solved_.discrete;
  const std::size_t obstacles = discrete.obstacles.all.size();
  held_ = algebra::Vector(discrete.space().layout, static_cast<int>(obstacles));
  for (const assembly::ContactRow& row : discrete.coordinates.rows)
    if (!row.is_touchable() && !row.is_left_out && discrete.points[row.node].weight > 0)
      held_.owned()[row.node * obstacles + static_cast<std::size_t>(row.obstacle)] = 1;
  held_.update_ghosts();
}

bool ContactEdge::is_held(std::size_t node, std::size_t obstacle) const {
  return held_.local()[node * solved_.discrete.obstacles.all.size() + obstacle] > 0;
}

bool ContactEdge::reaches_support(std::size_t cell, std::size_t obstacle) const {
  return std::ranges::all_of(solved_.discrete.space().nodes(cell), [&](algebra::LocalIndex node) {
    return touches(static_cast<std::size_t>(node), obstacle) || is_held(static_cast<std::size_t>(node), obstacle);
  });
}

std::optional<double> ContactEdge::place_at_support(std::size_t cell, std::size_t obstacle, int across) const {
  const fem::Space& space = solved_.discrete.space();
  if (space.shape() != mesh::Shape::quadrilateral || !reaches_support(cell, obstacle)) return {};
  const auto nodes = space.nodes(cell);
  const std::vector<double> line = mesh::gauss_lobatto(space.degree + 1).points;
  const std::size_t n = line.size();
  double sum = 0, count = 0;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const auto at = [&](std::size_t along) {
        return static_cast<std::size_t>(nodes[across == 0 ? j * n + along : along * n + j]);
      };
      if (touches(at(i), obstacle) == touches(at(i + 1), obstacle)) continue;
      sum += (line[i] + line[i + 1]) / 2;
      count += 1;
    }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

std::vector<Eigen::Vector2d> ContactEdge::sharp_edges(std::size_t cell, std::size_t obstacle, std::size_t direction,
                                                      std::size_t i, std::size_t j) const {
  constexpr double least_cosine = 0.7;  // between normals of one side
  constexpr int halvings = 12;
  const fem::Space& space = solved_.discrete.space();
  const std::vector<double> line = mesh::gauss_lobatto(space.degree + 1).points;
  const auto node =
      static_cast<std::size_t>(space.nodes(cell)[direction == 0 ? j * line.size() + i : i * line.size() + j]);
  const Eigen::Vector3d& normal = solved_.discrete.coordinates.gaps[obstacle][node].normal;
  const auto place = [&](double along) {
    Eigen::Vector2d xi(line[j], line[j]);
    xi[static_cast<Eigen::Index>(direction)] = along;
    return xi;
  };
  const auto is_on_other_side = [&](double along) {
    const element::BasisAt point = element::basis_at(space.shape(), space.degree, {place(along)});
    return cell_gaps(solved_, cell, obstacle, point).rows.front().normal.dot(normal) < least_cosine;
  };
  const bool at_node = is_on_other_side(line[i]);
  std::vector<Eigen::Vector2d> edges;
  for (const std::size_t next : {i - 1, i + 1}) {  // 0 - 1 is beyond the last one
    if (next >= line.size()) continue;
    double before = line[i];
    for (int s = 1; s <= samples; ++s) {
      double after = line[i] + (line[next] - line[i]) * s / (samples + 1);
      if (is_on_other_side(after) == at_node) {
        before = after;
        continue;
      }
      for (int h = 0; h < halvings; ++h) {
        const double middle = (before + after) / 2;
        (is_on_other_side(middle) == at_node ? before : after) = middle;
      }
      edges.push_back(place((before + after) / 2));
      break;
    }
  }
  return edges;
}

std::vector<ContactEdge::Part> ContactEdge::reactions_at(std::size_t node, double amount) const {
  const constraints::Row* row = solved_.discrete.space().continuity.find(node);
  if (row == nullptr) return {{node, amount}};
  std::vector<Part> parts;
  for (const constraints::Term& term : row->terms)
    if (term.weight > 0) parts.push_back({static_cast<std::size_t>(term.node), term.weight * amount});
  return parts;
}

template <class Item>
void ContactEdge::share_reactions(std::vector<Item>& items) const {
  const std::size_t obstacles = solved_.discrete.obstacles.all.size();
  algebra::Vector sums(solved_.discrete.space().layout, static_cast<int>(obstacles));
  for (const Item& item : items)
    for (const Part& part : item.reactions) sums.local()[part.node * obstacles + item.obstacle] += part.part;
  sums.accumulate_ghosts();
  sums.update_ghosts();
  for (Item& item : items)
    for (Part& part : item.reactions) part.part /= sums.local()[part.node * obstacles + item.obstacle];
}

double ContactEdge::reaction(const std::vector<Part>& parts, std::size_t obstacle,
                             const std::vector<double>& densities) const {
  double sum = 0;
  for (const Part& part : parts)
    sum += part.part * solved_.discrete.points[part.node].side_weight *
           densities[part.node * solved_.discrete.obstacles.all.size() + obstacle];
  return sum;
}

// Beyond a sharp edge the distance is that to another side of the body, and no gap. The node's own gap keeps the edge outside of its
// tangent plane, wherever it is (obstacle/gap.cc). But its reaction acts at the node: eta (B z - w) at the edge remains.
void ContactEdge::find_sharp_edges() {
  const assembly::DiscreteShell& discrete = solved_.discrete;
  const fem::Space& space = discrete.space();
  const std::size_t obstacles = discrete.obstacles.all.size(), n = static_cast<std::size_t>(space.degree) + 1;
  sharp_ = algebra::Vector(space.layout, static_cast<int>(obstacles));
  if (space.shape() != mesh::Shape::quadrilateral) return;
  const algebra::Vector with_area = width_->with_area();
  for (std::size_t c = 0; c < crossed_.size(); ++c)
    for (std::size_t k = 0; k < obstacles; ++k) {
      if (!discrete.obstacles.all[k].has_edges() || stands_on_rim(crossed_[c], k)) continue;
      const auto nodes = space.nodes(crossed_[c]);
      const auto d = static_cast<std::size_t>(width_->direction_across(crossed_[c], k));
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
          const auto node = static_cast<std::size_t>(nodes[d == 0 ? j * n + i : i * n + j]);
          const std::size_t entry = node * obstacles + k;
          if (!touches(node, k) || with_area.local()[entry] > 0) continue;
          auto edges = sharp_edges(crossed_[c], k, d, i, j);
          if (edges.empty()) continue;
          at_sharp_edges_.push_back({c, k, node, std::move(edges), reactions_at(node, 1)});
          has_kinks_ = has_kinks_ || (i > 0 && i + 1 < n);
          sharp_.local()[entry] += 1;
        }
    }
  has_kinks_ = algebra::sum_over_ranks(std::int64_t{has_kinks_}, space.layout->comm) > 0;
  sharp_.accumulate_ghosts();
  sharp_.update_ghosts();
  share_reactions(at_sharp_edges_);
}

// The gap at the edge is 0, so w of the energy is minus the opening by u_h there.
double ContactEdge::reach_at(const AtSharpEdge& at, const Dual& dual) const {
  const assembly::DiscreteShell& discrete = solved_.discrete;
  const std::size_t cell = crossed_[at.crossed];
  const obstacle::Gap& gap = discrete.coordinates.gaps[at.obstacle][at.node];
  const element::BasisAt points = element::basis_at(discrete.space().shape(), discrete.space().degree, at.edges);
  std::vector<geometry::Frame> frames(at.edges.size());
  discrete.shell.surface().frames(discrete.space().cells[cell], at.edges, frames, false);
  std::vector<double> moved(at.edges.size(), 0);
  const auto add = [&](const algebra::Vector& y) {
    const element::CellField field =
        discrete.shell.interpolation().values(cell, points, discrete.shell.gather(cell, y));
    const assembly::Vector6 own = assembly::node_values(y, at.node);
    for (std::size_t p = 0; p < moved.size(); ++p)
      moved[p] += opening(discrete, gap, frames[p].a3, field.row(static_cast<Eigen::Index>(p)).transpose()) -
                  opening(discrete, gap, discrete.points[at.node].a3, own);
  };
  add(dual.y);
  if (dual.derivative.weighs_gaps) add(solved_.nodal.y);
  return std::max(*std::ranges::max_element(moved), -*std::ranges::min_element(moved));
}

void ContactEdge::find_deepest() {
  const fem::Space& space = solved_.discrete.space();
  if (space.shape() != mesh::Shape::quadrilateral) return;
  const std::size_t obstacles = solved_.discrete.obstacles.all.size(), n = static_cast<std::size_t>(space.degree) + 1;
  for (int d = 0; d < 2; ++d) between_[static_cast<std::size_t>(d)] = between_nodes(space, d);
  const algebra::Vector with_area = width_->with_area(), with_inside = width_->with_inside();
  for (std::size_t c = 0; c < crossed_.size(); ++c)
    for (std::size_t k = 0; k < obstacles; ++k) {
      const auto nodes = space.nodes(crossed_[c]);
      const auto touches_it = [&](algebra::LocalIndex node) { return touches(static_cast<std::size_t>(node), k); };
      if (std::ranges::none_of(nodes, touches_it) || stands_on_rim(crossed_[c], k)) continue;
      const auto d = static_cast<std::size_t>(width_->direction_across(crossed_[c], k));
      const Eigen::VectorXd found = cell_gaps(solved_, crossed_[c], k, between_[d]).values;
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
          const auto node = static_cast<std::size_t>(nodes[d == 0 ? j * n + i : i * n + j]);
          if (!touches(node, k) || with_inside.local()[node * obstacles + k] > 0 || is_at_sharp_edge(node, k)) continue;
          const auto line = found.begin() + static_cast<std::ptrdiff_t>(j * (n - 1) * samples);
          const auto from = line + static_cast<std::ptrdiff_t>(i == 0 ? 0 : (i - 1) * samples);
          const auto to = line + static_cast<std::ptrdiff_t>(std::min(i + 1, n - 1) * samples);
          const auto least = std::min_element(from, to);
          if (!(*least < 0)) continue;
          const bool on_line = with_area.local()[node * obstacles + k] == 0;
          deepest_.push_back({c, k, d, least - found.begin(), *least, on_line, reactions_at(node, -*least)});
        }
    }
  share_reactions(deepest_);
}

// An obstacle at rest: mu g(u_h), for the energy with eta, and eta (B z - w). The obstacle of a force moves by z, too. The energy's
// term eta g(u_h) and the gap in w are large and cancel where only the position of the obstacle is wrong, so they are one term there.
ContactEdge::Products ContactEdge::products(const Dual& dual, std::size_t obstacle, const obstacle::Gap& gap, double mu,
                                            double eta, double opened, double opened_by_dual) const {
  const double depth = gap.initial + opened;
  double reach = opened_by_dual - dual.derivative.held_at(obstacle, gap);
  if (is_pressed_[obstacle] == 0)
    return {.penetration = (dual.derivative.weighs_gaps ? mu + eta : mu) * depth, .reach = eta * reach};
  reach -= dual.positions[obstacle] * gap.normal.dot(solved_.discrete.obstacles.all[obstacle].force.normalized());
  if (dual.derivative.weighs_gaps) reach += depth;
  return {.penetration = mu * depth, .reach = eta * reach};
}

std::vector<double> ContactEdge::line_shares(const Dual& dual) const {
  const assembly::DiscreteShell& discrete = solved_.discrete;
  std::vector<double> lines(crossed_.size(), 0);
  for (const Deepest& at : deepest_) {
    // Energies change only with the square of the edge's error.
    if (!at.on_line && dual.derivative.weighs_gaps) continue;
    const std::size_t cell = crossed_[at.crossed];
    const element::BasisAt& between = between_[at.direction];
    const Eigen::Vector2d xi = between.xi[static_cast<std::size_t>(at.point)];
    const element::BasisAt point = element::basis_at(mesh::Shape::quadrilateral, discrete.space().degree, {xi});
    const CellGaps found = cell_gaps(solved_, cell, at.obstacle, point);
    const obstacle::Gap& gap = found.rows.front();
    const auto sum = [&](const std::vector<double>& densities) {
      return reaction(at.reactions, at.obstacle, densities);
    };
    lines[at.crossed] += products(dual, at.obstacle, gap, sum(dual.mu), sum(eta_), at.gap - gap.initial,
                                  openings(solved_, cell, found, point, dual.y)[0])
                             .larger();
  }
  for (const AtSharpEdge& at : at_sharp_edges_)
    lines[at.crossed] += std::abs(reaction(at.reactions, at.obstacle, eta_)) * reach_at(at, dual);
  return lines;
}

void ContactEdge::find_rim() {
  const fem::Space& space = solved_.discrete.space();
  on_rim_.assign(solved_.discrete.points.size(), 0);
  for (const fem::BoundarySide& side : solution::edge_sides(solved_.discrete)) {
    if (side.cell < space.owned_cells) rim_sides_.emplace_back(side.cell, side.side);
    for (const int node : mesh::side_nodes(space.shape(), space.degree, side.side))
      on_rim_[static_cast<std::size_t>(space.nodes(side.cell)[static_cast<std::size_t>(node)])] = 1;
  }
}

bool ContactEdge::stands_on_rim(std::size_t cell, std::size_t obstacle) const {
  return !on_rim_.empty() && std::ranges::all_of(solved_.discrete.space().nodes(cell), [&](algebra::LocalIndex node) {
    const auto i = static_cast<std::size_t>(node);
    return on_rim_[i] != 0 || !touches(i, obstacle);
  });
}

bool ContactEdge::has_end_of_line(std::size_t cell, std::size_t obstacle) const {
  const fem::Space& space = solved_.discrete.space();
  return std::ranges::any_of(rim_sides_, [&](const auto& side) {
    if (side.first != cell) return false;
    const auto nodes = mesh::side_nodes(space.shape(), space.degree, side.second);
    const auto touching = std::ranges::count_if(nodes, [&](int node) {
      return touches(static_cast<std::size_t>(space.nodes(cell)[static_cast<std::size_t>(node)]), obstacle);
    });
    return touching > 0 && touching < std::ssize(nodes);
  });
}

/// Multipliers of active coordinates as densities that open the gap of their obstacle.
std::vector<double> ContactEdge::densities(const algebra::Vector& multiplier) const {
  const assembly::DiscreteShell& discrete = solved_.discrete;
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const std::size_t obstacles = discrete.obstacles.all.size();
  algebra::Vector all(discrete.space().layout, static_cast<int>(obstacles));
  for (const assembly::ContactRow& row : coordinates.rows) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    if (!row.binds || solved_.nodal.touching.at(row.node)[k] == 0) continue;
    all.owned()[row.node * obstacles + k] =
        multiplier.owned()[coordinates.at(row.node, row.coordinate)] / (row.scale * discrete.points[row.node].weight);
  }
  all.update_ghosts();
  solution::give_to_faces(discrete, all);
  discrete.space().continuity.apply(all);
  return {all.local().begin(), all.local().end()};
}

// The multiplier of a held node belongs to its support, but next to it the obstacle may press with its whole pressure.
void ContactEdge::extend_to_held_nodes(std::size_t cell, std::size_t obstacle, Eigen::MatrixXd& densities) const {
  if (!reaches_support(cell, obstacle)) return;
  const auto nodes = solved_.discrete.space().nodes(cell);
  double sum = 0, touching = 0;
  for (Eigen::Index i = 0; i < densities.rows(); ++i)
    if (touches(static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)]), obstacle)) {
      sum += densities(i, 1);
      touching += 1;
    }
  for (Eigen::Index i = 0; i < densities.rows() && touching > 0; ++i)
    if (is_held(static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)]), obstacle))
      densities(i, 1) = sum / touching;
}

double ContactEdge::share(std::size_t cell, std::size_t obstacle, const Dual& dual) const {
  const assembly::DiscreteShell& discrete = solved_.discrete;
  const energy::ShellOperator& shell = discrete.shell;
  const fem::Space& space = discrete.space();
  const element::BasisAt& at = shell.tables().quadrature;
  const std::size_t obstacles = discrete.obstacles.all.size();
  if (stands_on_rim(cell, obstacle)) return 0;  // a line reaction is no density
  Eigen::MatrixXd densities(space.nodes_per_cell(), 2);
  for (int i = 0; i < space.nodes_per_cell(); ++i) {
    const auto node = static_cast<std::size_t>(space.nodes(cell)[static_cast<std::size_t>(i)]);
    const std::size_t entry = node * obstacles + obstacle;
    if (is_at_sharp_edge(node, obstacle))
      densities.row(i).setZero();  // a line reaction, too
    else
      densities.row(i) << dual.mu[entry], eta_[entry];
  }
  extend_to_held_nodes(cell, obstacle, densities);
  const Eigen::MatrixXd density = reaction_basis_ * densities;
  const CellGaps gaps = cell_gaps(solved_, cell, obstacle, at);
  const Eigen::VectorXd by_dual = openings(solved_, cell, gaps, at, dual.y);
  const Eigen::VectorXd lifts = interpolated_lifts(discrete, cell, obstacle, at);
  Products sum;
  for (int q = 0; q < lifts.size(); ++q) {
    obstacle::Gap gap = gaps.rows[static_cast<std::size_t>(q)];
    const double area = shell.point(cell, q).area, opened = gaps.values[q] - gap.initial;
    gap.initial -= lifts[q];  // LiftedBounds counts them
    const Products here = products(dual, obstacle, gap, area * density(q, 0), area * density(q, 1), opened, by_dual[q]);
    sum.penetration += here.penetration;
    sum.reach += here.reach;
  }
  return sum.larger();
}

EdgeShares ContactEdge::shares(const Derivative& derivative, const DualSolution& dual, const algebra::Vector& y) const {
  EdgeShares result(crossed_.size());
  if (eta_.empty()) return result;
  Dual z{.derivative = derivative,
         .y = y,
         .mu = densities(dual.multiplier),
         .positions = std::vector<double>(is_pressed_.size(), 0)};
  const std::vector<std::size_t> pressed = assembly::pressed_obstacles(solved_.discrete);
  for (std::size_t k = 0; k < pressed.size(); ++k) z.positions[pressed[k]] = dual.positions.at(k);
  result.lines = line_shares(z);
  for (std::size_t i = 0; i < crossed_.size(); ++i) {
    for (std::size_t k = 0; k < solved_.discrete.obstacles.all.size(); ++k) result.all[i] += share(crossed_[i], k, z);
    result.all[i] = std::max(result.all[i], result.lines[i]);
  }
  return result;
}

}  // namespace plastron::estimation
