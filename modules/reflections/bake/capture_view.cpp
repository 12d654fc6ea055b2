// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/capture_view.h"

namespace gloam {

ViewSettings capture_view(std::uint32_t index) {
  ViewSettings settings;
  settings.id = ViewId{kFirstBakeView.value + index};
  settings.follow_camera = false;
  settings.purpose = ViewPurpose::capture;
  settings.without = {"fog", "particles", "reflections", "grass", "depth_of_field"};
  settings.static_only = true;
  settings.camera_cut = true;
  return settings;
}

void leave_lights_out(ViewSettings& settings) {
  for (const char* module : {"lights", "shadows", "closeups"}) settings.without.emplace_back(module);
}

}  // namespace gloam
