// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/resources.h"
#include "modules/accuracy/cost/picture_error.h"
#include "modules/accuracy/module.h"
#include "modules/fog/components.h"
#include "modules/fog/model.h"
#include "modules/reflections/knobs.h"
#include "modules/reflections/reference/adapter.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/reflections/case.h"
#include "sandbox/session/drawing/session_costs.h"

// Error of each set of reflection tiers against traced reflections, by camera.

namespace gloam {
namespace {

// Size of the pictures that are compared with rays for every pixel. A mirror has one ray a pixel, so the reference is
// not smooth: the smaller the picture, the more of the difference is aliasing of the reference.
constexpr std::uint32_t kReflectionErrorWidth = 640;
constexpr std::uint32_t kReflectionErrorHeight = 360;
constexpr std::uint32_t kRays = 256;
constexpr int kReflectionErrorDraws =
    3;  // the last frame finds what earlier ones left over (shadow caches, light scale)

struct TierSet {
  const char* name;  ///< in the row's id
  ReflectionKnobs::Mode mode;
  ReflectionTiers tiers;
  bool hierarchical = true;  ///< ssr.march
};
constexpr std::array<TierSet, 6> kTierSets = {
    {{"off", ReflectionKnobs::Mode::off, {.screen_space = true, .proxies = true}},
     {"cube", ReflectionKnobs::Mode::tiers, {.screen_space = false, .proxies = false}},
     {"ssr+cube", ReflectionKnobs::Mode::tiers, {.screen_space = true, .proxies = false}},
     {"ibr+cube", ReflectionKnobs::Mode::tiers, {.screen_space = false, .proxies = true}},
     {"all", ReflectionKnobs::Mode::tiers, {.screen_space = true, .proxies = true}},
     {"all_constant_march", ReflectionKnobs::Mode::tiers, {.screen_space = true, .proxies = true}, false}}};
constexpr std::size_t kCube = 1;
constexpr std::size_t kAll = 4;
constexpr std::size_t kConstantMarch = 5;

struct JudgedCamera {
  std::string_view scene;  ///< "courtyard", "wet_street" or kBalls
  const char* camera;
};
/// Metal balls over floors of several roughnesses. Rows over all scenes leave it out: it is nothing but metals.
constexpr std::string_view kBalls = "balls";
constexpr const char* kBallsFile = "../shared/cases/balls.gltf";
constexpr std::array<JudgedCamera, 14> kCameras = {{{"courtyard", "court"},
                                                    {"courtyard", "walkway"},
                                                    {"courtyard", "down"},
                                                    {"courtyard", "grazing"},
                                                    {"wet_street", "street"},
                                                    {"wet_street", "grazing"},
                                                    {"wet_street", "down"},
                                                    {"wet_street", "terrace"},
                                                    {"wet_street", "shop"},
                                                    {"wet_street", "still"},
                                                    {kBalls, "front"},
                                                    {kBalls, "low"},
                                                    {kBalls, "mid"},
                                                    {kBalls, "down"}}};

struct TierError {
  double rmse = 0.0;       ///< linear light, cd/m²
  double flip = 0.0;       ///< mean, 0…1
  std::uint64_t hash = 0;  ///< of the drawn and the expected light
};
using CameraErrors = std::array<TierError, kTierSets.size()>;

/// The last session that was opened, and all errors found so far.
struct SharedReflections {
  std::string scene;
  std::unique_ptr<Session> session;
  std::map<std::size_t, CameraErrors> judged;  ///< by index in kCameras
};

/// The scene file or built-in scene of a judged camera; none if it is missing.
std::optional<std::string> judged_scene_of(const BenchContext& context, const JudgedCamera& judged) {
  if (judged.scene == "courtyard") return courtyard_scene(context);
  if (judged.scene == "wet_street") return kWetStreet;
  std::error_code ignored;
  if (std::filesystem::exists(kBallsFile, ignored)) return kBallsFile;
  return std::nullopt;
}

BenchValue skipped_scene(std::string_view scene) {
  return skipped_row(scene == kBalls ? std::string("there is no ") + kBallsFile : no_courtyard());
}

Result<Session*> reflection_session_of(BenchContext& context, SharedReflections& shared, const std::string& scene,
                                       const char* camera) {
  if (shared.session == nullptr || shared.scene != scene) {
    shared.session.reset();
    auto opened = context.open_builtin(scene);
    if (!opened) return opened.error();
    shared.session = std::move(opened).value();
    shared.scene = scene;
  }
  const auto found = shared.session->world.resource<SceneNames>().find("camera", camera);
  if (!found) return found.error();
  shared.session->camera = *found;
  return shared.session.get();
}

/// Fog and fires, which reflected rays meet besides surfaces.
ReflectionExtras extras_of(const World& world) {
  ReflectionExtras extras;
  world.view<const Fog>().each([&](const Fog& fog) {
    if (fog.density > 0.0f)
      extras.fog = {.density = static_cast<double>(fog.density),
                    .color = dvec3(fog.color),
                    .sky_distance_m = static_cast<double>(fog.sky_distance_m)};
  });
  extras.fires = gather_fire_quads(world);
  return extras;
}

/// Sets knobs for its lifetime.
class TierKnobs {
 public:
  explicit TierKnobs(KnobRegistry& knobs)
      : knobs_(knobs),
        users_{"", knobs.value(kReflectionMode), knobs.value(kReflectionTiers), knobs.value(kSsrHierarchical)} {}
  ~TierKnobs() { set(users_); }
  TierKnobs(const TierKnobs&) = delete;
  TierKnobs& operator=(const TierKnobs&) = delete;
  void set(const TierSet& tiers) {
    knobs_.set(kReflectionMode, tiers.mode);
    knobs_.set(kReflectionTiers, tiers.tiers);
    knobs_.set(kSsrHierarchical, tiers.hierarchical);
  }

 private:
  KnobRegistry& knobs_;
  TierSet users_;
};

Result<FramePictures> draw_tiers(SessionCosts& costs, TierKnobs& knobs, const TierSet& tiers) {
  knobs.set(tiers);
  for (int i = 0; i < kReflectionErrorDraws; ++i)
    if (const auto drawn = costs.draw(0); !drawn) return drawn.error();
  return costs.read();
}

Result<CameraErrors> measure_camera(BenchContext& context, Session& session) {
  Options options = context.options();
  options.width = kReflectionErrorWidth;
  options.height = kReflectionErrorHeight;
  options.view = "none";
  options.time_s = 0.0;
  options.out = options.cache_dir.empty() ? "" : options.cache_dir + "/bench";
  SessionCosts costs(session, options);
  TierKnobs knobs(session.renderer->knobs());
  const auto with_all = draw_tiers(costs, knobs, kTierSets[kAll]);
  if (!with_all) return with_all.error();
  auto reference =
      costs.draw_reference(traced_reflections(std::string(kReflectionTiers.name), false, &extras_of), *with_all, kRays);
  if (!reference) return reference.error();
  const std::uint64_t expected = hash_of_light(reference->linear);
  const PictureJudge judge(std::move(reference).value());
  CameraErrors errors;
  for (std::size_t i = 0; i < kTierSets.size(); ++i) {
    const auto drawn = draw_tiers(costs, knobs, kTierSets[i]);
    if (!drawn) return drawn.error();
    LedgerRow row;
    GLOAM_TRY(judge.judge(*drawn, row));
    errors[i] = {.rmse = row.rmse.value_or(0.0),
                 .flip = row.flip.value_or(ErrorPair{}).mean,
                 .hash = hash_of_both(hash_of_light(drawn->linear), expected)};
  }
  return errors;
}

/// Null if the camera's scene is missing.
Result<const CameraErrors*> judge_reflections(BenchContext& context, SharedReflections& shared, std::size_t index) {
  if (const auto found = shared.judged.find(index); found != shared.judged.end()) return &found->second;
  const auto scene = judged_scene_of(context, kCameras[index]);
  if (!scene) return static_cast<const CameraErrors*>(nullptr);
  auto session = reflection_session_of(context, shared, *scene, kCameras[index].camera);
  if (!session) return session.error();
  auto errors = measure_camera(context, **session);
  if (!errors) return errors.error();
  const CameraErrors& kept = shared.judged.emplace(index, *errors).first->second;
  return &kept;
}

void add_reflection_camera_rows(BenchRegistry& registry, const std::shared_ptr<SharedReflections>& shared,
                                std::size_t index) {
  const JudgedCamera& judged = kCameras[index];
  const auto add = [&](std::size_t tiers, const char* name, const char* unit, auto value) {
    BenchRow row;
    row.id = "reflections.error." + std::string(judged.scene) + "." + judged.camera + "." + kTierSets[tiers].name +
             "." + name;
    row.unit = unit;
    row.run = [=](BenchContext& context) -> Result<BenchValue> {
      const auto errors = judge_reflections(context, *shared, index);
      if (!errors) return errors.error();
      if (*errors == nullptr) return skipped_scene(kCameras[index].scene);
      const TierError& error = (**errors)[tiers];
      BenchValue result = single_value(value(error), error.hash);
      result.scene = judged_scene_of(context, kCameras[index]);
      return result;
    };
    registry.add(std::move(row));
  };
  for (std::size_t tiers = 0; tiers < kTierSets.size(); ++tiers) {
    add(tiers, "rmse", "cd/m²", [](const TierError& error) { return error.rmse; });
    add(tiers, "flip", "FLIP", [](const TierError& error) { return error.flip; });
  }
}

/// FLIP of two sets of tiers over cameras.
struct FlipSums {
  double first = 0.0, second = 0.0;
  double worst_ratio = 0.0;  ///< of one camera, first over second
  std::uint64_t hash = 0;    ///< 0: no camera
};

/// scene: of JudgedCamera; empty: all scenes but kBalls.
Result<FlipSums> sum_flip(BenchContext& context, SharedReflections& shared, std::string_view scene, std::size_t first,
                          std::size_t second) {
  FlipSums sums;
  for (std::size_t index = 0; index < kCameras.size(); ++index) {
    if (scene.empty() ? kCameras[index].scene == kBalls : kCameras[index].scene != scene) continue;
    const auto errors = judge_reflections(context, shared, index);
    if (!errors) return errors.error();
    if (*errors == nullptr) continue;
    const TierError &a = (**errors)[first], &b = (**errors)[second];
    sums.first += a.flip;
    sums.second += b.flip;
    if (b.flip > 0.0) sums.worst_ratio = std::max(sums.worst_ratio, a.flip / b.flip);
    sums.hash = hash_of_both(sums.hash, hash_of_both(a.hash, b.hash));
  }
  return sums;
}

}  // namespace

void add_reflection_error_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<SharedReflections>();
  for (std::size_t index = 0; index < kCameras.size(); ++index) add_reflection_camera_rows(registry, shared, index);
  const auto add = [&](const std::string& id, std::string scene, std::size_t first, std::size_t second,
                       std::optional<double> bar, auto value) {
    BenchRow row;
    row.id = "reflections." + id;
    row.unit = "ratio";
    row.bar = bar;
    row.run = [=](BenchContext& context) -> Result<BenchValue> {
      const auto sums = sum_flip(context, *shared, scene, first, second);
      if (!sums) return sums.error();
      if (sums->hash == 0) return skipped_scene(scene);
      return single_value(value(*sums), sums->hash);
    };
    registry.add(std::move(row));
  };
  const auto mean = [](const FlipSums& sums) { return sums.second > 0.0 ? sums.first / sums.second : 0.0; };
  const auto worst = [](const FlipSums& sums) { return sums.worst_ratio; };
  add("flip_full_over_cube", "", kAll, kCube, 0.45, mean);
  for (const std::string scene : {"courtyard", "wet_street", "balls"})
    add("flip_full_over_cube." + scene, scene, kAll, kCube, std::nullopt, mean);
  add("worst_camera_full_over_cube", "", kAll, kCube, 1.0, worst);
  add("flip_constant_over_hierarchical_march", "", kConstantMarch, kAll, std::nullopt, mean);
}

}  // namespace gloam
