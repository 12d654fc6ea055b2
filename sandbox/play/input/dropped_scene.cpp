// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/dropped_scene.h"

#include "engine/core/result.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {

std::string dropped_scene(const std::vector<std::string>& paths, LogSink& log) {
  std::string last;
  for (const std::string& path : paths) {
    const bool scene = path.ends_with(".gltf") || path.ends_with(".glb");
    const Status exists =
        scene ? check_scene_exists(path) : Status(Error{ErrorKind::input, path + ": is no scene: .gltf or .glb"});
    if (exists.ok())
      last = path;
    else
      log.warning(exists.error().message);
  }
  return last;
}

}  // namespace gloam
