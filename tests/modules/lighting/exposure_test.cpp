// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/gpu/recording_device.h"

namespace gloam {
namespace {

RenderView view_of(std::uint32_t id, Entity camera = kNoEntity) {
  RenderView view;
  view.id = ViewId{id};
  view.camera_entity = camera;
  return view;
}

TEST(Exposure, of_an_exposure_value_makes_the_saturation_luminance_white) {
  // Lagarde and de Rousiers 2014: L_max = 1.2 · 2^EV100 cd/m².
  EXPECT_FLOAT_EQ(exposure_from_ev100(0.0f), 1.0f / 1.2f);
  EXPECT_FLOAT_EQ(exposure_from_ev100(15.0f), 1.0f / (1.2f * 32768.0f));
  EXPECT_FLOAT_EQ(exposure_from_ev100(-3.0f), 8.0f / 1.2f);
  for (const float ev : {-100.0f, -50.0f, 50.0f, 100.0f}) {
    EXPECT_GT(exposure_from_ev100(ev), 0.0f);
    EXPECT_TRUE(std::isfinite(exposure_from_ev100(ev)));
  }
}

struct Slots : ::testing::Test {
  std::unique_ptr<gpu::RecordingDevice> device = gpu::make_recording_device();
  ExposureSlots slots;
  LightingWorld world{1};

  Slots() { EXPECT_TRUE(slots.prepare(*device).ok()); }
  ~Slots() override {
    slots.release();
    EXPECT_TRUE(device->faults().empty());
    for (const gpu::ModuleMemory& m : device->memory()) EXPECT_EQ(m.bytes, 0u) << m.module;
  }
};

TEST_F(Slots, prepare_makes_one_buffer_for_the_lighting_module) {
  const gpu::BufferHandle buffer = slots.buffer();
  ASSERT_TRUE(buffer);
  EXPECT_EQ(device->desc(buffer).module, "lighting");
  EXPECT_EQ(device->desc(buffer).size, ExposureSlots::kCapacity * sizeof(float));
  ASSERT_TRUE(slots.prepare(*device).ok());
  EXPECT_EQ(slots.buffer(), buffer);
}

TEST_F(Slots, a_camera_is_fresh_once) {
  const auto first = slots.slot_of(world, view_of(0));
  EXPECT_TRUE(first.fresh);
  for (int i = 0; i < 3; ++i) {
    const auto again = slots.slot_of(world, view_of(0));
    EXPECT_FALSE(again.fresh);
    EXPECT_EQ(again.index, first.index);
  }
}

TEST_F(Slots, worlds_views_cameras_and_their_generations_have_their_own) {
  std::set<std::uint32_t> indices;
  for (const LightingWorld w : {LightingWorld{1}, LightingWorld{2}}) {
    for (const std::uint32_t id : {0u, 1u}) {
      for (const Entity camera : {kNoEntity, Entity{4, 1}, Entity{4, 2}, Entity{5, 1}}) {
        const auto slot = slots.slot_of(w, view_of(id, camera));
        EXPECT_TRUE(slot.fresh);
        EXPECT_TRUE(indices.insert(slot.index).second);
      }
    }
  }
}

TEST_F(Slots, that_are_all_taken_go_to_the_newest_cameras) {
  for (std::uint32_t i = 0; i < ExposureSlots::kCapacity; ++i) EXPECT_TRUE(slots.slot_of(world, view_of(i)).fresh);
  EXPECT_FALSE(slots.slot_of(world, view_of(0)).fresh);
  // One camera more takes the oldest camera's slot, and no other.
  const auto more = slots.slot_of(world, view_of(5000));
  EXPECT_TRUE(more.fresh);
  EXPECT_LT(more.index, ExposureSlots::kCapacity);
  for (std::uint32_t i = 1; i < ExposureSlots::kCapacity; ++i)
    ASSERT_FALSE(slots.slot_of(world, view_of(i)).fresh) << i;
  EXPECT_FALSE(slots.slot_of(world, view_of(5000)).fresh);
  const auto back = slots.slot_of(world, view_of(0));
  EXPECT_TRUE(back.fresh) << "what was metered for it is gone";
  EXPECT_NE(back.index, more.index);
}

TEST_F(Slots, never_share_an_index_over_many_rounds) {
  for (std::uint32_t i = 0; i < 4 * ExposureSlots::kCapacity; ++i) {
    const auto slot = slots.slot_of(world, view_of(i));
    ASSERT_TRUE(slot.fresh);
    ASSERT_LT(slot.index, ExposureSlots::kCapacity);
  }
  std::set<std::uint32_t> indices;
  for (std::uint32_t i = 3 * ExposureSlots::kCapacity; i < 4 * ExposureSlots::kCapacity; ++i) {
    const auto slot = slots.slot_of(world, view_of(i));
    ASSERT_FALSE(slot.fresh);
    ASSERT_TRUE(indices.insert(slot.index).second);
  }
}

TEST_F(Slots, of_a_frame_that_was_given_up_are_metered_again) {
  const auto frame_with = [&](std::uint32_t view, bool given_up) {
    EXPECT_TRUE(device->begin_frame().ok());
    const std::uint64_t frame = device->frame_number();
    EXPECT_TRUE(slots.prepare(*device).ok());
    const auto slot = slots.slot_of(world, view_of(view));
    EXPECT_TRUE((given_up ? device->abandon_frame() : device->submit_frame()).ok());
    if (given_up) slots.give_up_frame(frame);
    return slot;
  };
  const auto kept = frame_with(0, false);
  EXPECT_TRUE(frame_with(1, true).fresh);
  EXPECT_TRUE(frame_with(1, false).fresh);
  EXPECT_FALSE(frame_with(1, true).fresh);
  EXPECT_FALSE(frame_with(1, false).fresh) << "metered in an earlier frame";
  const auto still = frame_with(0, false);
  EXPECT_FALSE(still.fresh);
  EXPECT_EQ(still.index, kept.index);
}

TEST_F(Slots, release_forgets_every_camera) {
  static_cast<void>(slots.slot_of(world, view_of(0)));
  slots.release();
  EXPECT_FALSE(slots.buffer());
  ASSERT_TRUE(slots.prepare(*device).ok());
  EXPECT_TRUE(slots.slot_of(world, view_of(0)).fresh);
}

TEST_F(Slots, a_failed_creation_is_told_and_can_be_tried_again) {
  slots.release();
  device->fail_next_creation(Error{ErrorKind::failed, "out of memory"});
  const Status status = slots.prepare(*device);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message, "out of memory");
  EXPECT_FALSE(slots.buffer());
  EXPECT_TRUE(slots.prepare(*device).ok());
}

}  // namespace
}  // namespace gloam
