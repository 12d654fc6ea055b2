// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/reflections/case.h"

#include <array>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>

#include "engine/core/hash.h"
#include "sandbox/bench/harness/camera_path.h"
#include "sandbox/bench/shadows/phases.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

constexpr const char* kCourtyardFile = "../shared/scenes/courtyard/courtyard.gltf";
constexpr std::size_t kDownEvery = 10;

/// There and back along the street, inside its outline.
constexpr std::array<PathKey, 10> kStreetWalk = {{{{-0.5, 1.7, 6.0}, {0.0, 0.8, -4.0}},
                                                  {{0.4, 1.7, 1.0}, {-1.2, 0.0, -4.0}},
                                                  {{-0.3, 1.7, -5.0}, {4.5, 0.6, -10.0}},
                                                  {{0.2, 1.7, -11.0}, {-0.6, 0.0, -16.0}},
                                                  {{-0.2, 1.7, -17.5}, {0.2, 1.2, -30.0}},
                                                  {{0.3, 1.7, -19.5}, {8.0, 0.0, -20.5}},
                                                  {{0.0, 1.7, -16.0}, {-3.0, 0.5, -10.0}},
                                                  {{-0.6, 1.7, -9.0}, {-4.5, 0.4, -6.5}},
                                                  {{0.5, 1.7, -4.0}, {1.5, 0.0, -0.5}},
                                                  {{0.2, 1.7, 2.0}, {0.8, 1.0, 9.0}}}};

bool is_main(const PassTime& pass) { return pass.view == 0; }  // ViewId of Session::view_settings

dmat4 turned_down(const dmat4& pose) {
  const dvec3 eye(pose[3]);
  return glm::translate(dmat4(1.0), eye) * glm::mat4_cast(rotation_towards({0.0, -1.0, 0.0}));
}

}  // namespace

std::optional<std::string> courtyard_scene(const BenchContext& context) {
  const Options& options = context.options();
  if (!options.scene_is_default && !is_builtin(options.scene) && scene_stem(options.scene).starts_with("courtyard"))
    return options.scene;
  std::error_code ignored;
  if (std::filesystem::exists(kCourtyardFile, ignored)) return kCourtyardFile;
  return std::nullopt;
}

std::string no_courtyard() { return std::string("there is no ") + kCourtyardFile + " and --scene names no courtyard"; }

ReflectionFrames::ReflectionFrames(Session& session, std::uint32_t width, std::uint32_t height)
    : session_(session), settings_(session.view_settings(width, height, "none")) {}

ReflectionFrames::~ReflectionFrames() {
  for (const auto& [knob, value] : users_) static_cast<void>(session_.renderer->knobs().set(knob, value));
}

Status ReflectionFrames::set(const std::string& knob, const std::string& value) {
  KnobRegistry& knobs = session_.renderer->knobs();
  if (const Knob* known = knobs.find(knob)) users_.try_emplace(knob, knobs.text(*known));
  return knobs.set(knob, value);
}

Result<FrameSample> ReflectionFrames::draw() {
  auto sample = session_.render_frame({settings_, {}});
  settings_.camera_cut = false;
  return sample;
}

void ReflectionFrames::look_from(const dmat4& pose) {
  settings_.follow_camera = false;
  settings_.world_from_camera = pose;
}

Result<LinearPicture> ReflectionFrames::linear() { return session_.renderer->read_linear(settings_.id); }

Result<std::uint64_t> ReflectionFrames::hash() {
  const auto light = linear();
  if (!light) return light.error();
  return hash_of_light(*light);
}

Result<FrameSample> draw_in_mode(ReflectionFrames& frames, const char* mode, std::uint64_t& hash) {
  GLOAM_TRY(frames.set("reflections.mode", mode));
  auto sample = frames.draw();
  if (!sample) return sample.error();
  const auto light = frames.hash();
  if (!light) return light.error();
  hash = *light;
  return sample;
}

double reflection_ms(const FrameSample& sample) {
  double ms = 0.0;
  for (const PassTime& pass : sample.report.passes) ms += is_main(pass) && pass.module == "reflections" ? pass.ms : 0.0;
  return ms;
}

double companion_ms(const FrameSample& sample) {
  double ms = 0.0;
  for (const PassTime& pass : sample.report.passes) ms += is_main(pass) || makes_shadow_maps(pass) ? 0.0 : pass.ms;
  return ms;
}

std::vector<dmat4> recorded_walk(const Session& session, const std::string& scene, std::size_t count, bool down) {
  std::vector<PathKey> keys(kStreetWalk.begin(), kStreetWalk.end());
  if (scene != kWetStreet) keys = path_through_cameras(session.world, session.info);
  std::vector<dmat4> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const dmat4 pose = path_pose(keys, i, count);
    poses.push_back(down && i % kDownEvery == kDownEvery - 1 ? turned_down(pose) : pose);
  }
  return poses;
}

std::uint64_t hash_of_light(const LinearPicture& picture) { return hash_bytes(std::as_bytes(std::span(picture.rgba))); }

}  // namespace gloam
