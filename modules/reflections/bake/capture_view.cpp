// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/capture_view.h"

namespace gloam {

ViewSettings capture_view(std::uint32_t index) {
  ViewSettings settings;
  settings.id = ViewId{kFirstBakeView.value + index};
  settings.follow_camera = false;
  settings.purpose = ViewPurpose::capture;
  settings.without = {"fog", "particles", "depth_of_field"};
  settings.static_only = true;
  settings.camera_cut = true;
  return settings;
}

void leave_lights_out(ViewSettings& settings) {
  settings.id.value += kBakeViews / 2;
  for (const char* module : {"lights", "shadows", "closeups"}) settings.without.emplace_back(module);
}

bool is_unlit_capture(ViewId view) {
  return view.value >= kFirstBakeView.value + kBakeViews / 2 && view.value < kFirstBakeView.value + kBakeViews;
}

}  // namespace gloam
