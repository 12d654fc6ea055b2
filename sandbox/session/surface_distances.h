// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/jobs/executor.h"
#include "engine/render/reference/scene_tracer.h"
#include "engine/scene/assets.h"
#include "modules/reflections/module.h"

namespace gloam {

/// Distances by a tracer of the scene, for propose_proxies(). The arguments must outlive the result.
[[nodiscard]] SurfaceDistances surface_distances(const SceneTracer& tracer, const SceneAssets& assets,
                                                 JobExecutor& executor);

}  // namespace gloam
