// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/entity.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/math/types.h"
#include "engine/render/frame_builder.h"
#include "engine/render/reference/reference.h"
#include "modules/lights/components.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

/// A square of the atlas; its corner is a multiple of its side.
struct AtlasSquare {
  uvec2 origin = uvec2(0);
  std::uint32_t size = 0;  ///< texels, a power of two; 0: has no place
  bool operator==(const AtlasSquare&) const = default;
};

/// One square of depth: what a light sees along one axis.
struct ShadowFace {
  Entity light;
  LightKind kind =
      LightKind::spot;        ///< directional: orthographic; point: one of a cube's, also of a spot that needs a cube
  std::uint32_t index = 0;    ///< cube face or cascade
  dvec3 origin = dvec3(0.0);  ///< world: the light; orthographic: centre of the near side of the box
  vec3 right = vec3(1.0f, 0.0f, 0.0f);
  vec3 up = vec3(0.0f, 1.0f, 0.0f);
  vec3 forward = vec3(0.0f, 0.0f, -1.0f);
  float tan_half = 1.0f;       ///< perspective, rim included; 0: orthographic
  float half_extent_m = 0.0f;  ///< orthographic, rim included
  float near_m = 0.05f;        ///< orthographic: 0
  float far_m = 0.0f;          ///< what is farther cannot be lit: range of the light, or depth of the box
  AtlasSquare square;          ///< where it lies in the atlas
  float importance = 0.0f;     ///< the least important ones halve first when the atlas is full
};

/// Texels of a face, rows from its upper edge: from `begin` to before `end`.
struct TexelRect {
  uvec2 begin = uvec2(0);
  uvec2 end = uvec2(0);
  [[nodiscard]] bool empty() const { return begin.x >= end.x || begin.y >= end.y; }
  [[nodiscard]] std::uint64_t texels() const {
    return empty() ? 0 : std::uint64_t{end.x - begin.x} * (end.y - begin.y);
  }
  [[nodiscard]] bool contains(const TexelRect& other) const {
    return begin.x <= other.begin.x && begin.y <= other.begin.y && end.x >= other.end.x && end.y >= other.end.y;
  }
  bool operator==(const TexelRect&) const = default;
};

/// Texels that something in the world box may be drawn into, with room for what rounding does.
[[nodiscard]] TexelRect covered_texels(const ShadowFace& face, const dvec3& low, const dvec3& high);

/// False only if nothing in the box can block light in this face: what is nearer than a perspective face's near plane
/// or out of the light's range cannot. An orthographic face has no near side: whatever lies towards the light from it
/// may block. Boxes with min above max or with NaN may be anywhere.
[[nodiscard]] bool face_may_see(const ShadowFace& face, const dvec3& min, const dvec3& max);

/// What lights each shadow tile of a view and how much of each light its pixels see
/// (shaders/shadows/final_lists_shared.h), for shaders that include shaders/shadows/final_lists_api.glsl. Opaque
/// surfaces only.
struct FinalLists {
  ImageRef tiles;                   ///< rgba32ui, one texel a shadow tile
  BufferRef entries;                ///< a word an entry
  BufferRef visibilities[2];        ///< words of slots; the second is the first when one is enough
  BufferRef commands;               ///< ShadowListCommands
  std::uint64_t fallback_draw = 0;  ///< where in `commands` the arguments of the draw of fallback_tiles lie, bytes
  BufferRef counters;               ///< ShadowListCounters
  BufferRef fallback_tiles;  ///< y << 16 | x of tiles without a list, as many as ShadowListCommands::fallback_draw says
  gpu::Binding::BufferRange grid;  ///< a FinalGrid, uniform
  bool always_complete = false;    ///< there is room for every light of every tile: no tile is without a list
  std::uint32_t visibility_bits = 8;
  std::uint32_t slot_capacity = 0;  ///< slots the visibilities hold
  std::uint32_t pair_capacity = 0;
  /// GLOAM_FINAL_…_ID; `variant` names them.
  std::vector<gpu::SpecConstant> constants;
  std::string variant;
};

/// What the shadows module leaves for a view, for shaders that include shaders/shadows/shadows_api.glsl. On the board
/// only when shadows are to be looked at.
struct ShadowsOutputs {
  gpu::Binding::BufferRange block;      ///< a ShadowBlock (shaders/shadows/shadows_shared.h), uniform
  shaders::ShadowBlock block_values{};  ///< what it holds
  ImageRef rows;                        ///< rgba32f, GLOAM_SHADOW_ROW_TEXELS × local lights: ShadowRow
  std::shared_ptr<const std::vector<shaders::ShadowRow>>
      row_values;    ///< what it holds; directional lights' are CascadeRow
  ImageRef atlas;    ///< r32f or r16_unorm: depth of all faces and their mips
  ImageRef pyramid;  ///< r32f: nearest and farthest depth
  ImageRef cookies;  ///< rgba8_srgb, an array: cookies of spot lights; one white layer when there is none
  ImageRef traced;   ///< r8_unorm, an array: visibility a light and pixel that a reference has traced; the cookies'
                     ///< image when there is none
  gpu::SamplerHandle nearest;
  gpu::SamplerHandle linear;

  /// No light asks for a map or traced visibility: shaders may take cookies_api.glsl in place of shadows_api.glsl, many
  /// times smaller.
  bool cookies_only = false;
  /// The filter is what GLOAM_SHADOWS_STANDARD compiles, half as large.
  bool standard = false;
  /// GLOAM_SHADOWS_…_ID, the same for every shader of the frame. `variant` names them, for names of pipelines.
  std::vector<gpu::SpecConstant> constants;
  std::string variant;

  std::uint32_t cookie_lights = 0;  ///< lights of the scene with a cookie

  /// With shadows.mode = deferred, when there are maps.
  std::optional<FinalLists> final_lists;
};

/// For shaders that look at maps with contact-hardening shadows: the same penumbrae by single fetches from mip 0
/// (shadows.filter=pcss). What other filter they have stays.
[[nodiscard]] ShadowsOutputs by_single_fetches(ShadowsOutputs shadows);

void declare_shadow_reads(PassBuilder& pass, const ShadowsOutputs& shadows, gpu::Access access);
/// Bindings that shadows_api.glsl takes, from number `first` on: block, rows, atlas, pyramid, cookies, traced.
void append_shadow_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                            const ShadowsOutputs& shadows);

/// The same for shaders that include cookies_api.glsl when shadows.cookies_only, else shadows_api.glsl. The former
/// takes block, rows, cookies.
void declare_arriving_reads(PassBuilder& pass, const ShadowsOutputs& shadows, gpu::Access access);
void append_arriving_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                              const ShadowsOutputs& shadows);

/// Block, rows and cookies: what cookies_api.glsl takes.
void append_cookie_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                            const ShadowsOutputs& shadows);

/// Bindings that final_lists_api.glsl takes, from number `first` on: tiles, entries, both visibilities.
void declare_final_list_reads(PassBuilder& pass, const FinalLists& lists, gpu::Access access);
void append_final_list_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                                const FinalLists& lists, gpu::SamplerHandle nearest);

/// Casters that the maps of a light leave out, because a later module sees to what they keep of it. Put on the board in
/// PassPhase::announce; looked at only in frames that have final lists.
struct WithheldCasters {
  struct OfLight {
    Entity light;
    std::vector<Entity> casters;  ///< Caster::entity, ascending by Entity::index
  };
  std::vector<OfLight> lights;  ///< ascending by Entity::index
  [[nodiscard]] std::span<const Entity> of(Entity light) const;
};

/// One texel of FinalLists::tiles.
struct FinalList {
  bool complete = true;  ///< false: a buffer was full, the tile is shaded from shadow maps
  std::uint32_t directional_first = 0;
  std::uint32_t directional_count = 0;
  std::uint32_t local_first = 0;
  std::uint32_t local_count = 0;
};
[[nodiscard]] FinalList decode_final_list(uvec4 texel);

/// One word of FinalLists::entries.
struct FinalEntry {
  std::uint32_t light = 0;  ///< index among the view's directional or local lights
  std::uint32_t slot = 0;   ///< of visibilities, or GLOAM_ALL_LIT
};
[[nodiscard]] FinalEntry decode_final_entry(std::uint32_t word);

/// 0 … 1, of a pixel (0 … 63, row by row) of the tile that the entry is in. `words`: of all slots, one buffer after the
/// other. 0 where the slot lies beyond them.
[[nodiscard]] float decode_visibility(FinalEntry entry, std::uint32_t pixel, std::span<const std::uint32_t> words,
                                      std::uint32_t visibility_bits);

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

struct ShadowMapTools;  ///< what maps are drawn with

/// How later modules draw shadow maps of their own, alike to those of the atlas. On the board in frames that have final
/// lists.
class ShadowMapDrawer {
 public:
  explicit ShadowMapDrawer(std::shared_ptr<const ShadowMapTools> tools) : tools_(std::move(tools)) {}

  /// Transient images of a side, whose memory counts as the module's.
  [[nodiscard]] ExtraAtlas create(FrameGraph& graph, const char* module, std::uint32_t size) const;
  /// Maps of this side that `draw` takes at a time.
  [[nodiscard]] static std::size_t most_maps(std::uint32_t size);
  /// Draws maps, all of one size, and makes their mips and pyramids: passes shadow_map_`name` and
  /// shadow_map_`name`_mips.
  [[nodiscard]] Status draw(FrameBuilder& frame, const char* name, const char* module, std::span<const ExtraMap> maps,
                            ExtraAtlas& into) const;
  /// Constants for looking at maps of such an atlas with shaders/shadows/shadows_api.glsl.
  [[nodiscard]] Result<gpu::Binding::BufferRange> block(FrameBuilder& frame, std::uint32_t size) const;

 private:
  std::shared_ptr<const ShadowMapTools> tools_;
};

// How later modules let those who look at standard maps in this frame see more in them. The maps themselves are kept
// from frame to frame and stay as they are: what is to be seen goes into copies of faces, in squares of the atlas that
// are free, and rows that point to the copies take the place of ShadowsOutputs::rows. Nothing of it outlives the frame.

/// A standard face, and where its copy has room in the same atlas.
struct OverlayFace {
  ShadowFace face;
  AtlasSquare copy;
  /// The face where the copy lies.
  [[nodiscard]] ShadowFace at_copy() const {
    ShadowFace moved = face;
    moved.square = copy;
    return moved;
  }
};

struct ShadowViews;
class FreeSquares;

/// Faces that get copies in a frame; for the time when passes are announced or declared.
class OverlayPlan {
 public:
  OverlayPlan() = default;
  OverlayPlan(const World& world, ViewId view);
  /// Adds the faces of a light that may see something in the world box. False: some find no room, and none is added.
  [[nodiscard]] bool add(Entity light, const dvec3& low, const dvec3& high);
  [[nodiscard]] std::span<const OverlayFace> faces() const { return faces_; }

 private:
  const ShadowViews* views_ = nullptr;
  std::shared_ptr<const FreeSquares> free_;
  std::vector<OverlayFace> faces_;
};

/// Copies of faces while they are added to: compute shaders write to mip 0 of their squares in ShadowsOutputs::atlas,
/// reversed depth. Whoever does so leaves the version written on the board.
struct OverlayCopies {
  std::vector<OverlayFace> faces;
  bool d16 = false;  ///< the atlas is r16_unorm; else r32f
  std::uint32_t depth_bits =
      ~0u;  ///< mask of a depth's bits, as a float, that mip 0 holds: coarser mips use the others
  [[nodiscard]] bool empty() const { return faces.empty(); }
};

/// On the board in frames that have final lists.
class OverlayMaps {
 public:
  explicit OverlayMaps(std::shared_ptr<const ShadowMapTools> tools) : tools_(std::move(tools)) {}
  /// The atlas is r16_unorm.
  [[nodiscard]] bool d16() const;
  /// Copies mip 0 of the faces, at least one, within the atlas (pass shadow_overlay_copy). It takes no memory.
  [[nodiscard]] Result<OverlayCopies> start(FrameBuilder& frame, std::span<const OverlayFace> faces) const;
  /// Makes the copies' mips and pyramids (pass shadow_overlay_mips), and lets ShadowsOutputs on the board point to them
  /// (pass shadow_overlay_rows).
  [[nodiscard]] Status finish(FrameBuilder& frame, const OverlayCopies& copies) const;

 private:
  std::shared_ptr<const ShadowMapTools> tools_;
};

/// Pipelines that only overlays take; d16: of OverlayMaps.
void list_overlay_map_pipelines(bool d16, PipelineList& list);

/// What a knob of shadows is held against: the frame shaded with traced visibility.
[[nodiscard]] ReferenceInfo traced_shadows(std::string knob);

}  // namespace gloam
