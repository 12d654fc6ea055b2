// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/declare/compute_pass.h"
#include "engine/render/frame_builder.h"
#include "engine/render/view.h"
#include "modules/reflections/relighting/capture_factors.h"

namespace gloam {

/// A probe that is being captured again, a step a frame: its six faces, then the mips of its map.
struct ProbeProgress {
  bool running = false;
  std::uint32_t layer = 0;  ///< of ReflectionCaptures::probes
  std::uint32_t step = 0;   ///< next one: 0…5 a face, from 6 on mip step − 6
};

/// What a view captures again in this frame: a resource of the view.
struct DueRecapture {
  enum class Kind : std::uint8_t { none, proxy, probe };
  Kind kind = Kind::none;
  std::uint32_t layer = 0;  ///< of ReflectionCaptures::proxies or probes
  std::uint32_t step = 0;   ///< of a probe: ProbeProgress::step
  ViewId view{0};           ///< the companion that draws the proxy or the face
};

/// Captures that frames of one world make again.
struct RecaptureState {
  const CaptureFactors* factors = nullptr;  ///< of the view's last frame; null: it reflected nothing
  ProbeProgress progress;
  bool proxies = true;  ///< proxies are shown
};

/// Chooses the most outdated capture among the probes and the proxies that the view's last frame reflected, and adds
/// the companion that draws it. At most one view a frame: a proxy, or one face of a probe; none if no capture is
/// outdated. Sets the view's DueRecapture.
void add_recapture_view(World& world, const ViewSettings& main, const RecaptureState& state,
                        CompanionViews& companions);

/// Compute programs of the passes below.
[[nodiscard]] std::vector<ComputeProgram> recapture_programs();

/// Copies what the companion has drawn into the layer of its proxy, with all mips, and notes it in the factors when the
/// frame is submitted. images: those of all proxies. Returns them; unchanged if no proxy is due.
[[nodiscard]] ImageRef add_proxy_recapture(FrameBuilder& frame, CaptureFactors& factors, ImageRef images);
/// The same for probes: one step of the probe that is due. progress: goes on when the frame is submitted.
[[nodiscard]] ImageRef add_probe_recapture(FrameBuilder& frame, CaptureFactors& factors, ProbeProgress& progress,
                                           ImageRef images);

}  // namespace gloam
