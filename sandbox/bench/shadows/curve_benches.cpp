// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/bench/shadows/phases.h"
#include "sandbox/bench/shadows/variant.h"
#include "sandbox/scenes/lamps/shadow_grid.h"

namespace gloam {
namespace {

constexpr const char* kCurveScene = "builtin:shadow_grid";
constexpr int kCurveFrames = 5;
constexpr double kCurveLightsAPoint = 24.0;  // with all lights; fewer lights have the same range
constexpr std::array<std::uint32_t, 6> kCounts = {8, 16, 32, 64, 128, 256};
constexpr std::uint32_t kCurveWidth = 640;  // size for the curve over light counts
constexpr std::uint32_t kCurveHeight = 360;

struct Size {
  const char* name;
  std::uint32_t width;
  std::uint32_t height;
};
constexpr std::array<Size, 5> kSizes = {{{"320x180", 320, 180},
                                         {"640x360", 640, 360},
                                         {"960x540", 960, 540},
                                         {"1280x720", 1280, 720},
                                         {"1920x1080", 1920, 1080}}};

/// One point of a curve: times of frames.
struct Point {
  std::vector<double> lists_ns;
  std::vector<double> classify_ns;
  std::vector<double> generate_ns;
  std::vector<double> finish_ns;
  std::vector<double> lighting_ns;
  std::vector<double> deferred_ns;    ///< all phases
  std::vector<double> monolithic_ns;  ///< lists and lighting
  double lights_a_tile = 0.0;
  std::uint64_t deferred_hash = 0;  ///< of the pictures
  std::uint64_t monolithic_hash = 0;
};

void add_deferred(Point& point, const FrameReport& report) {
  const PhaseTimes t = phase_times(report);
  const auto ns = [&](ShadowPhase phase) { return t.of(phase) * kNsPerMs; };
  point.lists_ns.push_back(ns(ShadowPhase::prepare) + ns(ShadowPhase::approx) + ns(ShadowPhase::accurate));
  point.classify_ns.push_back(ns(ShadowPhase::classify));
  point.generate_ns.push_back(ns(ShadowPhase::generate));
  point.finish_ns.push_back(ns(ShadowPhase::finish));
  point.lighting_ns.push_back(ns(ShadowPhase::lighting));
  point.deferred_ns.push_back(t.total() * kNsPerMs);
  point.lights_a_tile = counter_of(report, "lights.per_tile_accurate_mean");
}

Result<Point> measure_point(Session& session, std::uint32_t width, std::uint32_t height) {
  ShadowCase shadows(session, width, height);
  Point point;
  for (int i = 0; i < kCurveFrames; ++i) {
    const auto deferred = draw_settled(shadows, kClassified);
    if (!deferred) return deferred.error();
    add_deferred(point, deferred->report);
    const auto deferred_hash = shadows.picture_hash();
    if (!deferred_hash) return deferred_hash.error();
    point.deferred_hash = *deferred_hash;
    const auto monolithic = draw_settled(shadows, kMonolithic);
    if (!monolithic) return monolithic.error();
    point.monolithic_ns.push_back(phase_times(monolithic->report).total() * kNsPerMs);
    const auto monolithic_hash = shadows.picture_hash();
    if (!monolithic_hash) return monolithic_hash.error();
    point.monolithic_hash = *monolithic_hash;
  }
  return point;
}

using CountPoints = std::array<Point, kCounts.size()>;

/// Measures from many lights to few, because removed lights do not come back.
Result<CountPoints> measure_curve_counts(BenchContext& context) {
  auto session = context.open_builtin(kCurveScene);
  if (!session) return session.error();
  CountPoints points;
  for (std::size_t i = kCounts.size(); i-- > 0;) {
    const double lights_a_point = kCurveLightsAPoint * kCounts[i] / static_cast<double>(kShadowGridLights);
    arrange_shadow_grid_lights((*session)->world, kCounts[i], lights_a_point);
    auto point = measure_point(**session, kCurveWidth, kCurveHeight);
    if (!point) return point.error();
    points[i] = std::move(*point);
  }
  return points;
}

using GetPoint = std::function<Result<const Point*>(BenchContext&)>;
using PointValue = std::function<BenchValue(const Point&)>;

BenchRow point_row(std::string id, std::string unit, GetPoint get, PointValue value, std::string scene) {
  BenchRow row;
  row.id = "shadows.curve." + std::move(id);
  row.unit = std::move(unit);
  row.run = [get = std::move(get), value = std::move(value),
             scene = std::move(scene)](BenchContext& context) -> Result<BenchValue> {
    const auto point = get(context);
    if (!point) return point.error();
    BenchValue result = value(**point);
    result.scene = scene.empty() ? context.scene_or(kCurveScene) : scene;
    return result;
  };
  return row;
}

/// Adds the rows of one point, one per column. scene: the measured scene; empty if the user may choose it.
void add_point(BenchRegistry& registry, const std::string& curve, const std::string& name, const GetPoint& get,
               const std::string& scene) {
  struct Column {
    const char* name;
    std::vector<double> Point::*times_ns;
    std::uint64_t Point::*hash = &Point::deferred_hash;
  };
  constexpr Column kColumns[] = {{"lists", &Point::lists_ns},
                                 {"classify", &Point::classify_ns},
                                 {"generate", &Point::generate_ns},
                                 {"finish", &Point::finish_ns},
                                 {"lighting", &Point::lighting_ns},
                                 {"deferred", &Point::deferred_ns},
                                 {"monolithic", &Point::monolithic_ns, &Point::monolithic_hash}};
  const std::string prefix = curve + "." + name + ".";
  for (const Column& column : kColumns)
    registry.add(point_row(
        prefix + column.name, "ms", get,
        [column](const Point& p) { return per_item(p.*column.times_ns, kNsPerMs, p.*column.hash); }, scene));
  registry.add(point_row(
      prefix + "deferred_over_monolithic", "ratio", get,
      [](const Point& p) {
        return ratio_of(p.deferred_ns, p.monolithic_ns, hash_of_both(p.deferred_hash, p.monolithic_hash));
      },
      scene));
  registry.add(point_row(
      prefix + "lights_a_tile", "lights", get,
      [](const Point& p) { return single_value(p.lights_a_tile, p.deferred_hash); }, scene));
}

}  // namespace

void add_shadow_curve_benches(BenchRegistry& registry) {
  const auto counts = std::make_shared<Once<CountPoints>>();
  for (std::size_t i = 0; i < kCounts.size(); ++i) {
    const GetPoint get = [counts, i](BenchContext& context) -> Result<const Point*> {
      const auto points = counts->get([&] { return measure_curve_counts(context); });
      if (!points) return points.error();
      return &(**points)[i];
    };
    add_point(registry, "lights", std::to_string(kCounts[i]), get, kCurveScene);
  }
  for (const Size& size : kSizes) {
    const auto shared = std::make_shared<Once<Point>>();
    const GetPoint get = [shared, &size](BenchContext& context) -> Result<const Point*> {
      return shared->get([&]() -> Result<Point> {
        auto session = context.session_or(kCurveScene);
        if (!session) return session.error();
        return measure_point(**session, size.width, size.height);
      });
    };
    add_point(registry, "size", size.name, get, "");
  }
}

}  // namespace gloam
