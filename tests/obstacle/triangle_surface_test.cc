#include "obstacle/probing.hpp"

#include <plastron/geometry/file_error.hpp>
#include <plastron/obstacle/error.hpp>

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>

namespace plastron::obstacle {
namespace {

/// A box from its corners, two triangles on each side.
TriangleMesh box_mesh(const Vector3d& low, const Vector3d& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.emplace_back(i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// The box's twelve triangles, divided n times and projected onto the unit ball.
TriangleMesh ball_mesh(int rounds) {
  TriangleMesh mesh = box_mesh({-1, -1, -1}, {1, 1, 1});
  for (Vector3d& p : mesh.points) p.normalize();
  for (int r = 0; r < rounds; ++r) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.points.size()));
      if (is_new) mesh.points.push_back((mesh.points[a] + mesh.points[b]).normalized());
      return found->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& t :
           {std::array{a, ab, ca}, std::array{b, bc, ab}, std::array{c, ca, bc}, std::array{ab, bc, ca}})
        finer.push_back(t);
    }
    mesh.triangles = finer;
  }
  return mesh;
}

std::string refusal(const TriangleMesh& mesh) {
  try {
    const TriangleSurface surface(mesh, "tool.stl");
  } catch (const ObstacleError& error) {
    return error.what();
  }
  return "";
}

TEST(ATriangulatedBox, IsTheBox) {
  const TriangleSurface surface(box_mesh({-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3}));
  const Box box{.size = {1, 0.8, 0.6}};
  for (const Vector3d& X : test::random_points(500, 1)) {
    const Nearest at = surface.nearest(X), exact = box.nearest(X);
    EXPECT_NEAR(at.distance, exact.distance, 1e-14);
    EXPECT_LT((at.normal - exact.normal).norm(), 1e-10);
    EXPECT_LT((at.curvature - exact.curvature).norm(), 1e-8 * (1 + exact.curvature.squaredNorm()));
  }
  test::expect_exact_derivatives(surface, test::random_points(200, 1), 1, 4);
}

TEST(AFlatSurface, IsTheHalfSpaceOnItsDiagonalsToo) {
  for (const double m : {1e-6, 1.0, 1e6}) {
    const TriangleSurface surface(box_mesh(m * Vector3d(-1, -1, -1), m * Vector3d(1, 1, 0)));
    for (int i = -3; i <= 3; ++i)
      for (const double z : {0.0, 1e-9, -1e-9, 0.1}) {
        const Nearest at = surface.nearest(m * Vector3d(i / 7.0, i / 7.0, z));
        EXPECT_NEAR(at.distance / m, z, 1e-12);
        EXPECT_LT((at.normal - Vector3d::UnitZ()).norm(), 1e-12);
        EXPECT_EQ(at.curvature.norm(), 0);
      }
  }
}

TEST(ATriangulatedBall, ApproachesTheBall) {
  double last = 1;
  for (const int rounds : {3, 5}) {
    const TriangleSurface surface(ball_mesh(rounds));
    double off = 0;
    for (const Vector3d& X : test::random_points(300, 1.2))
      off = std::max(off, std::abs(surface.nearest(X).distance - Ball{}.nearest(X).distance));
    EXPECT_LT(off, last / 8);
    last = off;
  }
  EXPECT_LT(last, 2e-3);
}

/// benchmarks/obstacle_cost measures the cost.
TEST(ASurfaceOf200000Triangles, IsTheBallItWasMadeFrom) {
  const TriangleSurface surface(ball_mesh(7));
  EXPECT_GE(surface.mesh().triangles.size(), 190000u);
  for (const Vector3d& X : test::random_points(1000, 1.2)) {
    const Nearest at = surface.nearest(X), exact = Ball{}.nearest(X);
    EXPECT_NEAR(at.distance, exact.distance, 1e-4);
    EXPECT_LT(X.norm() * (at.normal - exact.normal).norm(), 0.02);
  }
}

TEST(ASurface, IsRefusedForEachReasonInWords) {
  const TriangleMesh good = box_mesh({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(refusal(good), "");
  TriangleMesh bad = good;
  bad.triangles.pop_back();
  EXPECT_NE(refusal(bad).find("not closed"), std::string::npos);
  bad = good;
  std::swap(bad.triangles[3][0], bad.triangles[3][1]);
  EXPECT_NE(refusal(bad).find("not turned alike"), std::string::npos);
  bad = good;
  for (auto& t : bad.triangles) std::swap(t[0], t[1]);
  EXPECT_NE(refusal(bad).find("turned inward"), std::string::npos);
  bad = good;
  bad.points[0] = {1.5, 1.6, 1.7};
  EXPECT_NE(refusal(bad), "");
  bad = good;
  const TriangleMesh other = box_mesh({0.5, 0.5, 0.5}, {2, 2, 2});
  for (auto t : other.triangles) bad.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  bad.points.insert(bad.points.end(), other.points.begin(), other.points.end());
  EXPECT_NE(refusal(bad).find("cuts itself"), std::string::npos);
  EXPECT_NE(refusal({}).find("no triangles"), std::string::npos);
}

TEST(ACavity, IsTurnedInward) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {3, 3, 3});
  const TriangleMesh inner = box_mesh({1, 1, 1}, {2, 2, 2});
  mesh.points.insert(mesh.points.end(), inner.points.begin(), inner.points.end());
  TriangleMesh outward = mesh;
  for (auto t : inner.triangles) {
    outward.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    mesh.triangles.push_back({t[1] + 8, t[0] + 8, t[2] + 8});
  }
  EXPECT_NE(refusal(outward).find("cavity"), std::string::npos);
  EXPECT_EQ(refusal(mesh), "");
  EXPECT_NEAR(TriangleSurface(mesh).nearest({1.5, 1.5, 1.6}).distance, 0.4, 1e-14);
}

/// As in STL files: each triangle has its own three points, here moved by up to `off`.
TriangleMesh scattered(const TriangleMesh& mesh, double off) {
  TriangleMesh apart;
  const auto moves = test::random_points(static_cast<int>(3 * mesh.triangles.size()), off);
  for (const auto& triangle : mesh.triangles) {
    const int first = static_cast<int>(apart.points.size());
    for (const int corner : triangle) apart.points.push_back(mesh.points[corner] + moves[apart.points.size()]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  return apart;
}

TEST(PointsThatWereRoundedApart, AreJoinedUpToAMillionthOfTheSurface) {
  TriangleMesh sphere = ball_mesh(3);
  const std::size_t points = sphere.points.size(), triangles = sphere.triangles.size();
  const double size = 2 * std::sqrt(3.0);
  TriangleMesh near = scattered(sphere, 2e-7 * size);
  EXPECT_NE(refusal(near).find("not closed"), std::string::npos);
  geometry::join_near_points(near);
  EXPECT_EQ(refusal(near), "");
  EXPECT_EQ(near.points.size(), points);
  EXPECT_EQ(near.triangles.size(), triangles);
  EXPECT_EQ(near.joined, 3 * triangles - points);
  EXPECT_GT(near.joined_over, 2e-7 * size);
  EXPECT_LE(near.joined_over, geometry::joining_tolerance * size);
  TriangleMesh far = scattered(sphere, 1e-5 * size);
  geometry::join_near_points(far);
  EXPECT_THAT(refusal(far), testing::AllOf(testing::HasSubstr("not closed"),
                                           testing::HasSubstr("a millionth of the surface's size")));
}

TEST(APointFarOut, JoinsNoCornersThatAreApart) {
  TriangleMesh box = scattered(box_mesh({0, 0, 0}, {1, 1, 1}), 1e-7);
  box.points.back() = Vector3d(0, 0, 2.8e6);
  geometry::join_near_points(box);
  EXPECT_GT(box.joined, 0u);
  EXPECT_LE(box.joined_over, 1e-6);
  EXPECT_NE(refusal(box).find("not closed"), std::string::npos);
}

/// However small its triangles are.
TEST(AClosedSurface, KeepsItsPoints) {
  TriangleMesh two = ball_mesh(2);
  const TriangleMesh tiny = box_mesh({3, 0, 0}, Vector3d(3, 0, 0) + Vector3d::Constant(1e-7));
  const int count = static_cast<int>(two.points.size());
  for (const auto& t : tiny.triangles) two.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  two.points.insert(two.points.end(), tiny.points.begin(), tiny.points.end());
  const auto before = two.points;
  geometry::join_near_points(two);
  EXPECT_EQ(two.points, before);
  EXPECT_EQ(two.joined, 0u);
}

/// One box in all formats.
TEST(Files, OfAllFormatsGiveTheSameSurface) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 2, 3});
  const auto folder = std::filesystem::temp_directory_path() / "plastron_obstacle_files";
  std::filesystem::create_directories(folder);
  const auto path = [&](const char* name) { return (folder / name).string(); };
  {
    std::ofstream text(path("a.stl")), binary(path("b.stl"), std::ios::binary), obj(path("c.obj")), ply(path("d.ply"));
    text << "solid a box\n";
    const std::uint32_t count = 12;
    binary << std::string(80, 's');
    binary.write(reinterpret_cast<const char*>(&count), 4);
    for (const auto& t : box.triangles) {
      text << "facet normal 0 0 0\nouter loop\n";
      const std::string skipped(12, '\0');
      binary << skipped;
      for (const int c : t) {
        text << "vertex " << box.points[c].transpose() << "\n";
        const Eigen::Vector3f p = box.points[c].cast<float>();
        binary.write(reinterpret_cast<const char*>(p.data()), 12);
      }
      text << "endloop\nendfacet\n";
      binary << std::string(2, '\0');
    }
    text << "endsolid a box\n";
    ply << "ply\nformat ascii 1.0\ncomment element none\nelement vertex 8\nproperty double x\nproperty double "
           "y\nproperty double z\n"
           "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& p : box.points) obj << "v " << p.transpose() << "\n", ply << p.transpose() << "\n";
    obj << "# two faces are quadrilaterals\nf 1//1 3//1 4//1 2//1\nf 5 6 8 7\n";
    for (std::size_t t = 4; t < 12; ++t)
      obj << "f " << box.triangles[t][0] + 1 << " " << box.triangles[t][1] - 8 << " " << box.triangles[t][2] + 1
          << "\n";
    for (const auto& t : box.triangles) ply << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  }
  for (const char* name : {"a.stl", "b.stl", "c.obj", "d.ply"}) {
    const TriangleSurface surface(geometry::read_triangle_mesh(path(name)), name);
    EXPECT_EQ(surface.mesh().points.size(), 8u) << name;
    EXPECT_EQ(surface.mesh().triangles.size(), 12u) << name;
  }
  std::ofstream(path("e.stl")) << "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\n";
  std::ofstream(path("f.stl"), std::ios::binary) << std::string(300, 'x');
  for (const char* name : {"e.stl", "f.stl", "none.stl", "a.step"})
    EXPECT_THROW(geometry::read_triangle_mesh(path(name)), geometry::FileError) << name;
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace plastron::obstacle
