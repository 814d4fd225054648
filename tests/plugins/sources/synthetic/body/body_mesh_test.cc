#include "plugins/sources/synthetic/body/body_mesh.h"

#include <gtest/gtest.h>

#include <map>

#include "plugins/sources/synthetic/people/proportions.h"
#include "plugins/sources/synthetic/people/skeleton.h"

namespace plaza::synthetic {
namespace {

LookSeeds seeds(std::uint64_t seed, bool dark = false) {
  LookSeeds out;
  out.person = seed;
  out.clothing = seed + 100;
  out.dark = dark;
  out.bag = seed % 2 == 0;
  return out;
}

BodyMesh mesh_of(std::uint64_t seed) {
  return BodyMesh(draw_proportions(seed), make_look(seeds(seed)));
}

TEST(BodyMesh, IsClosedForEveryKindOfClothes) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const BodyMesh mesh = mesh_of(seed);
    EXPECT_GT(mesh.triangles().size(), 3000u);
    EXPECT_LT(mesh.triangles().size(), 9000u);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : mesh.triangles()) {
      for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    }
    for (const auto& [edge, count] : edges) {
      const auto back = edges.find({edge.second, edge.first});
      ASSERT_TRUE(back != edges.end() && back->second == count)
          << "seed " << seed << ": a hole at " << mesh.rest()[edge.first].transpose();
    }
  }
}

TEST(BodyMesh, StandsOnTheGroundAndIsAsTallAsItsStature) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Proportions p = draw_proportions(seed);
    const BodyMesh mesh(p, make_look(seeds(seed)));
    JointRotations joints;
    joints.pelvis_m = {1.0, 2.0, p.ankle_m + p.shin_m + p.thigh_m};
    std::vector<Vec3> at(mesh.vertex_count()), normals(mesh.vertex_count());
    mesh.place(place_segments(p, joints), at);
    mesh.turn(place_segments(p, joints), normals);
    float low = 9, high = -9;
    for (const Vec3& v : at) {
      low = std::min(low, v.z());
      high = std::max(high, v.z());
    }
    EXPECT_NEAR(low, 0, 0.02);
    EXPECT_NEAR(high, p.stature_m, 0.05);  // hair adds to it
  }
}

TEST(BodyMesh, NormalsPointOutwards) {
  const BodyMesh mesh = mesh_of(3);
  std::vector<Vec3> at(mesh.vertex_count()), normals(mesh.vertex_count());
  mesh.place(mesh.clothes().shape().bind_pose(), at);
  mesh.turn(mesh.clothes().shape().bind_pose(), normals);
  std::size_t agree = 0;
  for (const auto& t : mesh.triangles()) {
    const Vec3 n = (at[t[1]] - at[t[0]]).cross(at[t[2]] - at[t[0]]);
    agree += n.dot(normals[t[0]] + normals[t[1]] + normals[t[2]]) > 0 ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(agree), 0.97 * static_cast<double>(mesh.triangles().size()));
}

TEST(Clothes, FrontAndBackDiffer) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const BodyMesh mesh = mesh_of(seed);
    const auto& at = mesh.clothes().shape().landmarks();
    float difference = 0, sum = 0;
    for (float z = at.waist; z < at.neck - 0.02f; z += 0.01f) {
      for (float y = -0.12f; y <= 0.12f; y += 0.01f) {
        const Rgb front = mesh.clothes().at({at.torso_half_x, y, z}).albedo;
        const Rgb back = mesh.clothes().at({-at.torso_half_x, y, z}).albedo;
        difference += (front - back).norm();
        sum += 0.5f * (front + back).norm();
      }
    }
    EXPECT_GT(difference / sum, 0.05) << "seed " << seed;
  }
}

TEST(Clothes, SameKeySameClothesWhoeverWearsThem) {
  LookSeeds a = seeds(1), b = seeds(2);
  b.clothing = a.clothing;
  b.bag = a.bag;
  const Look la = make_look(a), lb = make_look(b);
  EXPECT_EQ(la.top, lb.top);
  EXPECT_EQ(la.bottom, lb.bottom);
  EXPECT_EQ(la.second, lb.second);
  EXPECT_EQ(la.front, lb.front);
  EXPECT_EQ(la.sleeve, lb.sleeve);
  EXPECT_NE(la.skin, lb.skin);
}

TEST(Clothes, DarkOnesAreDarkAndAlike) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Look look = make_look(seeds(seed, true));
    EXPECT_LT(look.top.maxCoeff(), 0.06f);
    EXPECT_LT(look.bottom.maxCoeff(), 0.06f);
  }
}

}  // namespace
}  // namespace plaza::synthetic
