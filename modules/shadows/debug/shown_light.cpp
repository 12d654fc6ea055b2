// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/shown_light.h"

#include <algorithm>
#include <span>
#include <string>

#include "engine/scene/resources.h"
#include "modules/lights/outputs.h"

namespace gloam {

std::optional<shaders::ShownLightConstants> shown_light(const FrameBuilder& frame, std::string_view name) {
  const auto entity = frame.world().resource<SceneNames>().find("light", name);
  if (!entity.ok()) return std::nullopt;
  const auto& visible = frame.world().view_resource<VisibleLights>(frame.view().id);
  std::uint32_t directional = 0;
  for (const std::span<const Entity> lights : {local_lights(visible), directional_lights(visible)}) {
    const auto at = std::find(lights.begin(), lights.end(), *entity);
    if (at != lights.end())
      return shaders::ShownLightConstants{static_cast<std::uint32_t>(at - lights.begin()), directional};
    ++directional;
  }
  return std::nullopt;
}

std::optional<shaders::ShownLightConstants> shown_light_or_warn(const FrameBuilder& frame, OnceLog& once_log) {
  const std::string_view shown = frame.visualizer();
  const auto light = shown_light(frame, shown.substr(shown.find(':') + 1));
  if (!light) {
    LogCategory log(frame.services().log, frame.module());
    once_log.warning(log,
                     "view " + std::string(shown) + " shows the picture as it is: the light reaches nothing in view");
  }
  return light;
}

}  // namespace gloam
