// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/frame_times.h"

#include <chrono>
#include <span>

#include "engine/core/hash.h"
#include "sandbox/bench/harness/gather_yardstick.h"

namespace gloam {
namespace {

constexpr int kFrameTimeRepetitions = 15;

template <class Work>
Result<double> timed_ns(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  if (Status status = work(); !status.ok()) return status.error();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

WithoutShadows::WithoutShadows(Session& session)
    : knobs_(session.renderer->knobs()), users_(knobs_.value(kShadowMode)) {
  knobs_.set(kShadowMode, ShadowMode::off);
}

WithoutShadows::~WithoutShadows() { knobs_.set(kShadowMode, users_); }

Result<MeasuredFrames> measure_frames(Session& session, const Options& options) {
  const WithoutShadows off(session);
  auto yardstick = GatherYardstick::create(*session.device, options.width, options.height);
  if (!yardstick.ok()) return yardstick.error();
  const ViewRequest request{session.view_settings(options.width, options.height, "none"), {}};
  const auto draw_scene = [&]() -> Status {
    GLOAM_TRY(session.renderer->render(session.world, std::span(&request, 1)));
    return session.renderer->wait();
  };
  const auto draw_gathers = [&]() -> Status { return (*yardstick)->draw(); };
  MeasuredFrames times;
  for (int i = -2; i < kFrameTimeRepetitions; ++i) {  // two rounds warm up
    auto scene = timed_ns(draw_scene);
    if (!scene.ok()) return scene.error();
    auto gather = timed_ns(draw_gathers);
    if (!gather.ok()) return gather.error();
    if (i < 0) continue;
    times.scene_ns.push_back(*scene);
    times.gather_ns.push_back(*gather);
  }
  auto picture = session.renderer->read_picture(request.settings.id);
  if (!picture.ok()) return picture.error();
  times.scene_hash = hash_bytes(std::as_bytes(std::span(picture->rgba)));
  auto gathered = (*yardstick)->picture_hash();
  if (!gathered.ok()) return gathered.error();
  times.gather_hash = *gathered;
  return times;
}

}  // namespace gloam
