// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/frame/transfers/staging.h"
#include "engine/render/frame_builder.h"
#include "engine/render/view.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/relighting/capture_factors.h"

namespace gloam {

/// Illuminance of a point by lights, lux, without shadows: the sum over its six sides.
[[nodiscard]] vec3 surrounding_lux(std::span<const CapturedLightState> lights, const dvec3& point);

/// What became of the light that lamps cause.
struct LampFactors {
  std::span<const CaptureFactor> factors = {};  ///< of CaptureFactors; empty: lamps are as captured
  std::span<const vec4> cells = {};
  bool lamps = true;  ///< false: their light is left out
};

/// Diffuse light of all captured probes with a box of positive, finite size, from the smallest volume to the largest,
/// then that of the grid's cells, which have their whole share in their cell and fade out half a cell beyond, then the
/// global probe. Cells fade out into the mean of them all if there is no global probe. A probe has one factor: the mean
/// over the cells of its map, weighted by the lamps' illuminance at capture.
[[nodiscard]] std::vector<shaders::DiffuseProbe> diffuse_probes(const World& world, const RenderView& view,
                                                                const ReflectionCaptures& captures,
                                                                const LampFactors& lamps = {});

/// Whether a frame of the world may show diffuse light that was captured, or traced.
[[nodiscard]] bool has_diffuse_light(const World& world);

/// Puts IndirectLight on the board, with lighting.indirect=probes or a TracedIndirect of the view's size. Captures have
/// that of probes, and those without lamps the part that lamps do not cause.
void announce_indirect_light(FrameBuilder& frame, Staging& staging, CaptureFactors& factors);

}  // namespace gloam
