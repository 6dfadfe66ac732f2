#include <fmt/core.h>
#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "matrix_storage.hpp"

namespace plastron::algebra {
namespace {

// Computes y = sum over the stored blocks B of B x and, off the diagonal, of the mirrored product. `map` is applied to
// all factors.
template <class Map>
void multiply_mapped(const MatrixStorage& A, const Vector& x, Vector& y, Map map) {
  PLASTRON_ASSERT(&x != &y, &x, &y);
  PLASTRON_ASSERT(x.block() == A.block && y.block() == A.block, x.block(), y.block(), A.block);
  PLASTRON_ASSERT(x.owned().size() == A.owned_unknowns() && y.owned().size() == A.owned_unknowns(), x.owned().size(),
                  y.owned().size(), A.owned_unknowns());
  const auto m = static_cast<std::size_t>(A.block);
  const auto owned = x.owned().size();
  A.work.resize(2 * A.global.size() * m);
  const auto u = std::span(A.work).first(A.global.size() * m), v = std::span(A.work).subspan(u.size());
  std::ranges::transform(x.owned(), u.begin(), map);
  A.wide->exchange().to_ghosts(u, A.block);
  std::ranges::fill(v, 0.0);
  for (LocalIndex row = 0; row < A.wide->owned; ++row) {
    const std::size_t i = static_cast<std::size_t>(row) * m;
    for (std::size_t k = A.row_begin(row); k < A.row_end(row); ++k) {
      const std::size_t j = static_cast<std::size_t>(A.column[k]) * m;
      const double* B = A.block_at(k);
      for (std::size_t a = 0; a < m; ++a)
        for (std::size_t b = 0; b < m; ++b) v[i + a] += map(B[a * m + b]) * u[j + b];
      if (j == i) continue;
      for (std::size_t a = 0; a < m; ++a)
        for (std::size_t b = 0; b < m; ++b) v[j + b] += map(B[a * m + b]) * u[i + a];
    }
  }
  A.wide->exchange().to_owners(v, A.block);
  y.fill(0.0);
  std::copy_n(v.begin(), owned, y.owned().begin());
}

void check_element(const MatrixStorage& A, std::span<const LocalIndex> nodes, std::size_t values) {
  const std::size_t width = nodes.size() * static_cast<std::size_t>(A.block);
  if (values != width * width)
    throw std::invalid_argument(fmt::format("an element matrix of {} nodes and {} values a node has {} entries, not {}",
                                            nodes.size(), A.block, width * width, values));
  for (const LocalIndex node : nodes)
    if (node < 0 || node >= A.layout->local_size())
      throw std::out_of_range(fmt::format("node {} is not in 0..{}", node, A.layout->local_size() - 1));
}

}  // namespace

std::size_t MatrixStorage::find(LocalIndex row, GlobalIndex column_global) const {
  const auto begin = column.begin() + static_cast<std::ptrdiff_t>(row_begin(row));
  const auto end = column.begin() + static_cast<std::ptrdiff_t>(row_end(row));
  const auto found = std::lower_bound(begin, end, column_global, [&](LocalIndex node, GlobalIndex wanted) {
    return global[static_cast<std::size_t>(node)] < wanted;
  });
  if (found == end || global[static_cast<std::size_t>(*found)] != column_global)
    throw std::out_of_range(
        fmt::format("the pattern does not couple nodes {} and {}: no element given to the "
                    "constructor holds both",
                    global[static_cast<std::size_t>(row)], column_global));
  return static_cast<std::size_t>(found - column.begin());
}

Matrix::Matrix(std::shared_ptr<const Layout> layout, int block, const Connectivity& elements)
    : storage_(std::make_unique<MatrixStorage>()) {
  PLASTRON_ASSERT(layout && block > 0, layout.get(), block);
  storage_->layout = std::move(layout);
  storage_->block = block;
  build_pattern(*storage_, elements);
  storage_->values.assign(storage_->column.size() * storage_->block_area(), 0.0);
}

Matrix::Matrix(std::unique_ptr<MatrixStorage> storage) : storage_(std::move(storage)) {}
Matrix::Matrix(Matrix&&) noexcept = default;
Matrix& Matrix::operator=(Matrix&&) noexcept = default;
Matrix::~Matrix() = default;

void Matrix::add(std::span<const LocalIndex> nodes, std::span<const double> values) {
  MatrixStorage& A = *storage_;
  check_element(A, nodes, values.size());
  const auto m = static_cast<std::size_t>(A.block);
  const std::size_t width = nodes.size() * m;
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    const LocalIndex row = A.in_wide(nodes[p]);
    for (std::size_t q = 0; q < nodes.size(); ++q) {
      const GlobalIndex column = A.global[static_cast<std::size_t>(A.in_wide(nodes[q]))];
      if (column < A.global[static_cast<std::size_t>(row)]) continue;
      double* target = A.block_at(A.find(row, column));
      const double* source = values.data() + p * m * width + q * m;
      for (std::size_t a = 0; a < m; ++a)
        for (std::size_t b = 0; b < m; ++b) target[a * m + b] += source[a * width + b];
    }
  }
}

void Matrix::finish() {
  MatrixStorage& A = *storage_;
  const std::size_t area = A.block_area();
  double* of_ghosts = A.block_at(A.row_begin(A.wide->owned));
  std::vector<double> in(A.incoming.total() * area);
  const ItemType block(static_cast<int>(area), MPI_DOUBLE);
  A.layout->exchange().send(of_ghosts, A.outgoing, in.data(), A.incoming, block.get());
  for (std::size_t k = 0; k < A.target.size(); ++k) {
    double* target = A.block_at(A.target[k]);
    for (std::size_t a = 0; a < area; ++a) target[a] += in[k * area + a];
  }
  std::fill(of_ghosts, A.values.data() + A.values.size(), 0.0);
}

void Matrix::set_zero() { std::ranges::fill(storage_->values, 0.0); }

Matrix Matrix::plus_multiple(double factor, const Matrix& B) const {
  const MatrixStorage &A = *storage_, &other = *B.storage_;
  in_agreement(A.layout->comm, [&] {
    if (A.column != other.column || A.row_start != other.row_start || A.block != other.block)
      throw std::invalid_argument("matrices of different patterns cannot be added");
  });
  auto sum = std::make_unique<MatrixStorage>(A);
  for (std::size_t k = 0; k < sum->values.size(); ++k) sum->values[k] += factor * other.values[k];
  return Matrix(std::move(sum));
}

void Matrix::multiply(const Vector& x, Vector& y) const {
  multiply_mapped(*storage_, x, y, [](double value) { return value; });
}

void Matrix::multiply_absolute(const Vector& x, Vector& y) const {
  multiply_mapped(*storage_, x, y, [](double value) { return std::abs(value); });
}

Vector Matrix::diagonal() const {
  const MatrixStorage& A = *storage_;
  Vector d(A.layout, A.block);
  const auto values = d.owned();
  const auto m = static_cast<std::size_t>(A.block);
  for (LocalIndex row = 0; row < A.layout->owned; ++row)
    for (std::size_t a = 0; a < m; ++a)
      values[static_cast<std::size_t>(row) * m + a] = A.block_at(A.row_begin(row))[a * m + a];
  return d;
}

const std::shared_ptr<const Layout>& Matrix::layout() const { return storage_->layout; }
int Matrix::block() const { return storage_->block; }

std::int64_t Matrix::nonzeros() const {
  const std::int64_t rows = storage_->layout->owned;
  const std::int64_t upper = storage_->row_start[static_cast<std::size_t>(rows)];
  return sum_over_ranks((2 * upper - rows) * static_cast<std::int64_t>(storage_->block_area()), storage_->layout->comm);
}

}  // namespace plastron::algebra
