// The loops of pack_kernels.hpp. The files that compile them name the lanes, the namespace and the kernels
// (pack_kernels_*.cc).
#pragma once
#include <plastron/energy/pack_points.hpp>

namespace plastron::energy {

namespace PLASTRON_PACK_NAMESPACE {

/// Components of a field with `block` values for each node.
struct Components {
  int first, count, block;
};
constexpr Components all_components{0, 6, 6}, of_rotation{3, 3, 6}, scalar{0, 1, 1};

/// A pack of cells between nodal values and strains: gathered values, derivatives at points by tables along one direction
/// after the other, and the transpose of each step. The end of a name says the range of its array: nodes, full or
/// reduced Gauss points. The points along xi_2 are named first, then those along xi_1, which run fastest.
class PackCell {
 public:
  explicit PackCell(const PackedCells& c)
      : c_(c),
        n_(c.value.columns),
        m_(c.kind == PackedCells::Kind::tied ? n_ - 1 : 0),
        nodes_(c.nodes_per_cell),
        points_(c.points_per_cell),
        scratch_(6 * nodes_ + 15 * points_ + 12 * n_ * n_ + 9 * m_ * n_ + 12 * m_ * n_ + 6 * m_ * m_ + 5 * points_ +
                 4 * m_ * n_ + m_ * m_ + m_ * n_) {
    field_ = scratch_.take(6 * nodes_);
    d1_ = scratch_.take(6 * points_);
    d2_ = scratch_.take(6 * points_);
    r_ = scratch_.take(3 * points_);
    value_full_nodes_ = scratch_.take(6 * n_ * n_);
    d_full_nodes_ = scratch_.take(6 * n_ * n_);
    value_reduced_nodes_ = scratch_.take(6 * m_ * n_);
    d_reduced_nodes_ = scratch_.take(3 * m_ * n_);
    along_1_ = scratch_.take(6 * m_ * n_);
    along_2_ = scratch_.take(6 * m_ * n_);
    mixed_ = scratch_.take(6 * m_ * m_);
    tied_ = scratch_.take(5 * points_);
    sampled_1_ = scratch_.take(2 * m_ * n_);
    sampled_2_ = scratch_.take(2 * m_ * n_);
    sampled_mixed_ = scratch_.take(m_ * m_);
    half_mixed_ = scratch_.take(m_ * n_);
  }

  /// Gathers the pack's nodal values. Lanes without a cell get zeros.
  void gather(std::size_t pack, const Components& which, const double* y) {
    const std::int32_t* nodes[lanes];
    const int used = nodes_of(pack, nodes), first = which.first, last = which.first + which.count;
    for (int i = 0; i < nodes_; ++i) {
      const double* at[lanes];
      for (int l = 0; l < lanes; ++l) at[l] = y + which.block * static_cast<std::ptrdiff_t>(nodes[l][i]);
      for (int k = first; k < last; ++k) {
        Pack v{};
        for (int l = 0; l < lanes; ++l) v[l] = at[l][k];
        field_[k * nodes_ + i] = v;
      }
    }
    if (used == lanes) return;
    Pack is_used{};
    for (int l = 0; l < used; ++l) is_used[l] = 1;
    for (int i = first * nodes_; i < last * nodes_; ++i) field_[i] = is_used != 0 ? field_[i] : Pack{};
  }
  /// Adds the pack's nodal forces to f, cell by cell.
  void scatter(std::size_t pack, const Components& which, double* f) const {
    const std::int32_t* nodes[lanes];
    const int used = nodes_of(pack, nodes);
    for (int l = 0; l < used; ++l)
      for (int i = 0; i < nodes_; ++i) {
        double* at = f + which.block * static_cast<std::ptrdiff_t>(nodes[l][i]);
        const double* force = reinterpret_cast<const double*>(field_ + i) + l;
        for (int k = which.first; k < which.first + which.count; ++k) at[k] += force[k * nodes_ * lanes];
      }
  }

  /// Computes derivatives of some components at the quadrature points, and r itself if `with_r`.
  void differentiate(const Components& which, bool with_r) {
    const int first = which.first, count = which.count;
    const Pack* field = field_ + first * nodes_;
    Pack *d1 = d1_ + first * points_, *d2 = d2_ + first * points_;
    if (c_.kind == PackedCells::Kind::plain) {
      map_1(forward(c_.cell_d1), field, d1, count);
      map_1(forward(c_.cell_d2), field, d2, count);
      if (with_r) map_1(forward(c_.cell_value), field_ + 3 * nodes_, r_, 3);
      return;
    }
    Pack *value = value_full_nodes_ + first * n_ * n_, *d = d_full_nodes_ + first * n_ * n_;
    map_2(forward(c_.value), field, value, count, n_);
    map_2(forward(c_.d), field, d, count, n_);
    map_1(forward(c_.d), value, d1, count * n_);
    map_1(forward(c_.value), d, d2, count * n_);
    if (with_r) map_1(forward(c_.value), value_full_nodes_ + 3 * n_ * n_, r_, 3 * n_);
  }
  /// Computes nodal forces from the duals of derivatives and r, and if `with_samples` also from the duals of the tied
  /// strains' samples. It is the transpose.
  void differentiate_transposed(const Components& which, bool with_r, bool with_samples) {
    const int first = which.first, count = which.count;
    Pack* field = field_ + first * nodes_;
    const Pack *d1 = d1_ + first * points_, *d2 = d2_ + first * points_;
    if (c_.kind == PackedCells::Kind::plain) {
      map_1(transposed(c_.cell_d1), d1, field, count);
      add_1(transposed(c_.cell_d2), d2, field, count);
      if (with_r) add_1(transposed(c_.cell_value), r_, field_ + 3 * nodes_, 3);
      return;
    }
    Pack *value = value_full_nodes_ + first * n_ * n_, *d = d_full_nodes_ + first * n_ * n_;
    map_1(transposed(c_.d), d1, value, count * n_);
    map_1(transposed(c_.value), d2, d, count * n_);
    if (with_r) add_1(transposed(c_.value), r_, value_full_nodes_ + 3 * n_ * n_, 3 * n_);
    if (with_samples) add_samples_to_lines();
    map_2(transposed(c_.value), value, field, count, n_);
    add_2(transposed(c_.d), d, field, count, n_);
    if (with_samples) {
      add_2(transposed(c_.reduced_value), value_reduced_nodes_, field_, 6, n_);
      add_2(transposed(c_.reduced_d), d_reduced_nodes_, field_, 3, n_);
    }
  }

  /// Computes the tied strains at the quadrature points from the sampling points (M22). Call it after differentiate().
  void tie(const Pack* geometry) {
    const int mn = m_ * n_, mm = m_ * m_;
    map_2(forward(c_.reduced_value), field_, value_reduced_nodes_, 6, n_);
    map_2(forward(c_.reduced_d), field_, d_reduced_nodes_, 3, n_);
    map_1(forward(c_.reduced_d), value_full_nodes_, along_1_, 3 * n_);
    map_1(forward(c_.reduced_value), value_full_nodes_ + 3 * n_ * n_, along_1_ + 3 * mn, 3 * n_);
    map_1(forward(c_.value), d_reduced_nodes_, along_2_, 3 * m_);
    map_1(forward(c_.value), value_reduced_nodes_ + 3 * mn, along_2_ + 3 * mn, 3 * m_);
    map_1(forward(c_.reduced_d), value_reduced_nodes_, mixed_, 3 * m_);
    map_1(forward(c_.reduced_value), d_reduced_nodes_, mixed_ + 3 * mm, 3 * m_);
    geometry = sample_line(geometry, along_1_, sampled_1_);
    geometry = sample_line(geometry, along_2_, sampled_2_);
    for (int t = 0; t < mm; ++t, geometry += PackedCells::sampling_size)
      sampled_mixed_[t] = dot(vector_at(mixed_ + t, mm), vector_at(geometry + 3, 1)) +
                          dot(vector_at(mixed_ + 3 * mm + t, mm), vector_at(geometry, 1));
    map_1(forward(c_.from_reduced), sampled_1_, tied_, 2 * n_);
    map_2(forward(c_.from_reduced), sampled_2_, tied_ + 2 * points_, 2, n_);
    map_1(forward(c_.from_reduced), sampled_mixed_, half_mixed_, m_);
    map_2(forward(c_.from_reduced), half_mixed_, tied_ + 4 * points_, 1, n_);
  }
  /// Computes the duals of derivatives and r at the sampling points. It is the transpose of tie(). Call it before
  /// differentiate_transposed().
  void tie_transposed(const Pack* geometry) {
    const int mm = m_ * m_;
    map_1(transposed(c_.from_reduced), tied_, sampled_1_, 2 * n_);
    map_2(transposed(c_.from_reduced), tied_ + 2 * points_, sampled_2_, 2, n_);
    map_2(transposed(c_.from_reduced), tied_ + 4 * points_, half_mixed_, 1, n_);
    map_1(transposed(c_.from_reduced), half_mixed_, sampled_mixed_, m_);
    geometry = sample_line_transposed(geometry, sampled_1_, along_1_);
    geometry = sample_line_transposed(geometry, sampled_2_, along_2_);
    for (int t = 0; t < mm; ++t, geometry += PackedCells::sampling_size) {
      put(sampled_mixed_[t] * vector_at(geometry + 3, 1), mixed_ + t, mm);
      put(sampled_mixed_[t] * vector_at(geometry, 1), mixed_ + 3 * mm + t, mm);
    }
  }

  Derivatives derivatives(int q) const {
    return {vector_at(d1_ + q, points_), vector_at(d2_ + q, points_), vector_at(d1_ + 3 * points_ + q, points_),
            vector_at(d2_ + 3 * points_ + q, points_)};
  }
  void put_dual(int q, const Derivatives& d) {
    put(d.u1, d1_ + q, points_);
    put(d.u2, d2_ + q, points_);
    put_rotation_dual(q, d.r1, d.r2);
  }
  void put_rotation_dual(int q, const Vector& r1, const Vector& r2) {
    put(r1, d1_ + 3 * points_ + q, points_);
    put(r2, d2_ + 3 * points_ + q, points_);
  }
  /// The gradient of r . a_3 along the cell's coordinates (shell/strain.hpp), or its dual.
  struct Gradient {
    Pack along_1, along_2;
  };
  Gradient normal_rotation_gradient(int q, const Frame& f) const {
    const Derivatives d = derivatives(q);
    return {dot(d.r1, f.a3) + dot(r(q), f.da1), dot(d.r2, f.a3) + dot(r(q), f.da2)};
  }
  void put_normal_rotation_dual(int q, const Frame& f, const Gradient& t) {
    put_rotation_dual(q, t.along_1 * f.a3, t.along_2 * f.a3);
    put_r_dual(q, t.along_1 * f.da1 + t.along_2 * f.da2);
  }
  Gradient scalar_gradient(int q) const { return {d1_[q], d2_[q]}; }
  void put_scalar_dual(int q, const Gradient& t) {
    d1_[q] = t.along_1;
    d2_[q] = t.along_2;
  }
  Vector r(int q) const { return vector_at(r_ + q, points_); }
  void put_r_dual(int q, const Vector& r) { put(r, r_ + q, points_); }

  void take_tied(int q, Strains& s) const {
    s.membrane[0] = tied_[q];
    s.shear[0] = tied_[points_ + q];
    s.membrane[1] = tied_[2 * points_ + q];
    s.shear[1] = tied_[3 * points_ + q];
    s.membrane[2] = tied_[4 * points_ + q];
  }
  void put_tied(int q, const Strains& n) {
    tied_[q] = n.membrane[0];
    tied_[points_ + q] = n.shear[0];
    tied_[2 * points_ + q] = n.membrane[1];
    tied_[3 * points_ + q] = n.shear[1];
    tied_[4 * points_ + q] = n.membrane[2];
  }

 private:
  int nodes_of(std::size_t pack, const std::int32_t** nodes) const {
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::size_t cell = pack * lanes + l, last = c_.cells - 1;
      nodes[l] = c_.nodes + (cell < last ? cell : last) * static_cast<std::size_t>(nodes_);
    }
    const std::size_t left = c_.cells - pack * lanes;
    return left < lanes ? static_cast<int>(left) : lanes;
  }
  /// Computes the strains along one direction: gamma_aa = d_a u . a_a and 2 delta_a = d_a u . a_3 + r . a_a.
  const Pack* sample_line(const Pack* geometry, const Pack* field, Pack* sampled) const {
    const int count = m_ * n_;
    for (int t = 0; t < count; ++t, geometry += PackedCells::sampling_size) {
      const Vector du = vector_at(field + t, count), a = vector_at(geometry, 1), a3 = vector_at(geometry + 3, 1);
      sampled[t] = dot(du, a);
      sampled[count + t] = dot(du, a3) + dot(vector_at(field + 3 * count + t, count), a);
    }
    return geometry;
  }
  const Pack* sample_line_transposed(const Pack* geometry, const Pack* sampled, Pack* field) const {
    const int count = m_ * n_;
    for (int t = 0; t < count; ++t, geometry += PackedCells::sampling_size) {
      const Vector a = vector_at(geometry, 1), a3 = vector_at(geometry + 3, 1);
      put(sampled[t] * a + sampled[count + t] * a3, field + t, count);
      put(sampled[count + t] * a, field + 3 * count + t, count);
    }
    return geometry;
  }
  void add_samples_to_lines() {
    const int mn = m_ * n_, mm = m_ * m_;
    add_1(transposed(c_.reduced_d), along_1_, value_full_nodes_, 3 * n_);
    add_1(transposed(c_.reduced_value), along_1_ + 3 * mn, value_full_nodes_ + 3 * n_ * n_, 3 * n_);
    map_1(transposed(c_.value), along_2_, d_reduced_nodes_, 3 * m_);
    map_1(transposed(c_.value), along_2_ + 3 * mn, value_reduced_nodes_ + 3 * mn, 3 * m_);
    map_1(transposed(c_.reduced_d), mixed_, value_reduced_nodes_, 3 * m_);
    add_1(transposed(c_.reduced_value), mixed_ + 3 * mm, d_reduced_nodes_, 3 * m_);
  }

  const PackedCells& c_;
  int n_, m_, nodes_, points_;  // nodes and reduced points of a line; nodes and points of a cell
  Scratch scratch_;
  Pack *field_, *d1_, *d2_, *r_;  // six components each, r_ three
  // Values after the tables along xi_2 only: six components, in the last array only u.
  Pack *value_full_nodes_, *d_full_nodes_, *value_reduced_nodes_, *d_reduced_nodes_;
  Pack *along_1_, *along_2_, *mixed_;  // at sampling points: d_a u, r; d_a u, r; d_1 u, d_2 u
  Pack *sampled_1_, *sampled_2_, *sampled_mixed_, *half_mixed_, *tied_;
};

/// Calls work(pack, geometry of its quadrature points, geometry of its sampling points, its materials) for every pack.
template <class Work>
void for_packs(const PackedCells& c, const Work& work) {
  const std::size_t points = static_cast<std::size_t>(c.points_per_cell * c.point_size()),
                    samplings = c.sampling_points() * PackedCells::sampling_size;
  for (std::size_t pack = 0; pack * lanes < c.cells; ++pack)
    work(pack, packs(c.points) + pack * points, packs(c.samplings) + pack * samplings,
         packs(c.materials) + pack * PackedCells::material_size);
}

/// Returns the stresses at quadrature point q of a pack times the point's area.
inline Strains stresses_at(const PackedCells& c, std::size_t pack, int q, const Strains& s, const Frame& f,
                           const Pack* material) {
  if (c.sections == nullptr) return stresses_of(s, f, material, c.weights[q]);
  const std::size_t point = pack * static_cast<std::size_t>(c.points_per_cell) + static_cast<std::size_t>(q);
  return stresses_of_section(s, f, packs(c.sections) + point * PackedCells::section_size, c.weights[q]);
}

/// Computes the strains of the gathered field at all quadrature points and calls take(q, frame, strains), which may
/// store stresses.
template <class Take>
inline void with_strains(const PackedCells& c, PackCell& cell, const Pack* points, const Pack* samplings,
                         const Take& take) {
  const bool tied = c.kind == PackedCells::Kind::tied;
  cell.differentiate(all_components, !tied);
  if (tied) cell.tie(samplings);
  for (int q = 0; q < c.points_per_cell; ++q) {
    const Frame f = frame_at(c, points, q);
    const Derivatives d = cell.derivatives(q);
    Strains s;
    set_bending(d, f, s);
    if (tied)
      cell.take_tied(q, s);
    else
      set_membrane_and_shear(d, cell.r(q), f, s);
    take(q, f, s);
  }
}

void add_product(const PackedCells& c, const double* y, double* f) {
  PackCell cell(c);
  const bool tied = c.kind == PackedCells::Kind::tied;
  for_packs(c, [&](std::size_t pack, const Pack* points, const Pack* samplings, const Pack* material) {
    cell.gather(pack, all_components, y);
    with_strains(c, cell, points, samplings, [&](int q, const Frame& frame, const Strains& s) {
      const Strains n = stresses_at(c, pack, q, s, frame, material);
      Derivatives dual = bending_dual(n.bending, frame);
      if (tied) {
        cell.put_tied(q, n);
      } else {
        add_membrane_and_shear_dual(n, frame, dual);
        cell.put_r_dual(q, n.shear[0] * frame.a1 + n.shear[1] * frame.a2);
      }
      cell.put_dual(q, dual);
    });
    if (tied) cell.tie_transposed(samplings);
    cell.differentiate_transposed(all_components, !tied, tied);
    cell.scatter(pack, all_components, f);
  });
}

PackEnergies energies(const PackedCells& c, const double* y) {
  PackCell cell(c);
  Pack membrane{}, bending{}, shear{};
  for_packs(c, [&](std::size_t pack, const Pack* points, const Pack* samplings, const Pack* material) {
    cell.gather(pack, all_components, y);
    with_strains(c, cell, points, samplings, [&](int q, const Frame& frame, const Strains& s) {
      const Strains n = stresses_at(c, pack, q, s, frame, material);
      for (int k = 0; k < 3; ++k) {
        membrane += n.membrane[k] * s.membrane[k];
        bending += n.bending[k] * s.bending[k];
      }
      for (int k = 0; k < 2; ++k) shear += n.shear[k] * s.shear[k];
    });
  });
  return {sum_of_lanes(membrane) / 2, sum_of_lanes(bending) / 2, sum_of_lanes(shear) / 2};
}

/// Returns scale a^{ab} g_b.
inline PackCell::Gradient raised(Pack scale, const Frame& f, const PackCell::Gradient& g) {
  return {scale * (f.g11 * g.along_1 + f.g12 * g.along_2), scale * (f.g12 * g.along_1 + f.g22 * g.along_2)};
}

void add_normal_rotation(const PackedCells& c, double factor, const double* y, double* f) {
  PackCell cell(c);
  for_packs(c, [&](std::size_t pack, const Pack* points, const Pack*, const Pack* material) {
    cell.gather(pack, of_rotation, y);
    cell.differentiate(of_rotation, true);
    for (int q = 0; q < c.points_per_cell; ++q) {
      const Frame p = frame_at(c, points, q);
      const Pack e = p.thickness, scale = factor * c.weights[q] * material[3] * (e * e * e) * p.sqrt_a;
      cell.put_normal_rotation_dual(q, p, raised(scale, p, cell.normal_rotation_gradient(q, p)));
    }
    cell.differentiate_transposed(of_rotation, true, false);
    cell.scatter(pack, of_rotation, f);
  });
}

void add_coupling(const PackedCells& c, const double* y, double* q) {
  PackCell cell(c);
  for_packs(c, [&](std::size_t pack, const Pack* points, const Pack*, const Pack*) {
    cell.gather(pack, of_rotation, y);
    cell.differentiate(of_rotation, true);
    for (int p = 0; p < c.points_per_cell; ++p) {
      const Frame f = frame_at(c, points, p);
      cell.put_scalar_dual(p, raised(c.weights[p] * f.sqrt_a, f, cell.normal_rotation_gradient(p, f)));
    }
    cell.differentiate_transposed(scalar, false, false);
    cell.scatter(pack, scalar, q);
  });
}

void add_coupling_transposed(const PackedCells& c, const double* lambda, double* f) {
  PackCell cell(c);
  for_packs(c, [&](std::size_t pack, const Pack* points, const Pack*, const Pack*) {
    cell.gather(pack, scalar, lambda);
    cell.differentiate(scalar, false);
    for (int q = 0; q < c.points_per_cell; ++q) {
      const Frame p = frame_at(c, points, q);
      cell.put_normal_rotation_dual(q, p, raised(c.weights[q] * p.sqrt_a, p, cell.scalar_gradient(q)));
    }
    cell.differentiate_transposed(of_rotation, true, false);
    cell.scatter(pack, of_rotation, f);
  });
}

using LoosePack [[gnu::vector_size(lanes * sizeof(double)), gnu::may_alias, gnu::aligned(8)]] = double;

/// Computes the part of b' b in `high` rows from i on and `wide` packs of columns from j on.
template <int high, int wide>
inline void gram_block(const double* b, int rows, int columns, int i, int j, double* k) {
  Pack sums[high][wide]{};
  for (int r = 0; r < rows; ++r) {
    const double* row = b + static_cast<std::ptrdiff_t>(r) * columns;
    for (int w = 0; w < wide; ++w) {
      const Pack right = *reinterpret_cast<const LoosePack*>(row + j + w * lanes);
      for (int h = 0; h < high; ++h) sums[h][w] += row[i + h] * right;
    }
  }
  for (int h = 0; h < high; ++h)
    for (int w = 0; w < wide; ++w)
      *reinterpret_cast<LoosePack*>(k + static_cast<std::ptrdiff_t>(i + h) * columns + j + w * lanes) = sums[h][w];
}

/// Computes `high` rows from i on, up to the diagonal and some columns further.
template <int high>
inline void gram_rows(const double* b, int rows, int columns, int i, double* k) {
  int j = 0;
  for (; j + 3 * lanes <= columns && j <= i + high - 1; j += 3 * lanes) gram_block<high, 3>(b, rows, columns, i, j, k);
  for (; j + lanes <= columns && j <= i + high - 1; j += lanes) gram_block<high, 1>(b, rows, columns, i, j, k);
  if (j > i + high - 1) return;
  for (; j < columns; ++j)
    for (int h = 0; h < high; ++h) {
      double sum = 0;
      for (int r = 0; r < rows; ++r) {
        const double* row = b + static_cast<std::ptrdiff_t>(r) * columns;
        sum += row[i + h] * row[j];
      }
      k[static_cast<std::ptrdiff_t>(i + h) * columns + j] = sum;
    }
}

void gram(const double* b, int rows, int columns, double* k) {
  int i = 0;
  for (; i + 4 <= columns; i += 4) gram_rows<4>(b, rows, columns, i, k);
  for (; i < columns; ++i) gram_rows<1>(b, rows, columns, i, k);
}

}  // namespace PLASTRON_PACK_NAMESPACE

extern const PackKernels PLASTRON_PACK_KERNELS;
const PackKernels PLASTRON_PACK_KERNELS{.name = PLASTRON_PACK_INSTRUCTIONS,
                                        .lanes = PLASTRON_PACK_NAMESPACE::lanes,
                                        .add_product = PLASTRON_PACK_NAMESPACE::add_product,
                                        .energies = PLASTRON_PACK_NAMESPACE::energies,
                                        .add_normal_rotation = PLASTRON_PACK_NAMESPACE::add_normal_rotation,
                                        .add_coupling = PLASTRON_PACK_NAMESPACE::add_coupling,
                                        .add_coupling_transposed = PLASTRON_PACK_NAMESPACE::add_coupling_transposed,
                                        .gram = PLASTRON_PACK_NAMESPACE::gram};

}  // namespace plastron::energy
