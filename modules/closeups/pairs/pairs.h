// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "engine/schedule/schedule.h"
#include "modules/closeups/components.h"
#include "modules/closeups/pairs/views.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"

namespace gloam {

/// Resolved lists of light names, keyed by their number in SceneStrings; a resource.
struct CloseupLightNames {
  std::unordered_map<std::uint32_t, std::vector<Entity>> lights;  ///< each list ascending by index
};

using PairLights = View<const Light, const WorldTransform, Maybe<const LightBounds>, Maybe<const ShadowCaster>>;

/// Creates and destroys entities so that exactly one CloseupPair exists for each combination of a subject with a known
/// box and a shadow-casting light that reaches the subject and is named by it (CloseupSubject::lights). A list with an
/// unknown or ambiguous name matches no light.
void closeup_pairs_system(PairLights lights, View<const CloseupPair> pairs, Resource<const CloseupSubjects> subjects,
                          Resource<const SceneNames> names, Resource<const SceneStrings> strings,
                          Resource<CloseupLightNames> resolved, Commands& commands);

}  // namespace gloam
