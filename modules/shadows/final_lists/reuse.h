// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Reuse of visibilities (shadows.reuse=exact): a tile and a light of which nothing has changed since the last frame
// keep that frame's visibilities, bit for bit. The CPU compares what all tiles share, and each light by itself; the GPU
// compares what the tile's pixels give (shaders/shadows/final_lists/tile_key.glsl). With shadows.reuse=reprojected,
// what has not changed but for the camera may be taken from where the last frame saw it
// (shaders/shadows/final_lists/reproject.glsl).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/frame/frame_graph.h"
#include "engine/render/camera/view_constants.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/atlas/view_map_state.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// Whether a caster has moved, since the last frame, that the light's maps may see.
enum class CastersMoved : std::uint8_t {
  none,
  some,     ///< ListInputs::moved has them
  unknown,  ///< it may be anywhere, or there are too many
};

/// What the visibilities of one light depend on besides the pixels, as hashes.
struct LightInputs {
  Entity light = kNoEntity;
  std::uint64_t hash = 0;      ///< where its light falls, and its row or cascades
  std::uint64_t maps = 0;      ///< versions of its maps; 0: it has none
  std::uint64_t composed = 0;  ///< what later modules change its visibilities by
  // With shadows.reuse=reprojected:
  std::uint64_t steady = 0;  ///< as `hash`, but without what follows the camera
  CastersMoved casters = CastersMoved::unknown;
};

/// The same of a view.
struct ListInputs {
  std::uint64_t shared = 0;        ///< what all tiles and lights share: view, knobs, sizes of buffers
  std::vector<LightInputs> local;  ///< in the order of the view's local lights
  std::vector<LightInputs> directional;
  // With shadows.reuse=reprojected:
  std::uint64_t steady = 0;        ///< as `shared`, but without what follows the camera
  std::uint64_t caster_frame = 0;  ///< CasterHistory::frame; casters have moved since the frame before it; 0: unknown
  std::vector<vec4> moved;         ///< ReprojectBlock::spheres
};

/// For each light of `now` its index in `last`, or GLOAM_LIGHT_CHANGED if it is not there or has changed. Plus
/// GLOAM_LIGHT_RECOMPOSED if only LightInputs::composed has changed. Local lights, and from GLOAM_MAX_LOCAL_LIGHTS on
/// directional ones. All have changed if `shared` differs. With GLOAM_LIGHT_REPROJECTED and GLOAM_LIGHT_CASTERS_MOVED
/// if only the camera and casters have moved.
[[nodiscard]] std::vector<std::uint32_t> last_indices(const ListInputs& last, const ListInputs& now);
/// Whether a light with maps has not changed: without one, keys of tiles are of no use. indices: last_indices().
[[nodiscard]] bool keeps_any(const ListInputs& now, std::span<const std::uint32_t> indices);
/// Whether any light has GLOAM_LIGHT_REPROJECTED.
[[nodiscard]] bool reprojects_any(std::span<const std::uint32_t> indices);

/// Bytes of the buffers that outlive a frame.
struct KeptSizes {
  std::uint64_t tiles = 0;
  std::uint64_t entries = 0;
  std::uint64_t visibilities[2] = {};  ///< the second is 0 if the first holds all slots
};

/// Buffers that outlive the frame.
struct KeptBuffers {
  BufferRef tiles;  ///< one KeptTile per shadow tile
  BufferRef entries;
  BufferRef visibilities[2];  ///< as FinalLists::visibilities
  bool filled = false;        ///< they hold what the last frame wrote
};
/// The view's buffers; without memory for them the frame is given up. instance: as in ViewReuse.
[[nodiscard]] KeptBuffers use_kept_buffers(FrameBuilder& frame, const KeptSizes& sizes, std::uint64_t instance);

/// What a view's last committed frame with final lists left for the next.
struct ViewReuse {
  ListInputs inputs;
  bool has_keys = false;       ///< its tiles have keys
  std::uint64_t instance = 0;  ///< 0 or 1: HistoryUse::instance of its buffers
  std::uint64_t last_use = 0;  ///< Device::frame_number of the last frame that asked for it
  // With shadows.reuse=reprojected:
  shaders::ViewConstants view{};
  dvec3 position = dvec3(0.0);     ///< of the camera, world
  std::uint32_t turn = 0;          ///< ReprojectBlock::phase
  std::uint32_t exact_frames = 4;  ///< frames since one in which a light had GLOAM_LIGHT_REPROJECTED, ≤ 4
};

/// ViewReuse of all views.
class ListReuse {
 public:
  /// Empty for a view that has not asked in the last 120 frames. Stays where it is until then. frame:
  /// Device::frame_number.
  [[nodiscard]] ViewReuse& view(std::uint64_t world, ViewId view, std::uint64_t frame);
  void forget_unused(std::uint64_t frame);
  void release_view(ViewId view);
  void release() { views_.clear(); }

 private:
  std::map<std::pair<std::uint64_t, std::uint32_t>, ViewReuse> views_;
};

/// The inputs of the frame's lists. Maps that are drawn in this frame equal those of no other frame. maps: the state of
/// the view's maps.
[[nodiscard]] ListInputs list_inputs(const FrameBuilder& frame, const ShadowKnobs& knobs, const ShadowsOutputs& shadows,
                                     const ViewMapState& maps, const KeptSizes& sizes);

/// What a frame takes over into ViewReuse besides its inputs.
struct NotedFrame {
  bool has_keys = false;
  std::uint32_t turn = 0;
  std::uint32_t exact_frames = 4;
};
/// When the frame is committed, notes that it has written the buffers of the other instance than `reuse.instance`.
void note_reuse(FrameBuilder& frame, const ViewMapState& maps, const NotedFrame& noted, ListInputs inputs,
                ViewReuse& reuse);

}  // namespace gloam
