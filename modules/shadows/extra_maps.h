// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/result.h"
#include "engine/ecs/entity.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/shadow_knobs.h"
#include "modules/shadows/shadow_views.h"

namespace gloam {

class ShadowStates;

/// A map of its own: one face, and some casters that it shows.
struct ExtraMap {
  ShadowFace face;                  ///< its square is its place in an ExtraAtlas
  std::span<const Entity> casters;  ///< Caster::entity, ascending by Entity::index
};

/// Images laid out as the atlas and its pyramid are (shaders/shadows/shadows_shared.h), of another side.
struct ExtraAtlas {
  ImageRef atlas;
  ImageRef pyramid;
  std::uint32_t size = 0;  ///< texels, a power of two
};

/// What shaders read of an orthographic face, for positions relative to view_position.
[[nodiscard]] shaders::ShadowCascade orthographic_constants(const ShadowFace& face, const dvec3& view_position);

/// Threads of a workgroup that asks the pixels of a shadow tile (shaders/shadows/pair_pixels_api.glsl, constant 0).
[[nodiscard]] std::uint32_t threads_a_tile(const gpu::DeviceInfo& device);

/// How later modules draw shadow maps of their own, alike to those of the atlas. On the board in frames that have final lists.
class ShadowMapDrawer {
 public:
  /// `block`: of the frame's standard maps.
  ShadowMapDrawer(ShadowStates& states, const ShadowKnobs& knobs, const shaders::ShadowBlock& block)
      : states_(&states), knobs_(knobs), block_(block) {}

  /// Transient images of a side, whose memory counts as the module's.
  [[nodiscard]] ExtraAtlas create(FrameGraph& graph, const char* module, std::uint32_t size) const;
  /// Draws maps, all of one size, and makes their mips and pyramids: passes shadow_map_`name` and shadow_map_`name`_mips.
  [[nodiscard]] Status draw(FrameBuilder& frame, const char* name, const char* module, std::span<const ExtraMap> maps,
                            ExtraAtlas& into) const;
  /// Constants for looking at maps of such an atlas with shaders/shadows/shadows_api.glsl.
  [[nodiscard]] Result<gpu::Binding::BufferRange> block(FrameBuilder& frame, std::uint32_t size) const;

 private:
  ShadowStates* states_;
  ShadowKnobs knobs_;
  shaders::ShadowBlock block_;
};

}  // namespace gloam
