// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/commands/cost_cameras.h"

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <utility>

#include "engine/core/text/formatted.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
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

/// An orthonormal basis, right-handed: the camera's axes without scale and mirror.
dquat orientation_of(const dmat4& matrix) {
  const dvec3 back = glm::normalize(dvec3(matrix[2]));
  const dvec3 right = glm::normalize(glm::cross(dvec3(matrix[1]), back));
  return glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)));
}

/// The cameras of the path; at least two.
Result<std::vector<std::string>> path_cameras(const Options& options, const Session& session) {
  std::vector<std::string> names;
  if (options.camera.empty() && options.cameras.empty()) {
    names = session.world.resource<SceneNames>().names("camera");
  } else {
    auto given = camera_names(options);
    if (!given) return given.error();
    names = std::move(given).value();
  }
  if (names.size() >= 2) return names;
  return Error{ErrorKind::usage, "--path needs a scene with an animation, or two cameras to lead through; " +
                                     options.scene + " has no animation, and " +
                                     (names.empty() ? "no camera with a name" : "the path has one camera")};
}

Result<std::vector<MeasuredCamera>> path_through_cameras(const Options& options, const Session& session) {
  const auto names = path_cameras(options, session);
  if (!names) return names.error();
  for (const std::string& name : *names)
    if (const auto camera = find_camera(session.world, session.info, name); !camera) return camera.error();
  std::vector<MeasuredCamera> all;
  const auto legs = static_cast<double>(names->size() - 1);
  for (std::uint32_t position = 0; position < kPathTimes; ++position) {
    const double way = legs * position / (kPathTimes - 1);
    const auto leg = static_cast<std::size_t>(way);
    MeasuredCamera& own = all.emplace_back(MeasuredCamera{.options = options, .part = way - static_cast<double>(leg)});
    own.options.camera = (*names)[leg];
    if (own.part > 0.0) own.towards = (*names)[leg + 1];
  }
  return all;
}

Camera camera_between(const Camera& from, const Camera& to, double part) {
  Camera camera = from;
  if (from.orthographic != to.orthographic) return camera;
  const auto mix = [part](float a, float b) { return static_cast<float>(a + (b - a) * part); };
  camera.fov_y = mix(from.fov_y, to.fov_y);
  camera.half_width_m = mix(from.half_width_m, to.half_width_m);
  camera.half_height_m = mix(from.half_height_m, to.half_height_m);
  return camera;
}

}  // namespace

std::string MeasuredCamera::name() const {
  return towards.empty() ? options.camera : options.camera + " to " + towards + formatted(", %.2g of the way", part);
}

dmat4 pose_between(const dmat4& from, const dmat4& to, double part) {
  const dquat turn = glm::slerp(orientation_of(from), orientation_of(to), part);
  const dvec3 place = glm::mix(dvec3(from[3]), dvec3(to[3]), part);
  return glm::translate(dmat4(1.0), place) * glm::mat4_cast(turn);
}

Result<std::vector<MeasuredCamera>> measured_cameras(const Options& options, const Session& session) {
  const double duration_s = options.path ? longest_animation_s(session.world) : 0.0;
  if (options.path && duration_s <= 0.0) return path_through_cameras(options, session);
  const auto names = camera_names(options);
  if (!names) return names.error();
  std::vector<MeasuredCamera> all;
  for (const std::string& name : *names) {
    const auto camera = find_camera(session.world, session.info, name);
    if (!camera) return camera.error();
    for (std::uint32_t time = 0; time < (options.path ? kPathTimes : 1); ++time) {
      Options& own = all.emplace_back(MeasuredCamera{.options = options}).options;
      own.camera = name;
      own.time_s += duration_s * time / kPathTimes;
    }
  }
  return all;
}

Status place_camera(const MeasuredCamera& measured, Session& session) {
  const auto camera = find_camera(session.world, session.info, measured.options.camera);
  if (!camera) return camera.error();
  session.camera = *camera;
  if (measured.towards.empty()) return {};
  const auto next = find_camera(session.world, session.info, measured.towards);
  if (!next) return next.error();
  World& world = session.world;
  const dmat4 pose =
      pose_between(world.get<WorldTransform>(*camera).matrix, world.get<WorldTransform>(*next).matrix, measured.part);
  world.add(*camera, camera_between(world.get<Camera>(*camera), world.get<Camera>(*next), measured.part));
  world.remove<Parent>(*camera);
  world.remove<LocalMatrix>(*camera);
  world.add(*camera, LocalTransform{.translation = dvec3(pose[3]), .rotation = glm::quat_cast(glm::dmat3(pose))});
  world.add(*camera, WorldTransform{pose});
  return {};
}

}  // namespace gloam
