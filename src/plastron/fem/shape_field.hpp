// A field (u, r) on a mesh of its own, as a change of the mid-surface: the shape of a mode that a computation on any mesh of the
// same domain has found.
#pragma once
#include <plastron/mesh/reference_cell.hpp>
#include <plastron/mesh/surface_shift.hpp>
#include <plastron/topology/box_tree.hpp>

#include <Eigen/Core>
#include <vector>

namespace plastron::fem {

class ShapeField final : public mesh::SurfaceShift {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  /// Nodes are those of mesh::node_points(), cell by cell.
  struct Cells {
    mesh::Shape shape = mesh::Shape::quadrilateral;
    int degree = 1;
    std::vector<mesh::Vector2d> points{};  ///< places of the nodes in Omega, or addresses
    std::vector<mesh::Vector3d> places{};  ///< phi there; empty: not known [m]
    std::vector<Vector6> values{};         ///< (u, r) there
  };

  /// Precondition: points and values of whole cells.
  explicit ShapeField(Cells cells);

  Jet at(const mesh::Vector2d& point, const mesh::Vector2d& inside) const override;
  /// Returns phi at a point as at() does. Precondition: phi is known.
  mesh::Vector3d place_at(const mesh::Vector2d& point) const;
  /// Returns the box around all nodes in Omega: its lowest and highest corner.
  std::array<mesh::Vector2d, 2> box() const;

 private:
  /// The functions of the nodes at a point of a cell, and the place in Omega with its derivatives along xi.
  struct Evaluation {
    mesh::Vector2d xi;
    Eigen::VectorXd value, d1, d2;
    mesh::Vector2d place;
    Eigen::Matrix2d derivatives;
  };
  struct Found {
    std::size_t cell;
    mesh::Vector2d xi;
  };
  void evaluate(std::size_t cell, Evaluation& at) const;
  std::size_t nodes_per_cell() const;
  bool invert(std::size_t cell, const mesh::Vector2d& point, double tolerance, Evaluation& at) const;
  Found find(const mesh::Vector2d& inside, double tolerance, Evaluation& at) const;

  Cells cells_;
  std::vector<double> nodes_{};  // of a square element along one direction
  topology::BoxTree boxes_;
};

}  // namespace plastron::fem
