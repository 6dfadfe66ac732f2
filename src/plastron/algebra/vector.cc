#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace plastron::algebra {

struct Vector::Storage {
  std::shared_ptr<const Layout> layout{};
  int block = 0;
  std::vector<double> values{};

  std::size_t owned_size() const {
    return layout ? static_cast<std::size_t>(layout->owned) * static_cast<std::size_t>(block) : 0;
  }
};

Vector::Vector() : storage_(std::make_unique<Storage>()) {}

Vector::Vector(std::shared_ptr<const Layout> layout, int block) : storage_(std::make_unique<Storage>()) {
  PLASTRON_ASSERT(layout && block > 0, layout.get(), block);
  storage_->values.assign(static_cast<std::size_t>(layout->local_size()) * static_cast<std::size_t>(block), 0.0);
  storage_->layout = std::move(layout);
  storage_->block = block;
}

Vector::Vector(const Vector& other) : storage_(std::make_unique<Storage>(*other.storage_)) {}

// The source of a move becomes empty but keeps storage: it can be read and assigned to.
Vector::Vector(Vector&& other) noexcept : storage_(std::move(other.storage_)) {
  other.storage_ = std::make_unique<Storage>();
}

Vector& Vector::operator=(const Vector& other) {
  if (this != &other) *storage_ = *other.storage_;
  return *this;
}

Vector& Vector::operator=(Vector&& other) noexcept {
  std::swap(storage_, other.storage_);
  return *this;
}

Vector::~Vector() = default;

const std::shared_ptr<const Layout>& Vector::layout() const { return storage_->layout; }
int Vector::block() const { return storage_->block; }

std::span<double> Vector::owned() { return local().first(storage_->owned_size()); }
std::span<const double> Vector::owned() const { return local().first(storage_->owned_size()); }
std::span<double> Vector::local() { return storage_->values; }
std::span<const double> Vector::local() const { return storage_->values; }

std::span<double> Vector::at(std::size_t node) {
  const auto width = static_cast<std::size_t>(storage_->block);
  return local().subspan(node * width, width);
}
std::span<const double> Vector::at(std::size_t node) const {
  const auto width = static_cast<std::size_t>(storage_->block);
  return local().subspan(node * width, width);
}

void Vector::fill(double value) { std::ranges::fill(storage_->values, value); }

void Vector::update_ghosts() {
  if (storage_->layout) storage_->layout->exchange().to_ghosts(storage_->values, storage_->block);
}

void Vector::accumulate_ghosts() {
  if (storage_->layout) storage_->layout->exchange().to_owners(storage_->values, storage_->block);
}

namespace {

MPI_Comm comm_of(const Vector& a) { return a.layout() ? a.layout()->comm : MPI_COMM_SELF; }

template <class Value>
Value reduce(Value value, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, type, operation, comm);
  return value;
}

}  // namespace

bool ghosts_are_current(const Vector& v) {
  Vector fresh = v;
  fresh.update_ghosts();
  constexpr double rounding = 1e-10;
  const double allowed = rounding * max_abs(v);
  double stale = 0;
  for (std::size_t i = v.owned().size(); i < v.local().size(); ++i) {
    const double is = v.local()[i], should_be = fresh.local()[i];
    const bool are_nan = std::isnan(is) && std::isnan(should_be), are_equal = is == should_be;
    if (!are_nan && !are_equal && !(std::abs(is - should_be) <= allowed)) ++stale;
  }
  return max_over_ranks(stale, comm_of(v)) == 0;
}

double dot(const Vector& a, const Vector& b) {
  const auto u = a.owned();
  const auto v = b.owned();
  PLASTRON_ASSERT(a.block() == b.block() && u.size() == v.size(), a.block(), b.block(), u.size(), v.size());
  double sum = 0;
  for (std::size_t i = 0; i < u.size(); ++i) sum += u[i] * v[i];
  return sum_over_ranks(sum, comm_of(a));
}

double norm(const Vector& a) { return std::sqrt(dot(a, a)); }

double max_abs(const Vector& a) {
  double largest = 0;
  for (const double value : a.owned()) largest = std::max(largest, std::abs(value));
  return max_over_ranks(largest, comm_of(a));
}

void axpy(double s, const Vector& x, Vector& y) {
  const auto u = x.owned();
  const auto v = y.owned();
  PLASTRON_ASSERT(x.block() == y.block() && u.size() == v.size(), x.block(), y.block(), u.size(), v.size());
  for (std::size_t i = 0; i < u.size(); ++i) v[i] += s * u[i];
}

int rank_in(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

double sum_over_ranks(double value, MPI_Comm comm) { return reduce(value, MPI_DOUBLE, MPI_SUM, comm); }
double min_over_ranks(double value, MPI_Comm comm) { return reduce(value, MPI_DOUBLE, MPI_MIN, comm); }
double max_over_ranks(double value, MPI_Comm comm) { return reduce(value, MPI_DOUBLE, MPI_MAX, comm); }
std::int64_t sum_over_ranks(std::int64_t value, MPI_Comm comm) { return reduce(value, MPI_INT64_T, MPI_SUM, comm); }

}  // namespace plastron::algebra
