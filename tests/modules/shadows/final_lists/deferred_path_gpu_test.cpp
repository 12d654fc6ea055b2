// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/support/final_lists/deferred_scene.h"
#include "tests/render/draws/small_scene.h"

// A camera on a closed curve through a scene of moving casters and lights: each frame is compared with monolithic.

namespace gloam {
namespace {

class DeferredShadowsPath : public test::DeferredShadowsTest {
 protected:
  static constexpr int kFrames = 300;

  void build() {
    put_room();
    for (int i = 0; i < 4; ++i) put(shapes_[0], glm::scale(at(-1.2 + 0.8 * i, 0.35, -0.9), dvec3(0.25, 0.7, 0.25)));
    put(shapes_[3], glm::rotate(at(0.9, 0.5, 0.6), 0.6, dvec3(0.2, 1.0, 0.0)));
    put(shapes_[5], at(-0.9, 0.5, 0.7));
    put(pane_, at(0.1, 0.6, 1.2));
    for (const std::size_t shape : {0u, 1u, 4u, 6u}) movers_.push_back(put(shapes_[shape], dmat4(1.0)));
    Skin skin;
    skin.joint_nodes = {0, 1};
    skin.inverse_bind = {mat4(1.0f), glm::translate(mat4(1.0f), vec3(0.0f, -2.0f, 0.0f))};
    scene.assets().skins.push_back(std::move(skin));
    for (std::uint32_t i = 0; i < 2; ++i) joints_.push_back(scene.node(i, dmat4(1.0)));
    world.create(WorldTransform{}, MeshInstance{scene.mesh(test::skinned_bar(stone)), 0});
    put_light(point(0.1f), dvec3(0.0, 1.6, 0.4), dvec3(0.0, -1.0, 0.0), 32);
    put_light(spot(35.0, 0.05f), dvec3(0.8, 1.8, 0.8), dvec3(-0.3, -1.0, -0.6), 32);
    put_light(spot(50.0), dvec3(-1.2, 1.6, 0.2), dvec3(0.5, -1.0, -0.2), 32);
    Light made = sun(0.03f);
    made.intensity = 0.8f;
    put_light(made, dvec3(0.0), dvec3(0.4, -1.0, -0.5), 64);
  }
  void set_frame(int frame) {
    const double t = 6.283185307179586 * frame / kFrames;
    const dvec3 eye(2.3 * std::sin(t), 1.1 + 0.6 * std::cos(2.0 * t), 1.2 + 1.9 * std::cos(t));
    settings = test::look_at(eye, dvec3(0.3 * std::cos(3.0 * t), 0.4, -0.4), 48, 32);
    settings.world_from_camera =
        settings.world_from_camera * glm::rotate(dmat4(1.0), 0.3 * std::sin(2.0 * t), dvec3(0.0, 0.0, 1.0));
    for (std::size_t i = 0; i < movers_.size(); ++i) {
      const double u = t * static_cast<double>(1 + i) + static_cast<double>(i);
      // One caster rests at times, so that maps are kept.
      const double v = i == 3 ? std::floor(u * 3.0) : u;
      move(movers_[i], glm::scale(glm::rotate(at(1.2 * std::cos(v), 0.6 + 0.4 * std::sin(1.7 * v), 0.8 * std::sin(v)),
                                              v, dvec3(0.3, 1.0, 0.1)),
                                  dvec3(0.35)));
    }
    for (std::size_t i = 0; i < joints_.size(); ++i)
      move(joints_[i],
           at(-0.4, 0.1, 0.3) *
               glm::rotate(dmat4(1.0), 0.5 * std::sin(3.0 * t + 0.8 * static_cast<double>(i)), dvec3(1.0, 0.2, 0.4)) *
               glm::scale(dmat4(1.0), dvec3(0.15)));
    move(lamps[0], at(0.9 * std::sin(2.0 * t), 1.5, 0.5 * std::cos(3.0 * t)));
    move(lamps[1], at(0.8, 1.8, 0.8) * test::turn_towards(dvec3(std::sin(4.0 * t), -1.0, -0.5)));
    if (frame % 20 == 0) move(lamps[3], test::turn_towards(dvec3(0.4 * std::cos(t), -1.0, -0.5)));
    world.get<Light>(lamps[2]).intensity = frame / 30 % 3 == 2 ? 0.0f : 6.0f;
    world.mark_changed<Light>(lamps[2]);
  }
  void move(Entity entity, const dmat4& matrix) {
    world.get<WorldTransform>(entity).matrix = matrix;
    world.mark_changed<WorldTransform>(entity);
  }

  std::vector<Entity> movers_, joints_;
};

// Hard case: selftest.deferred_monolithic
TEST_F(DeferredShadowsPath, of_300_frames_is_the_same_in_each) {
  build();
  double slots = 0.0, classified = 0.0;
  std::vector<std::uint8_t> last;
  int changed = 0;
  for (int frame = 0; frame < kFrames && !HasFailure(); ++frame) {
    set_frame(frame);
    const Drawn drawn = expect_deferred_is_monolithic("frame " + std::to_string(frame));
    EXPECT_EQ(counter("shadows.fallback_tiles"), 0.0) << frame;
    slots += counter("shadows.slots");
    classified += counter("shadows.tile_lights_lit") + counter("shadows.tile_lights_unlit");
    changed += drawn.picture.rgba != last ? 1 : 0;
    last = drawn.picture.rgba;
  }
  EXPECT_EQ(changed, kFrames);
  EXPECT_GT(slots, 1000.0);
  EXPECT_GT(classified, 0.0);
}

}  // namespace
}  // namespace gloam
