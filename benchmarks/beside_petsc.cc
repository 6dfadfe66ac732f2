// Our vectors and symmetric block matrices beside PETSc's, on the pattern of the cap (degree 2, five unknowns a node): beside_petsc [REFINEMENTS].
// Seconds of one call, CPU time of the calling thread where one rank runs, the least of several rounds that take turns. The numbers of
// docs/decisions/0009.
#include <plastron/algebra/matrix.hpp>
#include <plastron/algebra/session.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/mesh_sequence.hpp>

#include <fmt/format.h>
#include <mpi.h>
#include <petscmat.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace plastron::benchmarks {
namespace {

constexpr int block = 5;

double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Two ways to the same thing, in turns.
void compare(const char* what, int rounds, const std::function<void()>& ours, const std::function<void()>& theirs) {
  const auto once = [](const std::function<void()>& call) {
    const double start = now();
    call();
    return now() - start;
  };
  double a = std::numeric_limits<double>::infinity(), b = a;
  for (int i = 0; i < rounds; ++i) {
    a = std::min(a, once(ours));
    b = std::min(b, once(theirs));
  }
  fmt::print("{:<44} {:>10.5f} {:>10.5f} {:>7.2f}\n", what, a, b, b / a);
  std::fflush(stdout);
}

std::shared_ptr<const fem::Space> finest_mesh(int refinements) {
  fem::MeshSequence meshes(domain::coarse_mesh(domain::Disk{.radius = std::sin(0.5)}, mesh::Shape::quadrilateral), 2,
                           MPI_COMM_WORLD);
  for (int i = 0; i < refinements; ++i) meshes.refine({});
  return meshes.space();
}

/// Blocks on and above the diagonal in each row, one rank: what PETSc wants to know beforehand.
std::vector<PetscInt> upper_blocks(const fem::Space& space) {
  std::vector<std::vector<algebra::LocalIndex>> columns(static_cast<std::size_t>(space.layout->owned));
  for (std::size_t c = 0; c < space.owned_cells; ++c)
    for (const auto p : space.nodes(c))
      for (const auto q : space.nodes(c))
        if (q >= p) columns[static_cast<std::size_t>(p)].push_back(q);
  std::vector<PetscInt> counts;
  for (auto& row : columns) {
    std::ranges::sort(row);
    counts.push_back(static_cast<PetscInt>(std::unique(row.begin(), row.end()) - row.begin()));
  }
  return counts;
}

/// Symmetric, with a heavy diagonal; every element has the same: only the time counts.
std::vector<double> element_matrix(std::size_t width) {
  std::vector<double> values(width * width);
  for (std::size_t i = 0; i < width; ++i)
    for (std::size_t j = 0; j < width; ++j)
      values[i * width + j] = i == j ? 100.0 : 1.0 / static_cast<double>(1 + i + j);
  return values;
}

void fill(const fem::Space& space, const std::vector<double>& values, algebra::Matrix& A) {
  A.set_zero();
  for (std::size_t c = 0; c < space.owned_cells; ++c) A.add(space.nodes(c), values);
  A.finish();
}

void fill(const fem::Space& space, const std::vector<double>& values, Mat B) {
  MatZeroEntries(B);
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const auto nodes = space.nodes(c);
    MatSetValuesBlocked(B, static_cast<PetscInt>(nodes.size()), nodes.data(), static_cast<PetscInt>(nodes.size()),
                        nodes.data(), values.data(), ADD_VALUES);
  }
  MatAssemblyBegin(B, MAT_FINAL_ASSEMBLY);
  MatAssemblyEnd(B, MAT_FINAL_ASSEMBLY);
}

void run(int refinements) {
  const auto space = finest_mesh(refinements);
  const auto& layout = space->layout;
  const auto n = static_cast<PetscInt>(layout->owned) * block;
  const auto values = element_matrix(static_cast<std::size_t>(space->nodes_per_cell()) * block);
  const auto counts = upper_blocks(*space);
  fmt::print("{} unknowns, {} cells\n{:<44} {:>10} {:>10} {:>7}\n", n, space->owned_cells, "", "ours [s]", "PETSc [s]",
             "ratio");

  std::unique_ptr<algebra::Matrix> A;
  Mat B = nullptr;
  compare(
      "pattern (PETSc: rows counted for it)", 3,
      [&] { A = std::make_unique<algebra::Matrix>(layout, block, space->connectivity); },
      [&] {
        MatDestroy(&B);
        MatCreateSeqSBAIJ(PETSC_COMM_SELF, block, n, n, 0, counts.data(), &B);
        MatSetOption(B, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE);
      });
  fill(*space, values, B);  // PETSc learns the columns with the first values
  compare(
      "assembly from given element matrices", 5, [&] { fill(*space, values, *A); }, [&] { fill(*space, values, B); });

  algebra::Vector x(layout, block), y(layout, block);
  for (std::size_t i = 0; i < x.owned().size(); ++i) x.owned()[i] = std::sin(static_cast<double>(i));
  Vec u = nullptr, v = nullptr;
  VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, x.owned().data(), &u);
  VecDuplicate(u, &v);
  compare(
      "product", 20, [&] { A->multiply(x, y); }, [&] { MatMult(B, u, v); });
  double difference = 0;
  const double* w = nullptr;
  VecGetArrayRead(v, &w);
  for (std::size_t i = 0; i < y.owned().size(); ++i) difference = std::max(difference, std::abs(w[i] - y.owned()[i]));
  VecRestoreArrayRead(v, &w);
  double a = 0, b = 0;
  compare(
      "dot product", 50, [&] { a = algebra::dot(x, y); }, [&] { VecDot(u, v, &b); });
  compare(
      "axpy", 50, [&] { algebra::axpy(1e-3, x, y); }, [&] { VecAXPY(v, 1e-3, u); });
  MatInfo info;
  MatGetInfo(B, MAT_LOCAL, &info);
  const double kept = static_cast<double>(A->nonzeros() + static_cast<std::int64_t>(n) * block) / 2;
  fmt::print("memory: ours {:.1f} MB of values and {:.1f} MB of pattern, PETSc {:.1f} MB of values\n", 8e-6 * kept,
             1e-6 * (4 * kept / (block * block) + 16.0 * layout->owned), 8e-6 * info.nz_allocated);
  fmt::print("products differ by {:.1e}, dot products by {:.1e} of themselves\n", difference,
             std::abs(a - b) / std::abs(a));
  MatDestroy(&B);
  VecDestroy(&u);
  VecDestroy(&v);
}

}  // namespace
}  // namespace plastron::benchmarks

int main(int argc, char** argv) {
  const plastron::algebra::Session session(argc, argv, 1);
  plastron::benchmarks::run(argc == 2 ? std::atoi(argv[1]) : 6);
}
