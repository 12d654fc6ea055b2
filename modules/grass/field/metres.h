// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Grass is grown, simulated and culled in metres, because its wind, gravity, stiffness and level of detail are physics.
// Positions of the world in other units (SceneUnits) are converted where they enter, and those of drawn blades where
// they leave (GrassDraws::units_per_metre). All conversions are exact if a unit is a metre.
#pragma once

#include "engine/render/view.h"
#include "engine/scene/units.h"

namespace gloam {

/// Position and frustum of a view in metres. The matrices stay: they map units.
[[nodiscard]] inline RenderView metric_view(RenderView view, double metres_per_unit) {
  view.position *= metres_per_unit;
  for (Plane& plane : view.frustum.planes) plane.distance *= static_cast<float>(metres_per_unit);
  return view;
}

}  // namespace gloam
