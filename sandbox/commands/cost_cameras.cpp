// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/commands/cost_cameras.h"

#include <algorithm>
#include <string>

#include "engine/scene/assets.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

/// The names of --cameras; the one of --camera without it.
Result<std::vector<std::string>> camera_names(const Options& options) {
  if (options.cameras.empty()) return std::vector<std::string>{options.camera};
  std::vector<std::string> names;
  std::size_t begin = 0;
  while (begin <= options.cameras.size()) {
    const std::size_t end = std::min(options.cameras.find(',', begin), options.cameras.size());
    const std::string name = options.cameras.substr(begin, end - begin);
    if (name.empty()) return Error{ErrorKind::usage, "--cameras wants names with commas between them"};
    if (std::ranges::find(names, name) != names.end())
      return Error{ErrorKind::usage, "--cameras names '" + name + "' twice"};
    names.push_back(name);
    begin = end + 1;
  }
  return names;
}

double longest_animation_s(const World& world) {
  double longest_s = 0.0;
  for (const AnimationClip& clip : world.resource<SceneAssets>().clips)
    longest_s = std::max(longest_s, static_cast<double>(clip.duration_s));
  return longest_s;
}

}  // namespace

Result<std::vector<Options>> options_of_cameras(const Options& options, const Session& session) {
  const auto names = camera_names(options);
  if (!names) return names.error();
  const double duration_s = options.path ? longest_animation_s(session.world) : 0.0;
  if (options.path && duration_s <= 0.0)
    return Error{ErrorKind::usage, "--path needs a scene with an animation; " + options.scene + " has none"};
  std::vector<Options> all;
  for (const std::string& name : *names) {
    const auto camera = find_camera(session.world, session.info, name);
    if (!camera) return camera.error();
    for (std::uint32_t time = 0; time < (options.path ? kPathTimes : 1); ++time) {
      Options& own = all.emplace_back(options);
      own.camera = name;
      own.time_s += duration_s * time / kPathTimes;
    }
  }
  return all;
}

}  // namespace gloam
