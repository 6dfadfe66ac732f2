#include <plastron/estimation/strain_errors.hpp>

#include <plastron/recovery/resultant_patches.hpp>

#include <Eigen/Cholesky>

#include <optional>

namespace plastron::estimation {

namespace {

using geometry::Vector3d;
using recovery::Resultants;
using recovery::SurfaceAxes;

/// Orthonormal components become contravariant ones.
Resultants contravariant(const Resultants& in_axes, const SurfaceAxes& axes, const geometry::Frame& frame) {
  Eigen::Matrix2d change;
  for (int a = 0; a < 2; ++a) {
    const Vector3d& dual = frame.a_con[static_cast<std::size_t>(a)];
    change(a, 0) = dual.dot(axes.t1);
    change(a, 1) = dual.dot(axes.t2);
  }
  return recovery::in_other_axes(in_axes, change);
}

/// Of the patches' polynomials. A patch is twice as wide as a cell, so that a polynomial of the elements' degree k is worse there than
/// the element by 2^k times the ratio of successive coefficients: on meshes that matter higher degrees need more.
int patch_degree(const fem::Space& space) { return space.degree < 3 ? space.degree : space.degree + space.degree / 2; }

/// Takes the errors of a field's strains in one cell after the other.
class StrainErrorsOf {
 public:
  StrainErrorsOf(const assembly::DiscreteShell& discrete, const certificate::NodalSolution& field)
      : shell_(discrete.shell),
        y_(field.y),
        patches_(discrete, field, patch_degree(discrete.space())),
        points_(discrete),
        continuation_(element::resultant_continuation(shell_.space().shape(), shell_.space().degree,
                                                      shell_.tables().quadrature.xi)) {}

  StrainErrors operator()(std::size_t cell) const {
    const element::CellField field = shell_.gather(cell, y_);
    const CellStrain strains = shell_.strains(cell, field);
    StrainErrors result{.error = CellStrain(strains.rows(), 8),
                        .stresses = recovered(cell, field),
                        .incompatibility = incompatibility(cell, field, strains)};
    for (int q = 0; q < strains.rows(); ++q) {
      const assembly::QuadraturePoint& p = shell_.point(cell, q);
      const auto s = result.stresses.row(q);
      auto e = result.error.row(q);
      e.head<3>() = p.stiffness.membrane.llt().solve(s.head<3>().transpose()).transpose();
      e.segment<3>(3) = p.stiffness.bending.llt().solve(s.segment<3>(3).transpose()).transpose();
      e.tail<2>() = p.stiffness.shear.llt().solve(s.tail<2>().transpose()).transpose();
      e -= strains.row(q);
      result.stresses.row(q) *= p.area;
    }
    return result;
  }

 private:
  /// Contravariant resultants at the quadrature points: of the patches; where a cell has none, its own continued.
  CellStrain recovered(std::size_t cell, const element::CellField& field) const {
    const auto& xi = shell_.tables().quadrature.xi;
    CellStrain stresses(static_cast<Eigen::Index>(xi.size()), 8);
    std::vector<geometry::SurfaceJet> jets(xi.size());
    shell_.surface().jets(shell_.space().cells[cell], xi, jets, false);
    std::optional<CellStrain> own;
    for (std::size_t q = 0; q < xi.size(); ++q) {
      const geometry::Frame& frame = shell_.point(cell, static_cast<int>(q)).frame;
      const Vector3d t1 = frame.a_cov[0].normalized();
      SurfaceAxes axes{.t1 = t1, .t2 = frame.a3.cross(t1), .a3 = frame.a3};
      auto values = patches_.at(cell, xi[q], jets[q].value, axes);
      if (!values) {
        if (!own) own = continued(cell, field, axes);
        const recovery::SurfaceAxes& from = own_axes_;
        values =
            recovery::in_other_axes(Resultants(own->row(static_cast<Eigen::Index>(q))), change_of_axes(from, axes));
      }
      stresses.row(static_cast<Eigen::Index>(q)) = contravariant(*values, axes, frame);
    }
    return stresses;
  }

  /// In these axes.
  CellStrain continued(std::size_t cell, const element::CellField& field, const SurfaceAxes& axes) const {
    recovery::CellResultants all = points_(cell, field);
    for (std::size_t p = 0; p < all.axes.size(); ++p) {
      auto row = all.values.row(static_cast<Eigen::Index>(p));
      row = recovery::in_other_axes(Resultants(row), change_of_axes(all.axes[p], axes));
    }
    own_axes_ = axes;
    return continuation_ * all.values;
  }

  CellStrain incompatibility(std::size_t cell, const element::CellField& field, const CellStrain& tied) const {
    CellStrain result = CellStrain::Zero(tied.rows(), 8);
    if (!shell_.tables().tying) return result;
    const element::FieldRows rows =
        shell_.interpolation().fields(cell, shell_.tables().quadrature, shell_.quadrature_bases(cell), field);
    for (int q = 0; q < tied.rows(); ++q) {
      const geometry::Frame& frame = shell_.point(cell, q).frame;
      result.row(q).head<3>() = shell::membrane_strain(rows.at(q), frame.a_cov).transpose() - tied.row(q).head<3>();
      result.row(q).tail<2>() =
          shell::shear_strain(rows.at(q), frame.a_cov, frame.a3).transpose() - tied.row(q).tail<2>();
    }
    return result;
  }

  const assembly::ShellOperator& shell_;
  const algebra::Vector& y_;
  recovery::ResultantPatches patches_;
  recovery::ResultantPoints points_;
  Eigen::MatrixXd continuation_;  // resultant points -> quadrature points
  mutable SurfaceAxes own_axes_{};
};

}  // namespace

std::vector<StrainErrors> strain_errors(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  certificate::NodalSolution field;
  field.y = y;
  const StrainErrorsOf errors(discrete, field);
  std::vector<StrainErrors> all;
  all.reserve(discrete.space().owned_cells);
  for (std::size_t cell = 0; cell < discrete.space().owned_cells; ++cell) all.push_back(errors(cell));
  return all;
}

double energy_product(const assembly::ShellOperator& shell, std::size_t cell, const StrainErrors& u,
                      const StrainErrors& z) {
  return shell.weighted_stresses(cell, u.error).cwiseProduct(z.error).sum();
}

double tying_product(const StrainErrors& u, const StrainErrors& z) {
  return u.stresses.cwiseProduct(z.incompatibility).sum();
}

}  // namespace plastron::estimation
