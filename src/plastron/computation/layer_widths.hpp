// How wide the layers of a thin shell are: along its edges, and inside where its asymptotic lines carry them.
#pragma once
#include <plastron/computation/problem.hpp>

#include <optional>
#include <string>
#include <vector>

namespace plastron::computation {

/// Curvature in a direction n that a layer varies in quickly and the direction t at right angles to it along the layer [1/m].
struct LayerCurvatures {
  double along = 0;   ///< |b_tt|
  double twist = 0;   ///< |b_nt|
  double across = 0;  ///< |b_nn|
};

/// The length l in which bending fades away from a line of length L along which things vary slowly, where
///   e = |b_tt| l^2 + 2 |b_nt| l^3 / L + |b_nn| l^4 / L^2:
/// sqrt(e R) beside a line of normal curvature 1/R along itself, (e L / b_nt)^(1/3) beside an asymptotic line of a saddle and
/// (e L^2 R)^(1/4) beside a straight line of a cylinder. It balances e^2 d_n^8 with (b_tt d_n^2 + 2 b_nt d_n d_t + b_nn d_t^2)^2.
/// Infinite on a plate.
double layer_width(double thickness, const LayerCurvatures& curvatures, double length);

/// The layer along a boundary of a built-in domain, in one region.
struct EdgeLayer {
  int boundary = 0;           ///< as fem::boundary_names() orders them
  int region = 0;             ///< as fem::region_names() orders them
  double width = 0;           ///< l [m]
  double width_in_omega = 0;  ///< l over what a step off the boundary in Omega measures on the shell
};

/// Of all boundaries, region by region, from means along them; none for a mesh file.
std::vector<EdgeLayer> edge_layers(const Problem& problem);

/// What a shell with cells everywhere alike has to look at.
struct Interior {
  double area = 0;  ///< of the mid-surface [m^2]
  double width =
      0;  ///< the narrowest layer that asymptotic lines may carry inside [m]; infinite where the shell is convex or flat
  Eigen::Vector2d stretch = Eigen::Vector2d::Ones();  ///< mean |d phi/dx|, |d phi/dy|
};

Interior interior(const Problem& problem);

}  // namespace plastron::computation
