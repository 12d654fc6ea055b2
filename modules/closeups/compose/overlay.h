// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/render/frame_builder.h"
#include "modules/closeups/pairs/views.h"
#include "shaders/closeups/closeups_shared.h"

namespace gloam {

/// Shows close-up subjects to forward-lit surfaces and fallback tiles: adds them to the overlay, i.e. to copies of the
/// standard faces that may see them. Does nothing in a frame without overlay.
class CloseupOverlay {
 public:
  /// `draws`: true draws the subjects into the close-up map with the projection of the standard face, if the map is
  /// large enough, and adds these depths to the copy; false transfers the depths of the pairs' own faces.
  explicit CloseupOverlay(bool draws) : draws_(draws) {}

  /// Copies the planned faces within the atlas (pass shadow_overlay_copy).
  void start(FrameBuilder& frame, const OverlayPlan& plan);
  /// Adds the subjects of `pairs`, whose faces have their place in `map` (pass closeup_transfer). With `draws`, this
  /// overwrites `map`: call it after every other pass that reads these pairs' faces.
  void add(FrameBuilder& frame, std::span<const CloseupView> pairs, ExtraAtlas& map);
  /// Makes ShadowsOutputs on the board refer to the copies and their mips.
  void finish(FrameBuilder& frame);

 private:
  struct Transfer {
    std::size_t face = 0;  ///< index in OverlayCopies
    shaders::CloseupTransfer constants{};
  };
  /// Indices in OverlayCopies of the faces of the pair's light that may see its subject.
  [[nodiscard]] std::vector<std::size_t> faces_of(const FrameBuilder& frame, const CloseupView& pair) const;
  /// The transfer from `from`, a face in `map`, to a copy.
  [[nodiscard]] Transfer transfer_to(std::size_t face, const FrameBuilder& frame, const CloseupView& pair,
                                     const ShadowFace& from, const ExtraAtlas& map) const;
  void draw_and_add(FrameBuilder& frame, const CloseupView& pair, std::span<const std::size_t> faces, ExtraAtlas& map);
  void add_pass(FrameBuilder& frame, std::span<const Transfer> transfers, const ExtraAtlas& map) const;

  bool draws_;
  OverlayCopies copies_;
};

/// Pipelines of these passes. `d16`: as OverlayMaps::d16.
void list_closeup_overlay_pipelines(bool d16, PipelineList& list);

}  // namespace gloam
