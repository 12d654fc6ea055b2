// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/antialiasing/smooth_edges_passes.h"

#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "engine/render/views/seen_surfaces.h"
#include "modules/lighting/outputs.h"
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

/// Words of the edges of a picture (edge_bits.glsl), two planes each.
std::uint64_t edge_words(uvec2 size) {
  const auto words = [](std::uint64_t length) { return (length + 31) / 32 + 2; };
  return 2 * ((size.y + 1) * words(size.x) + (size.x + 1) * words(size.y));
}

BufferRef make_buffer(FrameBuilder& frame, const char* name, std::uint64_t bytes) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = frame.module();
  desc.size = bytes;
  return frame.graph().create_buffer(desc);
}
BufferRef make_words(FrameBuilder& frame, const char* name, std::uint64_t count) {
  return make_buffer(frame, name, count * sizeof(std::uint32_t));
}

}  // namespace

bool antialiases(const FrameBuilder& frame) {
  const bool picture = frame.visualizer() == "none" || frame.find<VisualizerIsPicture>() != nullptr;
  return frame.knobs().value(kAntialiasing) != Antialiasing::off && picture &&
         sees_surfaces(frame.world(), frame.view()) && frame.view().purpose != ViewPurpose::reference;
}

AntialiasingWeights add_antialiasing_weights(FrameBuilder& frame, ImageRef shown) {
  const uvec2 size(frame.view().width, frame.view().height);
  const shaders::AntialiasingConstants constants{size, 0};
  ComputePass edges(frame, "antialiasing_edges", shaders::lighting::edges_comp);
  edges.read("shown_image", shown);
  const BufferRef words = edges.write("edge_words", make_words(frame, "antialiasing_edges", edge_words(size)));
  BufferRef command = make_buffer(frame, "antialiasing_command", sizeof(uvec4));
  command = edges.write("blend_command", command);
  edges.push(constants);
  edges.dispatch(size.x / 32 + 1, size.y / 32 + 1);  // a line more than the picture has rows and columns

  AntialiasingWeights result;
  const std::uint64_t mask_words = std::uint64_t{(size.x + 31) / 32} * size.y;
  ComputePass weights(frame, "antialiasing_weights", shaders::lighting::weights_comp);
  weights.read("edge_words", words);
  result.weights = weights.write("weights", make_words(frame, "antialiasing_weights", std::uint64_t{size.x} * size.y));
  result.masks = weights.write("masks", make_words(frame, "antialiasing_masks", mask_words));
  const std::uint64_t rectangles = std::uint64_t{(size.x + GLOAM_BLEND_COLUMNS - 1) / GLOAM_BLEND_COLUMNS} *
                                   ((size.y + GLOAM_BLEND_ROWS - 1) / GLOAM_BLEND_ROWS);
  result.command = weights.write("blend_command", command);
  result.rectangles =
      weights.write("rectangles", make_buffer(frame, "antialiasing_rectangles", rectangles * sizeof(uvec2)));
  weights.push(constants);
  weights.dispatch((size.x + 31) / 32, (size.y + 15) / 16);
  return result;
}

void add_antialiasing_passes(FrameBuilder& frame, ImageRef shown, bool dither) {
  const AntialiasingWeights weights = add_antialiasing_weights(frame, shown);
  TargetOutput& target = frame.get<TargetOutput>();
  DrawProgram program{shaders::lighting::blend_frag, {{"kDither", dither ? 1u : 0u}}};
  program.vertex = shaders::lighting::blend_vert;
  DrawPass blend(frame, "antialiasing_blend", program);
  blend.read("shown_image", shown);
  blend.read("weights", weights.weights);
  blend.read("masks", weights.masks);
  blend.read("rectangles", weights.rectangles);
  blend.push(shaders::AntialiasingConstants{{frame.view().width, frame.view().height},
                                            gpu::encodes_srgb(target.format) ? 0u : 1u});
  target.color = blend.target(target.color, gpu::LoadOp::load);
  blend.draw_indirect(weights.command, 0);
}

}  // namespace gloam
