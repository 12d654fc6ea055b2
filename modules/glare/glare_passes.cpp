// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/glare_passes.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/render/declare/compute_pass.h"
#include "modules/glare/levels.h"
#include "modules/lighting/outputs.h"
#include "shaders/glare/glare_shared.h"
#include "shaders/glare/shaders.h"

namespace gloam {
namespace {

constexpr gpu::Format kGlareFormat = gpu::Format::rgba16_float;

constexpr std::int32_t kMostUnrolled = 4;  // pixels: loops of a known length are faster

ComputeProgram collect_program(std::int32_t most_pixels) {
  return {shaders::glare::collect_comp, {{"kMostPixels", most_pixels <= kMostUnrolled ? most_pixels : 0}}};
}
ComputeProgram spread_program(bool own, bool coarser) {
  return {shaders::glare::spread_comp, {{"kOwn", own ? 1u : 0u}, {"kCoarser", coarser ? 1u : 0u}}};
}

ImageRef make_glare_image(FrameBuilder& frame, std::string name, uvec2 size) {
  gpu::ImageDesc desc;
  desc.name = std::move(name);
  desc.module = frame.module();
  desc.format = kGlareFormat;
  desc.width = size.x;
  desc.height = size.y;
  return frame.graph().create_image(std::move(desc));
}

vec2 inverse_of(uvec2 size) { return 1.0f / vec2(size); }

/// The finest level.
ImageRef add_collect_passes(FrameBuilder& frame, const GlareLevels& levels) {
  const uvec2 corners = levels.cells + 1u;
  ImageRef parts = make_glare_image(frame, "glare_parts", 2u * corners);
  {
    const auto most_pixels = static_cast<std::int32_t>(std::ceil(levels.cell_px));
    ComputePass pass(frame, "glare_collect", collect_program(most_pixels));
    pass.read("lit_image", frame.get<LitOutput>().color);
    parts = pass.write("parts_image", parts);
    pass.push(shaders::GlareCollect{ivec2(frame.view().width, frame.view().height), ivec2(corners),
                                    vec2(levels.origin_px), static_cast<float>(levels.cell_px), most_pixels});
    pass.dispatch_over(corners);
  }
  const uvec2 size = levels.levels.front().size;
  ComputePass pass(frame, "glare_join", {shaders::glare::join_comp});
  pass.read("parts_image", parts);
  const ImageRef finest = pass.write("level_image", make_glare_image(frame, "glare_level0", size));
  pass.push(shaders::GlareLevel{ivec2(size), inverse_of(2u * corners), 1.0f});
  pass.dispatch_over(size);
  return finest;
}

/// The light of the picture in each level, from the finest.
std::vector<ImageRef> add_reduce_passes(FrameBuilder& frame, const GlareLevels& levels) {
  std::vector<ImageRef> images = {add_collect_passes(frame, levels)};
  for (std::size_t i = 1; i < levels.levels.size(); ++i) {
    const std::string number = std::to_string(i);
    const uvec2 size = levels.levels[i].size;
    ComputePass pass(frame, "glare_reduce" + number, {shaders::glare::reduce_comp});
    pass.read("finer_image", images.back(), Sampling::linear);
    images.push_back(pass.write("level_image", make_glare_image(frame, "glare_level" + number, size)));
    pass.push(shaders::GlareLevel{ivec2(size), inverse_of(levels.levels[i - 1].size), 1.0f});
    pass.dispatch_over(size);
  }
  return images;
}

/// The spread light, in texels of the finest level.
ImageRef add_spread_passes(FrameBuilder& frame, const GlareLevels& levels, const std::vector<ImageRef>& images) {
  ImageRef spread;
  for (std::size_t i = levels.levels.size(); i-- > 0;) {
    const std::string number = std::to_string(i);
    const GlareLevel& level = levels.levels[i];
    const bool is_last = i + 1 == levels.levels.size(), own = level.weight > 0.0f;
    ComputePass pass(frame, "glare_spread" + number, spread_program(own, !is_last));
    pass.read("level_image", own ? images[i] : ImageRef{}, Sampling::linear);
    pass.read("coarser_image", spread, Sampling::linear);
    const uvec2 coarser = is_last ? uvec2(1) : levels.levels[i + 1].size;
    spread = pass.write("spread_image", make_glare_image(frame, "glare_spread" + number, level.size));
    pass.push(shaders::GlareLevel{ivec2(level.size), inverse_of(coarser), level.weight});
    pass.dispatch_over(level.size);
  }
  return spread;
}

}  // namespace

void add_glare_passes(FrameBuilder& frame, float share, std::uint32_t lines) {
  const GlareLevels levels = glare_levels({frame.view().width, frame.view().height}, lines);
  const std::vector<ImageRef> images = add_reduce_passes(frame, levels);
  ScatteredLight scattered;
  scattered.light = add_spread_passes(frame, levels, images);
  const glm::dvec2 size(levels.levels.front().size);
  scattered.uv_scale = vec2(1.0 / (levels.cell_px * size));
  scattered.uv_offset = vec2((double{GLOAM_GLARE_MARGIN} - levels.origin_px / levels.cell_px) / size);
  scattered.share = share;
  frame.put(scattered);
}

void add_shown_light_pass(FrameBuilder& frame) {
  const ScatteredLight& scattered = frame.get<ScatteredLight>();
  LitOutput& lit = frame.get<LitOutput>();
  const uvec2 size(frame.view().width, frame.view().height);
  ComputePass pass(frame, "glare_show", {shaders::glare::show_comp});
  pass.read("lit_image", lit.color);
  pass.read("scattered_image", scattered.light, Sampling::linear);
  lit.color = pass.write("shown_image", create_view_image(frame, "glare_shown", kGlareFormat));
  pass.push(shaders::GlareShow{scattered.uv_scale, scattered.uv_offset, size, scattered.share});
  pass.dispatch_over(size);
}

void list_glare_pipelines(PipelineList& list) {
  const auto add = [&](const ComputeProgram& program) { list.push_back(pipeline_desc(program, "glare")); };
  for (std::int32_t pixels = 1; pixels <= kMostUnrolled + 1; ++pixels) add(collect_program(pixels));
  add({shaders::glare::join_comp});
  add({shaders::glare::reduce_comp});
  add(spread_program(true, false));
  add(spread_program(true, true));
  add(spread_program(false, true));
}

}  // namespace gloam
