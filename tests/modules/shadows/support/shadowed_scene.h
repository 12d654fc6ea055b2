// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "modules/shadows/components.h"
#include "tests/modules/lighting/lit_scene.h"

namespace gloam::test {

/// A wall in the plane z = 0, seen by the camera, with boxes in front of it. There is no light until a test adds one.
class ShadowedScene : public LitSceneTest {
 protected:
  struct Box {
    dvec3 center;
    dvec3 half;
  };

  [[nodiscard]] bool with_shadows() const override { return true; }
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(LitSceneTest::SetUp());
    if (IsSkipped()) return;
    environment().has_exposure = true;
    stone = scene.material(exact_material(180, 170, 160, 255, 0));
    scene.draw(scene.mesh(quad(4.0f, stone)));
    settings = look_at(dvec3(0.4, 0.3, 3.0), dvec3(0.0), 95, 63);
    set("shadows.visibility_bits", "exact");
  }

  Entity box(const dvec3& center, const dvec3& half) {
    boxes.push_back({center, half});
    return scene.draw(scene.mesh(test::box(vec3(half), stone)), glm::translate(dmat4(1.0), center));
  }
  /// Adds a named light of 8 cd (or lux) in front of the wall.
  Entity lamp(const std::string& name, LightKind kind, const dvec3& position,
              const dvec3& direction = dvec3(0.0, 0.0, -1.0)) {
    Light made;
    made.kind = kind;
    made.intensity = 8.0f;
    made.range_m = 12.0f;
    made.outer_angle = 0.7f;
    made.inner_angle = 0.5f;
    made.apparent_angle = 0.0f;
    const Entity entity = light(made, position, direction);
    world.resource<SceneNames>().add("light", name, entity);
    world.add(entity, ShadowCaster{true, 1024});
    return entity;
  }
  void set(const char* knob, const char* value) {
    const Status status = renderer->knobs().set(knob, value);
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  [[nodiscard]] LinearPicture drawn() {
    draw();
    return HasFatalFailure() ? LinearPicture{} : linear();
  }
  [[nodiscard]] LinearPicture drawn(const char* knob, const char* value) {
    set(knob, value);
    return drawn();
  }
  /// The image that visualizer "shadow:NAME" writes.
  [[nodiscard]] std::vector<float> visibility(const std::string& name) {
    settings.visualizer = "shadow:" + name;
    draw();
    settings.visualizer = "none";
    return floats("shadow_visibility");
  }
  [[nodiscard]] std::vector<float> floats(const char* image) {
    const ImageBytes bytes = value_of(renderer->read_image(world, ViewId{0}, image));
    std::vector<float> values(bytes.bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.bytes.data(), bytes.bytes.size());
    return values;
  }
  [[nodiscard]] double counter(const std::string& name) const { return renderer->report().counters.at(name); }

  /// Whether a box lies between two points.
  [[nodiscard]] bool blocked(const dvec3& from, const dvec3& to) const {
    for (const Box& b : boxes) {
      double enter = 1e-4, leave = 1.0;
      const dvec3 step = to - from;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (b.center[axis] - b.half[axis] - from[axis]) / step[axis];
        const double c = (b.center[axis] + b.half[axis] - from[axis]) / step[axis];
        enter = std::max(enter, std::min(a, c));
        leave = std::min(leave, std::max(a, c));
      }
      if (enter < leave) return true;
    }
    return false;
  }

  std::uint32_t stone = 0;
  std::vector<Box> boxes;
};

}  // namespace gloam::test
