// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/modules/closeups/scene.h"

#include "engine/ecs/view.h"

// A separate program: memory and pipelines are counted per module, over all renderers of the device.

namespace gloam::test {
namespace {

/// Has its own renderer, which has made no pipelines for other scenes.
class CloseupCosts : public LitSceneTest {
 protected:
  [[nodiscard]] bool with_shadows() const override { return true; }

  /// GPU memory of the module, by number of pairs.
  [[nodiscard]] std::map<int, std::uint64_t> bytes_by_pairs() {
    EXPECT_TRUE(renderer->knobs().set("shadows.mode", "deferred").ok());
    const std::uint32_t stone = scene.material(exact_material(180, 170, 160, 255, 0));
    scene.draw(scene.mesh(quad(4.0f, stone)));
    std::vector<Entity> blocks;
    for (int i = 0; i < 8; ++i)
      blocks.push_back(scene.draw(scene.mesh(box(vec3(0.08f), stone)),
                                  glm::translate(dmat4(1.0), dvec3(-0.9 + 0.25 * i, 0.1, 0.4))));
    Light lamp{.kind = LightKind::point, .intensity = 20.0f, .range_m = 12.0f};
    world.add(light(lamp, dvec3(0.5, 0.5, 2.0)), ShadowCaster{true, 128});
    std::map<int, std::uint64_t> bytes;
    for (const int count : {1, 2, 8}) {
      for (int i = 0; i < count; ++i)
        if (!world.has<CloseupSubject>(blocks[static_cast<std::size_t>(i)]))
          world.add(blocks[static_cast<std::size_t>(i)], CloseupSubject{true});
      for (int i = 0; i < 3; ++i) draw();
      renderer->free_idle_memory();
      draw();
      EXPECT_EQ(renderer->report().counters.at("closeups.pairs"), static_cast<double>(count));
      bytes[count] = module_state("closeups").gpu_bytes;
    }
    return bytes;
  }
};

TEST_F(CloseupCosts, are_nothing_for_a_world_without_subjects) {
  EXPECT_TRUE(renderer->knobs().set("shadows.mode", "deferred").ok());
  const std::uint32_t stone = scene.material(exact_material(180, 170, 160, 255, 0));
  scene.draw(scene.mesh(quad(4.0f, stone)));
  const Entity block = scene.draw(scene.mesh(box(vec3(0.3f), stone)), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 0.6)));
  Light lamp{.kind = LightKind::point, .intensity = 20.0f, .range_m = 12.0f};
  world.add(light(lamp, dvec3(0.5, 0.5, 2.0)), ShadowCaster{true, 128});
  draw();
  draw();
  const ModuleState without = module_state("closeups");
  EXPECT_FALSE(without.demanded);
  EXPECT_EQ(without.pipelines, 0u);
  EXPECT_EQ(without.gpu_bytes, 0u);
  for (const PassTime& pass : renderer->report().passes) EXPECT_NE(pass.module, "closeups") << pass.name;
  std::size_t pairs = 0;
  world.view<const CloseupPair>().each([&](const CloseupPair&) { ++pairs; });
  EXPECT_EQ(pairs, 0u);
  world.add(block, CloseupSubject{true});
  draw();
  draw();
  EXPECT_TRUE(module_state("closeups").demanded);
  EXPECT_GT(module_state("closeups").pipelines, 0u);
  EXPECT_EQ(renderer->report().counters.at("closeups.pairs"), 1.0);
}

TEST_F(CloseupCosts, in_memory_do_not_depend_on_the_number_of_pairs) {
  const std::map<int, std::uint64_t> bytes = bytes_by_pairs();
  EXPECT_EQ(bytes.at(1), bytes.at(2));
  EXPECT_EQ(bytes.at(1), bytes.at(8));
}

TEST_F(CloseupCosts, in_memory_do_not_depend_on_the_number_of_pairs_that_copies_are_made_for) {
  Material glass = exact_material(180, 170, 160, 255, 0);
  glass.alpha_mode = AlphaMode::blend;
  glass.base_color.a = 0.4f;
  const Entity pane =
      scene.draw(scene.mesh(quad(0.5f, scene.material(glass))), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 0.8)));
  const std::map<int, std::uint64_t> bytes = bytes_by_pairs();
  const auto transfers = [&] {
    const FrameReport report = renderer->report();
    return std::ranges::any_of(report.passes, [](const PassTime& pass) { return pass.name == "closeup_transfer"; });
  };
  EXPECT_TRUE(transfers());
  EXPECT_EQ(bytes.at(1), bytes.at(2));
  EXPECT_EQ(bytes.at(1), bytes.at(8));
  world.remove<MeshInstance>(pane);
  for (int i = 0; i < 3; ++i) draw();
  renderer->free_idle_memory();
  draw();
  EXPECT_FALSE(transfers());
  EXPECT_EQ(bytes.at(8), module_state("closeups").gpu_bytes) << "copies take none";
}

}  // namespace
}  // namespace gloam::test
