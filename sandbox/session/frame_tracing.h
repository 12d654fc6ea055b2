// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "engine/render/readback/geometry_picture.h"
#include "engine/render/reference/scene_tracer.h"
#include "sandbox/console.h"
#include "sandbox/session/session.h"

namespace gloam {

/// What rays of references need of a frame: where its pixels lie, and the triangles around them.
struct FrameToTrace {
  GeometryPicture geometry;
  std::unique_ptr<SceneTracer> tracer;
};

/// Of a session's last frame.
[[nodiscard]] Result<FrameToTrace> read_frame_to_trace(Session& session, ViewId view);

/// The view of this name (with its argument), when something has to be traced before it can be shown.
[[nodiscard]] std::optional<VisualizerInfo> traced_view(const Renderer& renderer, std::string_view name);

/// Usage error for a view that has to be traced: such views are of single frames.
[[nodiscard]] Status check_shown_live(const Renderer& renderer, std::string_view name);

/// Traces what `info` needs to show the session's last frame and puts it into the world; a bar on a terminal unless
/// quiet.
[[nodiscard]] Status trace_for_view(Session& session, const VisualizerInfo& info, ViewId view, Console& console,
                                    bool quiet);

}  // namespace gloam
