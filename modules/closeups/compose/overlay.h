// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/closeups/pairs/views.h"

namespace gloam {

/// Lets forward-lit surfaces and tiles without a final list see close-up subjects in this frame: in copies of the
/// standard faces that may see them. In a frame without such copies nothing happens.
class CloseupOverlay {
 public:
  /// draws: subjects are drawn into a map of the standard face's size where the close-up map has room for one, in place
  /// of transferring what the pairs' maps hold.
  explicit CloseupOverlay(bool draws) : draws_(draws) {}

  /// Copies the faces within the atlas (pass shadow_overlay_copy).
  [[nodiscard]] Status start(FrameBuilder& frame, const OverlayPlan& plan);
  /// Adds the subjects of pairs whose maps lie in `map` (pass closeup_transfer). Their faces are placed. Drawing, it
  /// uses the map: then it comes after all else that looks at these maps.
  [[nodiscard]] Status add(FrameBuilder& frame, std::span<const CloseupView> pairs, ExtraAtlas& map);
  /// ShadowsOutputs on the board with the copies and their mips.
  [[nodiscard]] Status finish(FrameBuilder& frame);

 private:
  struct Transfer {
    gpu::Binding::BufferRange constants;
    std::size_t face = 0;  ///< in OverlayCopies
    uvec2 groups = uvec2(0);
  };
  using Transfers = std::vector<Transfer>;
  /// Faces in OverlayCopies, of the pair's light, that its subject may be seen in.
  [[nodiscard]] std::vector<std::size_t> faces_of(const FrameBuilder& frame, const CloseupView& pair) const;
  [[nodiscard]] Status add_transfer(FrameBuilder& frame, const CloseupView& pair, const ShadowFace& from,
                                    std::size_t face, const ExtraAtlas& map, Transfers& transfers) const;
  [[nodiscard]] Status draw_and_add(FrameBuilder& frame, const CloseupView& pair, std::span<const std::size_t> faces,
                                    ExtraAtlas& map);
  [[nodiscard]] Status add_pass(FrameBuilder& frame, Transfers transfers, const ExtraAtlas& map) const;

  bool draws_;
  OverlayCopies copies_;
};

/// Pipelines that these passes take; d16: of OverlayMaps.
void list_closeup_overlay_pipelines(bool d16, PipelineList& list);

}  // namespace gloam
