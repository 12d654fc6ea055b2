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

/// Lists of light names that have been looked up, by number in SceneStrings; a resource.
struct CloseupLightNames {
  std::unordered_map<std::uint32_t, std::vector<Entity>> lights;  ///< ascending by index
};

using PairLights = View<const Light, const WorldTransform, Maybe<const LightBounds>, Maybe<const ShadowCaster>>;

/// Keeps one entity for every subject with a box and every light that casts its shadow. Names that mean no light, or
/// several, mean none.
void closeup_pairs_system(PairLights lights, View<const CloseupPair> pairs, Resource<const CloseupSubjects> subjects,
                          Resource<const SceneNames> names, Resource<const SceneStrings> strings,
                          Resource<CloseupLightNames> resolved, Commands& commands);

}  // namespace gloam
