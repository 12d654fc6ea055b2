// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "modules/lighting/outputs.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/camera_step.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"

// Whole frames with all savings (what is kept over frames, and what nobody sees is left out) over the same frames
// without any, on the wall and in turn: of a camera at rest, and of one that turns and steps. The scene's time goes on.
// Each side has a session, because a change of knobs loses what a session has kept.

namespace gloam {
namespace {

constexpr std::array<const char*, 4> kSavingScenes = {"builtin:lanterns", "builtin:wet_street", "builtin:shadow_grid",
                                                      "builtin:closeups"};
constexpr int kWarmUpFrames = 12;  // frames are kept after four that repeat each other; pipelines are made before
constexpr int kTimedFrames = 24;
constexpr double kNoSlower = 1.03;  // bar of scenes that have none

struct KnobText {
  const char* knob;
  const char* value;
};

/// The knobs that save time, at their values that save nothing.
constexpr std::array<KnobText, 6> kWithoutSavings = {{{"shadows.reuse", "off"},
                                                      {"lighting.reuse", "off"},
                                                      {"scene.reuse", "off"},
                                                      {"scene.culling", "frustum"},
                                                      {"shadows.lod_texels", "0"},
                                                      {"shadows.min_contribution", "0"}}};

/// A setting that is compared with frames without savings: the defaults of these knobs, with changes.
struct SavingSide {
  const char* suffix;  ///< of the rows' ids
  std::span<const KnobText> changes;
};
constexpr std::array<KnobText, 1> kReprojected = {{{"shadows.reuse", "reprojected"}}};
constexpr std::array<SavingSide, 2> kSavingSides = {{{"", {}}, {".reprojected", kReprojected}}};

struct Motion {
  const char* name;
  bool moves;
  double bar;  ///< of kSavingScenes
};
constexpr std::array<Motion, 2> kMotions = {{{"rest", false, 0.4}, {"moving", true, 0.7}}};

/// Frames of one side, and its last picture.
struct SideFrames {
  std::vector<double> ns;
  Picture picture;
};

struct SavingFrames {
  SideFrames without;
  std::array<SideFrames, kSavingSides.size()> sides;
};

/// A session that draws the frames of one side, as `gloam render` would.
class SavingSession {
 public:
  SavingSession(std::unique_ptr<Session> session, const Options& options)
      : session_(std::move(session)), options_(options) {
    session_->renderer->knobs().set(kAntialiasing, Antialiasing::smaa);
    settings_ = session_->view_settings(options.width, options.height, "none");
    if (settings_.follow_camera) follow_camera(session_->world, settings_);
    settings_.follow_camera = false;
    start_ = settings_.world_from_camera;
  }

  Status set(std::span<const KnobText> values) {
    for (const KnobText& set : values) GLOAM_TRY(session_->renderer->knobs().set(set.knob, set.value));
    return {};
  }

  /// Gives the knobs of kWithoutSavings their defaults, unless the user has set them.
  void set_savings() {
    KnobRegistry& knobs = session_->renderer->knobs();
    for (const KnobText& saving : kWithoutSavings) {
      const Knob& knob = *knobs.find(saving.knob);
      const bool users = std::ranges::any_of(options_.assignments, [&](const std::string& assignment) {
        return assignment.starts_with(std::string(saving.knob) + "=");
      });
      if (!users) knobs.set_number(knob, knob.default_number);
    }
  }

  /// Median distance to the surfaces of the first picture; 1 m if it shows only sky.
  Result<double> seen_m() {
    GLOAM_TRY(draw(0, 0.0, nullptr));
    const auto geometry = session_->renderer->read_geometry(session_->world, settings_.id);
    if (!geometry) return geometry.error();
    std::vector<double> depths;
    for (const float depth : geometry->depth)
      if (depth > 0.0f) depths.push_back(geometry->view.view_depth(depth));
    if (depths.empty()) return 1.0;
    std::ranges::nth_element(depths, depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2));
    return depths[depths.size() / 2];
  }

  /// seen_m: of moved_camera(); 0 for a camera at rest. times: gets the frame's time; may be null.
  Status draw(int frame, double seen_m, std::vector<double>* times) {
    session_->set_clock(options_.time_s + frame * options_.dt_s, options_.dt_s);
    if (seen_m > 0.0)
      settings_.world_from_camera = moved_camera(start_, seen_m, frame - 0.5 * (kWarmUpFrames + kTimedFrames));
    const auto sample = session_->render_frame({settings_, {}});
    if (!sample) return sample.error();
    if (times != nullptr) times->push_back(sample->wall_ms() * kNsPerMs);
    return {};
  }

  Result<Picture> picture() { return session_->renderer->read_picture(settings_.id); }

 private:
  std::unique_ptr<Session> session_;
  const Options& options_;
  ViewSettings settings_;
  dmat4 start_ = dmat4(1.0);
};

Status draw_in_turn(std::span<SavingSession> sessions, std::span<SideFrames* const> frames, double seen_m) {
  for (int frame = 0; frame < kWarmUpFrames + kTimedFrames; ++frame)
    for (std::size_t i = 0; i < sessions.size(); ++i)
      GLOAM_TRY(sessions[i].draw(frame, seen_m, frame < kWarmUpFrames ? nullptr : &frames[i]->ns));
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    auto picture = sessions[i].picture();
    if (!picture) return picture.error();
    frames[i]->picture = std::move(picture).value();
  }
  return {};
}

Result<SavingFrames> measure_savings(BenchContext& context, const std::string& scene, bool moves) {
  std::vector<SavingSession> sessions;
  SavingFrames frames;
  std::vector<SideFrames*> sides = {&frames.without};
  for (SideFrames& side : frames.sides) sides.push_back(&side);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    auto session = context.open_chosen(scene);
    if (!session) return session.error();
    sessions.emplace_back(std::move(session).value(), context.options());
    if (i > 0) sessions.back().set_savings();
    GLOAM_TRY(sessions.back().set(i > 0 ? kSavingSides[i - 1].changes : kWithoutSavings));
  }
  double seen_m = 0.0;
  for (SavingSession& session : sessions) {  // all draw the same frames, because exposure adapts from frame to frame
    const auto seen = session.seen_m();
    if (!seen) return seen.error();
    if (moves) seen_m = *seen;
  }
  GLOAM_TRY(draw_in_turn(sessions, sides, seen_m));
  return frames;
}

std::uint64_t hash_of(const Picture& picture) { return hash_bytes(std::as_bytes(std::span(picture.rgba))); }

/// Share of pixels in which two pictures of one size differ.
double differing_share(const Picture& a, const Picture& b) {
  constexpr std::size_t kChannels = 4;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += kChannels)
    count += std::equal(&a.rgba[i], &a.rgba[i] + kChannels, &b.rgba[i]) ? 0 : 1;
  return static_cast<double>(count * kChannels) / static_cast<double>(a.rgba.size());
}

using SharedSavings = std::shared_ptr<Once<SavingFrames>>;

template <class Value>
void add_saving_row(BenchRegistry& registry, BenchRow row, const SharedSavings& shared, const char* scene, bool moves,
                    Value value) {
  row.better = Better::lower;
  row.run = [=](BenchContext& context) -> Result<BenchValue> {
    const bool is_default = context.options().scene_is_default;
    if (scene != nullptr && !is_default) return skipped_row("--scene names another scene");
    if (scene == nullptr && is_default) return skipped_row("for the scene of --scene");
    const std::string name = scene != nullptr ? scene : context.options().scene;
    const auto frames = shared->get([&] { return measure_savings(context, name, moves); });
    if (!frames) return frames.error();
    BenchValue result = value(**frames);
    result.scene = name;
    return result;
  };
  registry.add(std::move(row));
}

/// scene: null for the scene that the user names.
void add_saving_scene(BenchRegistry& registry, const Motion& motion, const std::string& name, const char* scene) {
  const auto shared = std::make_shared<Once<SavingFrames>>();
  const std::string id = std::string("frame.") + motion.name + "." + name;
  const auto add = [&](const std::string& row_id, const char* unit, std::optional<double> bar, auto value) {
    add_saving_row(registry, {.id = row_id, .unit = unit, .bar = bar}, shared, scene, motion.moves, value);
  };
  for (std::size_t i = 0; i < kSavingSides.size(); ++i) {
    const std::string side = id + kSavingSides[i].suffix;
    add(side, "ratio", scene != nullptr ? motion.bar : kNoSlower, [i](const SavingFrames& f) {
      return ratio_of(f.sides[i].ns, f.without.ns,
                      hash_of_both(hash_of(f.sides[i].picture), hash_of(f.without.picture)));
    });
    add(side + ".ms", "ms", std::nullopt,
        [i](const SavingFrames& f) { return per_item(f.sides[i].ns, kNsPerMs, hash_of(f.sides[i].picture)); });
    add(side + ".differs", "share of pixels", std::nullopt, [i](const SavingFrames& f) {
      return single_value(differing_share(f.sides[i].picture, f.without.picture), hash_of(f.sides[i].picture));
    });
  }
  add(id + ".without_ms", "ms", std::nullopt,
      [](const SavingFrames& f) { return per_item(f.without.ns, kNsPerMs, hash_of(f.without.picture)); });
}

}  // namespace

void add_frame_saving_benches(BenchRegistry& registry) {
  for (const Motion& motion : kMotions) {
    for (const char* scene : kSavingScenes)
      add_saving_scene(registry, motion, std::string(scene).substr(std::string_view("builtin:").size()), scene);
    add_saving_scene(registry, motion, "scene", nullptr);
  }
}

}  // namespace gloam
