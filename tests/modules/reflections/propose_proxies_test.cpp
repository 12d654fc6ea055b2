// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/posing/animation.h"
#include "engine/scene/resources.h"
#include "modules/reflections/components.h"
#include "modules/reflections/fitting/scene_surfaces.h"
#include "modules/reflections/module.h"
#include "tests/modules/reflections/fitting/fit_scene.h"

namespace gloam {
namespace {

/// A yard without symmetry: a wet floor, a long wall with a niche, a turned house and a low block. Proxies placed by
/// hand can be added.
class Yard {
 public:
  Yard() {
    prepare_scene_world(world);
    make_reflections_module()->register_components(world);
    auto& assets = world.resource<SceneAssets>();
    assets.materials = {{.name = "wet", .metallic = 0.0f, .roughness = 0.1f},
                        {.name = "dry", .metallic = 0.0f, .roughness = 0.9f}};
    add(test::rectangle({-8.0, 0.0, -6.0}, {0.0, 0.0, 12.0}, {20.0, 0.0, 0.0}), 0);
    add(test::wall(-8.0, 0.0, 9.0, 4.0, -6.0), 1);
    add(test::wall(1.0, 0.0, 4.0, 4.0, -7.0), 1);
    add(test::wall(5.0, 0.0, 7.0, 3.0, -6.0), 1);
    add(test::rectangle({-8.0, 0.0, 5.0}, {2.0, 0.0, -11.0}, {0.0, 5.0, 0.0}), 1);
    add(test::box({4.0, 0.0, 1.0}, {6.0, 2.5, 3.0}), 1);
  }

  void add(const FitTriangles& shape, std::uint32_t material) {
    meshes.push_back(shape);
    auto& assets = world.resource<SceneAssets>();
    Primitive primitive;
    primitive.material = material;
    for (const dvec3& p : shape.positions) primitive.positions.emplace_back(p);
    primitive.indices = shape.indices;
    Mesh mesh;
    mesh.primitives.push_back(primitive);
    const Entity entity = world.create();
    world.add<MeshInstance>(entity, {.mesh = static_cast<std::uint32_t>(assets.meshes.size())});
    world.add<WorldTransform>(entity, {});
    assets.meshes.push_back(std::move(mesh));
  }
  void add_proxy(const ProposedProxy& proxy) {
    const Entity entity = world.create();
    world.add<IbrProxy>(entity, {.size_m = proxy.size_m});
    const dmat4 matrix = glm::translate(dmat4(1.0), proxy.translation) * glm::mat4_cast(proxy.rotation);
    world.add<WorldTransform>(entity, {.matrix = matrix});
  }
  void add_proxy(const dvec3& center, const dvec3& normal, float width, float height) {
    const dquat rotation = glm::quatLookAt(-normal, dvec3(0.0, 1.0, 0.0));
    add_proxy({.translation = center, .rotation = rotation, .size_m = {width, height}});
  }
  Entity add_camera(const dvec3& eye, const dvec3& target) {
    const Entity entity = world.create();
    world.add<Camera>(entity, {});
    world.add<WorldTransform>(entity, {.matrix = glm::inverse(glm::lookAt(eye, target, dvec3(0.0, 1.0, 0.0)))});
    return entity;
  }
  [[nodiscard]] ProxyProposal propose(std::size_t count, JobExecutor& jobs, std::vector<Entity> cameras = {}) const {
    return propose_proxies(world, {.count = count, .cameras = std::move(cameras), .eyes = 48},
                           test::brute_force(meshes), jobs);
  }
  [[nodiscard]] ProxyProposal propose(std::size_t count) const { return propose(count, *make_serial_executor()); }

  World world;
  std::vector<FitTriangles> meshes;
};

TEST(ProposedProxies, catch_as_many_rays_as_those_placed_by_hand) {
  Yard yard;
  yard.add_proxy({-3.5, 2.0, -6.0}, {0.0, 0.0, 1.0}, 9.0f, 4.0f);
  yard.add_proxy({3.0, 2.0, -7.0}, {0.0, 0.0, 1.0}, 4.0f, 4.0f);
  yard.add_proxy({8.5, 1.5, -6.0}, {0.0, 0.0, 1.0}, 7.0f, 3.0f);
  yard.add_proxy({-7.0, 2.5, -0.5}, glm::normalize(dvec3(11.0, 0.0, 2.0)), 11.18f, 5.0f);
  const ProxyProposal proposal = yard.propose(6);
  EXPECT_EQ(proposal.existing, 4u);
  ASSERT_EQ(proposal.shares.size(), 1u);
  const CaughtShares& shares = proposal.shares[0];
  EXPECT_GT(shares.rays, 200u);
  EXPECT_EQ(shares.in_rooms, shares.rays) << "there is no room";
  EXPECT_GT(static_cast<double>(shares.by_existing), 0.7 * static_cast<double>(shares.rays));
  EXPECT_GE(static_cast<double>(shares.by_proposed), 0.9 * static_cast<double>(shares.by_existing));
}

TEST(ProposedProxies, catch_the_same_rays_as_nodes_of_the_scene) {
  Yard yard;
  const ProxyProposal proposal = yard.propose(5);
  ASSERT_EQ(proposal.proxies.size(), 5u);
  for (const ProposedProxy& proxy : proposal.proxies) yard.add_proxy(proxy);
  const ProxyProposal again = yard.propose(5);
  EXPECT_EQ(again.existing, 5u);
  EXPECT_EQ(again.shares[0].by_existing, proposal.shares[0].by_proposed);
  EXPECT_EQ(again.shares[0].by_proposed, proposal.shares[0].by_proposed);
}

TEST(ProposedProxies, are_at_most_as_many_as_wanted_and_more_catch_more) {
  const Yard yard;
  std::uint64_t before = 0;
  for (const std::size_t count : {0u, 1u, 2u, 4u, 8u}) {
    const ProxyProposal proposal = yard.propose(count);
    EXPECT_LE(proposal.proxies.size(), count);
    EXPECT_GE(proposal.shares[0].by_proposed, before);
    before = proposal.shares[0].by_proposed;
  }
  EXPECT_EQ(yard.propose(0).shares[0].by_proposed, 0u);
}

TEST(ProposedProxies, do_not_depend_on_threads) {
  const Yard yard;
  const ProxyProposal serial = yard.propose(5);
  for (const std::uint32_t threads : {1u, 2u, 8u}) {
    const ProxyProposal pooled = yard.propose(5, *make_pool_executor(threads));
    ASSERT_EQ(pooled.proxies.size(), serial.proxies.size());
    for (std::size_t i = 0; i < serial.proxies.size(); ++i) {
      EXPECT_EQ(pooled.proxies[i].translation, serial.proxies[i].translation);
      EXPECT_EQ(pooled.proxies[i].rotation, serial.proxies[i].rotation);
      EXPECT_EQ(pooled.proxies[i].size_m, serial.proxies[i].size_m);
    }
    EXPECT_EQ(pooled.shares[0].by_proposed, serial.shares[0].by_proposed);
  }
}

TEST(ProposedProxies, are_judged_for_each_camera) {
  Yard yard;
  const Entity camera = yard.add_camera({0.0, 1.7, 5.0}, {0.0, 0.0, -2.0});
  const Entity up = yard.add_camera({0.0, 1.7, 5.0}, {0.0, 9.0, 2.0});
  const ProxyProposal proposal = yard.propose(4, *make_serial_executor(), {camera, up, kNoEntity});
  ASSERT_EQ(proposal.shares.size(), 3u);
  EXPECT_GT(proposal.shares[0].rays, 100u);
  EXPECT_EQ(proposal.shares[1].rays, 0u);
  EXPECT_GT(static_cast<double>(proposal.shares[0].by_proposed), 0.5 * static_cast<double>(proposal.shares[0].rays));
}

TEST(ProposedProxies, are_the_largest_quads_if_nothing_reflects) {
  Yard yard;
  yard.world.resource<SceneAssets>().materials[0].roughness = 0.9f;
  const ProxyProposal proposal = yard.propose(2);
  ASSERT_EQ(proposal.proxies.size(), 2u);
  EXPECT_EQ(proposal.shares[0].rays, 0u);
  const auto area = [](const ProposedProxy& p) { return p.size_m.x * p.size_m.y; };
  EXPECT_GE(area(proposal.proxies[0]), area(proposal.proxies[1]));
  EXPECT_GT(area(proposal.proxies[1]), 25.0f);
}

TEST(ProposedProxies, of_an_empty_world_are_none) {
  World world;
  prepare_scene_world(world);
  make_reflections_module()->register_components(world);
  const ProxyProposal proposal = propose_proxies(world, {}, test::brute_force({}), *make_serial_executor());
  EXPECT_TRUE(proposal.proxies.empty());
  EXPECT_EQ(proposal.candidates, 0u);
}

TEST(SceneSurfaces, leave_out_what_moves_and_what_is_blended) {
  Yard yard;
  const std::size_t all = gather_surfaces(yard.world).instances.size();
  auto& assets = yard.world.resource<SceneAssets>();
  const FitTriangles shape = test::wall(0.0, 0.0, 2.0, 2.0);
  yard.add(shape, 1);
  EXPECT_EQ(gather_surfaces(yard.world).instances.size(), all + 1);

  assets.materials.push_back({.name = "glass", .alpha_mode = AlphaMode::blend});
  yard.add(shape, 2);
  EXPECT_EQ(gather_surfaces(yard.world).instances.size(), all + 1) << "blended";

  const Entity parent = yard.world.create();
  const Entity child = yard.world.create();
  yard.world.add<Parent>(child, {.entity = parent});
  yard.world.add<MeshInstance>(child, {.mesh = 1});
  yard.world.add<WorldTransform>(child, {});
  EXPECT_EQ(gather_surfaces(yard.world).instances.size(), all + 2);
  AnimationClip clip;
  clip.channels.push_back(
      {.node = 12, .path = AnimationPath::translation, .times = {0.0f}, .values = {0.0f, 0.0f, 0.0f}});
  SceneNodes nodes;
  nodes.entities.resize(13, kNoEntity);
  nodes.entities[12] = parent;
  bind_animations(std::span(&clip, 1), nodes, yard.world.resource<AnimationBindings>());
  EXPECT_EQ(gather_surfaces(yard.world).instances.size(), all + 1) << "its parent moves";
}

TEST(SceneSurfaces, of_mirrored_instances_keep_their_fronts) {
  Yard yard;
  yard.meshes.clear();
  auto& assets = yard.world.resource<SceneAssets>();
  yard.add(test::wall(0.0, 0.0, 2.0, 2.0), 1);
  yard.world.view<const MeshInstance, WorldTransform>().each([&](const MeshInstance& drawn, WorldTransform& transform) {
    if (drawn.mesh + 1 == assets.meshes.size()) transform.matrix = glm::scale(dmat4(1.0), dvec3(-1.0, 1.0, 1.0));
  });
  const FitTriangles placed = gather_surfaces(yard.world).instances.back();
  const auto& p = placed.positions;
  const dvec3 normal =
      glm::cross(p[placed.indices[1]] - p[placed.indices[0]], p[placed.indices[2]] - p[placed.indices[0]]);
  EXPECT_GT(normal.z, 0.0);
  EXPECT_LT(p[1].x, 0.0);
}

}  // namespace
}  // namespace gloam
