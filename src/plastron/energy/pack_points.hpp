// Packs: one number for each lane of a vector register. Tables are applied to lines of packs. At a point of a pack of
// cells there are the formulas of shell/: frame and section stiffness from stored data, strains (M4-M6), stresses (M8)
// and the transposed strain maps. Tests compare them with shell/.
//
// The including file defines the number of lanes and the namespace. Everything here is compiled once for each set of
// instructions, so no name may occur twice. Templates of the standard library must not be instantiated here: the linker
// would keep only one file's version.
#pragma once
#include <plastron/energy/pack_kernels.hpp>

#include <cmath>
#include <cstdlib>

namespace plastron::energy::PLASTRON_PACK_NAMESPACE {

constexpr int lanes = PLASTRON_PACK_LANES;
using Pack [[gnu::vector_size(lanes * sizeof(double)), gnu::may_alias]] = double;

inline const Pack* packs(const double* at) { return reinterpret_cast<const Pack*>(at); }

inline Pack square_root(Pack v) {
  Pack root = v;
  for (int l = 0; l < lanes; ++l) root[l] = __builtin_sqrt(v[l]);
  return root;
}

inline double sum_of_lanes(Pack v) {
  double sum = 0;
  for (int l = 0; l < lanes; ++l) sum += v[l];
  return sum;
}

/// Memory for a loop over packs, given out piece by piece.
class Scratch {
 public:
  explicit Scratch(int packs)
      : memory_(static_cast<Pack*>(
            std::aligned_alloc(64, (static_cast<std::size_t>(packs) * sizeof(Pack) + 63) / 64 * 64))),
        next_(memory_) {
    if (!memory_) std::abort();
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::free(memory_); }
  Pack* take(int packs) {
    Pack* piece = next_;
    next_ += packs;
    return piece;
  }

 private:
  Pack *memory_, *next_;
};

/// A table that maps `columns` values to `rows` values.
struct Map {
  const double* values;
  int rows, columns;
};
inline Map forward(const PackTable& t) { return {t.values, t.rows, t.columns}; }
inline Map transposed(const PackTable& t) { return {t.transposed, t.columns, t.rows}; }

/// Computes out = T in or out += T in for one line. `size` > 0 is the number of columns; then the values stay in
/// registers.
template <int size, bool adds>
inline void map_line(const Map& t, const Pack* in, int in_step, Pack* out, int out_step) {
  Pack kept[size + (size == 0)];
  if constexpr (size > 0)
    for (int j = 0; j < size; ++j) kept[j] = in[j * in_step];
  for (int i = 0; i < t.rows; ++i) {
    const double* row = t.values + i * t.columns;
    Pack sum = adds ? out[i * out_step] : Pack{};
    if constexpr (size > 0)
      for (int j = 0; j < size; ++j) sum += row[j] * kept[j];
    else
      for (int j = 0; j < t.columns; ++j) sum += row[j] * in[j * in_step];
    out[i * out_step] = sum;
  }
}

/// Maps `blocks` arrays of lines. The lines of an array are side by side, `across` of them.
template <int size, bool adds>
void map_lines(const Map& t, const Pack* in, Pack* out, int blocks, int across) {
  for (int b = 0; b < blocks; ++b, in += t.columns * across, out += t.rows * across)
    for (int a = 0; a < across; ++a) map_line<size, adds>(t, in + a, across, out + a, across);
}

template <bool adds>
void map_blocks(const Map& t, const Pack* in, Pack* out, int blocks, int across) {
  switch (t.columns) {
    case 1:
      return map_lines<1, adds>(t, in, out, blocks, across);
    case 2:
      return map_lines<2, adds>(t, in, out, blocks, across);
    case 3:
      return map_lines<3, adds>(t, in, out, blocks, across);
    case 4:
      return map_lines<4, adds>(t, in, out, blocks, across);
    case 5:
      return map_lines<5, adds>(t, in, out, blocks, across);
    case 6:
      return map_lines<6, adds>(t, in, out, blocks, across);
    case 7:
      return map_lines<7, adds>(t, in, out, blocks, across);
    case 8:
      return map_lines<8, adds>(t, in, out, blocks, across);
    case 9:
      return map_lines<9, adds>(t, in, out, blocks, across);
    default:
      return map_lines<0, adds>(t, in, out, blocks, across);
  }
}

/// Maps along the direction that runs fastest, in `count` successive lines.
inline void map_1(const Map& t, const Pack* in, Pack* out, int count) { map_blocks<false>(t, in, out, count, 1); }
inline void add_1(const Map& t, const Pack* in, Pack* out, int count) { map_blocks<true>(t, in, out, count, 1); }
/// Maps along the other direction, in `blocks` arrays of `across` lines.
inline void map_2(const Map& t, const Pack* in, Pack* out, int blocks, int across) {
  map_blocks<false>(t, in, out, blocks, across);
}
inline void add_2(const Map& t, const Pack* in, Pack* out, int blocks, int across) {
  map_blocks<true>(t, in, out, blocks, across);
}

struct Vector {
  Pack x, y, z;
};
inline Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator*(const Pack& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Pack dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Returns the vector of three quantities at distance `step`.
inline Vector vector_at(const Pack* at, int step) { return {at[0], at[step], at[2 * step]}; }
inline void put(const Vector& v, Pack* at, int step) {
  at[0] = v.x;
  at[step] = v.y;
  at[2 * step] = v.z;
}

/// Strains or stresses: 11, 22, 12, and two components of shear.
struct Strains {
  Pack membrane[3], bending[3], shear[2];
};

struct Frame {
  Vector a1, a2, a3, da1, da2;  ///< tangents, normal or director, its derivatives
  Pack g11, g12, g22;           ///< a^{ab}
  Pack sqrt_a, thickness;
};

/// Returns the frame at quadrature point q of a pack whose first point is at `points`.
inline Frame frame_at(const PackedCells& c, const Pack* points, int q) {
  const Pack* point = points + q * c.point_size();
  Frame f;
  f.a1 = vector_at(point, 1);
  f.a2 = vector_at(point + 3, 1);
  const Vector n = cross(f.a1, f.a2);
  const Pack squared = dot(n, n), inverse = 1 / squared;
  f.sqrt_a = square_root(squared);
  f.g11 = inverse * dot(f.a2, f.a2);
  f.g22 = inverse * dot(f.a1, f.a1);
  f.g12 = -inverse * dot(f.a1, f.a2);
  f.thickness = point[6];
  if (c.has_directors) {
    f.a3 = vector_at(point + 7, 1);
    f.da1 = vector_at(point + 10, 1);
    f.da2 = vector_at(point + 13, 1);
    return f;
  }
  f.a3 = (f.sqrt_a * inverse) * n;
  const Pack b11 = point[7], b22 = point[8], b12 = point[9];
  f.da1 = -(b11 * f.g11 + b12 * f.g12) * f.a1 + -(b11 * f.g12 + b12 * f.g22) * f.a2;
  f.da2 = -(b12 * f.g11 + b22 * f.g12) * f.a1 + -(b12 * f.g12 + b22 * f.g22) * f.a2;
  return f;
}

struct Derivatives {
  Vector u1, u2, r1, r2;  ///< d_1 u, d_2 u, d_1 r, d_2 r
};

/// Sets the strains (M4), (M6).
inline void set_membrane_and_shear(const Derivatives& d, const Vector& r, const Frame& f, Strains& s) {
  s.membrane[0] = dot(d.u1, f.a1);
  s.membrane[1] = dot(d.u2, f.a2);
  s.membrane[2] = dot(d.u1, f.a2) + dot(d.u2, f.a1);
  s.shear[0] = dot(d.u1, f.a3) + dot(r, f.a1);
  s.shear[1] = dot(d.u2, f.a3) + dot(r, f.a2);
}
/// Sets the strains (M5).
inline void set_bending(const Derivatives& d, const Frame& f, Strains& s) {
  s.bending[0] = dot(d.u1, f.da1) + dot(d.r1, f.a1);
  s.bending[1] = dot(d.u2, f.da2) + dot(d.r2, f.a2);
  s.bending[2] = dot(d.u1, f.da2) + dot(d.u2, f.da1) + dot(d.r1, f.a2) + dot(d.r2, f.a1);
}

/// Returns the stresses (M8) times the area of the point.
inline Strains stresses_of(const Strains& s, const Frame& f, const Pack* material, double weight) {
  const Pack e = f.thickness, scale = weight * f.sqrt_a * e, bending = scale * e * e * (1.0 / 12);
  const Pack l = material[0], mu = material[1], both = l + 2 * mu;
  const Pack c00 = both * f.g11 * f.g11, c02 = both * f.g11 * f.g12, c11 = both * f.g22 * f.g22,
             c12 = both * f.g22 * f.g12, mixed = f.g11 * f.g22, square = f.g12 * f.g12,
             c01 = l * mixed + 2 * mu * square, c22 = l * square + mu * (mixed + square);
  const auto times = [&](const Pack* strain, Pack factor, Pack* stress) {
    stress[0] = factor * (c00 * strain[0] + c01 * strain[1] + c02 * strain[2]);
    stress[1] = factor * (c01 * strain[0] + c11 * strain[1] + c12 * strain[2]);
    stress[2] = factor * (c02 * strain[0] + c12 * strain[1] + c22 * strain[2]);
  };
  Strains n;
  times(s.membrane, scale, n.membrane);
  times(s.bending, bending, n.bending);
  const Pack shear = scale * material[2];
  n.shear[0] = shear * (f.g11 * s.shear[0] + f.g12 * s.shear[1]);
  n.shear[1] = shear * (f.g12 * s.shear[0] + f.g22 * s.shear[1]);
  return n;
}

/// Adds C strain for a symmetric matrix, given by its rows up to the diagonal.
inline void add_symmetric(const Pack* c, Pack factor, const Pack* strain, Pack* stress) {
  stress[0] += factor * (c[0] * strain[0] + c[1] * strain[1] + c[3] * strain[2]);
  stress[1] += factor * (c[1] * strain[0] + c[2] * strain[1] + c[4] * strain[2]);
  stress[2] += factor * (c[3] * strain[0] + c[4] * strain[1] + c[5] * strain[2]);
}

/// Returns the stresses of a stored section times the area of the point.
inline Strains stresses_of_section(const Strains& s, const Frame& f, const Pack* section, double weight) {
  const Pack area = weight * f.sqrt_a;
  const Pack *membrane = section, *coupling = section + 6, *bending = section + 12, *shear = section + 18;
  Strains n{};
  add_symmetric(membrane, area, s.membrane, n.membrane);
  add_symmetric(coupling, area, s.bending, n.membrane);
  add_symmetric(coupling, area, s.membrane, n.bending);
  add_symmetric(bending, area, s.bending, n.bending);
  n.shear[0] = area * (shear[0] * s.shear[0] + shear[1] * s.shear[1]);
  n.shear[1] = area * (shear[1] * s.shear[0] + shear[2] * s.shear[1]);
  return n;
}

inline Derivatives bending_dual(const Pack* m, const Frame& f) {
  return {m[0] * f.da1 + m[2] * f.da2, m[2] * f.da1 + m[1] * f.da2, m[0] * f.a1 + m[2] * f.a2,
          m[2] * f.a1 + m[1] * f.a2};
}
inline void add_membrane_and_shear_dual(const Strains& n, const Frame& f, Derivatives& d) {
  d.u1 = d.u1 + (n.membrane[0] * f.a1 + n.membrane[2] * f.a2 + n.shear[0] * f.a3);
  d.u2 = d.u2 + (n.membrane[2] * f.a1 + n.membrane[1] * f.a2 + n.shear[1] * f.a3);
}

}  // namespace plastron::energy::PLASTRON_PACK_NAMESPACE
