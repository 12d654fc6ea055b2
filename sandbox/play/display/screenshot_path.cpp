// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/screenshot_path.h"

#include <filesystem>
#include <system_error>

#include "engine/core/text/formatted.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {

std::string screenshot_path(const std::string& scene) {
  std::string path;
  std::error_code fault;
  for (int number = 1; path.empty() || std::filesystem::exists(path, fault); ++number)
    path = formatted("out/%s-%03d.png", scene_stem(scene).c_str(), number);
  return path;
}

}  // namespace gloam
