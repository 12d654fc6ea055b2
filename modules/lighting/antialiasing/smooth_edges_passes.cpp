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

struct EdgeLines {
  shaders::EdgeConstants rows{};
  shaders::EdgeConstants columns{};
  std::uint32_t words = 0;  ///< of both
};

/// The places of the edges of a picture, as in edge_bits.glsl.
EdgeLines edge_lines(uvec2 size) {
  const auto words = [](std::uint32_t length) { return (length + 31) / 32 + 2; };
  EdgeLines lines;
  lines.rows = {{1, 0}, {0, 1}, size.x, size.y + 1, words(size.x), 0};
  lines.columns = {{0, 1}, {1, 0}, size.y, size.x + 1, words(size.y), lines.rows.lines * lines.rows.words};
  lines.words = lines.columns.first + lines.columns.lines * lines.columns.words;
  return lines;
}

BufferRef make_words(FrameBuilder& frame, const char* name, std::uint64_t count) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = frame.module();
  desc.size = count * sizeof(std::uint32_t);
  return frame.graph().create_buffer(desc);
}

ComputeProgram edges_program(bool rows) { return {shaders::lighting::edges_comp, {{"kRows", rows ? 1u : 0u}}}; }

}  // namespace

bool antialiases(const FrameBuilder& frame) {
  const bool picture = frame.visualizer() == "none" || frame.find<VisualizerIsPicture>() != nullptr;
  return frame.knobs().value(kAntialiasing) != Antialiasing::off && picture &&
         sees_surfaces(frame.world(), frame.view()) && frame.view().purpose != ViewPurpose::reference;
}

AntialiasingWeights add_antialiasing_weights(FrameBuilder& frame, ImageRef shown) {
  const uvec2 size(frame.view().width, frame.view().height);
  const EdgeLines lines = edge_lines(size);
  const std::uint64_t mask_words = std::uint64_t{(size.x + 31) / 32} * size.y;
  ComputePass edges(frame, "antialiasing_edges", edges_program(true));
  edges.read("shown_image", shown);
  const BufferRef words =
      edges.write("edge_words", make_words(frame, "antialiasing_edges", std::uint64_t{2} * lines.words));
  const BufferRef candidates = edges.write("candidates", make_words(frame, "antialiasing_candidates", mask_words));
  for (const bool rows : {true, false}) {
    const shaders::EdgeConstants& constants = rows ? lines.rows : lines.columns;
    edges.use(edges_program(rows));
    edges.push(constants);
    edges.dispatch_over(constants.lines, constants.words);
  }

  AntialiasingWeights result;
  ComputePass weights(frame, "antialiasing_weights", shaders::lighting::weights_comp);
  weights.read("edge_words", words);
  weights.read("candidates", candidates);
  result.weights = weights.write("weights", make_words(frame, "antialiasing_weights", std::uint64_t{size.x} * size.y));
  result.masks = weights.write("masks", make_words(frame, "antialiasing_masks", mask_words));
  weights.push(shaders::AntialiasingConstants{size, 0});
  weights.dispatch_over(size.y, (size.x + 31) / 32);
  return result;
}

void add_antialiasing_passes(FrameBuilder& frame, ImageRef shown, bool dither) {
  const AntialiasingWeights weights = add_antialiasing_weights(frame, shown);
  TargetOutput& target = frame.get<TargetOutput>();
  DrawPass blend(frame, "antialiasing_blend", {shaders::lighting::blend_frag, {{"kDither", dither ? 1u : 0u}}});
  blend.read("shown_image", shown);
  blend.read("weights", weights.weights);
  blend.read("masks", weights.masks);
  blend.push(shaders::AntialiasingConstants{{frame.view().width, frame.view().height},
                                            gpu::encodes_srgb(target.format) ? 0u : 1u});
  target.color = blend.target(target.color);
  blend.draw_triangle();
}

}  // namespace gloam
