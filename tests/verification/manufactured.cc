#include "verification/manufactured.hpp"

#include "verification/taylor.hpp"

namespace plastron::verification {

namespace {

constexpr double peak_reaction = 0.01;  // eta_0 [Pa]

using Tensor = std::array<std::array<Series, 2>, 2>;

struct SeriesFrame {
  SeriesVector phi;
  std::array<SeriesVector, 2> a_cov;
  SeriesVector a3;
  std::array<SeriesVector, 2> da3;
  Tensor metric_con;
  Series sqrt_a;
};

struct Point {
  Series x, y;
  Point(double x0, double y0) : x(Series::variable(0, x0)), y(Series::variable(1, y0)) {}
};

// (M1)-(M3); exact to order 2, da3 to order 1.
SeriesFrame frame(const Point& p) {
  SeriesFrame f;
  f.phi = {{p.x, p.y, 0.5 + 0.3 * (p.x * p.x - p.y * p.y) + 0.1 * p.x * p.y}};
  f.a_cov = {f.phi.derivative(0), f.phi.derivative(1)};
  const SeriesVector n = cross(f.a_cov[0], f.a_cov[1]);
  const Series a = dot(n, n);
  f.sqrt_a = sqrt(a);
  f.a3 = inverse(f.sqrt_a) * n;
  f.da3 = {f.a3.derivative(0), f.a3.derivative(1)};
  const Series g12 = dot(f.a_cov[0], f.a_cov[1]);
  f.metric_con[0][0] = dot(f.a_cov[1], f.a_cov[1]) / a;
  f.metric_con[1][1] = dot(f.a_cov[0], f.a_cov[0]) / a;
  f.metric_con[0][1] = f.metric_con[1][0] = -g12 / a;
  return f;
}

struct Fields {
  SeriesVector u, r;
  Series gap, eta;
};

Series bubble(const Point& p) { return 16 * p.x * (1 - p.x) * p.y * (1 - p.y); }
Series contact_series(const Point& p) { return 24 * p.x * (1 - p.x) * p.y * (1 - p.y) * (1 + 0.5 * p.x); }

Fields clamped_fields(const Point& p, const SeriesFrame& f, double e) {
  const Series b = bubble(p);
  const auto& [x, y] = p;
  Fields s;
  s.u = b * SeriesVector{{0.3 + 0.2 * x - 0.1 * y * y, -0.2 + 0.1 * x * y + 0.3 * y, 0.5 - 0.4 * x + 0.2 * x * y}};
  s.r = b * (0.4 - 0.3 * x + 0.5 * y) * f.a_cov[0] + b * (-0.2 + 0.6 * x * y) * f.a_cov[1];
  s.gap = f.phi[2] + s.u[2] - e / 2 * (f.a3[2] + s.r[2]);
  return s;
}

Fields contact_fields(const Point& p, const SeriesFrame& f, double e) {
  Fields s = clamped_fields(p, f, e);
  s.r = Series(0.2) * s.r;
  const Series B = contact_series(p);
  const Series separation = positive_part(1 - B), pressing = positive_part(B - 1);
  const Series g0 = f.phi[2] - e / 2 * f.a3[2];
  s.gap = g0 * separation * separation * separation;
  s.eta = peak_reaction * pressing * pressing;
  s.u = {{s.u[0] / 20, s.u[1] / 20, s.gap - g0 + e / 2 * s.r[2]}};
  return s;
}

Fields fields(ManufacturedSolution solution, const Point& p, const SeriesFrame& f, double e) {
  return solution == ManufacturedSolution::clamped ? clamped_fields(p, f, e) : contact_fields(p, f, e);
}

// a^{abrs} strain_rs with the tensor of (M7).
Tensor stress(const Tensor& g, const Tensor& strain, double E, double nu) {
  const double l = E * nu / (1 - nu * nu), mu = E / (2 * (1 + nu));
  Tensor s;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      for (int r = 0; r < 2; ++r)
        for (int t = 0; t < 2; ++t)
          s[a][b] += (l * g[a][b] * g[r][t] + mu * (g[a][r] * g[b][t] + g[a][t] * g[b][r])) * strain[r][t];
  return s;
}

struct SeriesResultants {
  Tensor N, M;
  std::array<Series, 2> Q;
};

SeriesResultants resultants(const SeriesFrame& f, const Fields& v, const ManufacturedShell& shell) {
  const std::array<SeriesVector, 2> du{v.u.derivative(0), v.u.derivative(1)};
  const std::array<SeriesVector, 2> dr{v.r.derivative(0), v.r.derivative(1)};
  Tensor gamma, chi;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      gamma[a][b] = 0.5 * (dot(du[a], f.a_cov[b]) + dot(du[b], f.a_cov[a]));  // (M4)
      chi[a][b] = 0.5 * (dot(du[a], f.da3[b]) + dot(du[b], f.da3[a]) + dot(dr[a], f.a_cov[b]) +
                         dot(dr[b], f.a_cov[a]));  // (M5)
    }
  const double e = shell.thickness, mu = shell.E / (2 * (1 + shell.nu));
  SeriesResultants s;
  s.N = stress(f.metric_con, gamma, e * shell.E, shell.nu);
  s.M = stress(f.metric_con, chi, e * e * e / 12 * shell.E, shell.nu);
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      const Series delta = 0.5 * (dot(du[b], f.a3) + dot(v.r, f.a_cov[b]));  // (M6)
      s.Q[a] += 2 * shell.shear_correction * e * mu * f.metric_con[a][b] * delta;
    }
  return s;
}

ExactField exact_field(const SeriesVector& v) { return {v.value(), {v.d(0), v.d(1)}}; }

}  // namespace

std::array<std::string, 3> Manufactured::chart() { return {"x", "y", "0.5 + 0.3*(x^2 - y^2) + 0.1*x*y"}; }

ExactField Manufactured::u(double x, double y) const {
  const Point p(x, y);
  return exact_field(fields(solution_, p, frame(p), shell_.thickness).u);
}

ExactField Manufactured::r(double x, double y) const {
  const Point p(x, y);
  return exact_field(fields(solution_, p, frame(p), shell_.thickness).r);
}

// f = -1/sqrt(a) d_a [sqrt(a) (N^ab a_b + M^ab d_b a_3 + Q^a a_3)] - eta e_3
// m = -1/sqrt(a) d_a [sqrt(a) M^ab a_b] + Q^a a_a + e/2 eta e_3
ExactLoad Manufactured::load(double x, double y) const {
  const Point p(x, y);
  const SeriesFrame f = frame(p);
  const Fields v = fields(solution_, p, f, shell_.thickness);
  const SeriesResultants s = resultants(f, v, shell_);
  ExactLoad load{Vector3d::Zero(), Vector3d::Zero()};
  for (int a = 0; a < 2; ++a) {
    SeriesVector force_flux = s.Q[a] * f.a3, couple_flux;
    for (int b = 0; b < 2; ++b) {
      force_flux = force_flux + s.N[a][b] * f.a_cov[b] + s.M[a][b] * f.da3[b];
      couple_flux = couple_flux + s.M[a][b] * f.a_cov[b];
    }
    load.force -= (f.sqrt_a * force_flux).d(a) / f.sqrt_a.value();
    load.couple -= (f.sqrt_a * couple_flux).d(a) / f.sqrt_a.value();
    load.couple += s.Q[a].value() * f.a_cov[a].value();
  }
  load.force[2] -= v.eta.value();
  load.couple[2] += shell_.thickness / 2 * v.eta.value();
  return load;
}

double Manufactured::gap(double x, double y) const {
  const Point p(x, y);
  return fields(solution_, p, frame(p), shell_.thickness).gap.value();
}

double Manufactured::eta(double x, double y) const {
  const Point p(x, y);
  return fields(solution_, p, frame(p), shell_.thickness).eta.value();
}

double Manufactured::contact_function(double x, double y) { return contact_series(Point(x, y)).value(); }

}  // namespace plastron::verification
