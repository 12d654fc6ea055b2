// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/references.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "engine/render/camera/light_scale.h"
#include "engine/render/passes/renderer_passes.h"
#include "modules/fog/components.h"
#include "modules/fog/knobs.h"
#include "modules/fog/lamp_scattering.h"
#include "modules/fog/model.h"

namespace gloam {
namespace {

/// On the board between post and output: the light before the fog.
struct BareLightOutput {
  ImageRef light;
};

/// The frame's light before the fog.
Result<LinearPicture> draw_bare_light(const ReferenceInput& input) {
  if (!input.redraw || input.geometry == nullptr)
    return Error{ErrorKind::usage,
                 "the reference of fog needs the frame's geometry and a frame that can be drawn again"};
  auto bare = input.redraw([](World& world) { world.set_resource(BareLight{}); },
                           [](World& world) { world.remove_resource<BareLight>(); });
  if (!bare) return bare.error();
  return std::move(bare->linear);
}

/// fog_reference() of that light.
std::vector<double> add_fog(const ReferenceInput& input, const LinearPicture& light) {
  return fog_reference(light.rgba, fog_distances(*input.geometry), light.width, light.height, find_fog(input.world),
                       kMostHalf / static_cast<double>(input.view.light_scale));
}

Result<FramePictures> show(const ReferenceInput& input, const LinearPicture& light) {
  // Drawn again: what later modules make of this light is part of the frame that the knob is judged by.
  return input.redraw(
      [&](World& world) { world.set_resource(FogPicture{to_light_picture(light, input.view.light_scale)}); },
      [](World& world) { world.remove_resource<FogPicture>(); });
}

}  // namespace

void add_bare_light_pass(FrameBuilder& frame) {
  const ImageRef kept = create_view_image(frame, "fog_bare_light", gpu::Format::rgba16_float);
  frame.put(BareLightOutput{add_copy_light_pass(frame, frame.get<LitOutput>().color, kept)});
}

void show_bare_light(FrameBuilder& frame) { frame.get<LitOutput>().color = frame.get<BareLightOutput>().light; }

Result<FramePictures> draw_fog_reference(const ReferenceInput& input) {
  const auto bare = draw_bare_light(input);
  if (!bare) return bare.error();
  const std::vector<double> fogged = add_fog(input, *bare);
  return show(input, {bare->width, bare->height, {fogged.begin(), fogged.end()}});
}

Result<LinearPicture> march_fog(const ReferenceInput& input) {
  if (input.tracer == nullptr) return Error{ErrorKind::usage, "marched fog needs the scene's triangles"};
  auto bare = draw_bare_light(input);
  if (!bare) return bare.error();
  const std::vector<double> fogged = add_fog(input, *bare);
  const std::vector<dvec3> scattered = scatter_lamps({.world = input.world,
                                                      .geometry = *input.geometry,
                                                      .tracer = *input.tracer,
                                                      .executor = input.executor,
                                                      .samples = input.samples,
                                                      .progress = input.progress},
                                                     find_fog(input.world));
  LinearPicture marched{bare->width, bare->height, {fogged.begin(), fogged.end()}};
  for (std::size_t i = 0; i < scattered.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      marched.rgba[4 * i + c] = static_cast<float>(fogged[4 * i + c] + scattered[i][static_cast<int>(c)]);
  return marched;
}

Result<FramePictures> draw_marched_fog(const ReferenceInput& input) {
  const auto marched = march_fog(input);
  if (!marched) return marched.error();
  return show(input, *marched);
}

Status put_marched_fog(World& world, const ReferenceInput& input) {
  const auto marched = march_fog(input);
  if (!marched) return marched.error();
  world.set_resource(FogPicture{to_light_picture(*marched, input.view.light_scale)});
  return {};
}

std::vector<ReferenceInfo> fog_references() {
  std::vector<ReferenceInfo> references;
  for (const std::string_view knob : {kFogDivisor.name, kFogRadius.name})
    references.push_back({.knob = std::string(knob),
                          .kind = "traced",
                          .name = "fog along each ray, in double",
                          .draw = &draw_fog_reference});
  // The model's error is the same for both knobs: it is drawn for the first of them only.
  references.front().draw_model = &draw_marched_fog;
  references.front().model_name = "light of lamps marched along each ray";
  return references;
}

}  // namespace gloam
