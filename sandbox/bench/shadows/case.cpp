// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/shadows/case.h"

#include <cstring>
#include <span>

#include "engine/core/hash.h"
#include "engine/scene/resources.h"
#include "modules/accuracy/module.h"
#include "modules/shadows/reference/adapter.h"

namespace gloam {
namespace {

constexpr std::uint32_t kShadowCaseSamples = 256;

}  // namespace

ShadowCase::ShadowCase(Session& session, std::uint32_t width, std::uint32_t height)
    : session_(session), settings_(session.view_settings(width, height, "none")) {
  static_cast<void>(set("shadows.mode", "monolithic"));  // cannot fail: the knob and the value exist
}

ShadowCase::~ShadowCase() {
  for (const auto& [knob, value] : users_) static_cast<void>(session_.renderer->knobs().set(knob, value));
}

Status ShadowCase::set(const std::string& knob, const std::string& value) {
  KnobRegistry& knobs = session_.renderer->knobs();
  if (const Knob* known = knobs.find(knob)) users_.try_emplace(knob, knobs.text(*known));
  return knobs.set(knob, value);
}

void ShadowCase::set_back(const std::string& knob) {
  const auto found = users_.find(knob);
  if (found != users_.end()) static_cast<void>(session_.renderer->knobs().set(knob, found->second));
}

Result<FrameSample> ShadowCase::draw(const std::string& visualizer) {
  settings_.visualizer = visualizer;
  return session_.render_frame({settings_, {}});
}

Result<const TracedVisibility*> ShadowCase::traced() {
  if (traced_) return &*traced_;
  if (auto frame = draw(); !frame) return frame.error();
  auto geometry = session_.renderer->read_geometry(session_.world, settings_.id);
  if (!geometry) return geometry.error();
  auto tracer = make_scene_tracer(session_.world, *session_.executor, geometry->view.position);
  if (!tracer) return tracer.error();
  traced_ = trace_visibility({.world = session_.world,
                              .geometry = *geometry,
                              .tracer = **tracer,
                              .executor = *session_.executor,
                              .samples = kShadowCaseSamples,
                              .progress = {}});
  return &*traced_;
}

std::string ShadowCase::name_of(Entity light) {
  auto& names = session_.world.resource<SceneNames>();
  std::string alias = "#" + std::to_string(light.index);
  if (!names.find("light", alias).ok()) names.add("light", alias, light);
  return alias;
}

Result<std::vector<float>> ShadowCase::drawn(Entity light) {
  if (auto frame = draw("shadow:" + name_of(light)); !frame) return frame.error();
  const auto image = session_.renderer->read_image(session_.world, settings_.id, "shadow_visibility");
  if (!image) return image.error();
  std::vector<float> visibility(std::size_t{image->width} * image->height);
  std::memcpy(visibility.data(), image->bytes.data(), visibility.size() * sizeof(float));
  return visibility;
}

Result<JudgedShadows> ShadowCase::error() {
  const auto truth = traced();
  if (!truth) return truth.error();
  JudgedShadows sum;
  Hasher hasher;
  hasher.bytes(std::as_bytes(std::span((*truth)->visibility)));
  for (std::uint32_t layer = 0; layer < (*truth)->lights.size(); ++layer) {
    const auto visibility = drawn((*truth)->lights[layer]);
    if (!visibility) return visibility.error();
    sum += compare_visibility(**truth, layer, *visibility);
    hasher.bytes(std::as_bytes(std::span(*visibility)));
  }
  sum.hash = hasher.digest();
  return sum;
}

Result<std::uint64_t> ShadowCase::picture_hash() {
  const auto picture = session_.renderer->read_picture(settings_.id);
  if (!picture) return picture.error();
  return hash_bytes(std::as_bytes(std::span(picture->rgba)));
}

Result<std::uint64_t> ShadowCase::image_hash(std::string_view name) {
  const auto image = session_.renderer->read_image(session_.world, settings_.id, name);
  if (!image) return image.error();
  return hash_bytes(image->bytes);
}

Result<Picture> ShadowCase::picture() { return session_.renderer->read_picture(settings_.id); }

void ShadowCase::look_from(const dmat4& pose) {
  settings_.follow_camera = false;
  settings_.world_from_camera = pose;
}

double pass_ms(const FrameSample& sample, std::string_view name) {
  double ms = 0.0;
  for (const PassTime& pass : sample.report.passes) ms += pass.name == name ? pass.ms : 0.0;
  return ms;
}

}  // namespace gloam
