// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/references.h"

#include <limits>
#include <string>
#include <string_view>

#include "engine/ecs/view.h"
#include "engine/render/camera/light_scale.h"
#include "engine/render/passes/renderer_passes.h"
#include "modules/fog/components.h"
#include "modules/fog/knobs.h"
#include "modules/fog/model.h"

namespace gloam {
namespace {

/// On the board between post and output: the light before the fog.
struct BareLightOutput {
  ImageRef light;
};

/// Path lengths through the fog, one per pixel; infinite for the sky.
std::vector<double> distances_of(const GeometryPicture& geometry) {
  const RenderView& view = geometry.view;
  std::vector<double> distances(geometry.depth.size(), std::numeric_limits<double>::infinity());
  const dvec3 forward(-view.view_from_relative[0][2], -view.view_from_relative[1][2], -view.view_from_relative[2][2]);
  for (std::uint32_t y = 0; y < view.height; ++y)
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const std::size_t at = std::size_t{y} * view.width + x;
      if (geometry.is_sky(at)) continue;
      const dvec3 position = geometry.position(x, y);
      distances[at] = view.camera.orthographic ? glm::dot(position, forward) : glm::length(position);
    }
  return distances;
}

}  // namespace

void add_bare_light_pass(FrameBuilder& frame) {
  const ImageRef kept = create_view_image(frame, "fog_bare_light", gpu::Format::rgba16_float);
  frame.put(BareLightOutput{add_copy_light_pass(frame, frame.get<LitOutput>().color, kept)});
}

void show_bare_light(FrameBuilder& frame) { frame.get<LitOutput>().color = frame.get<BareLightOutput>().light; }

Result<FramePictures> draw_fog_reference(const ReferenceInput& input) {
  if (!input.redraw || input.geometry == nullptr)
    return Error{ErrorKind::usage,
                 "the reference of fog needs the frame's geometry and a frame that can be drawn again"};
  const auto bare = input.redraw([](World& world) { world.set_resource(BareLight{}); },
                                 [](World& world) { world.remove_resource<BareLight>(); });
  if (!bare) return bare.error();
  const Fog fog = find_fog(input.world);
  const LinearPicture& light = bare->linear;
  const std::vector<double> fogged = fog_reference(light.rgba, distances_of(*input.geometry), light.width, light.height,
                                                   fog, kMostHalf / static_cast<double>(input.view.light_scale));
  const LinearPicture exact{light.width, light.height, {fogged.begin(), fogged.end()}};
  // Drawn again: what later modules make of this light is part of the frame that the knob is judged by.
  return input.redraw(
      [&](World& world) { world.set_resource(FogPicture{to_light_picture(exact, input.view.light_scale)}); },
      [](World& world) { world.remove_resource<FogPicture>(); });
}

std::vector<ReferenceInfo> fog_references() {
  std::vector<ReferenceInfo> references;
  for (const std::string_view knob : {kFogDivisor.name, kFogRadius.name})
    references.push_back({.knob = std::string(knob),
                          .kind = "traced",
                          .name = "fog along each ray, in double",
                          .draw = &draw_fog_reference});
  return references;
}

}  // namespace gloam
