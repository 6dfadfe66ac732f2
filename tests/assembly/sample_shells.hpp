// Small shells for the tests of assembly/.
#pragma once
#include <plastron/assembly/box_problem.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/mesh_sequence.hpp>

#include <map>
#include <memory>
#include <string>
#include <tuple>

namespace plastron::test {

inline const std::array<std::string, 3> flat{"x", "y", "0.3"};
inline const std::array<std::string, 3> saddle{"x", "y", "0.5 + 0.3*(x^2 - y^2) + 0.1*x*y"};
inline const std::array<std::string, 3> cap{"x", "y", "2 - sqrt(4 - x^2 - y^2)"};

/// An element: shape, degree, tying.
using Element = std::tuple<mesh::Shape, int, bool>;
constexpr auto quadrilateral = mesh::Shape::quadrilateral, triangle = mesh::Shape::triangle;

struct MeshedSurface {
  std::shared_ptr<const fem::Space> space;
  std::shared_ptr<const fem::Surface> surface;
};

/// A skew quadrilateral, so that nothing is aligned with the axes.
inline domain::Polygon skew() { return {{{0, 0}, {1, 0.1}, {0.9, 1.1}, {-0.1, 0.8}}}; }

inline MeshedSurface meshed(const domain::Domain& domain, const std::array<std::string, 3>& chart, int degree,
                            int refinements, mesh::Shape shape = mesh::Shape::quadrilateral) {
  fem::MeshSequence meshes(domain::coarse_mesh(domain, shape), degree, MPI_COMM_WORLD);
  for (int i = 0; i < refinements; ++i) meshes.refine({});
  std::map<std::string, geometry::Chart> charts;
  charts.emplace("", geometry::Chart(chart, {}));
  return {meshes.space(), std::make_shared<const fem::Surface>(meshes.space()->coarse, charts)};
}

inline shell::Material steel_like() { return shell::Material::from_young_poisson(1.0, 0.3, 5.0 / 6); }
inline energy::CrossSections steel_of(const geometry::Expression& thickness) {
  return {.common = {.thickness = thickness, .material = steel_like()}};
}

inline assembly::Support clamp(const std::string& boundary) {
  assembly::Support support{.boundary = boundary, .components = {}};
  for (const auto unknown : {assembly::Unknown::displacement, assembly::Unknown::rotation})
    for (const auto direction : {assembly::Direction::x, assembly::Direction::y, assembly::Direction::z})
      support.components.push_back({unknown, direction, geometry::Expression(0.0)});
  return support;
}

/// Nodal values of a rigid motion u = c + w x phi, r = w x a_3.
inline algebra::Vector rigid_motion(const fem::Space& space, const std::vector<assembly::NodalPoint>& points,
                                    const Eigen::Vector3d& c, const Eigen::Vector3d& w) {
  algebra::Vector y(space.layout, 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d u = c + w.cross(points[i].phi), r = w.cross(points[i].a3);
    for (std::size_t k = 0; k < 3; ++k) {
      y.local()[6 * i + k] = u[static_cast<Eigen::Index>(k)];
      y.local()[6 * i + 3 + k] = r[static_cast<Eigen::Index>(k)];
    }
  }
  return y;
}

/// The interpolant of a function of position on the mid-surface, its value (u, r).
template <class Function>
inline algebra::Vector interpolant(const energy::ShellOperator& shell, const Function& f) {
  const auto points = assembly::nodal_geometry(shell.space(), shell.surface(), shell.tables(), shell.sections());
  algebra::Vector y(shell.space().layout, 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Matrix<double, 6, 1> value = f(points[i]);
    for (std::size_t k = 0; k < 6; ++k) y.local()[6 * i + k] = value[static_cast<Eigen::Index>(k)];
  }
  return y;
}

inline Eigen::MatrixXd dense(const algebra::Matrix& matrix) {
  algebra::Vector x(matrix.layout(), matrix.block()), y(x);
  const auto n = static_cast<Eigen::Index>(x.owned().size());
  Eigen::MatrixXd D(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    x.fill(0);
    x.local()[static_cast<std::size_t>(j)] = 1;
    matrix.multiply(x, y);
    D.col(j) = Eigen::Map<const Eigen::VectorXd>(y.owned().data(), n);
  }
  return D;
}

}  // namespace plastron::test
