// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/ecs/world.h"
#include "engine/render/declare/compute_pass.h"
#include "engine/render/frame_builder.h"
#include "engine/render/view.h"
#include "modules/reflections/relighting/capture_factors.h"

namespace gloam {

/// A proxy that a view captures again in this frame: a resource of the view.
struct DueRecapture {
  bool due = false;
  std::uint32_t layer = 0;  ///< of ReflectionCaptures::proxies
  ViewId view{0};           ///< the companion that draws it
};

/// Chooses the most outdated proxy among those that the view's last frame reflected, and adds the companion that draws
/// it (proxy_view). At most one a view and frame; none if no capture is outdated. Sets the view's DueRecapture.
/// factors: of the view's last frame; null: it reflected nothing.
void add_recapture_view(World& world, const ViewSettings& main, const CaptureFactors* factors,
                        CompanionViews& companions);
/// No proxy is captured again in this frame of the view.
void leave_recapture(World& world, ViewId main);

[[nodiscard]] ComputeProgram recapture_program();

/// Copies what the companion has drawn into the layer of its proxy, with all mips, and notes it in the factors when the
/// frame is submitted. images: those of all proxies. Returns them; unchanged if nothing is due.
[[nodiscard]] ImageRef add_recapture_passes(FrameBuilder& frame, CaptureFactors& factors, ImageRef images);

}  // namespace gloam
