#include <plastron/fem/mesh_sequence.hpp>

#include <plastron/fem/quadrilateral_sequence.hpp>
#include <plastron/fem/triangle_sequence.hpp>

#include <variant>

namespace plastron::fem {

struct MeshSequence::Storage {
  std::variant<QuadrilateralSequence, TriangleSequence> levels;
};

MeshSequence::MeshSequence(CoarseMesh coarse, int degree, MPI_Comm comm) {
  if (coarse.shape == Shape::triangle)
    storage_ = std::make_unique<Storage>(Storage{TriangleSequence(std::move(coarse), degree, comm)});
  else
    storage_ = std::make_unique<Storage>(Storage{QuadrilateralSequence(std::move(coarse), degree, comm)});
}

MeshSequence::~MeshSequence() = default;
MeshSequence::MeshSequence(MeshSequence&&) noexcept = default;

std::shared_ptr<const Space> MeshSequence::space() const {
  return std::visit([](const auto& levels) { return levels.space(); }, storage_->levels);
}

void MeshSequence::refine(std::span<algebra::Vector> fields) {
  std::visit([&](auto& levels) { levels.refine(fields); }, storage_->levels);
}

}  // namespace plastron::fem
