// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/draws/caster_source.h"

#include <gtest/gtest.h>

#include <functional>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <utility>

#include "engine/gpu/recording/device.h"
#include "engine/render/frame_builder.h"
#include "engine/render/renderer.h"
#include "tests/support/expect_assert.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

/// Calls a function in PassPhase::announce.
class AnnouncingModule final : public Module {
 public:
  explicit AnnouncingModule(std::function<void(FrameBuilder&)> announce) : announce_(std::move(announce)) {}
  [[nodiscard]] std::string_view name() const override { return "announcing"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::announce) announce_(frame);
  }

 private:
  std::function<void(FrameBuilder&)> announce_;
};

class CasterSourceTest : public ::testing::Test {
 protected:
  void render(std::function<void(FrameBuilder&)> announce) {
    RendererOptions options;
    options.device = device_.get();
    options.executor = executor_.get();
    options.modules.push_back(std::make_unique<AnnouncingModule>(std::move(announce)));
    const auto renderer = Renderer::create(std::move(options)).value();
    World world;
    renderer->prepare_world(world);
    ViewRequest view;
    view.settings = test::look_at(dvec3(0.0, 0.0, 5.0), dvec3(0.0), 48, 27);
    EXPECT_TRUE(renderer->render(world, {&view, 1}).ok());
  }
  [[nodiscard]] static CasterSource source(std::uint64_t hash) {
    CasterSource made;
    made.content_hash = hash;
    made.record = [](const CasterSourceDraw&) {};
    return made;
  }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  std::unique_ptr<JobExecutor> executor_ = make_serial_executor();
};

TEST_F(CasterSourceTest, a_frame_lists_its_sources_in_the_order_of_announcement) {
  bool called = false;
  const auto announce = [&](FrameBuilder& frame) {
    for (std::uint64_t i = 0; i < 100; ++i) frame.add_caster_source(source(i));
    const auto sources = frame.caster_sources();
    ASSERT_EQ(sources.size(), 100u);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(sources[i]->content_hash, i);
    called = true;
  };
  render(announce);
  EXPECT_TRUE(called);
}

TEST_F(CasterSourceTest, sources_of_a_frame_are_not_those_of_the_next_one) {
  for (int i = 0; i < 2; ++i)
    render([](FrameBuilder& frame) {
      frame.add_caster_source(source(1));
      EXPECT_EQ(frame.caster_sources().size(), 1u);
    });
}

TEST_F(CasterSourceTest, a_source_that_maps_would_miss_or_that_draws_nothing_asserts) {
  const auto late = [](FrameBuilder& frame) {
    static_cast<void>(frame.caster_sources());
    frame.add_caster_source(source(1));
  };
  EXPECT_ASSERT(render(late), "caster sources are added in PassPhase::announce");
  device_ = gpu::make_recording_device();  // a failed assertion leaves a frame begun
  const auto empty = [](FrameBuilder& frame) { frame.add_caster_source({}); };
  EXPECT_ASSERT(render(empty), "needs a function that records its draws");
  device_ = gpu::make_recording_device();
}

TEST_F(CasterSourceTest, a_projection_is_exact_far_from_the_worlds_origin) {
  CasterProjection projection;
  projection.origin = dvec3(1e7, -2e7, 3e7);
  projection.clip_from_relative = glm::scale(dmat4(1.0), dvec3(0.5, 2.0, 0.25));
  const dmat4 world_from_local = glm::translate(dmat4(1.0), projection.origin + dvec3(0.125, 0.25, -1.0));
  const vec4 clip = projection.clip_from(world_from_local) * vec4(1.0f, 2.0f, 3.0f, 1.0f);
  EXPECT_EQ(clip, vec4(0.5625f, 4.5f, 0.5f, 1.0f));
  EXPECT_EQ(projection.constants(world_from_local).orthographic, 0u);
  projection.orthographic = true;
  EXPECT_EQ(projection.constants(world_from_local).orthographic, 1u);
}

}  // namespace
}  // namespace gloam
