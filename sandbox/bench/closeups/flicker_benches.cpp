// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/scene/resources.h"
#include "modules/closeups/components.h"
#include "sandbox/bench/closeups/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/bench/shadows/phases.h"
#include "sandbox/bench/shadows/variant.h"
#include "sandbox/scenes/lamps/closeups.h"

// Error of the changes of visibility from frame to frame, against traced changes, while a subject walks with swinging
// arms under one lamp: close-ups compared with standard maps that have as many texels (see benches.cpp).

namespace gloam {
namespace {

constexpr std::uint32_t kFlickerWidth = 320, kHeight = 180;
constexpr std::size_t kFlickerFrames = 120;
constexpr double kFlickerFrame_s = 1.0 / 60.0;
constexpr double kFlickerSpeed = 1.2;  // metres per second
constexpr std::uint32_t kFlickerSamples = 64;
constexpr const char* kFlickerMostPairs = "8";
constexpr int kFlickerMostDraws = 6;

dquat turned_by(double angle, const dvec3& axis) { return {std::cos(0.5 * angle), std::sin(0.5 * angle) * axis}; }

/// A figure of the built-in scene and its parts at rest.
struct Walker {
  Entity root;
  std::vector<std::pair<Entity, LocalTransform>> arms;  ///< arms and fingers
};

Result<Walker> find_walker(World& world) {
  Walker walker;
  // Only one subject is enabled.
  world.view<const CloseupSubject>().each([&](Entity entity, const CloseupSubject& subject) {
    if (subject.enabled) walker.root = entity;
  });
  if (!world.alive(walker.root)) return Error{ErrorKind::failed, "the scene has no close-up subject"};
  constexpr double kShoulder = 0.2;  // metres from the figure's axis; parts farther out belong to an arm
  world.view<const Parent, const LocalTransform>().each(
      [&](Entity entity, const Parent& parent, const LocalTransform& local) {
        if (parent.entity == walker.root && std::abs(local.translation.x) > kShoulder)
          walker.arms.emplace_back(entity, local);
      });
  return walker;
}

void pose(World& world, const Walker& walker, std::size_t frame) {
  const double time_s = kFlickerFrame_s * static_cast<double>(frame);
  auto& root = world.get<LocalTransform>(walker.root);
  root.translation = dvec3(-1.9 + kFlickerSpeed * time_s, 0.0, 1.7);
  root.rotation = turned_by(1.5707963267948966, dvec3(0.0, 1.0, 0.0));
  const double swing = 0.5 * std::sin(6.0 * time_s);
  for (const auto& [part, rest] : walker.arms) {
    const double side = rest.translation.x < 0.0 ? 1.0 : -1.0;
    const dquat turn = turned_by(side * swing, dvec3(1.0, 0.0, 0.0));
    const dvec3 shoulder(rest.translation.x, 1.2, 0.04);
    auto& local = world.get<LocalTransform>(part);
    local.translation = shoulder + turn * (rest.translation - shoulder);
    local.rotation = turn * rest.rotation;
  }
}

/// Visibilities of one lamp, per frame and pixel.
struct FlickerWalk {
  std::vector<std::vector<float>> with;  ///< below 0 where the lamp does not reach
  std::vector<std::vector<float>> standard;
  std::vector<TracedVisibility> traced;
  std::vector<std::vector<std::uint8_t>> facing;
};

struct Flicker {
  double with = 0.0;  ///< mean error over changing pixels
  double standard = 0.0;
  double texels = 0.0;
  double texels_standard = 0.0;
  std::uint64_t with_hash = 0;  ///< of all frames' visibilities, drawn and traced
  std::uint64_t standard_hash = 0;
  [[nodiscard]] std::uint64_t hash() const { return hash_of_both(with_hash, standard_hash); }
};

std::uint64_t hash_of_walk(const std::vector<std::vector<float>>& drawn, const std::vector<TracedVisibility>& traced) {
  Hasher hasher;
  for (const std::vector<float>& frame : drawn) hasher.bytes(std::as_bytes(std::span(frame)));
  for (const TracedVisibility& frame : traced) hasher.bytes(std::as_bytes(std::span(frame.visibility)));
  return hasher.digest();
}

/// Draws the frame again until it has no fallback tiles.
Status draw_with_room(ShadowCase& shadows) {
  for (int i = 0; i < kFlickerMostDraws; ++i) {
    const auto sample = shadows.draw();
    if (!sample) return sample.error();
    if (lists_had_room(sample->report)) return {};
  }
  return Error{ErrorKind::failed, "tiles find no room for their lights, however often a frame is drawn"};
}

Result<std::uint64_t> most_closeup_texels(ShadowCase& shadows, const Walker& walker) {
  GLOAM_TRY(shadows.set("closeups.max_pairs", kFlickerMostPairs));
  std::uint64_t most = 0;
  for (std::size_t frame = 0; frame < kFlickerFrames; ++frame) {
    pose(shadows.session().world, walker, frame);
    if (auto sample = shadows.draw(); !sample) return sample.error();
    most = std::max(most, map_texels(shadows.session()).closeups);
  }
  return most;
}

Status trace_frame(Session& session, Entity lamp, FlickerWalk& walk) {
  const ViewId view = session.view_settings(kFlickerWidth, kHeight, "none").id;
  const auto geometry = session.renderer->read_geometry(session.world, view);
  if (!geometry) return geometry.error();
  auto rays = trace_lights(session, *geometry, {&lamp, 1}, kFlickerSamples);
  if (!rays) return rays.error();
  if (rays->lights.empty()) return Error{ErrorKind::failed, "the lamp reaches no pixel"};
  walk.traced.push_back(std::move(*rays));
  walk.facing.push_back(pixels_that_face(session.world, *geometry, lamp));
  return {};
}

/// Draws the walk with the current knobs, and traces it too unless `traced` is null. most: raised to the largest number
/// of texels of all maps in a frame.
Status draw_flicker_walk(ShadowCase& shadows, const Walker& walker, Entity lamp, std::vector<std::vector<float>>& drawn,
                         FlickerWalk* traced, double& most) {
  Session& session = shadows.session();
  for (std::size_t frame = 0; frame < kFlickerFrames; ++frame) {
    pose(session.world, walker, frame);
    GLOAM_TRY(draw_with_room(shadows));
    most = std::max(most, static_cast<double>(map_texels(session).total()));
    if (traced != nullptr) GLOAM_TRY(trace_frame(session, lamp, *traced));
    auto visibility = shadows.drawn(lamp);
    if (!visibility) return visibility.error();
    drawn.push_back(std::move(*visibility));
  }
  return {};
}

Flicker flicker_of(const FlickerWalk& walk) {
  Flicker flicker;
  double changing = 0.0;
  for (std::size_t t = 1; t < kFlickerFrames; ++t) {
    const TracedVisibility &now = walk.traced[t], &before = walk.traced[t - 1];
    for (std::size_t pixel = 0; pixel < now.pixels(); ++pixel) {
      const float values[] = {walk.with[t][pixel], walk.with[t - 1][pixel], walk.standard[t][pixel],
                              walk.standard[t - 1][pixel]};
      if (walk.facing[t][pixel] == 0 || walk.facing[t - 1][pixel] == 0) continue;
      if (!now.is_judged(pixel) || !before.is_judged(pixel) || *std::ranges::min_element(values) < 0.0f) continue;
      const double right = (now.visibility[pixel] - before.visibility[pixel]) / 255.0;
      const double with = static_cast<double>(values[0]) - static_cast<double>(values[1]);
      const double standard = static_cast<double>(values[2]) - static_cast<double>(values[3]);
      if (right == 0.0 && with == 0.0 && standard == 0.0) continue;
      flicker.with += std::abs(with - right);
      flicker.standard += std::abs(standard - right);
      changing += 1.0;
    }
  }
  flicker.with /= std::max(changing, 1.0);
  flicker.standard /= std::max(changing, 1.0);
  return flicker;
}

Result<Flicker> measure_flicker(BenchContext& context) {
  auto session = context.open_builtin(kCloseupScene);
  if (!session) return session.error();
  World& world = (*session)->world;
  keep_closeup_figures(world, 1);
  const auto lamp = world.resource<SceneNames>().find("light", "lamp 2");
  if (!lamp) return lamp.error();
  const OnlyCasting only(world, {&*lamp, 1});
  const auto walker = find_walker(world);
  if (!walker) return walker.error();
  ShadowCase shadows(**session, kFlickerWidth, kHeight);
  GLOAM_TRY(shadows.set("shadows.mode", "deferred"));
  const auto most = most_closeup_texels(shadows, *walker);
  if (!most) return most.error();
  pose(world, *walker, 0);
  const auto texels = find_equal_texels(shadows, kFlickerMostPairs, *most);
  if (!texels) return texels.error();
  FlickerWalk both;
  double texels_with = 0.0, texels_standard = 0.0;
  GLOAM_TRY(use_closeups(shadows, *texels, kFlickerMostPairs));
  GLOAM_TRY(draw_flicker_walk(shadows, *walker, *lamp, both.with, &both, texels_with));
  GLOAM_TRY(use_standard(shadows, *texels));
  GLOAM_TRY(draw_flicker_walk(shadows, *walker, *lamp, both.standard, nullptr, texels_standard));
  Flicker flicker = flicker_of(both);
  flicker.texels = texels_with;
  flicker.texels_standard = texels_standard;
  flicker.with_hash = hash_of_walk(both.with, both.traced);
  flicker.standard_hash = hash_of_walk(both.standard, both.traced);
  return flicker;
}

}  // namespace

void add_closeup_flicker_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<Flicker>>();
  const auto add = [&](const char* id, const char* unit, std::optional<double> bar,
                       std::function<BenchValue(const Flicker&)> value) {
    BenchRow row;
    row.id = std::string("closeups.") + id;
    row.unit = unit;
    row.bar = bar;
    row.run = [shared, value = std::move(value)](BenchContext& context) -> Result<BenchValue> {
      const auto flicker = shared->get([&] { return measure_flicker(context); });
      if (!flicker) return flicker.error();
      BenchValue result = value(**flicker);
      result.scene = kCloseupScene;
      return result;
    };
    registry.add(std::move(row));
  };
  using F = Flicker;
  add("flicker_over_standard", "ratio", 1.0,
      [](const F& f) { return single_value(f.standard > 0.0 ? f.with / f.standard : 0.0, f.hash()); });
  add("flicker", "visibility a frame", std::nullopt, [](const F& f) { return single_value(f.with, f.with_hash); });
  add("flicker_standard", "visibility a frame", std::nullopt,
      [](const F& f) { return single_value(f.standard, f.standard_hash); });
  add("flicker_texels", "texels", std::nullopt, [](const F& f) { return single_value(f.texels, f.with_hash); });
  add("flicker_texels_standard", "texels", std::nullopt,
      [](const F& f) { return single_value(f.texels_standard, f.standard_hash); });
}

}  // namespace gloam
