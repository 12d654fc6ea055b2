// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/render/readback/picture.h"
#include "engine/render/view.h"
#include "sandbox/session/session.h"

namespace gloam {

/// The numbers that the visualizer of a view's last frame shows, in up to three channels: base colour (albedo), the
/// shading normal (normal), the view depth in metres and 0 for the sky (depth), or what the visualizer's own image
/// holds, such as a radius in pixels or a visibility. The lit picture and visualizers without such an image: linear
/// light in cd/m². Draws the frame again and waits for the GPU.
[[nodiscard]] Result<LinearPicture> read_view_values(Session& session, const ViewSettings& view);

/// Texels of an image as floats, four to a texel; channels that it lacks are 0. Unsigned integers keep their value.
/// An error if the format is not one of those that visualizers write.
[[nodiscard]] Result<std::vector<float>> texels_as_floats(const ImageBytes& image);

}  // namespace gloam
