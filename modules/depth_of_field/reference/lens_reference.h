// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/render/reference/reference.h"

namespace gloam {

/// Light of the input's frame through its camera's lens: the mean of input.samples frames without depth of field, each
/// drawn from a point of the lens (LensPoint, lens_point()). Taken from the input's store if it holds it. Usage error
/// if the frame cannot be drawn again. The light of the frame itself if its camera has no focus.
[[nodiscard]] Result<LinearPicture> light_through_lens(const ReferenceInput& input);

/// The same with the picture that the frame makes from this light.
[[nodiscard]] Result<FramePictures> draw_through_lens(const ReferenceInput& input);

/// Puts the light into the world as LensPicture: later frames show it (VisualizerInfo::trace).
[[nodiscard]] Status put_lens_picture(World& world, const ReferenceInput& input);

/// draw_through_lens() as the reference of a knob of the module.
[[nodiscard]] ReferenceInfo lens_reference(std::string knob);

}  // namespace gloam
