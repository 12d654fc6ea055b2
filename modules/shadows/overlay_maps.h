// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/entity.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/shadow_knobs.h"
#include "modules/shadows/shadow_views.h"

// How later modules let those who look at standard maps in this frame see more in them. The maps themselves are kept from frame to frame and
// stay as they are: what is to be seen goes into copies of faces, in squares of the atlas that are free, and rows that point to the copies
// take the place of ShadowsOutputs::rows. Nothing of it outlives the frame.

namespace gloam {

class ShadowStates;
struct FacePlan;

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

/// Faces that get copies in a frame; for the time when passes are announced or declared.
class OverlayPlan {
 public:
  OverlayPlan() = default;
  explicit OverlayPlan(const ShadowViews& views) : views_(&views), free_(views.atlas.free_squares()) {}
  /// Adds the faces of a light that may see something in the world box. False: some find no room, and none is added.
  [[nodiscard]] bool add(Entity light, const dvec3& low, const dvec3& high);
  [[nodiscard]] std::span<const OverlayFace> faces() const { return faces_; }

 private:
  const ShadowViews* views_ = nullptr;
  FreeSquares free_;
  std::vector<OverlayFace> faces_;
};

/// Copies of faces while they are added to.
struct OverlayCopies {
  struct Layer {
    std::size_t image = 0;  ///< in `images`
    std::uint32_t layer = 0;
  };
  std::vector<OverlayFace> faces;
  std::vector<Layer> layers;  ///< by face
  std::vector<ImageRef>
      images;  ///< r32f, arrays: reversed depth as mip 0 of the standard map has it. For compute shaders to write to.
  std::shared_ptr<const FacePlan> plan;
  [[nodiscard]] bool empty() const { return faces.empty(); }
};

/// On the board in frames that have final lists.
class OverlayMaps {
 public:
  OverlayMaps(ShadowStates& states, const ShadowKnobs& knobs) : states_(&states), knobs_(knobs) {}
  /// Copies the faces, at least one (pass shadow_overlay_copy). The images' memory counts as the module's.
  [[nodiscard]] Result<OverlayCopies> start(FrameBuilder& frame, const char* module,
                                            std::span<const OverlayFace> faces) const;
  /// Moves copies into the atlas, with mips and pyramids (pass shadow_overlay_mips), and lets ShadowsOutputs on the board point to them (pass
  /// shadow_overlay_rows).
  [[nodiscard]] Status finish(FrameBuilder& frame, const OverlayCopies& copies) const;

 private:
  ShadowStates* states_;
  ShadowKnobs knobs_;
};

/// Pipelines that only overlays take.
void list_overlay_map_pipelines(PipelineList& list);

}  // namespace gloam
