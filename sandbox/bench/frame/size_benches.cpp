// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/hash.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/session/drawing/frame_run.h"

// GPU time per pixel by the size of the picture. It falls slowly with size; a step means that the driver does something
// else at some sizes, such as compiling kernels in each frame.

namespace gloam {
namespace {

/// Scales of 1280x720, with those that the window's scale of resolution passes through.
constexpr std::array<std::array<std::uint32_t, 2>, 11> kSizes = {{{320, 180},
                                                                  {400, 225},
                                                                  {427, 240},
                                                                  {480, 270},
                                                                  {512, 288},
                                                                  {640, 360},
                                                                  {800, 450},
                                                                  {853, 480},
                                                                  {960, 540},
                                                                  {1067, 600},
                                                                  {1280, 720}}};
constexpr int kSizeRounds = 3;
constexpr std::uint32_t kFramesASize = 5;
constexpr std::size_t kUncounted = 2;  ///< first frames of a size: images are made, lists find their length

/// Median GPU time of a frame, all passes, over its pixels.
Result<double> ns_per_pixel(Session& session, const Options& options, std::array<std::uint32_t, 2> size) {
  const ViewRequest request{session.view_settings(size[0], size[1], "none"), {}};
  FrameRun run(session, 1);
  for (std::uint32_t frame = 0; frame < kFramesASize; ++frame) {
    session.set_clock(options.time_s + frame * options.dt_s, options.dt_s);
    GLOAM_TRY(run.draw(request));
  }
  const auto samples = run.finish();
  if (!samples) return samples.error();
  std::vector<double> times;
  for (const FrameSample& sample : std::span(*samples).subspan(kUncounted))
    times.push_back(sample.report.gpu_ms * kNsPerMs / (double{1} * size[0] * size[1]));
  std::ranges::sort(times);
  return times[times.size() / 2];
}

Result<BenchValue> size_cliff(BenchContext& context) {
  auto session = context.session();
  if (!session) return session.error();
  std::vector<double> largest, smallest;
  for (int round = -1; round < kSizeRounds; ++round) {
    std::vector<double> times;
    for (const auto size : kSizes) {
      const auto time = ns_per_pixel(**session, context.options(), size);
      if (!time) return time.error();
      times.push_back(*time);
    }
    if (round < 0) continue;  // warms up
    largest.push_back(std::ranges::max(times));
    smallest.push_back(std::ranges::min(times));
  }
  const auto picture = (*session)->renderer->read_picture(
      (*session)->view_settings(context.options().width, context.options().height, "none").id);
  if (!picture) return picture.error();
  return ratio_of(largest, smallest, hash_bytes(std::as_bytes(std::span(picture->rgba))));
}

}  // namespace

void add_frame_size_benches(BenchRegistry& registry) {
  registry.add({.id = "frame.size_cliff", .unit = "ratio", .bar = 2.0, .better = Better::lower, .run = &size_cliff});
}

}  // namespace gloam
