// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include "engine/core/hash.h"
#include "sandbox/bench/benches.h"
#include "sandbox/bench/context.h"
#include "sandbox/bench/gather_yardstick.h"
#include "sandbox/bench/measure.h"

namespace gloam {
namespace {

constexpr int kRepetitions = 15;

/// Whole frames of the scene and the yardstick, alternating: times in nanoseconds, pair by pair.
struct FrameTimes {
  std::vector<double> scene_ns;
  std::vector<double> gather_ns;
  std::uint64_t scene_hash = 0;
  std::uint64_t gather_hash = 0;
};

template <class Work>
Result<double> timed_ns(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  if (Status status = work(); !status.ok()) return status.error();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

Result<FrameTimes> measure_frames(BenchContext& context) {
  auto session = context.session();
  if (!session) return session.error();
  Session& s = **session;
  const Options& options = context.options();
  auto yardstick = GatherYardstick::create(*s.device, options.width, options.height);
  if (!yardstick.ok()) return yardstick.error();
  const ViewRequest request{s.view_settings(options.width, options.height, "none"), {}};
  const auto draw_scene = [&]() -> Status {
    GLOAM_TRY(s.renderer->render(s.world, std::span(&request, 1)));
    return s.renderer->wait();
  };
  const auto draw_gathers = [&]() -> Status { return (*yardstick)->draw(); };
  FrameTimes times;
  for (int i = -2; i < kRepetitions; ++i) {  // two rounds warm up
    auto scene = timed_ns(draw_scene);
    if (!scene.ok()) return scene.error();
    auto gather = timed_ns(draw_gathers);
    if (!gather.ok()) return gather.error();
    if (i < 0) continue;
    times.scene_ns.push_back(*scene);
    times.gather_ns.push_back(*gather);
  }
  auto picture = s.renderer->read_picture(request.settings.id);
  if (!picture.ok()) return picture.error();
  times.scene_hash = hash_bytes(std::as_bytes(std::span(picture->rgba)));
  auto gathered = (*yardstick)->picture_hash();
  if (!gathered.ok()) return gathered.error();
  times.gather_hash = *gathered;
  return times;
}

/// Measured once a run of the program, whichever rows are asked for.
class SharedFrames {
 public:
  [[nodiscard]] Result<FrameTimes> get(BenchContext& context) {
    if (times_ == nullptr) {
      auto measured = measure_frames(context);
      if (!measured.ok()) return measured.error();
      times_ = std::make_unique<FrameTimes>(std::move(*measured));
    }
    return *times_;
  }

 private:
  std::unique_ptr<FrameTimes> times_;
};

template <class Value>
BenchRow frame_row(std::string id, std::string unit, std::shared_ptr<SharedFrames> frames, Value value) {
  BenchRow row;
  row.id = std::move(id);
  row.unit = std::move(unit);
  row.run = [frames = std::move(frames), value](BenchContext& context) -> Result<BenchValue> {
    auto times = frames->get(context);
    if (!times.ok()) return times.error();
    return value(*times);
  };
  return row;
}

}  // namespace

void add_frame_benches(BenchRegistry& registry) {
  auto frames = std::make_shared<SharedFrames>();
  registry.add(frame_row("frame.scene", "ms", frames,
                         [](const FrameTimes& t) { return per_item(t.scene_ns, 1e6, t.scene_hash); }));
  registry.add(frame_row("frame.gather48", "ms", frames,
                         [](const FrameTimes& t) { return per_item(t.gather_ns, 1e6, t.gather_hash); }));
  BenchRow ratio = frame_row("frame.scene_over_gather48", "ratio", frames,
                             [](const FrameTimes& t) { return ratio_of(t.scene_ns, t.gather_ns, t.scene_hash); });
  ratio.bar = 1.5;
  registry.add(std::move(ratio));
}

}  // namespace gloam
