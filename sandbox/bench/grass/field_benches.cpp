// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "modules/grass/components.h"
#include "modules/grass/field/grow.h"
#include "sandbox/bench/grass/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/scenes/construction/scene_builder.h"

// Cost of a field ten times as large in which the same blades are live: builtin:meadow against the meadow with nine
// more fields in view, beyond the greatest distance of its blades.

namespace gloam {
namespace {

constexpr const char* kFieldCamera = "near";
constexpr std::uint32_t kFieldWidth = 640;
constexpr std::uint32_t kFieldHeight = 360;
constexpr int kFieldRounds = 15;
constexpr int kFieldWarmUp = 3;
constexpr std::uint32_t kFewLive = 20'000;
constexpr double kFieldSide_m = 24.0;
constexpr double kFirstRow_m = -60.0;  // z of the middle of the nearest row of further fields

struct FieldTimes {
  std::vector<double> passes_ns;  ///< sort, level of detail and simulation
  std::vector<double> drawing_ns;
  std::vector<double> cpu_ns;  ///< of the whole frame
};

struct Fields {
  FieldTimes small;
  FieldTimes large;
  double live = 0.0;
  std::uint64_t hash = 0;  ///< of the poses of the live blades, equal in both
};

/// Adds nine fields of grass with other seeds, in three rows beyond the meadow.
void add_fields(GrassCase& grass) {
  World& world = grass.session().world;
  std::uint32_t mesh = 0;
  GrassSurface surface;
  world.view<const GrassSurface, const MeshInstance>().each(
      [&](Entity, const GrassSurface& grown, const MeshInstance& instance) {
        surface = grown;
        mesh = instance.mesh;
      });
  SceneBuilder builder(world, grass.session().info);
  for (int i = 0; i < 9; ++i) {
    const Entity entity =
        builder.add_instance("", mesh, {kFieldSide_m * (i % 3 - 1), 0.0, kFirstRow_m - kFieldSide_m * (i / 3)});
    surface.seed = static_cast<std::uint32_t>(i + 2);
    world.add<GrassSurface>(entity, surface);
  }
}

void set_max_distance(GrassCase& grass, double distance_m) {
  grass.session().world.view<GrassSurface>().each(
      [&](GrassSurface& surface) { surface.max_distance_m = static_cast<float>(distance_m); });
}

Status draw_once(GrassCase& grass, bool measured, FieldTimes& times, double& live) {
  const auto sample = grass.draw(kGrassFrame_s);
  if (!sample) return sample.error();
  live = counter_of(*sample, "grass.live");
  if (!measured) return {};
  const GrassTimes passes = grass_times(*sample);
  times.passes_ns.push_back(passes.sort_ns + passes.lod_ns + passes.simulation_ns);
  times.drawing_ns.push_back(passes.drawing_ns);
  times.cpu_ns.push_back(sample->report.cpu_ms * kNsPerMs);
  return {};
}

Result<Fields> compare_fields(GrassCase& small, GrassCase& large) {
  Fields fields;
  double large_live = 0.0;
  for (int i = -kFieldWarmUp; i < kFieldRounds; ++i) {
    GLOAM_TRY(draw_once(small, i >= 0, fields.small, fields.live));
    GLOAM_TRY(draw_once(large, i >= 0, fields.large, large_live));
  }
  const auto small_read = small.draw_and_read(kGrassFrame_s);
  if (!small_read) return small_read.error();
  const auto large_read = large.draw_and_read(kGrassFrame_s);
  if (!large_read) return large_read.error();
  fields.hash = hash_of_poses(*small_read);
  if (fields.hash != hash_of_poses(*large_read) || fields.live != large_live)
    return Error{ErrorKind::failed, "grass.field: the larger field draws other blades"};
  return fields;
}

struct BothFields {
  Fields usual;     ///< as the scene is drawn
  Fields few_live;  ///< kFewLive of 100,000 and of 1,000,000 blades are live
};

Result<BothFields> measure_fields(BenchContext& context) {
  const auto small = GrassCase::open(context, kFieldCamera, kFieldWidth, kFieldHeight);
  if (!small) return small.error();
  const auto large = GrassCase::open(context, kFieldCamera, kFieldWidth, kFieldHeight);
  if (!large) return large.error();
  add_fields(**large);
  const auto usual = compare_fields(**small, **large);
  if (!usual) return usual.error();
  for (GrassCase* grass : {small->get(), large->get()}) GLOAM_TRY(grass->set("grass.lod_pixels", "0"));
  const auto all = (*small)->draw_and_read(kGrassFrame_s);
  if (!all) return all.error();
  if (const auto also = (*large)->draw(kGrassFrame_s); !also) return also.error();  // both at the same step
  const double distance_m = distance_of_live(all->bins, static_cast<double>(all->range_m), kFewLive);
  for (GrassCase* grass : {small->get(), large->get()}) set_max_distance(*grass, distance_m);
  const auto few_live = compare_fields(**small, **large);
  if (!few_live) return few_live.error();
  const auto blades = [](GrassCase& grass) { return grass.session().world.resource<GrassField>().statistics.blades; };
  if (blades(**large) != 10 * blades(**small))
    return Error{ErrorKind::failed, "grass.field: the larger field has " + std::to_string(blades(**large)) + " blades"};
  return BothFields{*usual, *few_live};
}

void add_rows(BenchRegistry& registry, const std::string& ratio_id, const std::string& id,
              const std::shared_ptr<Once<BothFields>>& shared, Fields BothFields::*which) {
  const auto add = [&](const std::string& row_id, const char* unit, std::optional<double> bar, auto value) {
    BenchRow row;
    row.id = row_id;
    row.unit = unit;
    row.bar = bar;
    row.run = [shared, which, value](BenchContext& context) -> Result<BenchValue> {
      const auto fields = shared->get([&] { return measure_fields(context); });
      if (!fields) return fields.error();
      BenchValue result = value((**fields).*which);
      result.scene = kMeadow;
      return result;
    };
    registry.add(std::move(row));
  };
  add(ratio_id, "ratio", 1.3, [](const Fields& f) { return ratio_of(f.large.passes_ns, f.small.passes_ns, f.hash); });
  add(id + ".drawing_over_same_live", "ratio", std::nullopt,
      [](const Fields& f) { return ratio_of(f.large.drawing_ns, f.small.drawing_ns, f.hash); });
  add(id + ".cpu_over_same_live", "ratio", std::nullopt,
      [](const Fields& f) { return ratio_of(f.large.cpu_ns, f.small.cpu_ns, f.hash); });
  add(id + ".ms", "ms", std::nullopt, [](const Fields& f) { return per_item(f.large.passes_ns, kNsPerMs, f.hash); });
  add(id + ".live", "blades", std::nullopt, [](const Fields& f) { return single_value(f.live, f.hash); });
}

}  // namespace

void add_grass_field_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<BothFields>>();
  add_rows(registry, "grass.field_x10_same_live", "grass.field_x10", shared, &BothFields::usual);
  add_rows(registry, "grass.field_1m_over_100k", "grass.field_1m", shared, &BothFields::few_live);
}

}  // namespace gloam
