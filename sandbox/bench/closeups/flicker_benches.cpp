// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/resources.h"
#include "modules/closeups/components.h"
#include "sandbox/bench/closeups/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/bench/shadows/phases.h"
#include "sandbox/bench/shadows/variant.h"
#include "sandbox/scenes/closeups.h"

// How far changes of visibility from frame to frame are off traced ones while a subject walks with swinging arms:
// close-ups against standard maps with as many texels (closeup_benches.cpp), under one lamp.

namespace gloam {
namespace {

constexpr std::uint32_t kWidth = 320, kHeight = 180;
constexpr std::size_t kFrames = 120;
constexpr double kFrame_s = 1.0 / 60.0;
constexpr double kSpeed = 1.2;  // metres a second
constexpr std::uint32_t kSamples = 64;
constexpr const char* kMostPairs = "8";
constexpr int kMostDraws = 6;

dquat turned_by(double angle, const dvec3& axis) { return {std::cos(0.5 * angle), std::sin(0.5 * angle) * axis}; }

/// A figure of the built-in scene and its parts at rest.
struct Walker {
  Entity root;
  std::vector<std::pair<Entity, LocalTransform>> arms;  ///< with fingers
};

Result<Walker> find_walker(World& world) {
  Walker walker;
  // The only subject that is left.
  world.view<const CloseupSubject>().each([&](Entity entity, const CloseupSubject& subject) {
    if (subject.enabled) walker.root = entity;
  });
  if (!world.alive(walker.root)) return Error{ErrorKind::failed, "the scene has no close-up subject"};
  constexpr double kShoulder = 0.2;  // metres from the middle; what is farther out is of an arm
  world.view<const Parent, const LocalTransform>().each(
      [&](Entity entity, const Parent& parent, const LocalTransform& local) {
        if (parent.entity == walker.root && std::abs(local.translation.x) > kShoulder)
          walker.arms.emplace_back(entity, local);
      });
  return walker;
}

void pose(World& world, const Walker& walker, std::size_t frame) {
  const double time_s = kFrame_s * static_cast<double>(frame);
  auto& root = world.get<LocalTransform>(walker.root);
  root.translation = dvec3(-1.9 + kSpeed * time_s, 0.0, 1.7);
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

/// Shadows of one lamp, frame by frame.
struct Walk {
  std::vector<std::vector<float>> with;  ///< below 0 where the lamp does not reach
  std::vector<std::vector<float>> standard;
  std::vector<TracedVisibility> traced;
  std::vector<std::vector<std::uint8_t>> facing;
};

struct Flicker {
  double with = 0.0;  ///< mean over changing pixels
  double standard = 0.0;
  double texels = 0.0;
  double texels_standard = 0.0;
};

/// The frame until every tile has its lights.
Status draw_with_room(ShadowCase& shadows) {
  for (int i = 0; i < kMostDraws; ++i) {
    const auto sample = shadows.draw();
    if (!sample) return sample.error();
    if (lists_had_room(sample->report)) return {};
  }
  return Error{ErrorKind::failed, "tiles find no room for their lights, however often a frame is drawn"};
}

Result<std::uint64_t> most_closeup_texels(ShadowCase& shadows, const Walker& walker) {
  GLOAM_TRY(shadows.set("closeups.max_pairs", kMostPairs));
  std::uint64_t most = 0;
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    pose(shadows.session().world, walker, frame);
    if (auto sample = shadows.draw(); !sample) return sample.error();
    most = std::max(most, map_texels(shadows.session()).closeups);
  }
  return most;
}

Status trace_frame(Session& session, Entity lamp, Walk& walk) {
  const ViewId view = session.view_settings(kWidth, kHeight, "none").id;
  const auto geometry = session.renderer->read_geometry(session.world, view);
  if (!geometry) return geometry.error();
  auto rays = trace_lights(session, *geometry, {&lamp, 1}, kSamples);
  if (!rays) return rays.error();
  if (rays->lights.empty()) return Error{ErrorKind::failed, "the lamp reaches no pixel"};
  walk.traced.push_back(std::move(*rays));
  walk.facing.push_back(pixels_that_face(session.world, *geometry, lamp));
  return {};
}

/// With the knobs as they are; traces as well where `traced` is given. most: greatest texels of all maps.
Status draw_walk(ShadowCase& shadows, const Walker& walker, Entity lamp, std::vector<std::vector<float>>& drawn,
                 Walk* traced, double& most) {
  Session& session = shadows.session();
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
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

Flicker flicker_of(const Walk& walk) {
  Flicker flicker;
  double changing = 0.0;
  for (std::size_t t = 1; t < kFrames; ++t) {
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

Result<Flicker> measure(BenchContext& context) {
  auto session = context.open_builtin(kCloseupScene);
  if (!session) return session.error();
  World& world = (*session)->world;
  keep_closeup_figures(world, 1);
  const auto lamp = world.resource<SceneNames>().find("light", "lamp 2");
  if (!lamp) return lamp.error();
  const OnlyCasting only(world, {&*lamp, 1});
  const auto walker = find_walker(world);
  if (!walker) return walker.error();
  ShadowCase shadows(**session, kWidth, kHeight);
  GLOAM_TRY(shadows.set("shadows.mode", "deferred"));
  const auto most = most_closeup_texels(shadows, *walker);
  if (!most) return most.error();
  pose(world, *walker, 0);
  const auto texels = find_equal_texels(shadows, kMostPairs, *most);
  if (!texels) return texels.error();
  Walk both;
  double texels_with = 0.0, texels_standard = 0.0;
  GLOAM_TRY(use_closeups(shadows, *texels, kMostPairs));
  GLOAM_TRY(draw_walk(shadows, *walker, *lamp, both.with, &both, texels_with));
  GLOAM_TRY(use_standard(shadows, *texels));
  GLOAM_TRY(draw_walk(shadows, *walker, *lamp, both.standard, nullptr, texels_standard));
  Flicker flicker = flicker_of(both);
  flicker.texels = texels_with;
  flicker.texels_standard = texels_standard;
  return flicker;
}

}  // namespace

void add_closeup_flicker_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<Flicker>>();
  const auto add = [&](const char* id, const char* unit, std::optional<double> bar,
                       std::function<double(const Flicker&)> value) {
    BenchRow row;
    row.id = std::string("closeups.") + id;
    row.unit = unit;
    row.bar = bar;
    row.run = [shared, value = std::move(value)](BenchContext& context) -> Result<BenchValue> {
      const auto flicker = shared->get([&] { return measure(context); });
      if (!flicker) return flicker.error();
      BenchValue result;
      result.value = value(**flicker);
      result.scene = kCloseupScene;
      return result;
    };
    registry.add(std::move(row));
  };
  add("flicker_over_standard", "ratio", 1.0,
      [](const Flicker& f) { return f.standard > 0.0 ? f.with / f.standard : 0.0; });
  add("flicker", "visibility a frame", std::nullopt, [](const Flicker& f) { return f.with; });
  add("flicker_standard", "visibility a frame", std::nullopt, [](const Flicker& f) { return f.standard; });
  add("flicker_texels", "texels", std::nullopt, [](const Flicker& f) { return f.texels; });
  add("flicker_texels_standard", "texels", std::nullopt, [](const Flicker& f) { return f.texels_standard; });
}

}  // namespace gloam
