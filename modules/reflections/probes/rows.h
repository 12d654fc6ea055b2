// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/view.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/relighting/capture_factors.h"

namespace gloam {

/// Share of half a probe's box over which its influence falls to 0 toward the faces.
inline constexpr float kProbeFade = 0.2f;

/// Rows of all captured probes with a box of positive, finite size, from the smallest volume to the largest, then the
/// global one. Probes of equal volume come in the order of their entities' indices. factors: by layer of the captures;
/// empty: captured light is shown as captured.
[[nodiscard]] std::vector<shaders::ProbeRow> probe_rows(const World& world, const RenderView& view,
                                                        const ReflectionCaptures& captures,
                                                        std::span<const CaptureFactor> factors = {});

}  // namespace gloam
