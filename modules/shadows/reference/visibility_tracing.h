// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/render/reference/scene_tracer.h"
#include "modules/shadows/filter/traced_visibility.h"

namespace gloam {

/// The model of the reference that shadow maps are compared with:
/// - The emitter of a point or spot light is a sphere with diameter Light::width_m. A receiver sees it as a disc of
///   that diameter that faces the receiver, so that a penumbra is (d_r − d_b) · width / d_b wide, as the filters
///   assume. The emitter of a directional light is a cone of Light::apparent_angle. Without width, one ray goes to the
///   centre.
/// - Rays begin at the surface under a pixel's centre, offset along its face normal to the visible side (subsurface
///   materials: to the light's side) by GeometryPicture::error_share of their distance from the camera. They end at the
///   disc, short of it by their rounding.
/// - Where the geometry has smooth surfaces (shadows.terminator), rays begin there, and the smooth surface's normal
///   takes the place of the face normal. Subsurface materials are left out, as by the filters.
/// - Bulbs (modules/shadows/views/bulbs.h) do not block the light that they belong to.
/// - A ray that leaves below the receiver's surface, by more than kBehindSine, is blocked, unless the material is
///   subsurface: the surface is opaque, even if the mesh behind it is open.
/// - Where light from behind passes (GeometryPicture::extinction_m(), by the shading normal), a ray counts by
///   exp(−way inside the receiver's body / extinction length), and is blocked by anything else on it.
/// Sine of an angle below the surface, several times the rounding error of face normals, which have 16 bits a
/// component.
inline constexpr double kBehindSine = 2e-4;
/// Default number of rays per light and pixel.
inline constexpr std::uint32_t kVisibilitySamples = 256;

/// Input of trace_visibility(). The world is as the frame's systems left it; the geometry is that frame's.
struct VisibilityInput {
  const World& world;
  const GeometryPicture& geometry;
  const SceneTracer& tracer;
  JobExecutor& executor;
  std::uint32_t samples = kVisibilitySamples;  ///< rays per light and pixel, ≥ 1; powers of two are spread best
  /// Reports rows of pixels that are done; called by one thread at a time; may be empty.
  std::function<void(std::size_t done, std::size_t total)> progress;
};

/// The visibility of every casting light at every pixel that it reaches by range and cone. The result depends on the
/// input only, not on the executor.
[[nodiscard]] TracedVisibility trace_visibility(const VisibilityInput& input);

/// One line that identifies the result of trace_visibility(): the same for the same result.
[[nodiscard]] std::string visibility_identity(const VisibilityInput& input);

}  // namespace gloam
