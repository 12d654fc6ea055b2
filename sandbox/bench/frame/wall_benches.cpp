// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/session/drawing/frame_run.h"

// Time from frame to frame with one and with two frames in flight, in runs of the same animated frames that alternate.

namespace gloam {
namespace {

constexpr int kWallRounds = 5;
constexpr std::uint32_t kFramesARun = 8;  // the first is not counted: with two in flight it waits for none

/// Times of frames in nanoseconds and the hash of the last picture, by frames in flight less 1.
struct WallTimes {
  std::array<std::vector<double>, 2> ns;
  std::array<std::uint64_t, 2> hashes{};
};

Status draw_run(Session& session, const Options& options, std::uint32_t in_flight, WallTimes* times) {
  const ViewRequest request{session.view_settings(options.width, options.height, "none"), {}};
  FrameRun run(session, in_flight);
  for (std::uint32_t frame = 0; frame < kFramesARun; ++frame) {
    session.set_clock(options.time_s + frame * options.dt_s, options.dt_s);
    GLOAM_TRY(run.draw(request));
  }
  const auto samples = run.finish();
  if (!samples) return samples.error();
  auto picture = session.renderer->read_picture(request.settings.id);
  if (!picture) return picture.error();
  if (times == nullptr) return {};
  for (const FrameSample& sample : std::span(*samples).subspan(1))
    times->ns[in_flight - 1].push_back(sample.wall_ms() * kNsPerMs);
  times->hashes[in_flight - 1] = hash_bytes(std::as_bytes(std::span(picture->rgba)));
  return {};
}

Result<WallTimes> measure_walls(BenchContext& context) {
  auto session = context.session();
  if (!session) return session.error();
  WallTimes times;
  for (int round = -1; round < kWallRounds; ++round) {  // one round warms up
    for (const std::uint32_t in_flight : {1u, 2u})
      GLOAM_TRY(draw_run(**session, context.options(), in_flight, round < 0 ? nullptr : &times));
  }
  if (times.hashes[0] != times.hashes[1])
    return Error{ErrorKind::failed, "frame.wall: pictures with one and with two frames in flight differ"};
  return times;
}

template <class Value>
BenchRow wall_row(std::string id, std::string unit, std::shared_ptr<Once<WallTimes>> shared, Value value) {
  BenchRow row;
  row.id = std::move(id);
  row.unit = std::move(unit);
  row.run = [shared = std::move(shared), value](BenchContext& context) -> Result<BenchValue> {
    const auto times = shared->get([&] { return measure_walls(context); });
    if (!times) return times.error();
    return value(**times);
  };
  return row;
}

}  // namespace

void add_frame_wall_benches(BenchRegistry& registry) {
  auto shared = std::make_shared<Once<WallTimes>>();
  registry.add(wall_row("frame.wall.1_in_flight", "ms", shared,
                        [](const WallTimes& t) { return per_item(t.ns[0], kNsPerMs, t.hashes[0]); }));
  registry.add(wall_row("frame.wall.2_in_flight", "ms", shared,
                        [](const WallTimes& t) { return per_item(t.ns[1], kNsPerMs, t.hashes[1]); }));
  registry.add(wall_row("frame.wall.2_over_1_in_flight", "ratio", shared,
                        [](const WallTimes& t) { return ratio_of(t.ns[1], t.ns[0], t.hashes[1]); }));
}

}  // namespace gloam
