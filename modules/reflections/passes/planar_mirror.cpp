// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/planar_mirror.h"

#include "modules/reflections/passes/mirror_surfaces.h"
#include "shaders/reflections/passes/planar_shared.h"
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
  return {shaders::reflections::planar_mirror_comp, {{"kPixelRoughness", knobs.pixel_roughness ? 1u : 0u}}};
}

std::optional<PlanarMirror> drawn_planar_mirror(const FrameBuilder& frame) {
  const auto* mirror = frame.world().try_view_resource<std::optional<PlanarMirror>>(frame.view().id);
  const bool drawn = mirror != nullptr && *mirror && images_of(frame, (*mirror)->view) != nullptr;
  return drawn ? *mirror : std::nullopt;
}

MirroredLight add_planar_pass(FrameBuilder& frame, const ReflectionKnobs& knobs, const ReflectionUniforms& uniforms,
                              const MirrorSurfaces& surfaces, const PlanarMirror& mirror) {
  const CompanionLight::Images& mirrored = *images_of(frame, mirror.view);
  ComputePass pass(frame, "reflection_planar", planar_program(knobs));
  pass.read("reflection", uniforms.block);
  pass.read("mirrored_light", mirrored.light);
  pass.read("mirrored_depth", mirrored.depth);
  pass.push(shaders::PlanarConstants{static_cast<float>(mirror.height_m - frame.view().position.y),
                                     static_cast<float>(mirror.slack_m)});
  const std::uint32_t scale = uniforms.constants.scale;
  MirroredLight light;
  light.color =
      pass.write("color_image", create_view_image(frame, "reflection_color", gpu::Format::rgba16_float, scale));
  light.surface = pass.write("surface_image", surfaces.surface);
  dispatch_mirror_tiles(pass, surfaces.tiles);
  return light;
}

}  // namespace gloam
