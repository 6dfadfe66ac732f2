#include <plastron/estimation/strain_errors.hpp>

#include <plastron/mesh/basis.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace plastron::estimation {

namespace {

using geometry::Vector3d;
using recovery::Resultants;
using recovery::SurfaceAxes;

/// Transforms orthonormal components to contravariant ones.
Resultants contravariant(const Resultants& in_axes, const SurfaceAxes& axes, const geometry::Frame& frame) {
  Eigen::Matrix2d change;
  for (int a = 0; a < 2; ++a) {
    const Vector3d& dual = frame.a_con[static_cast<std::size_t>(a)];
    change(a, 0) = dual.dot(axes.t1);
    change(a, 1) = dual.dot(axes.t2);
  }
  return recovery::in_other_axes(in_axes, change);
}

/// Computes the errors of a field's strains, one cell at a time.
class StrainErrorsOf {
 public:
  StrainErrorsOf(const assembly::DiscreteShell& discrete, assembly::FieldKind kind, const algebra::Vector& y,
                 const recovery::ResultantPatches& patches)
      : discrete_(discrete), shell_(discrete.shell), kind_(kind), y_(y), patches_(patches), points_(discrete, kind) {}

  StrainErrors operator()(std::size_t cell) const {
    const element::CellField field = shell_.gather(cell, y_);
    const auto state = discrete_.linearised_at(kind_, cell, field);
    const energy::CellGeometry at = state ? shell_.geometry(cell, *state) : shell_.geometry(cell);
    const CellStrain strains = shell_.strains(cell, field, at);
    StrainErrors result{.error = CellStrain(strains.rows(), 8),
                        .stresses = recovered(cell, field),
                        .incompatibility = incompatibility(cell, field, strains, at),
                        .has_patch = patches_.has_patch(cell)};
    for (int q = 0; q < strains.rows(); ++q) {
      const energy::QuadraturePoint& p = shell_.point(cell, q);
      const auto s = result.stresses.row(q);
      auto e = result.error.row(q);
      e = p.section.strains_of(s.transpose()).transpose() - strains.row(q);
      result.stresses.row(q) *= p.area;
    }
    return result;
  }

  /// Appends weighted values of M_nt at the points of an edge.
  void add_twist(const FreeEdge& edge, Eigen::VectorXd& twist) const {
    std::vector<geometry::Frame> frames(edge.xi.size());
    shell_.surface().frames(shell_.space().cells[edge.cell], edge.xi, frames, false);
    std::vector<SurfaceAxes> axes;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const Vector3d& a3 = frames[i].a3;
      axes.push_back({.t1 = edge.tangent[i], .t2 = a3.cross(edge.tangent[i]), .a3 = a3});
    }
    const auto stresses = recovered(edge.cell, shell_.gather(edge.cell, y_), {edge.xi, frames, axes});
    const Eigen::Index before = twist.size();
    twist.conservativeResize(before + stresses.rows());
    for (Eigen::Index i = 0; i < stresses.rows(); ++i)
      twist[before + i] = stresses(i, 5) * std::sqrt(edge.weight[static_cast<std::size_t>(i)]);
  }

 private:
  struct Points {
    const std::vector<Eigen::Vector2d>& xi;
    const std::vector<geometry::Frame>& frames;
    const std::vector<SurfaceAxes>& axes;
  };

  /// Resultants in the points' axes: from the patches; in a cell without a patch, its own resultants continued.
  recovery::ResultantRows recovered(std::size_t cell, const element::CellField& field, const Points& at) const {
    recovery::ResultantRows rows(static_cast<Eigen::Index>(at.xi.size()), 8);
    if (!patches_.has_patch(cell)) {
      const recovery::CellResultants own = points_(cell, field);
      const Eigen::MatrixXd continuation =
          element::resultant_continuation(shell_.space().shape(), shell_.space().degree, at.xi);
      // In the axes of one point; later turned into the axes of each point.
      recovery::ResultantRows values = own.values;
      for (std::size_t p = 0; p < own.axes.size(); ++p) {
        auto row = values.row(static_cast<Eigen::Index>(p));
        row = recovery::in_other_axes(Resultants(row), change_of_axes(own.axes[p], at.axes.front()));
      }
      rows = continuation * values;
      for (std::size_t q = 0; q < at.xi.size(); ++q) {
        auto row = rows.row(static_cast<Eigen::Index>(q));
        row = recovery::in_other_axes(Resultants(row), change_of_axes(at.axes.front(), at.axes[q]));
      }
      return rows;
    }
    for (std::size_t q = 0; q < at.xi.size(); ++q)
      rows.row(static_cast<Eigen::Index>(q)) = *patches_.at(cell, at.xi[q], at.frames[q].phi, at.axes[q]);
    return rows;
  }

  /// Contravariant components at the quadrature points.
  CellStrain recovered(std::size_t cell, const element::CellField& field) const {
    const auto& xi = shell_.tables().quadrature.xi;
    std::vector<geometry::Frame> frames(xi.size());
    shell_.surface().frames(shell_.space().cells[cell], xi, frames, false);
    std::vector<SurfaceAxes> axes;
    for (std::size_t q = 0; q < xi.size(); ++q) {
      const Vector3d t1 = frames[q].a_cov[0].normalized();
      axes.push_back({.t1 = t1, .t2 = frames[q].a3.cross(t1), .a3 = frames[q].a3});
    }
    CellStrain stresses = recovered(cell, field, {xi, frames, axes});
    for (std::size_t q = 0; q < xi.size(); ++q) {
      auto row = stresses.row(static_cast<Eigen::Index>(q));
      row = contravariant(Resultants(row), axes[q], frames[q]);
    }
    return stresses;
  }

  CellStrain incompatibility(std::size_t cell, const element::CellField& field, const CellStrain& tied,
                             const energy::CellGeometry& at) const {
    CellStrain result = CellStrain::Zero(tied.rows(), 8);
    if (!shell_.tables().tying) return result;
    const element::FieldRows rows =
        shell_.interpolation().fields(cell, shell_.tables().quadrature, shell_.quadrature_bases(cell), field);
    for (int q = 0; q < tied.rows(); ++q) {
      const geometry::Frame& frame = at.frames[static_cast<std::size_t>(q)];
      result.row(q).head<3>() = shell::membrane_strain(rows.at(q), frame.a_cov).transpose() - tied.row(q).head<3>();
      result.row(q).tail<2>() =
          shell::shear_strain(rows.at(q), frame.a_cov, frame.a3).transpose() - tied.row(q).tail<2>();
    }
    return result;
  }

  const assembly::DiscreteShell& discrete_;
  const energy::ShellOperator& shell_;
  assembly::FieldKind kind_;
  const algebra::Vector& y_;
  const recovery::ResultantPatches& patches_;
  recovery::ResultantPoints points_;
};

}  // namespace

std::vector<StrainErrors> StrainRecovery::of_solution(const solution::NodalSolution& solution) {
  const recovery::ResultantPatches resultants(discrete_, solution);
  patches_ = resultants.patches();
  return errors(assembly::FieldKind::solution, solution.y, resultants);
}

std::vector<StrainErrors> StrainRecovery::of_motion(const algebra::Vector& y) const {
  return errors(assembly::FieldKind::motion, y, recovery::ResultantPatches(discrete_, y, patches_));
}

std::vector<StrainErrors> StrainRecovery::errors(assembly::FieldKind kind, const algebra::Vector& y,
                                                 const recovery::ResultantPatches& resultants) const {
  const StrainErrorsOf errors(discrete_, kind, y, resultants);
  std::vector<StrainErrors> all;
  all.reserve(discrete_.space().owned_cells);
  for (std::size_t cell = 0; cell < discrete_.space().owned_cells; ++cell) all.push_back(errors(cell));
  for (const FreeEdge& edge : edges_) errors.add_twist(edge, all[edge.cell].edge_twist);
  return all;
}

double energy_product(const energy::ShellOperator& shell, std::size_t cell, const StrainErrors& u,
                      const StrainErrors& z) {
  return shell.weighted_stresses(cell, u.error).cwiseProduct(z.error).sum() + u.edge_twist.dot(z.edge_twist);
}

double tying_product(const StrainErrors& u, const StrainErrors& z) {
  return u.stresses.cwiseProduct(z.incompatibility).sum();
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Orthonormal polynomials of degrees 0 to n - 1 at the n Gauss points in [0, 1], times the roots of the weights. The
/// result is an orthogonal matrix with a row per degree.
MatrixXd weighed_legendre(int n) {
  const mesh::Rule rule = mesh::gauss(n);
  MatrixXd p(n, n);
  for (int a = 0; a < n; ++a) {
    const double x = 2 * rule.points[static_cast<std::size_t>(a)] - 1;
    const double root = std::sqrt(rule.weights[static_cast<std::size_t>(a)]);
    double before = 0, now = 1;
    for (int i = 0; i < n; ++i) {
      p(i, a) = root * std::sqrt(2 * i + 1) * now;
      const double next = ((2 * i + 1) * x * now - i * before) / (i + 1);
      before = now;
      now = next;
    }
  }
  return p;
}

class Profiler {
 public:
  explicit Profiler(int points) : legendre_(weighed_legendre(points)), along_first_(points, points) {
    for (int i = 0; i < points; ++i)
      for (int j = 0; j < points; ++j) along_first_(i, j) = i + j == 0 ? 0.5 : double{1} * i * i / (i * i + j * j);
  }

  /// Computes a profile from strains and stresses at the points; stresses contain the points' area. The products give
  /// the energy, the strains its sign.
  ErrorProfile operator()(const energy::CellStrain& strains, const energy::CellStrain& stresses) const {
    const Index n = legendre_.rows();
    MatrixXd energy = MatrixXd::Zero(n, n);
    double first = 0;
    for (Index k = 0; k < strains.cols(); ++k) {
      // indices: xi_1, xi_2.
      MatrixXd root(n, n);
      for (Index q = 0; q < n * n; ++q) {
        const double product = std::max(stresses(q, k) * strains(q, k), 0.0);
        energy(q % n, q / n) += product;
        root(q % n, q / n) = std::copysign(std::sqrt(product), strains(q, k));
      }
      first += (legendre_ * root * legendre_.transpose()).cwiseAbs2().cwiseProduct(along_first_).sum();
    }
    const double whole = energy.sum();
    if (!(whole > 0))
      return {std::vector<double>(static_cast<std::size_t>(n), 0), std::vector<double>(static_cast<std::size_t>(n), 0)};
    const double part = std::clamp(first / whole, 0.0, 1.0);
    const Eigen::VectorXd columns = part / whole * energy.rowwise().sum(),
                          rows = (1 - part) / whole * energy.colwise().sum().transpose();
    return {std::vector<double>(columns.begin(), columns.end()), std::vector<double>(rows.begin(), rows.end())};
  }

 private:
  MatrixXd legendre_, along_first_;
};

}  // namespace

std::vector<ErrorProfile> error_profiles(const energy::ShellOperator& shell, const std::vector<StrainErrors>& errors) {
  if (shell.space().shape() != mesh::Shape::quadrilateral) return {};
  const Profiler profile(shell.space().degree + 1);
  std::vector<ErrorProfile> profiles;
  profiles.reserve(errors.size());
  for (std::size_t c = 0; c < errors.size(); ++c)
    profiles.push_back(profile(errors[c].error, shell.weighted_stresses(c, errors[c].error)));
  return profiles;
}

}  // namespace plastron::estimation
