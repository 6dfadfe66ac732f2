// Mesh files in a job of several processes: one process reads and checks the file and sends the mesh to the others.
#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/vector.hpp>
#include <plastron/domain/cad_mesh.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/mesh/surface_patches.hpp>

#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <memory>
#include <type_traits>

// Serialisation of the parts of a coarse mesh.
namespace boost::serialization {

template <class Archive>
void serialize(Archive& archive, Eigen::Vector2d& x, unsigned) {
  archive& x[0] & x[1];
}

template <class Archive>
void serialize(Archive& archive, Eigen::Vector3d& x, unsigned) {
  archive& x[0] & x[1] & x[2];
}

/// Meshes of files have only polynomial maps.
template <class Archive>
void serialize(Archive& archive, plastron::mesh::ExactMap& map, unsigned) {
  bool is_triangle = std::holds_alternative<plastron::mesh::TriangleLagrangeMap>(map);
  archive& is_triangle;
  if constexpr (Archive::is_loading::value) {
    if (is_triangle)
      map = plastron::mesh::TriangleLagrangeMap{};
    else
      map = plastron::mesh::LagrangeMap{};
  }
  std::visit(
      [&](auto& polynomial) {
        if constexpr (!std::is_same_v<decltype(polynomial), plastron::mesh::BlendedMap&>)
          archive& polynomial.order& polynomial.nodes;
      },
      map);
}

template <class Archive>
void serialize(Archive& archive, plastron::mesh::CoarseCell& cell, unsigned) {
  auto& [map, origin, axes] = cell.map;
  archive& cell.vertices& cell.region& cell.patch& map& origin& axes(0, 0) & axes(0, 1) & axes(1, 0) & axes(1, 1);
}

template <class Archive>
void serialize(Archive& archive, plastron::mesh::BoundaryEdge& edge, unsigned) {
  archive& edge.vertices& edge.boundary;
}

template <class Archive>
void serialize(Archive& archive, plastron::mesh::Fold& fold, unsigned) {
  archive& fold.edges;
}

template <class Archive>
void serialize(Archive& archive, plastron::mesh::SurfacePatches::Patch& patch, unsigned) {
  archive& patch.order& patch.nodes;
}

template <class Archive>
void serialize(Archive& archive, plastron::mesh::SurfacePatches& surface, unsigned) {
  archive& surface.shape& surface.positions& surface.directors& surface.patches& surface.axes;
}

template <class Archive>
void serialize(Archive& archive, plastron::domain::FrozenMesh& mesh, unsigned) {
  archive& mesh.text& mesh.failure;
}

template <class Archive>
void serialize(Archive& archive, plastron::mesh::CoarseMesh& mesh, unsigned) {
  archive& mesh.shape& mesh.vertices& mesh.cells& mesh.edges& mesh.regions& mesh.boundaries& mesh.folds& mesh
      .fold_boundaries;
  plastron::mesh::SurfacePatches patches;
  if (Archive::is_saving::value && mesh.patches) patches = *mesh.patches;
  archive& patches;
  if (Archive::is_loading::value && !patches.patches.empty())
    mesh.patches = std::make_shared<const plastron::mesh::SurfacePatches>(std::move(patches));
}

}  // namespace boost::serialization

namespace plastron::domain {

namespace {

/// Returns a mesh without cells if the file cannot be read.
mesh::CoarseMesh read_if_possible(const MeshFile& file, mesh::Shape shape) {
  try {
    return read_mesh_file(file, shape);
  } catch (const mesh::DomainError&) {
    return {};
  }
}

}  // namespace

Domain with_shared_mesh(Domain domain, mesh::Shape shape, MPI_Comm comm) {
  auto* file = std::get_if<MeshFile>(&domain);
  // The same on all ranks, unless their cases differ.
  if (algebra::min_over_ranks(file ? 1 : 0, comm) == 0) return domain;
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  auto mesh = algebra::in_agreement(comm, [&] {
    if (rank != 0) return mesh::CoarseMesh{};
    if (is_cad_file(file->path) && !file->frozen) file->frozen = std::make_shared<const FrozenMesh>(frozen_mesh(*file));
    return read_if_possible(*file, shape);
  });
  if (ranks > 1) mesh = dealii::Utilities::MPI::broadcast(comm, mesh);
  if (ranks > 1 && is_cad_file(file->path))
    file->frozen = std::make_shared<const FrozenMesh>(
        dealii::Utilities::MPI::broadcast(comm, file->frozen ? *file->frozen : FrozenMesh{}));
  file->mesh = mesh.cells.empty() ? nullptr : std::make_shared<const mesh::CoarseMesh>(std::move(mesh));
  return domain;
}

}  // namespace plastron::domain
