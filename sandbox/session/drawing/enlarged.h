// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/readback/picture.h"

// Pictures of a reduced resolution (kViewScale) at their full size.

namespace gloam {

/// Width or height that is drawn, at least 1 pixel. scale: above 0, at most 1.
[[nodiscard]] std::uint32_t scaled_size(std::uint32_t size, double scale);

/// The picture at another size, by the filter of shaders/sandbox/upscale.frag: along one axis, then along the other.
/// A picture that has the size is returned unchanged.
[[nodiscard]] Picture enlarged(const Picture& picture, std::uint32_t width, std::uint32_t height);
[[nodiscard]] LinearPicture enlarged(const LinearPicture& picture, std::uint32_t width, std::uint32_t height);

}  // namespace gloam
