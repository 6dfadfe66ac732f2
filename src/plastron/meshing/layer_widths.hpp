// Widths of the layers of a thin shell: along its edges, and inside where its asymptotic lines carry them.
#pragma once
#include <plastron/problem/problem.hpp>

#include <optional>
#include <string>
#include <vector>

namespace plastron::meshing {

/// Curvatures at a layer [1/m]. n is the direction in which it varies quickly, t is perpendicular to n along the layer.
struct LayerCurvatures {
  double along = 0;   ///< |b_tt|
  double twist = 0;   ///< |b_nt|
  double across = 0;  ///< |b_nn|
};

/// Returns the length l in which bending decays from a line of length L along which quantities vary slowly, where
///   e = |b_tt| l^2 + 2 |b_nt| l^3 / L + |b_nn| l^4 / L^2:
/// sqrt(e R) beside a line of normal curvature 1/R along itself, (e L / b_nt)^(1/3) beside an asymptotic line of a
/// saddle and (e L^2 R)^(1/4) beside a straight line of a cylinder. It balances e^2 d_n^8 with
/// (b_tt d_n^2 + 2 b_nt d_n d_t + b_nn d_t^2)^2. It is infinite on a plate.
double layer_width(double thickness, const LayerCurvatures& curvatures, double length);

/// The layer along a boundary of a built-in domain, in one region.
struct EdgeLayer {
  int boundary = 0;           ///< in the order of domain::boundary_names()
  int region = 0;             ///< in the order of domain::region_names()
  double width = 0;           ///< l [m]
  double width_in_omega = 0;  ///< l divided by the length on the shell of a unit step from the boundary in Omega
};

/// Returns the layers of all boundaries by region, from means along them; none for a mesh file.
std::vector<EdgeLayer> edge_layers(const problem::Problem& problem);

/// Data of the shell's interior for cells of uniform size.
struct Interior {
  double area = 0;  ///< area of the mid-surface [m^2]
  double width =
      0;  ///< narrowest layer that asymptotic lines may carry inside [m]; infinite where the shell is convex or flat
  Eigen::Vector2d stretch = Eigen::Vector2d::Ones();  ///< mean |d phi/dx|, |d phi/dy|
};

Interior interior(const problem::Problem& problem);

}  // namespace plastron::meshing
