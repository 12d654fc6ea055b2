// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/planar/pass.h"

#include "modules/reflections/surfaces/pass.h"
#include "shaders/reflections/planar/planar_shared.h"
#include "shaders/reflections/shaders.h"

namespace gloam {
namespace {

const CompanionLight::Images* images_of(const FrameBuilder& frame, ViewId companion) {
  const CompanionLight* companions = frame.shared().find<CompanionLight>();
  if (companions == nullptr) return nullptr;
  const auto found = companions->views.find(companion.value);
  return found == companions->views.end() ? nullptr : &found->second;
}

}  // namespace

ComputeProgram planar_program(const ReflectionKnobs& knobs) {
  return {shaders::reflections::mirrored_comp, {{"kPixelRoughness", knobs.pixel_roughness ? 1u : 0u}}};
}

void find_planar_mirror(FrameBuilder& frame, ReflectionFrame& reflections) {
  const auto* mirror = frame.world().try_view_resource<std::optional<PlanarMirror>>(frame.view().id);
  if (mirror != nullptr && *mirror && images_of(frame, (*mirror)->view) != nullptr) reflections.planar = *mirror;
}

void add_planar_pass(FrameBuilder& frame, ReflectionFrame& reflections) {
  const PlanarMirror& mirror = *reflections.planar;
  const CompanionLight::Images& mirrored = *images_of(frame, mirror.view);
  ComputePass pass(frame, "reflection_planar", planar_program(reflections.knobs));
  pass.read("reflection", reflections.block);
  pass.read("mirrored_light", mirrored.light);
  pass.read("mirrored_depth", mirrored.depth);
  pass.push(shaders::PlanarConstants{static_cast<float>(mirror.height_m - frame.view().position.y),
                                     static_cast<float>(mirror.slack_m)});
  const std::uint32_t scale = reflections.constants.scale;
  reflections.color =
      pass.write("color_image", create_view_image(frame, "reflection_color", gpu::Format::rgba16_float, scale));
  reflections.surface = pass.write("surface_image", reflections.surface);
  dispatch_mirror_tiles(pass, reflections);
}

}  // namespace gloam
