// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/reference/glare_run.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/math/packing.h"
#include "engine/render/kernel_check/pass_run.h"
#include "modules/glare/glare_passes.h"
#include "modules/lighting/outputs.h"

namespace gloam {

void GlareInput::add_lamp(glm::dvec2 at_px, double brightness) {
  const glm::dvec2 corner = at_px - 0.5;
  const glm::ivec2 first(glm::floor(corner));
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const glm::dvec2 covered = 1.0 - glm::abs(glm::dvec2(first + glm::ivec2(dx, dy)) - corner);
      const std::uint32_t x = static_cast<std::uint32_t>(first.x + dx), y = static_cast<std::uint32_t>(first.y + dy);
      if (covered.x <= 0.0 || covered.y <= 0.0 || x >= size.x || y >= size.y) continue;
      at(x, y) += vec4(vec3(static_cast<float>(brightness * covered.x * covered.y)), 0.0f);
    }
}

Result<std::vector<vec4>> run_glare(const KernelLab& lab, const GlareInput& in) {
  using Texel = std::array<std::uint16_t, 4>;
  std::vector<Texel> texels;
  for (const vec4& v : in.light)
    texels.push_back({float_to_half(v.x), float_to_half(v.y), float_to_half(v.z), float_to_half(v.w)});
  RenderView view;
  view.width = in.size.x;
  view.height = in.size.y;
  PassRun frames(lab, view);
  const gpu::ImageHandle image = frames.make_image(gpu::Format::rgba16_float, in.size.x, in.size.y, texels);
  GLOAM_TRY(frames.draw([&](FrameBuilder& frame) {
    frame.set_module("glare");
    frame.put(LitOutput{frames.input("lit", image)});
    add_glare_passes(frame, in.share, in.lines);
    add_shown_light_pass(frame);
    frames.keep("light", frame.get<LitOutput>().color);
  }));
  std::vector<vec4> shown;
  for (const Texel& t : frames.read<Texel>("light"))
    shown.emplace_back(half_to_float(t[0]), half_to_float(t[1]), half_to_float(t[2]), half_to_float(t[3]));
  return shown;
}

}  // namespace gloam
