// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "engine/render/frame/frame.h"
#include "engine/render/frame/renderer_parts.h"

/// The stages of a frame between the systems of the world and its submission, in the order of their calls. The first
/// error gives the frame up.
namespace gloam {

/// Starts the frame's views from the requests: their knobs and visualizers are checked.
[[nodiscard]] Status begin_views(Frame& frame, std::span<const ViewRequest> requests, const ModuleList& modules);

/// Settles pose and size of the requested views, and puts their companions before them.
[[nodiscard]] Status add_companions(Frame& frame, const ModuleSet& modules, const gpu::Device& device);

/// Creates the images and the RenderView of each view, hands settled results to the modules, and runs the systems of
/// the views.
[[nodiscard]] Status prepare_views(Frame& frame, RendererParts& parts);

/// Declares the passes of view number `index`.
[[nodiscard]] Status declare_view(Frame& frame, std::size_t index, RendererParts& parts);

/// Makes the pipelines that the declared passes lack, compiles the graph and records it.
[[nodiscard]] Status record_graph(gpu::CommandList& commands, RendererParts& parts);

/// Runs the systems of the world, or of a view. An exception becomes an error that names the system.
[[nodiscard]] Status run_systems(Frame& frame, std::optional<ViewId> view, RendererParts& parts);

}  // namespace gloam
