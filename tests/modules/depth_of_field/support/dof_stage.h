// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/math/packing.h"
#include "engine/render/renderer.h"
#include "modules/depth_of_field/components.h"
#include "modules/depth_of_field/lens/lens.h"
#include "modules/depth_of_field/reference/lens_reference.h"
#include "modules/module_list/module_list.h"
#include "tests/support/gpu_device.h"
#include "tests/support/render_scene.h"
#include "tests/support/stage_test.h"

namespace gloam::test {

/// A renderer of all modules, and a world of glowing quads without other light. The camera is at the origin and looks
/// along −Z.
class DofStage {
 public:
  explicit DofStage(std::unique_ptr<JobExecutor> executor = make_pool_executor(2)) : executor_(std::move(executor)) {
    RendererOptions made;
    made.device = device();
    made.executor = executor_.get();
    made.log = &gpu_log();
    made.modules = make_all_modules();
    renderer = value_of(Renderer::create(std::move(made)));
    renderer->prepare_world(world);
    auto& environment = world.resource<SceneEnvironment>();
    environment.sky_zenith = environment.sky_horizon = environment.sky_ground = vec3(0.0f);
    Camera lens;
    lens.fov_y = 0.6f;
    camera = world.create(WorldTransform{}, lens);
    view.width = 96;
    view.height = 64;
    view.camera_entity = camera;
  }

  /// A glowing square that faces the camera.
  void glow(const dvec3& at, float half, vec3 light) {
    Material material{.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f), .metallic = 0.0f, .roughness = 1.0f};
    material.emissive = light;
    scene.draw(scene.mesh(quad(half, scene.material(material))), glm::translate(dmat4(1.0), at));
  }
  void focus(const DepthOfField& values) {
    if (world.try_get<DepthOfField>(camera) != nullptr) world.remove<DepthOfField>(camera);
    world.add<DepthOfField>(camera, values);
  }
  void set(std::string_view knob, std::string_view value) {
    ASSERT_TRUE(renderer->knobs().set(knob, value).ok()) << knob << "=" << value;
  }
  [[nodiscard]] LinearPicture draw() {
    const ViewRequest request{view, {}};
    const Status drawn = renderer->render(world, std::span(&request, 1));
    EXPECT_TRUE(drawn.ok()) << (drawn.ok() ? "" : drawn.error().message);
    return value_of(renderer->read_linear(view.id));
  }
  /// The light of the stage's frame through its camera's lens.
  [[nodiscard]] LinearPicture through_lens(std::uint32_t samples) {
    const FramePictures frame{draw(), {}};
    const ReferenceInput input{.world = world,
                               .view = drawn_view(),
                               .knobs = renderer->knobs(),
                               .frame = frame,
                               .samples = samples,
                               .executor = executor(),
                               .redraw = [this](const auto& change, const auto& restore) -> Result<FramePictures> {
                                 change(world);
                                 FramePictures drawn{draw(), {}};
                                 restore(world);
                                 return drawn;
                               }};
    return value_of(light_through_lens(input));
  }
  [[nodiscard]] JobExecutor& executor() { return *executor_; }
  [[nodiscard]] const RenderView& drawn_view() { return world.view_resource<RenderView>(view.id); }

  /// The tests' device, or null.
  [[nodiscard]] static gpu::Device* device() {
    static const std::unique_ptr<gpu::Device> made = make_test_device();
    return made.get();
  }

  World world;
  SceneMaker scene{world};
  std::unique_ptr<Renderer> renderer;
  Entity camera;
  ViewSettings view;

 private:
  std::unique_ptr<JobExecutor> executor_;
};

using DofStageTest = StageTest<DofStage>;

}  // namespace gloam::test
