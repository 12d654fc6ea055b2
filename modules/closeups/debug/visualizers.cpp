// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/debug/visualizers.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/render/passes/visualizer_pass.h"
#include "modules/closeups/compose/frame.h"
#include "modules/closeups/debug/lines.h"
#include "modules/shadows/outputs.h"
#include "shaders/closeups/closeup_views_shared.h"
#include "shaders/closeups/shaders.h"

namespace gloam {
namespace {

constexpr const char* kFrusta = "closeup_frusta";
constexpr const char* kTexels = "closeup_texels";

/// Pairs and the lines of their frusta, as the shaders read them.
struct Shown {
  std::vector<shaders::ShownCloseup> closeups;
  std::vector<shaders::CloseupLine> lines;
};

shaders::ShownCloseup shown_closeup(const CloseupView& pair, const RenderView& view) {
  const ShadowFace& face = pair.face;
  shaders::ShownCloseup shown{};
  shown.origin = view.relative(face.origin);
  shown.tan_half = face.tan_half;
  shown.right = face.right;
  shown.half_extent_m = face.half_extent_m;
  shown.up = face.up;
  shown.near_m = face.near_m;
  shown.forward = face.forward;
  shown.far_m = face.far_m;
  shown.color = closeup_color(pair.pair);
  shown.size = static_cast<float>(face.square.size);
  shown.first_tile = pair.tiles.begin;
  shown.end_tile = pair.tiles.end;
  return shown;
}

Shown shown_closeups(std::span<const CloseupView> pairs, const RenderView& view) {
  Shown shown;
  for (const CloseupView& pair : pairs) {
    shaders::ShownCloseup closeup = shown_closeup(pair, view);
    const std::vector<shaders::CloseupLine> lines =
        frustum_lines(pair.face, view, static_cast<double>(GLOAM_CLOSEUP_LINE_REACH));
    closeup.first_line = static_cast<std::uint32_t>(shown.lines.size());
    closeup.line_count = static_cast<std::uint32_t>(lines.size());
    closeup.lines_low = vec2(1e9f);
    closeup.lines_high = vec2(-1e9f);
    for (const shaders::CloseupLine& line : lines) {
      closeup.lines_low = glm::min(closeup.lines_low, glm::min(line.from, line.to) - GLOAM_CLOSEUP_LINE_REACH);
      closeup.lines_high = glm::max(closeup.lines_high, glm::max(line.from, line.to) + GLOAM_CLOSEUP_LINE_REACH);
    }
    shown.lines.insert(shown.lines.end(), lines.begin(), lines.end());
    shown.closeups.push_back(closeup);
  }
  // A buffer needs at least one item.
  if (shown.lines.empty()) shown.lines.emplace_back();
  return shown;
}

void add_view(FrameBuilder& frame, std::span<const CloseupView> pairs, bool texels) {
  using namespace shaders::closeups;
  const Shown shown = shown_closeups(pairs.first(std::min(pairs.size(), kMostShownCloseups)), frame.view());
  const GeometryOutputs& geometry = frame.get<GeometryOutputs>();
  const std::string name = texels ? kTexels : kFrusta;
  DrawPass pass(frame, name + "_view",
                {.fragment = texels ? closeup_texels_view_frag : closeup_frusta_view_frag,
                 .constants = visualizer_constants(frame),
                 .blend = gpu::BlendMode::alpha});
  pass.read("depth_image", geometry.depth);
  pass.items<shaders::ShownCloseup>("closeups", shown.closeups);
  if (texels)
    pass.read("normals", geometry.normals);
  else
    pass.items<shaders::CloseupLine>("lines", shown.lines);
  pass.push(static_cast<std::uint32_t>(shown.closeups.size()));
  add_visualizer_targets(frame, pass, name, texels ? gpu::Format::rgba16_float : gpu::Format::rgba8_unorm);
  pass.draw_triangle();
}

}  // namespace

std::span<const CloseupView> drawn_closeups(const FrameBuilder& frame) {
  const auto* closeups = frame.find<CloseupFrame>();
  if (closeups == nullptr || find_final_lists(frame) == nullptr) return {};
  return closeups->pairs;
}

vec3 closeup_color(Entity pair) {
  // Golden-ratio steps keep the hues of consecutive indices far apart.
  const double hue = 6.0 * std::fmod(0.618033988749895 * pair.index, 1.0);
  const auto channel = [&](double at) {
    const double away = std::abs(std::remainder(hue - at, 6.0));
    return static_cast<float>(0.06 + 0.94 * std::clamp(2.0 - away, 0.0, 1.0));
  };
  return {channel(0.0), channel(2.0), channel(4.0)};
}

std::vector<VisualizerInfo> closeup_visualizers() {
  const std::string most = std::to_string(kMostShownCloseups);
  std::vector<VisualizerInfo> views = {
      {kFrusta, "closeups", "",
       "close-up pairs, each in a different colour: edges of the map's frustum (dim behind surfaces), and the tiles "
       "that the shadow may touch (tinted and framed); only the first " +
           most + " pairs, no skipped ones"},
      {kTexels, "closeups", "",
       "close-up map texels along a pixel's side; where pairs overlap, of the finest map: blue 1/8, cyan 1/2, between "
       "cyan and green 1, green 2, yellow 8, red 32, white more; darkened: outside the frustum or tiles of every pair; "
       "only the first " +
           most + " pairs"}};
  for (VisualizerInfo& view : views) {
    view.knob = kShadowMode.name;
    view.value = text_of(kShadowMode, ShadowMode::deferred);
  }
  return views;
}

void CloseupViewPasses::add_pass(FrameBuilder& frame) {
  const std::string shown(frame.visualizer());
  if (shown != kFrusta && shown != kTexels) return;
  const std::span<const CloseupView> pairs = drawn_closeups(frame);
  if (!pairs.empty()) return add_view(frame, pairs, shown == kTexels);
  if (find_final_lists(frame) != nullptr) return;
  once_log_.warning(frame.log(), "view " + shown + " shows the picture as it is: the frame has no final lists");
}

}  // namespace gloam
