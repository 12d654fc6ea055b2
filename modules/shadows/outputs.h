// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The interface of the shadows module to other modules: ShadowsOutputs for shaders that evaluate shadows, FinalLists
// for shaders that read deferred visibilities, ShadowMapDrawer for shadow maps outside the atlas, and OverlayMaps for
// changes to standard maps that last one frame. "Put on the board" means FrameBuilder::put. Readers call
// FrameBuilder::find, which returns null if the output is absent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/entity.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/math/types.h"
#include "engine/render/declare/shader_pass.h"
#include "engine/render/frame_builder.h"
#include "engine/render/knobs/knob_table.h"
#include "engine/render/reference/reference.h"
#include "modules/lights/components.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

/// When shadows are computed.
enum class ShadowMode : std::uint8_t {
  off,
  monolithic,  ///< during shading, for each pixel and light
  deferred,    ///< before shading: final lists are made
};
[[nodiscard]] constexpr std::string_view name_of(ShadowMode mode) {
  switch (mode) {
    case ShadowMode::off:
      return "off";
    case ShadowMode::monolithic:
      return "monolithic";
    case ShadowMode::deferred:
      return "deferred";
  }
  return {};
}

inline constexpr EnumKnob<ShadowMode> kShadowMode{
    .name = "shadows.mode",
    .meaning =
        "when shadows are computed: never; during shading, for each pixel and light (monolithic); or before "
        "shading, for each pair of an 8x8 tile and a light that is neither wholly lit nor wholly unlit "
        "(deferred)",
    .default_value = ShadowMode::deferred};

/// What of the last frame's visibilities a frame keeps.
enum class ShadowReuse : std::uint8_t {
  off,
  exact,        ///< those of tiles and lights of which nothing has changed
  reprojected,  ///< and of the same points of surfaces, where no caster in the light's way has moved
};
[[nodiscard]] constexpr std::string_view name_of(ShadowReuse reuse) {
  switch (reuse) {
    case ShadowReuse::off:
      return "off";
    case ShadowReuse::exact:
      return "exact";
    case ShadowReuse::reprojected:
      return "reprojected";
  }
  return {};
}
inline constexpr EnumKnob<ShadowReuse> kShadowReuse{
    .name = "shadows.reuse",
    .meaning =
        "visibilities of the last frame that are kept: none; or those of pairs of a tile and a light of which nothing "
        "has changed, neither pixels nor light nor casters, and the maps of close-up subjects that hold still (exact: "
        "the picture is the same to the bit); or also those of surfaces that the camera saw elsewhere in the last "
        "frame, where no caster that has moved is in the light's way (reprojected: each tile is made anew every fourth "
        "frame); cost and bench set off, so that what they measure at rest is what a moving camera pays",
    .default_value = ShadowReuse::exact,
    .exact = ShadowReuse::off,
    .only_with = "shadows.mode=deferred"};

/// A knob of the grass module, which this module obeys. Values of kThinFilter (shadows_api.glsl).
inline constexpr ChoiceKnob<std::uint32_t> kGrassShadowFilter{
    .name = "grass.shadow_filter",
    .meaning =
        "filter of the shadows that fall on blades of grass (shadows.filter=chs): that of all surfaces (full), or in "
        "one mip of the receiver's face, without the estimate of near blockers (one_mip)",
    .choices = {{"full", 0}, {"one_mip", 1}},
    .default_value = 1,
    .exact = 0,
    .only_with = "shadows.filter=chs"};

/// On the board if the frame draws thin surfaces into the geometry buffer (encode_thin_color() in gbuffer_api.glsl). A
/// module that draws them puts it there in PassPhase::announce. Without it no shader looks for them.
struct ThinSurfaces {};

/// A square of texels in an atlas. Its origin is a multiple of its size.
struct AtlasSquare {
  uvec2 origin = uvec2(0);  ///< texels from the upper left corner of mip 0
  std::uint32_t size = 0;   ///< texels of a side, a power of two; 0: no place in the atlas
  bool operator==(const AtlasSquare&) const = default;
};

/// One square shadow map: the view from a light along one axis.
struct ShadowFace {
  Entity light;
  LightKind kind = LightKind::spot;  ///< directional: orthographic; spot: perspective; point: a cube face (also of spot
                                     ///< lights wider than 120°)
  std::uint32_t index = 0;  ///< cube face 0 … 5 in the order of shadows_shared.h, or cascade 0 … GLOAM_MAX_CASCADES − 1
  dvec3 origin = dvec3(0.0);  ///< world position of the light; orthographic: centre of the near side of the box
  /// World axes of the face: unit vectors at right angles. For a mirrored spot light they are left-handed.
  vec3 right = vec3(1.0f, 0.0f, 0.0f);
  vec3 up = vec3(0.0f, 1.0f, 0.0f);
  vec3 forward = vec3(0.0f, 0.0f, -1.0f);
  float tan_half = 1.0f;       ///< tangent of half the field of view, rim included; 0: the face is orthographic
  float half_extent_m = 0.0f;  ///< orthographic: half the width of the box, rim included
  float near_m = 0.05f;        ///< perspective: distance along `forward` with depth 1 in the map; orthographic: 0
  float clip_share = 1.0f;  ///< perspective: the near plane as a share of near_m, ≤ 1; what lies between has depth 1
  float far_m = 0.0f;  ///< perspective: range of the light, a distance from `origin`; orthographic: depth of the box
  float bulb_radius_m = -1.0f;  ///< local light: bulb_radius(); directional: −1
  AtlasSquare square;           ///< place in the atlas
  float importance = 0.0f;      ///< ≥ 0; when the atlas is full, the least important faces halve first
  std::uint32_t view = 0;       ///< as FaceKey::view

  /// Depth of the near plane.
  [[nodiscard]] float clip_m() const { return near_m * clip_share; }
};

/// A rectangle of a face's texels: x from the left edge, y from the upper edge. `end` is one past the last texel.
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

/// The texels that casters in a world-space box may be drawn into. Includes a margin for rounding; corners are
/// multiples of 8 texels. low, high: corners of the box in metres. Empty if the box lies behind the light. The whole
/// face if low is above high on any axis, or if a bound is not finite.
[[nodiscard]] TexelRect covered_texels(const ShadowFace& face, const dvec3& low, const dvec3& high);

/// Whether casters in a world-space box may block light in this face. Conservative: false only if they certainly do
/// not. In a perspective face, casters nearer than the near plane (clip_m()) or beyond far_m block nothing. In an
/// orthographic face, casters beyond far_m block nothing, but casters in front of the near side block. min, max:
/// corners of the box in metres. True if min is above max on any axis or a bound is NaN, because the position is then
/// unknown.
[[nodiscard]] bool face_may_see(const ShadowFace& face, const dvec3& min, const dvec3& max);

/// The final lists of a view: which lights reach each shadow tile, and how much of each light its pixels see. Opaque
/// surfaces only. Layout: shaders/shadows/final_lists_shared.h. Shaders read them with
/// shaders/shadows/final_lists_api.glsl.
struct FinalLists {
  ImageRef tiles;                   ///< rgba32ui, one texel per shadow tile
  BufferRef entries;                ///< one 32-bit word per entry
  BufferRef visibilities[2];        ///< visibility slots; both refs name the same buffer when one is large enough
  BufferRef commands;               ///< one ShadowListCommands
  std::uint64_t fallback_draw = 0;  ///< byte offset of ShadowListCommands::fallback_draw in `commands`
  BufferRef counters;               ///< one ShadowListCounters
  /// With kReuse of `constants`, a KeptTile per shadow tile. A later module that changes visibilities of a light adds
  /// the light to KeptTile::composed; one that makes a tile a fallback tile sets KeptTile::local_first to
  /// GLOAM_NO_FINAL_LIST. Otherwise one that is not read.
  BufferRef kept_tiles;
  bool has_anew = false;     ///< KeptTile::anew is set: other lights show what the last frame's later modules have left
  BufferRef fallback_tiles;  ///< y << 16 | x per fallback tile; their number is ShadowListCommands::fallback_draw.y
  gpu::Binding::BufferRange grid;     ///< uniform buffer range that holds a FinalGrid
  bool always_complete = false;       ///< the buffers hold every light of every tile: there are no fallback tiles
  std::uint32_t visibility_bits = 8;  ///< bits of one visibility: 8 or 4
  std::uint32_t slot_capacity = 0;    ///< visibility slots that both buffers hold together
  std::uint32_t pair_capacity = 0;    ///< tile-light pairs that the view has room for
  /// Specialisation constants of shaders that include final_lists_api.glsl.
  gpu::SpecConstants constants;
};

/// The inputs of shaders that evaluate a view's shadows and cookies with shaders/shadows/shadows_api.glsl. Put on the
/// board in PassPhase::lists, only in views that demand the module (shadow_demand() in keys.h).
struct ShadowsOutputs {
  gpu::Binding::BufferRange block;      ///< uniform: a ShadowBlock (shaders/shadows/shadows_shared.h)
  shaders::ShadowBlock block_values{};  ///< content of `block`
  ImageRef rows;  ///< rgba32f: light rows, GLOAM_SHADOW_ROW_TEXELS texels wide, one row per local light and per cascade
  ImageRef standard_rows;  ///< `rows` without overlays: rows that refer to no copies
  /// Content of `rows`: a ShadowRow per local light; from block.cascade_row on, a CascadeRow per cascade.
  std::shared_ptr<const std::vector<shaders::ShadowRow>> row_values;
  ImageRef atlas;    ///< r32f or r16_unorm: reversed depth of all faces and mips; null without maps
  ImageRef pyramid;  ///< r32f: nearest and farthest depth of blocks of the atlas; null without maps
  ImageRef cookies;  ///< rgba8_srgb array: cookies of spot lights; one white layer when there is none
  ImageRef traced;   ///< r8_unorm array: traced visibility, one layer per light, of the view's size; null when
                     ///< nothing was traced

  /// No light of the view has a map or traced visibility. Shaders may then include cookies_api.glsl in place of
  /// shadows_api.glsl, which is many times smaller.
  bool cookies_only = false;
  /// The view's shadows use the standard filter. Shaders may then define GLOAM_SHADOWS_STANDARD, which halves their
  /// code.
  bool standard = false;
  /// Specialisation constants of shaders that include shadows_api.glsl, the same for all shaders of the frame. They
  /// apply where present: programs without shadows may take them, too.
  gpu::SpecConstants constants;

  bool may_have_dim_lights = false;   ///< shadows.min_contribution counts in this frame
  std::uint64_t cookies_version = 0;  ///< changes with the content of `cookies`
  std::uint32_t cookie_lights = 0;    ///< spot lights of the scene that project a cookie
  bool transmission = false;          ///< lets_light_through() (engine/scene/transmission.h)

  /// Set only with shadows.mode=deferred, and only in frames that make final lists: the view has shadow maps, its
  /// visibilities are quantised, its local lights (if any) have early lists, and all pipelines of the passes are ready.
  std::optional<FinalLists> final_lists;
};

/// Returns a copy with the constants and shader versions (final_lists->constants included) that the view would have
/// with other knobs: for Module::pipelines. Images and buffers are those of `now`.
[[nodiscard]] ShadowsOutputs with_knobs(const ShadowsOutputs& now, const KnobRegistry& knobs);
/// Returns a copy whose constants select shadows.filter=pcss instead of chs: the same penumbrae, computed by single
/// fetches from mip 0. Outputs with any other filter keep their filter. `standard` becomes false when the filter
/// changes.
[[nodiscard]] ShadowsOutputs by_single_fetches(ShadowsOutputs shadows);

/// Binds the inputs of shadows_api.glsl and cookies_api.glsl that the program in use declares: shadow_block,
/// shadow_rows, shadow_atlas, shadow_pyramid, shadow_cookies and shadow_traced.
void read_shadows(ShaderPass& pass, const ShadowsOutputs& shadows);
/// Binds the inputs of final_lists_api.glsl that the program in use declares: final_tiles, final_entries,
/// visibilities_0 and visibilities_1.
void read_final_lists(ShaderPass& pass, const FinalLists& lists);
/// Binds visibilities_0 and visibilities_1 for writing, which may be one buffer.
void write_visibilities(ShaderPass& pass, FinalLists& lists);
/// The view's final lists; null if the frame makes none.
[[nodiscard]] const FinalLists* find_final_lists(const FrameBuilder& frame);

/// Withheld casters: a light's standard maps leave them out, because a later module draws them itself. That module puts
/// this on the board in PassPhase::announce. Ignored in frames without final lists, in which the maps hold all casters.
struct WithheldCasters {
  struct OfLight {
    Entity light;
    /// Caster::entity of the left-out casters and CasterSource::entity of the left-out sources, ascending by
    /// Entity::index.
    std::vector<Entity> casters;
    bool operator==(const OfLight&) const = default;
  };
  bool operator==(const WithheldCasters&) const = default;
  std::vector<OfLight> lights;  ///< ascending by Entity::index
  /// The casters withheld from this light; empty when there are none. Valid while `lights` is unchanged.
  [[nodiscard]] std::span<const Entity> of(Entity light) const;
};

/// What a later module changes visibilities by. That module puts it on the board in PassPhase::announce, so that
/// visibilities which it would change alike are kept with its changes (shadows.reuse=exact).
struct ComposedLights {
  struct OfLight {
    Entity light;
    std::uint64_t hash = 0;  ///< of everything that the changes depend on besides pixels, light and withheld casters
  };
  std::vector<OfLight> lights;
};

/// One texel of FinalLists::tiles, decoded. Firsts are indices into FinalLists::entries.
struct FinalList {
  bool complete = true;  ///< false: a buffer was full; the tile is a fallback tile and all other members are 0
  std::uint32_t directional_first = 0;
  std::uint32_t directional_count = 0;
  std::uint32_t local_first = 0;
  std::uint32_t local_count = 0;
};
[[nodiscard]] FinalList decode_final_list(uvec4 texel);

/// One word of FinalLists::entries, decoded.
struct FinalEntry {
  std::uint32_t light = 0;  ///< index among the view's directional or local lights, by the run that the entry is in
  std::uint32_t slot = 0;   ///< visibility slot, or GLOAM_ALL_LIT
};
[[nodiscard]] FinalEntry decode_final_entry(std::uint32_t word);

/// Visibility 0 … 1 of one pixel (0 … 63, row by row) of the entry's tile. words: all slots, the first visibility
/// buffer followed by the second. visibility_bits: FinalLists::visibility_bits. 1 for GLOAM_ALL_LIT; 0 for
/// GLOAM_ALL_UNLIT and for slots beyond `words`.
[[nodiscard]] float decode_visibility(FinalEntry entry, std::uint32_t pixel, std::span<const std::uint32_t> words,
                                      std::uint32_t visibility_bits);

/// For visualizers "shadow_unculled:LIGHT" and "shadow_filtered:LIGHT": the visibility 0 … 1 that maps of withheld
/// casters leave of this light, r32f, at every pixel of the view. The module that withholds casters puts it on the
/// board in PassPhase::lists.
struct UnculledCloseups {
  ImageRef visibility;
};
inline constexpr std::string_view kUnculledVisualizers[] = {"shadow_unculled", "shadow_filtered"};

/// Reserved tiles: shadow tiles whose final lists are complete, even if others need too much. A later module that adds
/// to final lists puts this on the board in PassPhase::announce; it can then rely on lists in these tiles.
struct ReservedTiles {
  std::vector<std::uint32_t> tiles;  ///< bit i % 32 of word i / 32 for the tile of index i = row · columns + column
  std::uint32_t slots = 0;           ///< visibility slots that are kept free for them
};
/// The reservation for these tiles of the view, of all directional lights and of the local lights that cast there:
/// those with maps, and `lights`, whose casters later modules draw. None if there may not be room: because of knobs
/// that limit lists, or because it would take more than 64 MiB.
[[nodiscard]] std::optional<ReservedTiles> reserve_tiles(const FrameBuilder& frame, std::vector<std::uint32_t> tiles,
                                                         std::span<const Entity> lights);

/// A shadow map outside the standard atlas: one face and the casters that are drawn into it.
struct ExtraMap {
  ShadowFace face;  ///< face.square is the place in the ExtraAtlas. Kept maps: face.light and face.index name the map
  /// Caster::entity of the casters and CasterSource::entity of the sources, ascending by Entity::index.
  std::span<const Entity> casters;
};

/// An atlas and its pyramid in the layout of shaders/shadows/shadows_shared.h, with a size independent of the standard
/// atlas.
struct ExtraAtlas {
  ImageRef atlas;
  ImageRef pyramid;
  std::uint32_t size = 0;  ///< texels of the atlas' side (W), a power of two
};

/// The shader constants of an orthographic face, with a rim of 0, for positions relative to view_position (world).
[[nodiscard]] shaders::ShadowCascade orthographic_constants(const ShadowFace& face, const dvec3& view_position);

/// Workgroup size for shaders that include shaders/shadows/pair_pixels_api.glsl (specialisation constant 0): 8 on a
/// device that is a CPU, else 64.
[[nodiscard]] std::uint32_t threads_a_tile(const gpu::DeviceInfo& device);

/// The mips that maps of an ExtraAtlas get.
enum class MapMips : std::uint8_t {
  all,
  bounds_only,  ///< the pyramid only: for by_single_fetches(), which reads no coarser mip of the atlas
};

/// Maps that stay as they are between frames of a view, in an atlas of their own.
struct KeptMaps {
  ExtraAtlas atlas;
  std::vector<AtlasSquare> squares;  ///< by map: its place; size 0: it found no room, and was not drawn
  std::uint32_t drawn = 0;           ///< maps that were drawn in this frame; the others show the same as before
};

struct ShadowMapTools;  ///< internal to the shadows module

/// Draws shadow maps outside the standard atlas for later modules, with the same knobs, bias and mips as standard maps.
/// On the board from PassPhase::lists on, only in frames that have final lists.
class ShadowMapDrawer {
 public:
  explicit ShadowMapDrawer(std::shared_ptr<const ShadowMapTools> tools) : tools_(std::move(tools)) {}

  /// Creates transient images for an atlas with a side of `size` texels, a power of two. Their memory counts towards
  /// the module that is adding passes.
  [[nodiscard]] ExtraAtlas create(FrameBuilder& frame, std::uint32_t size) const;
  /// Greatest number of maps with a side of `size` texels that one call of draw() accepts (asserted there).
  [[nodiscard]] static std::size_t most_maps(std::uint32_t size);
  /// Draws the maps and makes their mips and pyramids: passes shadow_map_`name` and shadow_map_`name`_mips, which count
  /// towards the module that is adding passes. maps: 1 … most_maps(size), all with the same square.size. Afterwards
  /// `into` refers to the written images. If a pipeline or memory cannot be created, the frame is given up
  /// (FrameBuilder::fail).
  void draw(FrameBuilder& frame, const char* name, std::span<const ExtraMap> maps, ExtraAtlas& into,
            MapMips mips = MapMips::all) const;
  /// The same for maps of a view that outlive the frame, each of its own size. Finds their places in an atlas with a
  /// side of `size` texels, the first maps first; a map keeps its place while its size stays the same and the others
  /// leave room. Draws only those whose face, casters or knobs differ from those of the last frame with this map. The
  /// atlas belongs to the module that is adding passes.
  [[nodiscard]] KeptMaps draw_kept(FrameBuilder& frame, const char* name, std::span<const ExtraMap> maps,
                                   std::uint32_t size, MapMips mips) const;
  /// Uploads the ShadowBlock that shadows_api.glsl needs for maps of an ExtraAtlas, and returns its range in the
  /// frame's uniform memory. It equals the standard maps' ShadowBlock except for atlas_size. size: ExtraAtlas::size.
  /// If there is no memory, the range is empty and the frame is given up.
  [[nodiscard]] gpu::Binding::BufferRange block(FrameBuilder& frame, std::uint32_t size) const;

 private:
  std::shared_ptr<const ShadowMapTools> tools_;
};

// Overlays: changes to standard maps for one frame. The maps themselves are cached between frames and stay as they are.
// Faces that change are copied into free squares of the atlas, a later module draws into the copies, and light rows
// that point to the copies replace ShadowsOutputs::rows. Nothing of an overlay outlives the frame.

/// A standard face and the free square of the same atlas that its copy goes to.
struct OverlayFace {
  ShadowFace face;
  AtlasSquare copy;
  /// The face with `copy` as its square.
  [[nodiscard]] ShadowFace at_copy() const {
    ShadowFace moved = face;
    moved.square = copy;
    return moved;
  }
};

/// Whether later modules want to make overlays; a view resource. The shadows module resets it in Module::prepare_view;
/// a later module sets it in its own. The atlas then keeps as much free room as faces take.
struct OverlayRoom {
  bool wanted = false;
};

struct ViewFaces;
class FreeSquares;

/// Chooses the faces that are copied in a frame and finds squares for the copies. The world must outlive the plan, and
/// the view's ViewFaces must not change while the plan is in use. On a default-constructed plan, add() always returns
/// false.
class OverlayPlan {
 public:
  OverlayPlan() = default;
  OverlayPlan(const World& world, ViewId view);
  /// Adds the light's faces for which face_may_see() is true for the world-space box; a face that is already in the
  /// plan is not added again. If there are not enough free squares for all of them, adds none and returns false.
  [[nodiscard]] bool add(Entity light, const dvec3& low, const dvec3& high);
  [[nodiscard]] std::span<const OverlayFace> faces() const { return faces_; }

 private:
  const ViewFaces* view_faces_ = nullptr;
  std::shared_ptr<const FreeSquares> free_;
  std::vector<OverlayFace> faces_;
};

/// The copies of a frame between OverlayMaps::start() and finish(). In between, compute shaders may write reversed
/// depth to mip 0 of each copy's square in ShadowsOutputs::atlas. A pass that does so must put the written version back
/// into ShadowsOutputs::atlas on the board.
struct OverlayCopies {
  std::vector<OverlayFace> faces;
  bool d16 = false;                ///< the atlas is r16_unorm, else r32f
  std::uint32_t depth_bits = ~0u;  ///< bits of a float depth that writers to mip 0 must keep; the others must be 0, as
                                   ///< coarser mips hold a count in them
  [[nodiscard]] bool empty() const { return faces.empty(); }
};

/// Makes overlays (see above). On the board from PassPhase::lists on, only in frames that have final lists.
class OverlayMaps {
 public:
  explicit OverlayMaps(std::shared_ptr<const ShadowMapTools> tools) : tools_(std::move(tools)) {}
  /// Whether the atlas is r16_unorm; otherwise it is r32f.
  [[nodiscard]] bool d16() const;
  /// Copies mip 0 of each face (at least one) into OverlayFace::copy: pass shadow_overlay_copy. Allocates no image
  /// memory. Cached maps that lie in the squares of the copies are dropped from the cache. Passes of overlays count
  /// towards the shadows module. On an error the frame is given up (FrameBuilder::fail) and the copies are empty.
  [[nodiscard]] OverlayCopies start(FrameBuilder& frame, std::span<const OverlayFace> faces) const;
  /// Makes the copies' mips and pyramids (pass shadow_overlay_mips), and makes ShadowsOutputs on the board refer to
  /// them: atlas, pyramid, and rows that point to the copies (pass shadow_overlay_rows). Call after all writes to the
  /// copies.
  void finish(FrameBuilder& frame, const OverlayCopies& copies) const;

 private:
  std::shared_ptr<const ShadowMapTools> tools_;
};

/// Appends the pipelines that only maps with MapMips::bounds_only use. d16: as OverlayMaps::d16().
void list_bounds_pipelines(bool d16, PipelineList& list);
/// Appends the pipelines that only overlays use. d16: as OverlayMaps::d16().
void list_overlay_map_pipelines(bool d16, PipelineList& list);

/// The reference for a knob of this module: the frame shaded with traced visibility.
[[nodiscard]] ReferenceInfo traced_shadows(std::string knob);

}  // namespace gloam
