// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/math/types.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/cache.h"
#include "modules/shadows/atlas/face_casters.h"
#include "modules/shadows/atlas/face_regions.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/atlas/view_map_state.h"
#include "modules/shadows/knobs.h"

namespace gloam {

/// A part of a face that is drawn in this frame. Its depths are bit-identical to those of drawing the whole face.
struct DrawnRegion {
  TexelRect texels;
  std::vector<FaceDraw> draws;
  std::vector<mat4> matrices;  ///< clip_from_mesh of each of `draws`
  /// The depth of resting casters comes from the image of backgrounds; `draws` and `sources` hold the other casters
  /// only.
  bool on_background = false;
  std::vector<const CasterSource*> sources = {};  ///< drawn after `draws`
  std::vector<std::uint32_t> parts = {};          ///< CasterSourceDraw::part() of each of `sources`, or empty
};

/// One face that is drawn in this frame.
struct DrawnFace {
  ShadowFace face;
  FaceContent content;
  std::vector<DrawnRegion> regions;         ///< not overlapping
  std::vector<FaceBackground> backgrounds;  ///< content of the image of backgrounds for the face, after the frame
  std::vector<CasterBox> late = {};         ///< as HeldFace::late; outside of `regions`, or drawn there as it is now
};

/// A face whose map the atlas holds, and its content in this frame.
struct HeldFace {
  FaceKey face;
  FaceContent content;
  std::vector<CasterBox> late = {};  ///< boxes inside which the map waits for its turn (CasterSource::turns)
};

/// All shadow-map draws of one frame.
struct DrawnMaps {
  std::vector<DrawnFace> faces;
  /// Parts of faces whose resting casters are drawn into the image of backgrounds, before `faces`.
  std::vector<DrawnFace> backgrounds;
  std::vector<HeldFace> held;  ///< faces that are not drawn
};

/// Hash of everything that maps depend on besides face and casters.
[[nodiscard]] std::uint64_t map_salt(const FrameBuilder& frame, const ShadowKnobs& knobs);

/// Everything that the maps of a view depend on in one frame.
struct MapInputs {
  std::span<const ShadowFace> faces;             ///< those without a place (square.size 0) are ignored
  std::span<const Caster> casters;               ///< ordered by Entity::index
  std::span<const std::uint64_t> poses;          ///< caster_poses(), or empty
  std::span<const CasterSource* const> sources;  ///< in any order
  std::uint64_t salt = 0;                        ///< as in face_contents()
  CasterForm form;
  /// Another view of the frame that shares the atlas has planned its maps already: what it draws is up to date.
  bool continues_frame = false;
  bool atlas_is_empty = false;  ///< the atlas has no contents. Without effect if `continues_frame`
};

/// Decides which of the faces are drawn in this frame: all faces whose map the atlas does not hold. If only casters
/// changed since the last frame, only the regions around the changed casters are drawn, otherwise the whole face.
/// Resting casters of a region come from the image of backgrounds, except in whole faces that see no unsteady caster.
/// Casters withheld from a light are left out of its faces. Sets kept.frame and kept.counts, and leaves what describes
/// the last committed frame as it is.
[[nodiscard]] DrawnMaps plan_maps(const MapInputs& inputs, ViewMapState& kept, JobExecutor& executor);

/// Records that the frame with these maps was committed: once for each plan_maps() of the frame, in the same order.
/// drawn: DrawnMaps::faces. held: DrawnMaps::held.
void commit_maps(std::span<const DrawnFace> drawn, std::span<const HeldFace> held, ViewMapState& kept);

/// plan_maps() for the view that the frame draws. atlas_is_empty: as in MapInputs.
[[nodiscard]] DrawnMaps faces_to_draw(FrameBuilder& frame, ViewMapState& kept, const ViewFaces& view_faces,
                                      const ShadowKnobs& knobs, bool atlas_is_empty);

}  // namespace gloam
