// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/reference/blur_run.h"

#include <algorithm>
#include <random>

#include "engine/render/kernel_check/pass_run.h"
#include "modules/depth_of_field/dof_passes.h"
#include "modules/depth_of_field/frame.h"
#include "modules/lighting/outputs.h"

namespace gloam {
namespace {

void set_dof_knobs(KnobRegistry& registry, const DofKnobs& knobs) {
  add_dof_knobs(registry);
  registry.set(kDofCache, knobs.cache);
  registry.set(kDofRadius, static_cast<double>(knobs.radius));
  registry.set(kDofFullResolution, knobs.full_resolution);
}

/// Adds a pass that fills transient images of the picture's size with NaN. Images of later passes share their memory,
/// so a texel that is read but was not written shows.
void add_nan_pass(FrameBuilder& frame) {
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
constexpr double kDofOffset = 40.0;

}  // namespace

DofInput objects_in_depth(std::uint32_t width, std::uint32_t height, std::uint32_t seed) {
  DofInput in(width, height, 0.0f);
  std::mt19937 random(seed);
  const auto between = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); };
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      in.coc[in.at(x, y)] = 24.317f - 31.0f * static_cast<float>(y) / static_cast<float>(height);
  for (int object = 0; object < 6; ++object) {
    const float circle = object == 0 ? 0.1f : between(-20.0f, 35.0f);
    const auto left = static_cast<std::uint32_t>(between(0.0f, 0.8f) * static_cast<float>(width));
    const auto top = static_cast<std::uint32_t>(between(0.0f, 0.8f) * static_cast<float>(height));
    for (std::uint32_t y = top; y < std::min(height, top + 1 + height / 6); ++y)
      for (std::uint32_t x = left; x < std::min(width, left + 1 + width / 5); ++x) in.coc[in.at(x, y)] = circle;
  }
  for (vec4& light : in.light) {
    light = vec4(between(0.1f, 1.0f), between(0.1f, 1.0f), between(0.1f, 1.0f), 1.0f);
    if (random() % 50 == 0) light *= 5.0f;
  }
  return in;
}

Result<DofResult> run_dof(const KernelLab& lab, const DofInput& in) {
  std::vector<float> depth;
  for (const float coc : in.coc) depth.push_back(static_cast<float>((kDofOffset - coc) / (2.0 * kDofOffset)));
  std::vector<DofHalf> light;
  for (const vec4& value : in.light) light.push_back(dof_half(value));
  RenderView view;
  view.width = in.width;
  view.height = in.height;
  PassRun frames(lab, view);
  const gpu::ImageHandle depth_image = frames.make_image(gpu::Format::r32_float, in.width, in.height, depth);
  const gpu::ImageHandle light_image = frames.make_image(gpu::Format::rgba16_float, in.width, in.height, light);
  set_dof_knobs(frames.knobs(), in.knobs);
  Lens lens;
  lens.offset_px = kDofOffset;
  lens.slope_px = -2.0 * kDofOffset;
  GLOAM_TRY(frames.draw([&](FrameBuilder& frame) {
    frame.set_module("depth_of_field");
    add_nan_pass(frame);
    GeometryOutputs geometry;
    geometry.depth = frames.input("depth", depth_image);
    frame.put(geometry);
    frame.put(LitOutput{frames.input("lit", light_image)});
    add_dof_passes(frame, {.focus_m = 1.0f, .bokeh = in.bokeh}, lens);
    frames.keep("light", frame.get<LitOutput>().color);
    frames.keep(frame, "lists", frame.get<DofFrame>().tiles.lists, sizeof(DofResult::lists));
  }));
  DofResult result;
  result.halves = frames.read<DofHalf>("light");
  for (const DofHalf& texel : result.halves) result.light.push_back(dof_light(texel));
  const auto lists = frames.read<shaders::DofList>("lists");
  std::copy_n(lists.begin(), result.lists.size(), result.lists.begin());
  return result;
}

}  // namespace gloam
