// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

/// The light that add_default_light has added; a resource of worlds that have one.
struct DefaultLight {
  Entity sun = kNoEntity;  ///< a directional light that casts shadows
};

/// Gives a scene that draws something but has neither a light nor a sky a soft sky, a low sun from the right of a
/// framed_view(), and an exposure that suits them and how bright the drawn surfaces are, unless the scene sets one.
/// With that exposure, what emits 1 cd/m² in the file looks white, as in programs that show emission and unlit
/// materials in units of the picture. False: nothing was added.
bool add_default_light(World& world, SceneInfo& info);

/// The sentence that tells of it.
inline constexpr const char* kDefaultLightSentence =
    "the scene has no light and no sky, so it gets a soft sky and a low sun; --set scene.default_light=off leaves it "
    "dark";

}  // namespace gloam
