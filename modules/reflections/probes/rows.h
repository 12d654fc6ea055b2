// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/view.h"
#include "modules/reflections/captures.h"
#include "shaders/reflections/reflections_shared.h"

namespace gloam {

/// Share of half a probe's box over which its influence falls to 0 toward the faces.
inline constexpr float kProbeFade = 0.2f;

/// Rows of all captured probes with a box of positive, finite size, from the smallest volume to the largest, then the
/// global one. Probes of equal volume come in the order of their entities' indices.
[[nodiscard]] std::vector<shaders::ProbeRow> probe_rows(const World& world, const RenderView& view,
                                                        const ReflectionCaptures& captures);

}  // namespace gloam
