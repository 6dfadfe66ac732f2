#include <plastron/fem/mesh_sequence.hpp>

#include <plastron/fem/quadrilateral_sequence.hpp>
#include <plastron/fem/triangle_sequence.hpp>

#include <algorithm>
#include <variant>

namespace plastron::fem {

struct MeshSequence::Storage {
  std::variant<QuadrilateralSequence, TriangleSequence> levels;
  Finish finish{};
  std::shared_ptr<const Space> finished{};

  std::shared_ptr<const Space> bare() const {
    return std::visit([](const auto& of_shape) { return of_shape.space(); }, levels);
  }
  void finish_level() { finished = finish ? finish(bare()) : bare(); }
};

namespace {

/// The same owned values with the ghosts of another layout (collective).
algebra::Vector on_layout(const std::shared_ptr<const algebra::Layout>& layout, const algebra::Vector& v) {
  algebra::Vector other(layout, v.block());
  std::ranges::copy(v.owned(), other.owned().begin());
  other.update_ghosts();
  return other;
}

}  // namespace

MeshSequence::MeshSequence(CoarseMesh coarse, int degree, MPI_Comm comm, Finish finish) {
  if (coarse.shape == Shape::triangle)
    storage_ = std::make_unique<Storage>(Storage{TriangleSequence(std::move(coarse), degree, comm), std::move(finish)});
  else
    storage_ =
        std::make_unique<Storage>(Storage{QuadrilateralSequence(std::move(coarse), degree, comm), std::move(finish)});
  storage_->finish_level();
}

MeshSequence::~MeshSequence() = default;
MeshSequence::MeshSequence(MeshSequence&&) noexcept = default;

std::shared_ptr<const Space> MeshSequence::space() const { return storage_->finished; }

void MeshSequence::refine(std::span<algebra::Vector> fields) {
  const bool has_own_layout = storage_->finished->layout != storage_->bare()->layout;
  if (has_own_layout)
    for (algebra::Vector& field : fields) field = on_layout(storage_->bare()->layout, field);
  std::visit([&](auto& levels) { levels.refine(fields); }, storage_->levels);
  storage_->finish_level();
  if (storage_->finished->layout != storage_->bare()->layout)
    for (algebra::Vector& field : fields) field = on_layout(storage_->finished->layout, field);
}

}  // namespace plastron::fem
