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

// Time of a frame per pixel by the size of the picture, by the clock of the cost ledger: GPU time, or processor time if
// the device is a processor. It falls slowly with size; a step means that the driver does something else at some sizes,
// such as compiling kernels in each frame.

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
constexpr std::uint32_t kUncounted = 2;  ///< first frames of a size: images are made, lists find their length

/// Median time of a frame over its pixels. On the wall, a device that is a processor would show how its threads wait in
/// small dispatches, too.
Result<double> ns_per_pixel(Session& session, const Options& options, std::array<std::uint32_t, 2> size) {
  const ViewRequest request{session.view_settings(size[0], size[1], "none"), {}};
  std::vector<double> times;
  for (std::uint32_t frame = 0; frame < kFramesASize; ++frame) {
    session.set_clock(options.time_s + frame * options.dt_s, options.dt_s);
    const auto sample = session.render_frame(request);
    if (!sample) return sample.error();
    if (frame < kUncounted) continue;
    const double ms = sample->processor_ms > 0.0 ? sample->processor_ms : sample->report.gpu_ms;
    times.push_back(ms * kNsPerMs / (double{1} * size[0] * size[1]));
  }
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
