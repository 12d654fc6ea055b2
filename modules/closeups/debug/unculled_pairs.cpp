// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/debug/unculled_pairs.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "engine/render/declare/draw_pass.h"
#include "engine/scene/resources.h"
#include "modules/lights/outputs.h"
#include "shaders/closeups/shaders.h"

namespace gloam {

UnculledPairs::UnculledPairs(const FrameBuilder& frame) {
  const std::string_view shown = frame.visualizer();
  const std::size_t colon = shown.find(':');
  if (colon == std::string_view::npos ||
      std::ranges::find(kUnculledVisualizers, shown.substr(0, colon)) == std::end(kUnculledVisualizers))
    return;
  if (const auto light = frame.world().resource<SceneNames>().find("light", shown.substr(colon + 1))) light_ = *light;
}

void UnculledPairs::add(FrameBuilder& frame, const CloseupView& pair, const ShadowsOutputs& shadows,
                        const shaders::CloseupConstants& constants) {
  using namespace shaders::closeups;
  if (light_ == kNoEntity || pair.light != light_) return;
  DrawProgram program{pair.directional ? unculled_suns_view_frag : unculled_local_view_frag, shadows.constants};
  program.constants.set("kEarlier", visibility_ ? 1u : 0u);
  DrawPass pass(frame, "closeup_unculled_view", program);
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_shadows(pass, shadows);
  pass.read_if_declared("light_texels", frame.get<LightsOutputs>().texels);
  pass.read("earlier", visibility_);
  pass.uniform("closeup", constants);
  visibility_ = pass.target(create_view_image(frame, "closeup_unculled", gpu::Format::r32_float));
  pass.draw_triangle();
}

void UnculledPairs::finish(FrameBuilder& frame) const {
  if (visibility_) frame.put(UnculledCloseups{visibility_});
}

}  // namespace gloam
