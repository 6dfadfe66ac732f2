// Charts with positive, negative, zero and mixed curvature, and points where they are regular.
#pragma once
#include <plastron/geometry/chart.hpp>

#include <string>
#include <vector>

namespace plastron::geometry {

struct Surface {
  std::string name;
  Chart chart;
};

inline std::vector<Surface> surfaces() {
  const Constants c{{"R", 1.5}, {"a", 0.4}, {"h", 0.1}};
  return {{"plane", Chart({"x", "y", "0"}, c)},
          {"sheared plane", Chart({"2*x + y", "y - 0.3*x", "0.5*x - y"}, c)},
          {"cylinder", Chart({"R*sin(x/R)", "y", "R*cos(x/R)"}, c)},
          {"sphere as a graph", Chart({"x", "y", "R - sqrt(R^2 - x^2 - y^2)"}, c)},
          {"sphere by angles", Chart({"R*cos(x)*cos(y)", "R*sin(x)*cos(y)", "R*sin(y)"}, c)},
          {"saddle", Chart({"x", "y", "x^2 - y^2"}, c)},
          {"hat", Chart({"x", "y", "h*((x^2 + y^2)/(4*a^2) - 1)^2"}, c)},
          {"torus", Chart({"(R + a*cos(y))*cos(x)", "(R + a*cos(y))*sin(x)", "a*sin(y)"}, c)},
          {"helicoid", Chart({"y*cos(x) + cos(x)", "y*sin(x) + sin(x)", "a*x"}, c)},
          {"wavy sheet", Chart({"x + 0.1*sin(y)", "y*exp(0.2*x)", "0.2*sin(2*x)*cos(y) + tanh(y)/5"}, c)}};
}

inline std::vector<Vector2d> sample_points() {
  return {{0.31, 0.17}, {-0.42, 0.23}, {0.11, -0.47}, {0.5, 0.5}, {-0.2, -0.3}};
}

}  // namespace plastron::geometry
