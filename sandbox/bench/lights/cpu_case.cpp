// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/lights/cpu_case.h"

#include <bit>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <random>
#include <span>

#include "engine/core/assert.h"
#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/render/view.h"
#include "engine/scene/gltf/import.h"
#include "modules/lights/module.h"
#include "modules/lights/selection/light_list.h"

namespace gloam::bench {
namespace {

constexpr std::size_t kMoments = 4;
constexpr double kLightCaseTurn = 0.01;  // radians per frame
constexpr double kMove = 0.05;           // metres per frame
constexpr float kLightCaseFov = 1.0471975512f;
constexpr ViewId kView{0};

/// Uniform numbers that are the same with every standard library.
class Draw {
 public:
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  dvec3 direction() {
    const double z = (*this)(-1.0, 1.0);
    const double turn = (*this)(0.0, 6.283185307179586);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(turn), across * std::sin(turn), z};
  }

 private:
  std::mt19937 engine_{7};
};

struct Placed {
  Light light;
  dvec3 position;
  dvec3 axis;  ///< the node is turned about it by angle
  double angle = 0.0;
};

Placed draw_light(Draw& draw, const LightCpuScene& scene, std::uint32_t i) {
  Placed placed;
  placed.light.kind = i % 2 == 0 ? LightKind::point : LightKind::spot;
  placed.light.intensity = static_cast<float>(draw(1.0, 100.0));
  placed.light.range_m = static_cast<float>(draw(scene.least_radius_m, scene.greatest_radius_m));
  placed.light.outer_angle = static_cast<float>(draw(0.2, 1.0));
  placed.light.inner_angle = placed.light.outer_angle * 0.7f;
  const double depth = draw(1.0, 100.0);
  const double high = std::tan(0.5 * static_cast<double>(kLightCaseFov)) * depth;
  const double wide = high * scene.width / scene.height;
  placed.position = dvec3(draw(-wide, wide), draw(-high, high), -depth);
  placed.axis = draw.direction();
  placed.angle = draw(0.0, 3.1);
  return placed;
}

}  // namespace

LightCpuCase::LightCpuCase(const LightCpuScene& scene) : scene_(scene), module_(make_lights_module()) {
  prepare_scene_world(world_);
  module_->register_components(world_);
  module_->add_systems(schedule_);
  module_->knobs(knobs_);
  Draw draw;
  std::vector<Placed> placed;
  for (std::uint32_t i = 0; i < scene.lights; ++i) {
    placed.push_back(draw_light(draw, scene, i));
    const Entity entity = i % 3 == 0 ? world_.create(placed.back().light, WorldTransform{}, Parent{})
                                     : world_.create(placed.back().light, WorldTransform{});
    entities_.push_back(entity);
  }
  for (std::size_t m = 0; m < kMoments; ++m) {
    Moment moment;
    const double at = static_cast<double>(m);
    for (const Placed& p : placed) {
      const dmat4 stands = glm::translate(dmat4(1.0), p.position + kMove * at * p.axis);
      moment.lights.push_back(glm::rotate(stands, p.angle + kLightCaseTurn * at, p.axis));
    }
    moment.camera = glm::rotate(dmat4(1.0), kLightCaseTurn * at, dvec3(0.0, 1.0, 0.0));
    moments_.push_back(std::move(moment));
  }
}

void LightCpuCase::set_knob(const char* name, const char* value) {
  const Status status = knobs_.set(name, value);
  GLOAM_ASSERT(status.ok(), "benches set knobs that exist");
}

void LightCpuCase::move() {
  const Moment& moment = moments_[next_++ % moments_.size()];
  for (std::size_t i = 0; i < entities_.size(); ++i) world_.get<WorldTransform>(entities_[i]).matrix = moment.lights[i];
  ViewSettings settings;
  settings.id = kView;
  settings.width = scene_.width;
  settings.height = scene_.height;
  settings.camera.fov_y = kLightCaseFov;
  settings.world_from_camera = moment.camera;
  world_.set_view_resource(kView, make_view(settings, next_));
  module_->prepare_view(world_, kView, knobs_);
}

void LightCpuCase::run(JobExecutor& executor) {
  schedule_.run(Stage::world, world_, executor);
  schedule_.run_view(kView, world_, executor);
}

std::size_t LightCpuCase::bytes_written() const {
  const auto& visible = world_.view_resource<VisibleLights>(kView);
  const std::size_t lights = visible.block.local_count;
  return lights * (sizeof(shaders::LocalLight) + sizeof(Entity) + sizeof(LightDepth) + sizeof(MaskLight)) +
         std::as_bytes(std::span(world_.view_resource<ZBins>(kView).bins)).size() +
         std::as_bytes(std::span(world_.view_resource<TileLightMasks>(kView).words)).size();
}

double LightCpuCase::lights_per_tile() const {
  const std::vector<std::uint32_t>& words = world_.view_resource<TileLightMasks>(kView).words;
  std::size_t bits = 0;
  for (std::size_t tile = 0; tile < words.size(); tile += GLOAM_MASK_WORDS) {
    for (std::uint32_t group = 0; group < GLOAM_LIGHT_GROUPS; ++group)
      if ((words[tile] >> group & 1u) != 0) bits += static_cast<std::size_t>(std::popcount(words[tile + 1 + group]));
  }
  return static_cast<double>(bits) / (static_cast<double>(words.size()) / GLOAM_MASK_WORDS);
}

std::uint64_t LightCpuCase::hash() const {
  Hasher hasher;
  for (const ZBin& bin : world_.view_resource<ZBins>(kView).bins) hasher.value(bin.begin).value(bin.end);
  const std::vector<std::uint32_t>& words = world_.view_resource<TileLightMasks>(kView).words;
  for (std::size_t tile = 0; tile < words.size(); tile += GLOAM_MASK_WORDS) {
    hasher.value(words[tile]);
    for (std::uint32_t group = 0; group < GLOAM_LIGHT_GROUPS; ++group)
      if ((words[tile] >> group & 1u) != 0) hasher.value(words[tile + 1 + group]);
  }
  return hasher.digest();
}

}  // namespace gloam::bench
