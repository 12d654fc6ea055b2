// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "modules/reflections/culling/rooms.h"
#include "modules/reflections/proxies/rows.h"
#include "shaders/reflections_test/shaders.h"
#include "tests/modules/reflections/support/proxy_world.h"
#include "tests/modules/reflections/support/reflection_kernel.h"

namespace gloam::test {
namespace {

struct KernelRay {
  vec3 origin;
  vec3 direction;
};
struct KernelHit {
  vec2 uv;
  float distance_m;
  std::uint32_t met;
  std::uint32_t sphere;
  std::uint32_t served;
};

/// One ray and the proxy that it is tested against.
struct MeetCase {
  SceneProxy proxy;
  dvec3 origin = dvec3(0.0);  ///< relative to the camera at the world's origin
  dvec3 direction = dvec3(0.0);
};

class ProxyMeeting : public KernelTest {
 protected:
  [[nodiscard]] std::vector<KernelHit> meet(const std::vector<shaders::ProxyRow>& rows,
                                            const std::vector<KernelRay>& rays) {
    Kernel kernel(device(), shaders::reflections_test::meet_proxies_comp);
    std::vector<shaders::ProxyRow> padded = rows;
    std::vector<KernelRay> padded_rays = rays;
    padded.resize((rows.size() + 63) / 64 * 64);
    padded_rays.resize(padded.size());
    kernel.input(0, padded);
    kernel.input(1, padded_rays);
    kernel.output(2, padded.size() * sizeof(KernelHit));
    kernel.run(static_cast<std::uint32_t>(padded.size() / 64));
    std::vector<KernelHit> hits = kernel.read<KernelHit>(2);
    hits.resize(rows.size());
    return hits;
  }
  [[nodiscard]] std::vector<KernelHit> meet(const std::vector<MeetCase>& cases) {
    ProxyScene scene;
    std::vector<KernelRay> rays;
    for (const MeetCase& c : cases) {
      scene.proxies.push_back(c.proxy);
      rays.push_back({vec3(c.origin), vec3(glm::normalize(c.direction))});
    }
    const ProxyWorld world(scene);
    return meet(world.rows(view_from(dvec3(0.0), 0.0, 0.0), true), rays);
  }
  struct Agreement {
    std::size_t met = 0;
    std::size_t met_below_1e_4 = 0;  ///< with a smaller sine of the angle to the proxy
    std::size_t undecided = 0;       ///< rounding may decide
  };
  /// Expects what double precision says, within the error that rounding causes.
  [[nodiscard]] Agreement expect_as_in_double(const std::vector<MeetCase>& cases) {
    const std::vector<KernelHit> hits = meet(cases);
    Agreement all;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < cases.size() && wrong < 3; ++i) {
      const MeetCase& c = cases[i];
      const dvec3 origin{vec3(c.origin)}, direction = glm::normalize(dvec3(vec3(glm::normalize(c.direction))));
      const RayMeeting expected = meet_in_double(c.proxy, origin, direction);
      const double sine = -glm::dot(dvec3(c.proxy.world_from_node[2]), direction);
      const std::string what = "ray " + std::to_string(i) + " with the sine " + std::to_string(sine);
      all.undecided += expected.decided ? 0 : 1;
      if (!expected.decided) continue;
      EXPECT_EQ(hits[i].met != 0, expected.met) << what;
      wrong += (hits[i].met != 0) != expected.met ? 1 : 0;
      if (!expected.met) continue;
      ++all.met;
      all.met_below_1e_4 += sine < 1e-4 ? 1 : 0;
      const double uv_slack = expected.uv_slack(c.proxy.proxy) + 1e-6;
      const dvec2 uv_off = glm::abs(dvec2(hits[i].uv) - expected.uv);
      const bool same = std::abs(static_cast<double>(hits[i].distance_m) - expected.distance_m) <= expected.slack_m &&
                        uv_off.x <= uv_slack && uv_off.y <= uv_slack;
      EXPECT_TRUE(same) << what << ": " << hits[i].distance_m << " m in place of " << expected.distance_m << " ± "
                        << expected.slack_m << ", uv off by " << uv_off.x << ", " << uv_off.y << ", slack " << uv_slack;
      wrong += same ? 0 : 1;
    }
    return all;
  }
  [[nodiscard]] static SceneProxy facing(const dvec3& center, const dvec3& toward, vec2 size) {
    ProxyScene scene;
    return scene.add(center, toward, size);
  }
};

TEST_F(ProxyMeeting, agrees_with_intersections_in_double) {
  ProxyRandom random(21);
  std::vector<MeetCase> cases;
  for (int i = 0; i < 8192; ++i) {
    const vec2 size(static_cast<float>(random.length(-1.0, 1.5)), static_cast<float>(random.length(-1.0, 1.5)));
    MeetCase c{facing(random.inside(dvec3(20.0)), random.direction(), size), random.inside(dvec3(20.0))};
    const dvec3 aim = c.proxy.point(random.between(-0.8, 0.8), random.between(-0.8, 0.8));
    c.direction = aim - c.origin;
    cases.push_back(c);
  }
  const Agreement all = expect_as_in_double(cases);
  EXPECT_GT(all.met, 1500u);
  EXPECT_LT(all.undecided, cases.size() / 100);
}

// Rays at 0.0003 to 0.6 degrees to the proxy, from both sides.
// Hard case: reflections.grazing_floor
TEST_F(ProxyMeeting, agrees_with_intersections_in_double_at_grazing_incidence) {
  ProxyRandom random(26);
  std::vector<MeetCase> cases;
  for (int i = 0; i < 8192; ++i) {
    const vec2 size(static_cast<float>(random.length(-0.5, 1.5)), static_cast<float>(random.length(-0.5, 1.5)));
    MeetCase c{facing(random.inside(dvec3(2.0)), random.direction(), size)};
    const dvec3 aim = c.proxy.point(random.between(-0.8, 0.8), random.between(-0.8, 0.8));
    const dmat4& node = c.proxy.world_from_node;
    const double turn = random.between(0.0, 6.2831853), sine = random.length(-5.3, -2.0) * (i % 4 == 0 ? -1.0 : 1.0);
    const dvec3 along = std::cos(turn) * dvec3(node[0]) + std::sin(turn) * dvec3(node[1]);
    const dvec3 toward = glm::normalize(along - sine * dvec3(node[2]));
    c.origin = aim - random.length(-0.5, 1.0) * toward;
    c.direction = toward;
    cases.push_back(c);
  }
  const Agreement all = expect_as_in_double(cases);
  EXPECT_GT(all.met, 1500u);
  EXPECT_GT(all.met_below_1e_4, 200u);
  EXPECT_LT(all.undecided, cases.size() / 2);
}

TEST_F(ProxyMeeting, a_sphere_test_never_rejects_a_hit) {
  ProxyRandom random(22);
  std::vector<MeetCase> cases;
  for (int i = 0; i < 16384; ++i) {
    const double away = random.length(-0.5, 3.0), size = random.length(-1.0, 1.5);
    MeetCase c;
    c.direction = random.direction();
    c.origin = random.inside(dvec3(10.0));
    c.proxy = facing(c.origin + c.direction * away, random.direction() - c.direction, vec2(static_cast<float>(size)));
    const double corner = random.one_in(2) ? 0.499 : 0.3;  // corners lie on the sphere
    c.direction = c.proxy.point(random.one_in(2) ? corner : -corner, random.one_in(2) ? corner : -corner) - c.origin;
    cases.push_back(c);
  }
  const std::vector<KernelHit> hits = meet(cases);
  std::size_t met = 0, rejected = 0;
  for (const KernelHit& hit : hits) {
    met += hit.met;
    rejected += hit.met != 0 && hit.sphere == 0 ? 1 : 0;
  }
  EXPECT_GT(met, 8000u);
  EXPECT_EQ(rejected, 0u) << "of " << met;
}

TEST_F(ProxyMeeting, a_sphere_test_rejects_rays_far_beside_and_behind) {
  std::vector<MeetCase> cases;
  const SceneProxy proxy = facing({0.0, 0.0, -5.0}, {0.0, 0.0, 1.0}, vec2(2.0f));
  cases.push_back({proxy, dvec3(0.0), {0.0, 0.0, -1.0}});
  cases.push_back({proxy, dvec3(0.0), {0.0, 1.0, 0.0}});
  cases.push_back({proxy, dvec3(0.0), {0.0, 0.0, 1.0}});
  cases.push_back({proxy, dvec3(3.0, 0.0, 0.0), {0.0, 0.0, -1.0}});
  cases.push_back({proxy, dvec3(0.0, 0.0, -4.9), {0.0, 1.0, 0.0}});  // inside the sphere
  const std::vector<KernelHit> hits = meet(cases);
  const std::vector<std::uint32_t> sphere = {1, 0, 0, 0, 1}, met = {1, 0, 0, 0, 0};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(hits[i].sphere, sphere[i]) << i;
    EXPECT_EQ(hits[i].met, met[i]) << i;
  }
}

// Hard case: reflections.parallel_ray
TEST_F(ProxyMeeting, parallel_rays_backs_and_proxies_behind_the_origin_are_not_met) {
  const SceneProxy wall = facing({0.0, 0.0, -5.0}, {0.0, 0.0, 1.0}, vec2(4.0f));
  const std::vector<MeetCase> cases = {
      {wall, {0.0, 0.0, 0.0}, {1.0, 0.5, 0.0}},    // parallel, in front
      {wall, {-5.0, 0.0, -5.0}, {1.0, 0.0, 0.0}},  // parallel, in the plane
      {wall, {0.0, 0.0, -9.0}, {0.0, 0.0, 1.0}},   // at the back
      {wall, {0.0, 0.0, -9.0}, {0.0, 0.0, -1.0}},  // behind the origin, against the normal
      {wall, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}},    // behind the origin
      {wall, {0.0, 0.0, -5.0}, {0.0, 0.0, -1.0}},  // origin on the proxy
  };
  const std::vector<KernelHit> hits = meet(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) EXPECT_EQ(hits[i].met, 0u) << i;
}

TEST_F(ProxyMeeting, u_runs_along_the_nodes_x_and_v_from_the_top) {
  SceneProxy wall;
  wall.proxy.size_m = {4.0f, 2.0f};
  wall.world_from_node = glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -5.0));
  const std::vector<MeetCase> cases = {{wall, {-1.9, 0.9, 0.0}, {0, 0, -1}},
                                       {wall, {1.9, 0.9, 0.0}, {0, 0, -1}},
                                       {wall, {1.9, -0.9, 0.0}, {0, 0, -1}},
                                       {wall, {0.0, 0.0, 0.0}, {0, 0, -1}}};
  const std::vector<vec2> expected = {{0.025f, 0.05f}, {0.975f, 0.05f}, {0.975f, 0.95f}, {0.5f, 0.5f}};
  const std::vector<KernelHit> hits = meet(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(hits[i].met, 1u);
    EXPECT_NEAR(hits[i].uv.x, expected[i].x, 1e-4f) << i;
    EXPECT_NEAR(hits[i].uv.y, expected[i].y, 1e-4f) << i;
    EXPECT_NEAR(hits[i].distance_m, 5.0f, 1e-5f);
  }
}

TEST_F(ProxyMeeting, heights_are_served_in_each_band_and_nowhere_else) {
  ProxyScene scene;
  scene.add({0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, vec2(2.0f));
  scene.add_room(dvec3(0.0), vec3(50.0f)).heights = ReflectingHeights{{-3.0f, 0.0f, 1.5f, 4.0f}, 4};
  const ProxyWorld world(scene);
  const shaders::ProxyRow row = world.rows(view_from(dvec3(0.0, 1.0, 0.0), 0.0, 0.0), true).front();
  std::vector<KernelRay> rays;
  std::vector<bool> expected;
  for (int cm = -500; cm <= 500; ++cm) {
    const double world_y = 0.01 * cm + 0.002;
    rays.push_back({vec3(0.0f, static_cast<float>(world_y - 1.0), 0.0f), vec3(0.0f, 1.0f, 0.0f)});
    bool served = false;
    for (const double height : {-3.0, 0.0, 1.5, 4.0}) served |= std::abs(world_y - height) <= kReceiverSlack;
    expected.push_back(served);
  }
  const std::vector<KernelHit> hits = meet(std::vector(rays.size(), row), rays);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(hits[i].served != 0, expected[i]) << rays[i].origin.y;
}

TEST_F(ProxyMeeting, a_row_of_another_room_serves_no_height) {
  ProxyScene scene;
  scene.add({0.0, 1.0, 30.0}, {0.0, 0.0, 1.0}, vec2(2.0f));
  scene.add_room(dvec3(0.0), vec3(10.0f));
  scene.add_room(dvec3(0.0, 0.0, 30.0), vec3(10.0f));
  const ProxyWorld world(scene);
  const shaders::ProxyRow row = world.rows(view_from(dvec3(0.0, 1.0, 0.0), 0.0, 0.0), true).front();
  EXPECT_EQ(row.room, 0u);
  const std::vector<KernelHit> hits = meet({row, row}, {{vec3(0.0f), vec3(0, 1, 0)}, {vec3(0, -2, 0), vec3(0, 1, 0)}});
  for (const KernelHit& hit : hits) EXPECT_EQ(hit.served, 0u);
}

}  // namespace
}  // namespace gloam::test
