// A mesh file that one process reads for all.
#include <plastron/domain/domain_mesh.hpp>

#include <gtest/gtest.h>

namespace plastron::domain {
namespace {

int rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

MeshFile file(const std::string& name) { return {std::string(PLASTRON_TESTS_DIR "/domain/data/") + name}; }

/// As the first rank reads it; the others have no such file.
mesh::CoarseMesh shared(const std::string& name, mesh::Shape shape) {
  const Domain domain = with_shared_mesh(rank() == 0 ? file(name) : MeshFile{"/no/such.msh"}, shape, MPI_COMM_WORLD);
  return coarse_mesh(domain, shape);
}

void expect_same_map(const mesh::CellMap& map, const mesh::CellMap& expected) {
  for (const Vector2d& xi : {Vector2d(0.2, 0.3), Vector2d(0.6, 0.1)}) {
    const geometry::PlaneJet jet = map(xi), other = expected(xi);
    EXPECT_EQ(jet.value, other.value);
    EXPECT_EQ(jet.d, other.d);
    EXPECT_EQ(jet.dd, other.dd);
  }
}

void expect_same(const mesh::CoarseMesh& mesh, const mesh::CoarseMesh& expected) {
  EXPECT_EQ(mesh.shape, expected.shape);
  EXPECT_EQ(mesh.vertices, expected.vertices);
  EXPECT_EQ(mesh.regions, expected.regions);
  EXPECT_EQ(mesh.boundaries, expected.boundaries);
  ASSERT_EQ(mesh.cells.size(), expected.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    EXPECT_EQ(mesh.cells[c].vertices, expected.cells[c].vertices);
    EXPECT_EQ(mesh.cells[c].region, expected.cells[c].region);
    expect_same_map(mesh.cells[c].map, expected.cells[c].map);
  }
  ASSERT_EQ(mesh.edges.size(), expected.edges.size());
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    EXPECT_EQ(mesh.edges[i].vertices, expected.edges[i].vertices);
    EXPECT_EQ(mesh.edges[i].boundary, expected.edges[i].boundary);
  }
}

TEST(SharedMesh, IsTheOneThatTheFirstRankReads) {
  for (const std::string name : {"two-regions-4.1.msh", "quarter-annulus-2.2.msh"})
    expect_same(shared(name, mesh::Shape::quadrilateral), coarse_mesh(file(name), mesh::Shape::quadrilateral));
}

TEST(SharedMesh, OfCurvedTrianglesHasTheirExactMaps) {
  const std::string name = "quarter-annulus-2.2.msh";
  expect_same(shared(name, mesh::Shape::triangle), coarse_mesh(file(name), mesh::Shape::triangle));
}

TEST(SharedMesh, OfFacetsIsMeshedOnce) {
  const auto facets = [](const std::string& path) { return MeshFile{.path = path, .in_space = SpaceReading{}}; };
  const MeshFile angle = facets(file("angle.stl").path);
  const MeshFile here = rank() == 0 ? angle : facets("/no/such.stl");
  const mesh::CoarseMesh mesh =
      coarse_mesh(with_shared_mesh(here, mesh::Shape::quadrilateral, MPI_COMM_WORLD), mesh::Shape::quadrilateral);
  expect_same(mesh, coarse_mesh(angle, mesh::Shape::quadrilateral));
}

TEST(SharedMesh, IsReadAgainForCellsOfAnotherShape) {
  const Domain domain = with_shared_mesh(file("two-regions-4.1.msh"), mesh::Shape::quadrilateral, MPI_COMM_WORLD);
  EXPECT_EQ(coarse_mesh(domain, mesh::Shape::triangle).shape, mesh::Shape::triangle);
}

TEST(SharedMesh, OfAFileThatIsNoneIsLeftToWhoeverNeedsIt) {
  const Domain domain = with_shared_mesh(MeshFile{"/no/such.msh"}, mesh::Shape::quadrilateral, MPI_COMM_WORLD);
  EXPECT_EQ(std::get<MeshFile>(domain).mesh, nullptr);
  EXPECT_THROW(coarse_mesh(domain, mesh::Shape::quadrilateral), mesh::DomainError);
}

TEST(SharedMesh, IsLeftWhereItIsWhereRanksHaveDifferentDomains) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) GTEST_SKIP() << "there is no other rank";
  const Domain mine = rank() == 0 ? Domain{file("two-regions-4.1.msh")} : Domain{Disk{}};
  const Domain domain = with_shared_mesh(mine, mesh::Shape::quadrilateral, MPI_COMM_WORLD);
  EXPECT_EQ(domain.index(), mine.index());
  const auto* unread = std::get_if<MeshFile>(&domain);
  EXPECT_EQ(unread ? unread->mesh : nullptr, nullptr);
}

TEST(SharedMesh, IsNothingToDomainsThatAreNotRead) {
  const Domain domain =
      with_shared_mesh(Disk{.centre = {1, 2}, .radius = 3}, mesh::Shape::quadrilateral, MPI_COMM_WORLD);
  EXPECT_EQ(std::get<Disk>(domain).radius, 3);
}

}  // namespace
}  // namespace plastron::domain
