// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/debug/pick.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>

#include "engine/core/text/formatted.h"
#include "engine/scene/resources.h"
#include "modules/particles/emitters/strongest_lights.h"
#include "modules/particles/emitters/visible.h"

namespace gloam {
namespace {

constexpr const char* kParticles = "particles.state";
constexpr const char* kOrder = "particles.order";
constexpr const char* kDraws = "particles.draws";

/// The sprites of one emitter at the pixel.
struct Layers {
  std::uint32_t sprites = 0;
  float near_m = std::numeric_limits<float>::infinity();
  float far_m = 0.0f;
};

/// Depth of a sprite whose disc covers the middle of the pixel; 0 if it does not.
float depth_at(const RenderView& view, const shaders::Particle& p, const PickedPixel& pixel) {
  const vec4 middle = view.clip_from_relative * vec4(p.position, 1.0f);
  const vec3 of_view = mat3(view.view_from_relative) * p.position;
  // Half the sprite in clip space, before the division by w.
  const vec2 half(p.radius_m * view.clip_from_view[0][0], p.radius_m * view.clip_from_view[1][1]);
  const vec2 share((static_cast<float>(pixel.x) + 0.5f) / static_cast<float>(view.width),
                   (static_cast<float>(pixel.y) + 0.5f) / static_cast<float>(view.height));
  const vec2 at = (vec2(2.0f * share.x - 1.0f, 1.0f - 2.0f * share.y) * middle.w - vec2(middle)) / half;
  return glm::dot(at, at) < 1.0f ? -of_view.z : 0.0f;
}

std::string line_of(const World& world, const VisibleEmitter& seen, std::size_t index, const Layers& layers) {
  constexpr const char* kNames[] = {"nothing", "fog", "dust", "smoke", "fire"};
  const PlacedEmitter& emitter = world.resource<EmitterSet>().emitters[seen.emitter];
  const std::string name(world.resource<SceneNames>().name_of(emitter.entity));
  return formatted("particles: %u sprites of %s \"%s\" (%u alive, %u lights), %.2f to %.2f m away", layers.sprites,
                   kNames[static_cast<std::size_t>(emitter.values.kind)],
                   name.empty() ? std::to_string(index).c_str() : name.c_str(), seen.live.count,
                   world.resource<EmitterLights>().emitters[seen.emitter].count, static_cast<double>(layers.near_m),
                   static_cast<double>(layers.far_m));
}

}  // namespace

Status add_particle_pick_copies(FrameBuilder& frame, const ParticlesFrame& particles, Captures& copies) {
  GLOAM_TRY(copies.add(frame.graph(), kParticles, particles.simulated.state));
  GLOAM_TRY(copies.add(frame.graph(), kOrder, particles.sorted.order));
  return copies.add(frame.graph(), kDraws, particles.sorted.draws);
}

std::vector<std::string> particle_pick_lines(const FrameBuilder& frame, const PickedPixel& pixel,
                                             const Captures& copies) {
  const VisibleEmitters& visible = frame.world().view_resource<VisibleEmitters>(frame.view().id);
  std::map<std::uint32_t, Layers> by_row;
  const auto drawn = copies.item<shaders::ParticleDraws>(kDraws, 0).drawn;
  for (std::uint32_t i = 0; i < drawn; ++i) {
    const auto p = copies.item<shaders::Particle>(kParticles, copies.item<std::uint32_t>(kOrder, i));
    const float depth_m = depth_at(frame.view(), p, pixel);
    if (!(depth_m > 0.0f) || (pixel.depth > 0.0f && depth_m > pixel.view_depth_m)) continue;
    Layers& layers = by_row[p.look & 0xFFFFu];
    ++layers.sprites;
    layers.near_m = std::min(layers.near_m, depth_m);
    layers.far_m = std::max(layers.far_m, depth_m);
  }
  std::vector<std::string> lines;
  for (const auto& [row, layers] : by_row) lines.push_back(line_of(frame.world(), visible.emitters[row], row, layers));
  return lines;
}

}  // namespace gloam
