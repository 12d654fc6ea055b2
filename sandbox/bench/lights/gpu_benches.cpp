// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdlib>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "modules/lights/outputs.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/frame_times.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/scenes/lamps/many_lights.h"

namespace gloam {
namespace {

constexpr const char* kLightScene = "builtin:many_lights";  // unless the user names one
constexpr int kLightPairs = 7;
constexpr int kLightFrames = 9;
constexpr int kBruteFrames = 3;
constexpr int kLightWarmUp = 3;  // lists also grow to their size
constexpr std::array<std::uint32_t, 4> kLightCounts = {8, 64, 256, 1024};

double pass_ns(const FrameSample& sample, std::string_view name) {
  double ms = 0.0;
  for (const PassTime& pass : sample.report.passes) ms += pass.name == name ? pass.ms : 0.0;
  return ms * kNsPerMs;
}

/// Time of the passes that search the lights of tiles and shade opaque surfaces, and of passes that only the searches
/// need.
double light_pass_ns(const FrameSample& sample) {
  double ns = pass_ns(sample, "deferred") + pass_ns(sample, "depth_bounds") + pass_ns(sample, "results");
  for (const PassTime& pass : sample.report.passes) ns += pass.module == "lights" ? pass.ms * kNsPerMs : 0.0;
  return ns;
}

/// Draws frames of one session's camera with a given lights.culling, without shadows.
class LightFrames {
 public:
  LightFrames(Session& session, const Options& options)
      : session_(session),
        without_shadows_(session),
        users_(session.renderer->knobs().value(kLightCulling)),
        request_{session.view_settings(options.width, options.height, "none"), {}} {}
  ~LightFrames() { session_.renderer->knobs().set(kLightCulling, users_); }
  LightFrames(const LightFrames&) = delete;
  LightFrames& operator=(const LightFrames&) = delete;

  [[nodiscard]] Result<FrameSample> draw(const char* culling) {
    GLOAM_TRY(session_.renderer->knobs().set("lights.culling", culling));
    return session_.render_frame(request_);
  }
  [[nodiscard]] Status warm_up(const char* culling) {
    for (int i = 0; i < kLightWarmUp; ++i) GLOAM_TRY(draw(culling));
    return {};
  }
  /// Picture of the last frame.
  [[nodiscard]] Result<Picture> picture() { return session_.renderer->read_picture(request_.settings.id); }

 private:
  Session& session_;
  WithoutShadows without_shadows_;
  LightCulling users_;
  ViewRequest request_;
};

std::uint64_t image_hash_of(const Picture& picture) { return hash_bytes(std::as_bytes(std::span(picture.rgba))); }

/// ErrorKind::failed if a channel differs by more than one step of 8 bits.
Status expect_same(const Picture& brute, const Picture& tiled) {
  for (std::size_t i = 0; i < brute.rgba.size(); ++i) {
    if (std::abs(brute.rgba[i] - tiled.rgba[i]) > 1)
      return Error{ErrorKind::failed, "lights.culling=tiled draws another picture than brute"};
  }
  return {};
}

struct Culling {
  std::vector<double> brute_ns;
  std::vector<double> tiled_ns;
  std::uint64_t brute_hash = 0;  ///< of the pictures
  std::uint64_t tiled_hash = 0;
};

Result<Culling> measure_culling(Session& session, const Options& options) {
  LightFrames frames(session, options);
  Culling result;
  GLOAM_TRY(frames.warm_up("brute"));
  auto brute_picture = frames.picture();
  if (!brute_picture) return brute_picture.error();
  GLOAM_TRY(frames.warm_up("tiled"));
  auto tiled_picture = frames.picture();
  if (!tiled_picture) return tiled_picture.error();
  GLOAM_TRY(expect_same(*brute_picture, *tiled_picture));
  result.brute_hash = image_hash_of(*brute_picture);
  result.tiled_hash = image_hash_of(*tiled_picture);
  for (int pair = 0; pair < kLightPairs; ++pair) {
    const auto brute = frames.draw("brute");
    if (!brute) return brute.error();
    const auto tiled = frames.draw("tiled");
    if (!tiled) return tiled.error();
    result.brute_ns.push_back(light_pass_ns(*brute));
    result.tiled_ns.push_back(light_pass_ns(*tiled));
  }
  return result;
}

/// Times of the passes with one number of lights.
struct PassTimes {
  std::vector<double> approx_ns;
  std::vector<double> accurate_ns;
  std::vector<double> deferred_ns;
  std::vector<double> brute_ns;
  std::uint64_t tiled_hash = 0;  ///< of the pictures
  std::uint64_t brute_hash = 0;
};

Result<PassTimes> measure_passes(Session& session, const Options& options) {
  LightFrames frames(session, options);
  PassTimes times;
  GLOAM_TRY(frames.warm_up("tiled"));
  for (int i = 0; i < kLightFrames; ++i) {
    const auto sample = frames.draw("tiled");
    if (!sample) return sample.error();
    times.approx_ns.push_back(pass_ns(*sample, "find_lights_approx"));
    times.accurate_ns.push_back(pass_ns(*sample, "find_lights_accurate"));
    times.deferred_ns.push_back(pass_ns(*sample, "deferred"));
  }
  auto tiled_picture = frames.picture();
  if (!tiled_picture) return tiled_picture.error();
  times.tiled_hash = image_hash_of(*tiled_picture);
  for (int i = -1; i < kBruteFrames; ++i) {
    const auto sample = frames.draw("brute");
    if (!sample) return sample.error();
    if (i >= 0) times.brute_ns.push_back(pass_ns(*sample, "deferred"));
  }
  auto brute_picture = frames.picture();
  if (!brute_picture) return brute_picture.error();
  times.brute_hash = image_hash_of(*brute_picture);
  return times;
}

/// Measures the built-in scene with 1024 lights, then with fewer and fewer. The results are in the order of
/// kLightCounts.
Result<std::array<PassTimes, kLightCounts.size()>> measure_light_counts(BenchContext& context) {
  auto session = context.open_builtin(kLightScene);
  if (!session) return session.error();
  std::array<PassTimes, kLightCounts.size()> times;
  for (std::size_t i = kLightCounts.size(); i-- > 0;) {
    thin_out_lights((*session)->world, kLightCounts[i]);
    auto measured = measure_passes(**session, context.options());
    if (!measured) return measured.error();
    times[i] = std::move(measured).value();
  }
  return times;
}

struct SharedLights {
  Once<Culling> culling;
  Once<MeasuredFrames> frames;
  Once<std::array<PassTimes, kLightCounts.size()>> counts;
};

BenchRow light_row_of(std::string id, std::string unit, std::function<Result<BenchValue>(BenchContext&)> run) {
  BenchRow row;
  row.id = std::move(id);
  row.unit = std::move(unit);
  row.run = std::move(run);
  return row;
}

template <class Value>
BenchRow culling_row(std::string id, std::string unit, const std::shared_ptr<SharedLights>& shared, Value value) {
  return light_row_of(std::move(id), std::move(unit), [shared, value](BenchContext& context) -> Result<BenchValue> {
    const auto culling = shared->culling.get([&]() -> Result<Culling> {
      auto session = context.session_or(kLightScene);
      if (!session) return session.error();
      return measure_culling(**session, context.options());
    });
    if (!culling) return culling.error();
    BenchValue result = value(**culling);
    result.scene = context.scene_or(kLightScene);
    return result;
  });
}

void add_culling_rows(BenchRegistry& registry, const std::shared_ptr<SharedLights>& shared) {
  BenchRow ratio = culling_row("lights.brute_over_tiled", "ratio", shared, [](const Culling& c) {
    return ratio_of(c.brute_ns, c.tiled_ns, hash_of_both(c.brute_hash, c.tiled_hash));
  });
  ratio.bar = 6.0;
  ratio.better = Better::higher;
  registry.add(std::move(ratio));
  registry.add(culling_row("lights.gpu.lighting_tiled_ms", "ms", shared,
                           [](const Culling& c) { return per_item(c.tiled_ns, kNsPerMs, c.tiled_hash); }));
  registry.add(culling_row("lights.gpu.lighting_brute_ms", "ms", shared,
                           [](const Culling& c) { return per_item(c.brute_ns, kNsPerMs, c.brute_hash); }));
}

void add_frame_row(BenchRegistry& registry, const std::shared_ptr<SharedLights>& shared) {
  BenchRow row =
      light_row_of("lights.frame_1024_over_gather48", "ratio", [shared](BenchContext& context) -> Result<BenchValue> {
        const auto times = shared->frames.get([&]() -> Result<MeasuredFrames> {
          auto session = context.session_or(kLightScene);
          if (!session) return session.error();
          return measure_frames(**session, context.options());
        });
        if (!times) return times.error();
        const MeasuredFrames& t = **times;
        BenchValue value = ratio_of(t.scene_ns, t.gather_ns, hash_of_both(t.scene_hash, t.gather_hash));
        value.scene = context.scene_or(kLightScene);
        return value;
      });
  row.bar = 3.2;
  registry.add(std::move(row));
}

void add_count_rows(BenchRegistry& registry, const std::shared_ptr<SharedLights>& shared) {
  struct Column {
    const char* name;
    std::vector<double> PassTimes::*times_ns;
    std::uint64_t PassTimes::*hash;
  };
  const Column columns[] = {{"approx_ms", &PassTimes::approx_ns, &PassTimes::tiled_hash},
                            {"accurate_ms", &PassTimes::accurate_ns, &PassTimes::tiled_hash},
                            {"deferred_ms", &PassTimes::deferred_ns, &PassTimes::tiled_hash},
                            {"deferred_brute_ms", &PassTimes::brute_ns, &PassTimes::brute_hash}};
  for (const Column& column : columns) {
    for (std::size_t i = 0; i < kLightCounts.size(); ++i) {
      const std::string id = std::string("lights.gpu.") + column.name + "." + std::to_string(kLightCounts[i]);
      registry.add(light_row_of(id, "ms", [shared, i, column](BenchContext& context) -> Result<BenchValue> {
        const auto counts = shared->counts.get([&] { return measure_light_counts(context); });
        if (!counts) return counts.error();
        const PassTimes& times = (**counts)[i];
        BenchValue value = per_item(times.*column.times_ns, kNsPerMs, times.*column.hash);
        value.scene = kLightScene;
        return value;
      }));
    }
  }
}

}  // namespace

void add_light_gpu_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<SharedLights>();
  add_culling_rows(registry, shared);
  add_frame_row(registry, shared);
  add_count_rows(registry, shared);
}

}  // namespace gloam
