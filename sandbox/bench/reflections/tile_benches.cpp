// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/reflections/case.h"
#include "sandbox/bench/reflections/halls.h"
#include "sandbox/bench/shadows/case.h"

// The proxy pass with proxy tiles against the loop over all proxies, and by number of tiles.

namespace gloam {
namespace {

constexpr const char* kPass = "reflection_proxies";
constexpr int kTilePairs = 11;
constexpr int kTileWarmUp = 2;
constexpr std::array<const char*, 6> kTileCounts = {"1", "4", "8", "16", "32", "64"};

struct Loops {
  std::vector<double> tiled_ns;
  std::vector<double> naive_ns;
  std::uint64_t hash = 0;  ///< of the linear light, the same with both
};

/// Time of the proxy pass of a frame with this loop. hash: set to that of the frame's light.
Result<double> loop_ns(ReflectionFrames& frames, const char* loop, std::uint64_t& hash) {
  GLOAM_TRY(frames.set("ibr.loop", loop));
  const auto sample = frames.draw();
  if (!sample) return sample.error();
  const auto light = frames.hash();
  if (!light) return light.error();
  hash = *light;
  return pass_ms(*sample, kPass) * kNsPerMs;
}

/// ErrorKind::failed if the pictures differ.
Result<Loops> measure_loops(BenchContext& context, std::uint32_t rooms, const char* sphere_test) {
  auto session = open_proxy_street(context, rooms);
  if (!session) return session.error();
  ReflectionFrames frames(**session, context.options().width, context.options().height);
  GLOAM_TRY(frames.set("reflections.tiers", "ibr+cube"));
  GLOAM_TRY(frames.set("ibr.sphere_test", sphere_test));
  Loops loops;
  for (int i = -kTileWarmUp; i < kTilePairs; ++i) {
    std::uint64_t naive_hash = 0;
    const auto tiled = loop_ns(frames, "tiles", loops.hash);
    if (!tiled) return tiled.error();
    const auto naive = loop_ns(frames, "naive", naive_hash);
    if (!naive) return naive.error();
    if (naive_hash != loops.hash) return Error{ErrorKind::failed, "proxy tiles change the picture"};
    if (i < 0) continue;
    loops.tiled_ns.push_back(*tiled);
    loops.naive_ns.push_back(*naive);
  }
  return loops;
}

struct Curve {
  std::array<std::vector<double>, kTileCounts.size()> ns;
  std::uint64_t hash = 0;
};

/// Frames with each number of tiles, in turn.
Result<Curve> measure_curve(BenchContext& context) {
  auto session = open_proxy_street(context, 1);
  if (!session) return session.error();
  ReflectionFrames frames(**session, context.options().width, context.options().height);
  GLOAM_TRY(frames.set("reflections.tiers", "ibr+cube"));
  Curve curve;
  for (int i = -kTileWarmUp; i < kTilePairs; ++i)
    for (std::size_t count = 0; count < kTileCounts.size(); ++count) {
      GLOAM_TRY(frames.set("ibr.tiles", kTileCounts[count]));
      std::uint64_t hash = 0;
      const auto ns = loop_ns(frames, "tiles", hash);
      if (!ns) return ns.error();
      if (curve.hash != 0 && hash != curve.hash)
        return Error{ErrorKind::failed, "the number of proxy tiles changes the picture"};
      curve.hash = hash;
      if (i >= 0) curve.ns[count].push_back(*ns);
    }
  return curve;
}

using SharedLoops = std::shared_ptr<Once<Loops>>;

template <class Value>
BenchRow loop_row(std::string id, const char* unit, const SharedLoops& shared, std::uint32_t rooms, bool sphere_test,
                  Value value) {
  BenchRow row;
  row.id = std::move(id);
  row.unit = unit;
  row.run = [=](BenchContext& context) -> Result<BenchValue> {
    const auto loops = shared->get([&] { return measure_loops(context, rooms, sphere_test ? "on" : "off"); });
    if (!loops) return loops.error();
    return value(**loops);
  };
  return row;
}

void add_loop_rows(BenchRegistry& registry, const std::string& id, std::uint32_t rooms, double bar) {
  const auto shared = std::make_shared<Once<Loops>>(), without = std::make_shared<Once<Loops>>();
  const auto ratio = [](const Loops& loops) { return ratio_of(loops.naive_ns, loops.tiled_ns, loops.hash); };
  BenchRow over = loop_row(id, "ratio", shared, rooms, true, ratio);
  over.bar = bar;
  over.better = Better::higher;
  registry.add(std::move(over));
  registry.add(loop_row(id + ".tiled_ms", "ms", shared, rooms, true,
                        [](const Loops& loops) { return per_item(loops.tiled_ns, kNsPerMs, loops.hash); }));
  registry.add(loop_row(id + ".naive_ms", "ms", shared, rooms, true,
                        [](const Loops& loops) { return per_item(loops.naive_ns, kNsPerMs, loops.hash); }));
  BenchRow plain = loop_row(id + ".without_sphere_test", "ratio", without, rooms, false, ratio);
  plain.better = Better::higher;
  registry.add(std::move(plain));
}

void add_curve_rows(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<Curve>>();
  for (std::size_t count = 0; count < kTileCounts.size(); ++count) {
    BenchRow row;
    row.id = std::string("reflections.curve.tiles.") + kTileCounts[count];
    row.unit = "ms";
    row.run = [=](BenchContext& context) -> Result<BenchValue> {
      const auto curve = shared->get([&] { return measure_curve(context); });
      if (!curve) return curve.error();
      return per_item((*curve)->ns[count], kNsPerMs, (*curve)->hash);
    };
    registry.add(std::move(row));
  }
}

}  // namespace

void add_reflection_tile_benches(BenchRegistry& registry) {
  add_loop_rows(registry, "reflections.tiled_over_naive", 1, 4.0);
  add_loop_rows(registry, "reflections.tiled_over_naive.four_rooms", 4, 8.0);
  add_curve_rows(registry);
}

}  // namespace gloam
