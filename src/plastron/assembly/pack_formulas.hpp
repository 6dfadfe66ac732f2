// The loops of pack_kernels.hpp. The files that compile them name the lanes, the namespace and the kernels
// (pack_kernels_*.cc).
#pragma once
#include <plastron/assembly/pack_cell.hpp>

namespace plastron::assembly {

namespace PLASTRON_PACK_NAMESPACE {

/// Calls work(pack, geometry of its quadrature points, geometry of its sampling points, its materials) for every pack.
template <class Work>
void for_packs(const PackedCells& c, const Work& work) {
  const std::size_t points = static_cast<std::size_t>(c.points_per_cell) * PackedCells::point_size,
                    samplings = c.sampling_points() * PackedCells::sampling_size;
  for (std::size_t pack = 0; pack * lanes < c.cells; ++pack)
    work(pack, packs(c.points) + pack * points, packs(c.samplings) + pack * samplings,
         packs(c.materials) + pack * PackedCells::material_size);
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
    const Frame f = frame_at(points + q * PackedCells::point_size);
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
      const Strains n = stresses_of(s, frame, material, c.weights[q]);
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
      const Strains n = stresses_of(s, frame, material, c.weights[q]);
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
      const Frame p = frame_at(points + q * PackedCells::point_size);
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
      const Frame f = frame_at(points + p * PackedCells::point_size);
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
      const Frame p = frame_at(points + q * PackedCells::point_size);
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

}  // namespace plastron::assembly
