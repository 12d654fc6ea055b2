// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/render/reference/scene_tracer.h"
#include "modules/accuracy/tracing/scene_triangles.h"

namespace gloam {

/// Traces with Embree 3 on the calling threads and starts no threads. Fails with ErrorKind::failed if Embree cannot be
/// used or cannot take the scene. Triangles with non-finite positions are left out.
[[nodiscard]] Result<std::unique_ptr<SceneTracer>> make_embree_tracer(SceneTriangles triangles);

}  // namespace gloam
