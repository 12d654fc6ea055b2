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

/// Input of traced references for one frame: its geometry buffer, and a tracer for the triangles of the world.
struct FrameToTrace {
  GeometryPicture geometry;
  std::unique_ptr<SceneTracer> tracer;
};

/// Reads the geometry of the session's last frame back and builds the tracer.
[[nodiscard]] Result<FrameToTrace> read_frame_to_trace(Session& session, ViewId view);

/// The visualizer of this name, if something has to be traced before it can be shown; otherwise none. name: NAME or
/// NAME:ARGUMENT.
[[nodiscard]] std::optional<VisualizerInfo> traced_view(const Renderer& renderer, std::string_view name);

/// Returns ErrorKind::usage for a visualizer that has to be traced: it can show single frames only.
[[nodiscard]] Status check_shown_live(const Renderer& renderer, std::string_view name);

/// Traces the data with which visualizer `info` shows the session's last frame, and stores it in the world. Shows a
/// progress bar on a terminal unless quiet.
[[nodiscard]] Status trace_for_view(Session& session, const VisualizerInfo& info, const ViewSettings& view,
                                    Console& console, bool quiet);

}  // namespace gloam
