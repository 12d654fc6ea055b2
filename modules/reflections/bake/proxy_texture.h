// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/core/result.h"
#include "modules/reflections/bake/light_sources.h"
#include "modules/reflections/bake/picture.h"

namespace gloam {

/// The image file of a proxy as light: decoded from sRGB, so that white is 1 cd/m², and premultiplied by alpha. Error
/// of kind input if the file cannot be read; the message names the key and the path.
[[nodiscard]] Result<CapturedPicture> read_proxy_texture(const std::string& path, std::uint32_t side);

/// Scales the picture of a fire so that the quad, seen from the front, has the luminous intensity of its lights
/// together: mean luminance · area = candela · light_scale. Directional lights do not count. Leaves a black picture as
/// it is. light_scale: of the captures.
void scale_to_lights(CapturedPicture& picture, double area_m2, std::span<const LightSource> lights,
                     std::span<const CapturedProxyLight> chosen, float light_scale);

}  // namespace gloam
