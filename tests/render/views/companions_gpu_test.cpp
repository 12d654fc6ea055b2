// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Companion views: drawn before the view that needs them, and released with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "engine/render/frame_builder.h"
#include "tests/render/draws/drawn_scene.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

/// Adds companions as the test says, shows the first one's light in place of the main view's, and notes released views.
class CompanionModule final : public Module {
 public:
  struct Log {
    std::function<void(const ViewSettings&, CompanionViews&)> add;
    std::vector<std::uint32_t> views;  ///< declared, in order
    std::vector<std::uint32_t> released;
  };
  explicit CompanionModule(Log& log) : log_(log) {}
  [[nodiscard]] std::string_view name() const override { return "companions"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void companion_views(World&, const ViewSettings& main, const KnobRegistry&,
                       CompanionViews& companions) const override {
    if (log_.add) log_.add(main, companions);
  }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::announce) log_.views.push_back(frame.view().id.value);
    EXPECT_TRUE(phase < PassPhase::output || !frame.view().is_companion());
    if (phase != PassPhase::post || frame.view().is_companion()) return;
    EXPECT_EQ(frame.view().has_companions, frame.shared().find<CompanionLight>() != nullptr);
    if (const CompanionLight* companions = frame.shared().find<CompanionLight>())
      frame.put(LitOutput{companions->views.at(CompanionViews::ids_of(frame.view().id)[0].value).light});
  }
  void release_view(ViewId view) override { log_.released.push_back(view.value); }

 private:
  Log& log_;
};

struct Companions : ::testing::Test {
  void SetUp() override {
    GLOAM_REQUIRE_GPU(test::drawing_device());
    GLOAM_REQUIRE_DEPTH_TESTS(test::drawing_device());
    stage = std::make_unique<test::Stage>(std::make_unique<CompanionModule>(log));
    test::fill_small_scene(stage->world);
    static_cast<void>(test::add_lights(stage->world));
    stage->settings = test::look_at(dvec3(3.0, 2.0, 7.0), dvec3(0.0), 64, 48);
    log.add = [](const ViewSettings& main, CompanionViews& companions) {
      ViewSettings mirrored = main;
      mirrored.mirror = MirrorPlane{.offset = -2.0};
      mirrored.purpose = ViewPurpose::capture;
      static_cast<void>(companions.add(std::move(mirrored)));
    };
  }
  void TearDown() override {
    stage.reset();
    if (test::drawing_device() != nullptr) {
      EXPECT_EQ(test::drawing_device()->validation_messages(), 0u);
    }
  }
  CompanionModule::Log log;
  std::unique_ptr<test::Stage> stage;
};

TEST_F(Companions, show_what_a_view_with_their_settings_shows) {
  stage->render();
  const LinearPicture companion = stage->linear();
  log.add = {};
  ViewRequest request = stage->request(7);
  request.settings.mirror = MirrorPlane{.offset = -2.0};
  request.settings.purpose = ViewPurpose::capture;
  stage->render({request});
  EXPECT_EQ(stage->linear(7).rgba, companion.rgba);
  stage->render();
  EXPECT_NE(stage->linear().rgba, companion.rgba);
}

TEST_F(Companions, come_before_their_view_and_captures_have_none) {
  const gpu::ImageDesc desc{.name = "capture",
                            .module = "test",
                            .format = gpu::Format::rgba16_float,
                            .width = 64,
                            .height = 48,
                            .usage = gpu::ImageUsage::color_target | gpu::ImageUsage::sampled};
  const gpu::ImageHandle image = test::value_of(test::drawing_device()->create_image(desc));
  ViewRequest capture = stage->request(9);
  capture.target.light = LightTarget{.image = image};
  stage->render({capture, stage->request(3), stage->request(5)});
  const std::uint32_t of_3 = CompanionViews::ids_of(ViewId{3})[0].value;
  const std::uint32_t of_5 = CompanionViews::ids_of(ViewId{5})[0].value;
  EXPECT_THAT(log.views, ::testing::ElementsAre(9u, of_3, 3u, of_5, 5u));
  ASSERT_TRUE(stage->renderer->wait().ok());
  test::drawing_device()->destroy(image);
}

TEST_F(Companions, are_released_with_their_view_or_when_no_frame_draws_them) {
  const std::uint32_t id = CompanionViews::ids_of(ViewId{0})[0].value;
  stage->render();
  stage->renderer->release_view(stage->world, ViewId{0});
  EXPECT_THAT(log.released, ::testing::Contains(id));
  EXPECT_EQ(stage->world.try_view_resource<RenderView>(ViewId{id}), nullptr);
  log.released.clear();
  stage->settings.width = stage->settings.height = 16;
  stage->render();
  log.add = {};
  for (int i = 0; i < 119; ++i) stage->render();
  EXPECT_THAT(log.released, ::testing::IsEmpty());
  stage->render();
  EXPECT_THAT(log.released, ::testing::ElementsAre(id));
}

TEST_F(Companions, are_few_and_have_ids_that_no_other_view_may_have) {
  CompanionViews companions(ViewId{1});
  for (std::uint32_t i = 0; i < CompanionViews::kMost; ++i) static_cast<void>(companions.add({}));
  EXPECT_ASSERT((void)companions.add({}), "at most");
  CompanionViews too_high(ViewId{CompanionViews::kMostMainIds});
  EXPECT_ASSERT((void)too_high.add({}), "below");
  EXPECT_ASSERT((void)stage->renderer->render(stage->world, std::vector{stage->request(CompanionViews::kFirstId)}),
                "for companions");
}

}  // namespace
}  // namespace gloam
