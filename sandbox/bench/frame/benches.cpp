// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <memory>
#include <string>
#include <utility>

#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/frame_times.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"

namespace gloam {
namespace {

using SharedFrames = std::shared_ptr<Once<MeasuredFrames>>;

template <class Value>
BenchRow frame_row(std::string id, std::string unit, SharedFrames frames, Value value) {
  BenchRow row;
  row.id = std::move(id);
  row.unit = std::move(unit);
  row.run = [frames = std::move(frames), value](BenchContext& context) -> Result<BenchValue> {
    const auto times = frames->get([&]() -> Result<MeasuredFrames> {
      auto session = context.session();
      if (!session) return session.error();
      return measure_frames(**session, context.options());
    });
    if (!times) return times.error();
    return value(**times);
  };
  return row;
}

}  // namespace

void add_frame_benches(BenchRegistry& registry) {
  auto frames = std::make_shared<Once<MeasuredFrames>>();
  registry.add(frame_row("frame.scene", "ms", frames,
                         [](const MeasuredFrames& t) { return per_item(t.scene_ns, 1e6, t.scene_hash); }));
  registry.add(frame_row("frame.gather48", "ms", frames,
                         [](const MeasuredFrames& t) { return per_item(t.gather_ns, 1e6, t.gather_hash); }));
  BenchRow ratio = frame_row("frame.scene_over_gather48", "ratio", frames, [](const MeasuredFrames& t) {
    return ratio_of(t.scene_ns, t.gather_ns, hash_of_both(t.scene_hash, t.gather_hash));
  });
  ratio.bar = 1.5;
  registry.add(std::move(ratio));
}

}  // namespace gloam
