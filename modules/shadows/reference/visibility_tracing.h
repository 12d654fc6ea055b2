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

/// The model that shadow maps are held against, traced:
/// - The emitter of a point or spot light is a sphere of Light::width_m in diameter; a point sees it as a disc of that
/// diameter which faces
///   the point. A penumbra is then (d_r − d_b) · width / d_b wide, as the maps' filters assume. Of a directional light
///   it is a cone of Light::apparent_angle. Without width there is one ray, to the middle.
/// - Rays begin at the surface under a pixel's centre, kRayStart off along its face normal on the visible side (for
/// subsurface materials:
///   on the light's side), and end kEmitterClearance_m before the disc: a lamp's bulb does not darken it, as what is
///   nearer than a map's near plane is in no map.
/// - What of the emitter is behind the surface itself is hidden by it.
inline constexpr double kEmitterClearance_m = 0.05;
/// Metres, and per metre from the camera: several times what depth buffer and transforms round.
inline constexpr double kRayStart_m = 1e-4;
inline constexpr double kRayStartPerMetre = 2e-5;
/// Samples of pictures that people look at.
inline constexpr std::uint32_t kVisibilitySamples = 256;

/// What visibility is traced from. The world is as the frame's systems left it, the geometry is that frame's.
struct VisibilityInput {
  const World& world;
  const GeometryPicture& geometry;
  const SceneTracer& tracer;
  JobExecutor& executor;
  std::uint32_t samples = kVisibilitySamples;  ///< rays a light and pixel, ≥ 1; powers of two are spread best
  std::function<void(std::size_t done, std::size_t total)>
      progress;  ///< rows of pixels; by one thread at a time; may be empty
};

/// Visibility of every light that casts shadows, at every pixel of the frame that it reaches by range and cone. The
/// same input gives the same bytes, whatever the executor.
[[nodiscard]] TracedVisibility trace_visibility(const VisibilityInput& input);

/// One line that tells what trace_visibility would compute: the same for the same result.
[[nodiscard]] std::string visibility_identity(const VisibilityInput& input);

}  // namespace gloam
