// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/readback/picture.h"
#include "engine/render/view.h"

// Pictures of a reduced resolution (kViewScale) at their full size.

namespace gloam {

/// Width or height that is drawn, at least 1 pixel. scale: above 0, at most 1.
[[nodiscard]] std::uint32_t scaled_size(std::uint32_t size, double scale);

/// Sets the view's size to that of a picture times a scale. The view has the picture's shape, whatever was rounded.
void set_scaled_size(ViewSettings& view, std::uint32_t width, std::uint32_t height, double scale);

/// The picture at another size, by the filter of shaders/sandbox/upscale.frag: along one axis, then along the other.
/// A picture that has the size is returned unchanged.
[[nodiscard]] Picture enlarged(const Picture& picture, std::uint32_t width, std::uint32_t height);
[[nodiscard]] LinearPicture enlarged(const LinearPicture& picture, std::uint32_t width, std::uint32_t height);

}  // namespace gloam
