// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/fog_passes.h"

#include "engine/render/declare/draw_pass.h"
#include "modules/fog/knobs.h"
#include "modules/fog/model.h"
#include "modules/lighting/outputs.h"
#include "shaders/fog/fog_shared.h"
#include "shaders/fog/shaders.h"

namespace gloam {
namespace {

constexpr gpu::Format kGlowFormat = gpu::Format::rgba16_float;

std::uint32_t glow_divisor(const KnobRegistry& knobs) { return knobs.value(kFogDivisor); }

DrawProgram reduce_program(bool orthographic, std::uint32_t divisor) {
  return {shaders::fog::reduce_frag,
          {{"kOrthographic", orthographic ? 1u : 0u}, {"kDivisor", static_cast<std::int32_t>(divisor)}}};
}
DrawProgram blur_program() { return {shaders::fog::blur_frag}; }
DrawProgram apply_program(bool orthographic, std::uint32_t divisor) {
  return {shaders::fog::apply_frag,
          {{"kOrthographic", orthographic ? 1u : 0u}, {"kDivisor", static_cast<std::int32_t>(divisor)}},
          gpu::BlendMode::premultiplied};
}

/// The light of LitOutput that fog scatters, blurred at 1/divisor of its size.
ImageRef add_glow_passes(FrameBuilder& frame, const shaders::FogConstants& fog, std::uint32_t divisor, float radius) {
  DrawPass reduce(frame, "fog_reduce", reduce_program(frame.view().camera.orthographic, divisor));
  reduce.uniform("fog", fog);
  reduce.read("depth_image", front_depth(frame));
  reduce.read("lit_image", frame.get<LitOutput>().color);
  const ImageRef source = reduce.target(create_view_image(frame, "fog_reduced", kGlowFormat, divisor));
  reduce.draw_triangle();
  const GlowKernel kernel = glow_kernel(frame.view().height, divisor, radius);
  const auto blurred = [&](const char* name, glm::ivec2 direction, ImageRef from) {
    DrawPass blur(frame, name, blur_program());
    blur.read("image", from);
    blur.push(shaders::FogBlurConstants{direction, kernel.taps, 1.0f / kernel.sigma});
    const ImageRef target = blur.target(create_view_image(frame, name, kGlowFormat, divisor));
    blur.draw_triangle();
    return target;
  };
  return blurred("fog_blur_y", {0, 1}, blurred("fog_blur_x", {1, 0}, source));
}

}  // namespace

void list_fog_pipelines(const KnobRegistry& knobs, PipelineList& list) {
  const gpu::Format formats[] = {kGlowFormat};
  const auto add = [&](const DrawProgram& program) { list.push_back(pipeline_desc(program, "fog", formats)); };
  const std::uint32_t divisor = glow_divisor(knobs);
  add(blur_program());
  for (const bool orthographic : {false, true}) {
    add(reduce_program(orthographic, divisor));
    add(apply_program(orthographic, divisor));
  }
}

void add_fog_passes(FrameBuilder& frame, const Fog& fog) {
  const std::uint32_t divisor = glow_divisor(frame.knobs());
  const shaders::FogConstants constants{vec4(fog.color * frame.view().light_scale, 0.0f), fog.density, kFogForwardShare,
                                        fog.sky_distance_m};
  const ImageRef glow = add_glow_passes(frame, constants, divisor, static_cast<float>(frame.knobs().value(kFogRadius)));
  LitOutput& lit = frame.get<LitOutput>();
  DrawPass pass(frame, "fog_apply", apply_program(frame.view().camera.orthographic, divisor));
  pass.uniform("fog", constants);
  pass.read("depth_image", front_depth(frame));
  pass.read("glow_image", glow, Sampling::linear);
  lit.color = pass.target(lit.color, gpu::LoadOp::load);  // the fog is blended over the light
  pass.draw_triangle();
}

}  // namespace gloam
