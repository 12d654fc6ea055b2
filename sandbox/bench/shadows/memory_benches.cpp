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
#include "sandbox/bench/harness/camera_path.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/bench/shadows/phases.h"
#include "sandbox/bench/shadows/variant.h"
#include "sandbox/scenes/lamps/shadow_grid.h"

namespace gloam {
namespace {

constexpr const char* kMemoryScene = "builtin:shadow_grid";
constexpr std::size_t kPathFrames = 300;
constexpr int kMostDraws = 6;

/// A picture size and the step between drawn frames of the path, because a software device takes seconds for large
/// frames. With a stride above 1 the camera jumps and buffers must grow at once, so each frame is drawn until every
/// tile has room.
struct PathCase {
  const char* name;
  std::uint32_t width;
  std::uint32_t height;
  std::size_t stride;
};
struct LightCase {
  const char* prefix;     ///< of the row ids
  double lights_a_point;  ///< ranges that reach a point on the ground; a tile has fewer lights (cones)
  std::array<PathCase, 2> sizes;
};
constexpr std::array<LightCase, 2> kLights = {
    {{"memory.", 3.0, {{{"1080p", 1920, 1080, 1}, {"4k", 3840, 2160, 30}}}},
     {"memory.32_lights.", 60.0, {{{"1080p", 1920, 1080, 150}, {"4k", 3840, 2160, 300}}}}}};

struct Memory {
  double list_bytes = 0.0;  ///< allocated after the last frame
  double visibility_bytes = 0.0;
  double lights_a_tile = 0.0;        ///< mean over the path
  std::size_t last_overflow = 0;     ///< number of frames until the last overflow: 0 (none) … 300
  double slots_of_small_kernel = 1;  ///< relative to the slots of the default kernel, at the path's first pose
  std::uint64_t hash = 0;            ///< of the picture after the path's last frame
};

/// A drawn frame of the path.
struct PoseSample {
  FrameSample sample;
  bool overflowed = false;  ///< in the first draw of the frame
};

Result<PoseSample> draw_pose(ShadowCase& shadows, const std::vector<PathKey>& path, std::size_t frame,
                             bool until_room) {
  shadows.look_from(path_pose(path, frame, kPathFrames));
  auto sample = shadows.draw();
  if (!sample) return sample.error();
  const bool overflowed = !lists_had_room(sample->report);
  for (int i = 0; until_room && i < kMostDraws && !lists_had_room(sample->report); ++i) {
    sample = shadows.draw();
    if (!sample) return sample.error();
  }
  return PoseSample{std::move(*sample), overflowed};
}

/// Visibility slots with the 4-texel kernel over those with the user's kernel, which is equally wide but has more
/// gathers.
Result<double> slots_of_small_kernel(ShadowCase& shadows) {
  const auto small = draw_settled(shadows, kClassified);
  if (!small) return small.error();
  shadows.set_back("shadows.kernel");
  const auto full = draw_settled(shadows, kClassified);
  if (!full) return full.error();
  return counter_of(small->report, "shadows.slots") / std::max(1.0, counter_of(full->report, "shadows.slots"));
}

/// Measures along the path through the scene's cameras. Buffer sizes depend on the numbers of tiles and lights. So the
/// 4-texel kernel is used: it is as wide as larger kernels and takes a quarter of the gathers.
Result<Memory> measure_memory(BenchContext& context, const LightCase& lights, const PathCase& size) {
  auto session = context.open_builtin(kMemoryScene);
  if (!session) return session.error();
  arrange_shadow_grid_lights((*session)->world, kShadowGridLights, lights.lights_a_point);
  const std::vector<PathKey> path = path_through_cameras((*session)->world, (*session)->info);
  ShadowCase shadows(**session, size.width, size.height);
  GLOAM_TRY(shadows.set("shadows.mode", kClassified.mode));
  GLOAM_TRY(shadows.set("shadows.classify", kClassified.classify));
  GLOAM_TRY(shadows.set("shadows.kernel", "4"));
  if (size.stride > 1) {
    // Fallback tiles cost the most time. So buffers first grow with the cheap hard filter, to less than penumbrae need.
    GLOAM_TRY(shadows.set("shadows.filter", "hard"));
    const auto grown = draw_pose(shadows, path, 0, true);
    if (!grown) return grown.error();
    shadows.set_back("shadows.filter");
  }
  Memory memory;
  double frames = 0.0;
  for (std::size_t frame = 0; frame < kPathFrames; frame += size.stride) {
    const auto drawn = draw_pose(shadows, path, frame, size.stride > 1);
    if (!drawn) return drawn.error();
    const FrameReport& report = drawn->sample.report;
    if (drawn->overflowed) memory.last_overflow = frame + 1;
    memory.list_bytes = counter_of(report, "shadows.list_bytes");
    memory.visibility_bytes = counter_of(report, "shadows.visibility_bytes");
    memory.lights_a_tile += counter_of(report, "lights.per_tile_accurate_mean");
    frames += 1.0;
  }
  memory.lights_a_tile /= frames;
  const auto hash = shadows.picture_hash();
  if (!hash) return hash.error();
  memory.hash = *hash;
  if (size.stride > 1) return memory;
  shadows.look_from(path_pose(path, 0, kPathFrames));
  const auto kernels = slots_of_small_kernel(shadows);
  if (!kernels) return kernels.error();
  memory.slots_of_small_kernel = *kernels;
  return memory;
}

using Value = std::function<double(const Memory&)>;

void add_case(BenchRegistry& registry, const LightCase& lights, const PathCase& size) {
  const auto shared = std::make_shared<Once<Memory>>();
  const auto add = [&](const char* what, const char* unit, std::optional<double> bar, Value value) {
    BenchRow row;
    row.id = std::string("shadows.") + lights.prefix + what + "." + size.name;
    row.unit = unit;
    row.bar = bar;
    row.run = [shared, &lights, &size, value = std::move(value)](BenchContext& context) -> Result<BenchValue> {
      const auto memory = shared->get([&] { return measure_memory(context, lights, size); });
      if (!memory) return memory.error();
      // The hash is of the last frame's picture: it shows that lights and visibilities had room.
      BenchValue result = single_value(value(**memory), (*memory)->hash);
      result.scene = kMemoryScene;
      return result;
    };
    registry.add(std::move(row));
  };
  const double fixed_lists = fixed_list_bytes(size.width, size.height);
  const double fixed_visibility = fixed_visibility_bytes(size.width, size.height);
  add("lists_over_fixed", "ratio", 0.25, [=](const Memory& m) { return m.list_bytes / fixed_lists; });
  add("visibility_over_fixed", "ratio", 0.25, [=](const Memory& m) { return m.visibility_bytes / fixed_visibility; });
  add("list_mib", "MiB", std::nullopt, [](const Memory& m) { return m.list_bytes / 1048576.0; });
  add("visibility_mib", "MiB", std::nullopt, [](const Memory& m) { return m.visibility_bytes / 1048576.0; });
  // Bar if every frame is drawn: none of the last tenth may overflow.
  const std::optional<double> quiet = size.stride == 1 ? std::optional(0.9 * kPathFrames) : std::nullopt;
  add("last_overflow", "frames from the start", quiet,
      [](const Memory& m) { return static_cast<double>(m.last_overflow); });
  // Shows how much of the path was drawn.
  add("frames", "of 300 frames drawn", std::nullopt,
      [&size](const Memory&) { return static_cast<double>((kPathFrames + size.stride - 1) / size.stride); });
  add("lights_a_tile", "lights", std::nullopt, [](const Memory& m) { return m.lights_a_tile; });
  if (size.stride == 1)
    add("slots_of_small_kernel", "ratio", std::nullopt, [](const Memory& m) { return m.slots_of_small_kernel; });
}

}  // namespace

void add_shadow_memory_benches(BenchRegistry& registry) {
  for (const LightCase& lights : kLights)
    for (const PathCase& size : lights.sizes) add_case(registry, lights, size);
}

}  // namespace gloam
