// Packs (one number for each lane of a vector register), and tables applied to lines of them. The including file
// defines the number of lanes and the namespace. Everything here is compiled once for each set of instructions, so no
// name may occur twice. Templates of the standard library must not be instantiated here: the linker would keep only one
// file's version.
#pragma once
#include <plastron/assembly/pack_kernels.hpp>

#include <cmath>
#include <cstdlib>

namespace plastron::assembly::PLASTRON_PACK_NAMESPACE {

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

}  // namespace plastron::assembly::PLASTRON_PACK_NAMESPACE
