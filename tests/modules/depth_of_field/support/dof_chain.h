// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/math/packing.h"
#include "modules/depth_of_field/dof_passes.h"
#include "tests/support/gpu_device.h"
#include "tests/support/pass_frame.h"

namespace gloam::test {

/// A picture with a signed circle of confusion for each pixel, within ±40 pixels.
struct DofInput {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  std::vector<float> coc;
  std::vector<vec4> light;
  DofKnobs knobs;
  Bokeh bokeh = Bokeh::round;

  DofInput(std::uint32_t w, std::uint32_t h, float everywhere, vec4 shown = vec4(1.0f))
      : width(w), height(h), coc(std::size_t{w} * h, everywhere), light(std::size_t{w} * h, shown) {}
  [[nodiscard]] std::size_t at(std::uint32_t x, std::uint32_t y) const { return std::size_t{y} * width + x; }
};

using DofHalf = std::array<std::uint16_t, 4>;

struct DofResult {
  std::vector<DofHalf> halves;
  std::vector<vec4> light;
  std::array<shaders::DofList, GLOAM_DOF_LISTS> lists{};
};

/// The light that the passes read: rounded to half floats.
[[nodiscard]] inline DofHalf dof_half(const vec4& v) {
  return {float_to_half(v.x), float_to_half(v.y), float_to_half(v.z), float_to_half(v.w)};
}
[[nodiscard]] inline vec4 dof_light(const DofHalf& t) {
  return {half_to_float(t[0]), half_to_float(t[1]), half_to_float(t[2]), half_to_float(t[3])};
}

inline void set_dof_knobs(KnobRegistry& registry, const DofKnobs& knobs) {
  add_dof_knobs(registry);
  registry.set(kDofCache, knobs.cache);
  registry.set(kDofRadius, static_cast<double>(knobs.radius));
  registry.set(kDofFullResolution, knobs.full_resolution);
}

/// Adds a pass that fills transient images of the picture's size with NaN. Images of later passes share their memory,
/// so a texel that is read but was not written shows.
inline void add_nan_pass(FrameBuilder& frame) {
  PassBuilder pass = frame.graph().add_pass("nan", frame.module());
  pass.keep();
  std::vector<ImageRef> images;
  for (int i = 0; i < 16; ++i)
    images.push_back(
        pass.write(create_view_image(frame, "nan", gpu::Format::rgba16_float), gpu::Access::transfer_write));
  pass.execute([images](PassContext& context) {
    constexpr std::uint32_t kNan = 0x7FC00000u;
    for (const ImageRef& image : images)
      context.commands().clear_color_image(context.image(image), {kNan, kNan, kNan, kNan});
  });
}

/// Circles follow from depths as kDofOffset − 2 · kDofOffset · depth.
inline constexpr double kDofOffset = 40.0;

/// Runs the passes of the module on a picture.
[[nodiscard]] inline DofResult run_dof(gpu::Device& device, const DofInput& in) {
  std::vector<float> depth;
  for (const float coc : in.coc) depth.push_back(static_cast<float>((kDofOffset - coc) / (2.0 * kDofOffset)));
  std::vector<DofHalf> light;
  for (const vec4& value : in.light) light.push_back(dof_half(value));
  RenderView view;
  view.width = in.width;
  view.height = in.height;
  ReadPassFrames frames(device, view);
  const gpu::ImageHandle depth_image = frames.make_image(gpu::Format::r32_float, in.width, in.height, depth);
  const gpu::ImageHandle light_image = frames.make_image(gpu::Format::rgba16_float, in.width, in.height, light);
  set_dof_knobs(frames.knobs(), in.knobs);
  Lens lens;
  lens.offset_px = kDofOffset;
  lens.slope_px = -2.0 * kDofOffset;
  frames.draw([&](FrameBuilder& frame) {
    frame.set_module("depth_of_field");
    add_nan_pass(frame);
    GeometryOutputs geometry;
    geometry.depth = frames.input("depth", depth_image);
    frame.put(geometry);
    frame.put(LitOutput{frames.input("lit", light_image)});
    add_dof_passes(frame, {.focus_m = 1.0f, .bokeh = in.bokeh}, lens);
    frames.keep("light", frame.get<LitOutput>().color);
    frames.keep(frame, "lists", frame.get<DofFrame>().tiles.lists, sizeof(DofResult::lists));
  });
  DofResult result;
  result.halves = frames.read<DofHalf>("light");
  for (const DofHalf& texel : result.halves) result.light.push_back(dof_light(texel));
  const auto lists = frames.read<shaders::DofList>("lists");
  std::copy_n(lists.begin(), result.lists.size(), result.lists.begin());
  return result;
}

/// Runs on a validated device, with the shaders for threads in turn (true) and for threads together (false).
class DofChainTest : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(device());
    messages_ = device()->validation_messages();
  }
  void TearDown() override {
    if (device()) {
      EXPECT_EQ(device()->validation_messages(), messages_);
    }
  }
  [[nodiscard]] static DofResult run(const DofInput& in) { return run_dof(*device(), in); }
  [[nodiscard]] static gpu::Device* device() {
    static const std::unique_ptr<gpu::Device> devices[] = {make(false), make(true)};
    return devices[GetParam() ? 1 : 0].get();
  }

 private:
  static std::unique_ptr<gpu::Device> make(bool in_turn) {
    gpu::VulkanOptions options = test_device_options();
    options.threads_in_turn = in_turn;
    return make_test_device(true, options);
  }
  std::uint64_t messages_ = 0;
};

}  // namespace gloam::test
