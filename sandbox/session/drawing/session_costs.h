// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "modules/accuracy/module.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Draws a session's frames for the cost ledger. Frame `index` is at time --time + index · --dt. On a device that is a
/// processor, a frame's time is processor time of the process, divided by the cores: other processes hardly change it.
/// With views.scale below 1, frames are drawn smaller, and read() enlarges them; that takes no time of a frame.
class SessionCosts final : public CostSubject {
 public:
  /// session and options must outlive it.
  SessionCosts(Session& session, const Options& options);

  [[nodiscard]] KnobRegistry& knobs() override { return session_.renderer->knobs(); }
  [[nodiscard]] std::vector<ReferenceInfo> references() const override;
  [[nodiscard]] std::vector<MeasureInfo> measures() const override;
  [[nodiscard]] Result<FrameCost> draw(std::int32_t index) override;
  [[nodiscard]] std::uint32_t frames_to_rest() override { return session_.renderer->frames_to_rest(session_.world); }
  [[nodiscard]] Status settle_memory() override;
  [[nodiscard]] Result<std::uint64_t> gpu_bytes() override;
  [[nodiscard]] FrameCounters counters() override { return session_.renderer->report().counters; }
  [[nodiscard]] Result<FramePictures> read() override;
  [[nodiscard]] Result<FramePictures> draw_reference(const ReferenceInfo& reference, const FramePictures& frame,
                                                     std::uint32_t samples) override;
  [[nodiscard]] Result<std::optional<MovedDistance>> measure_distance(const ReferenceInfo& reference,
                                                                      std::uint32_t samples) override;
  [[nodiscard]] std::string no_effect_reason(const Knob& knob) override;

 private:
  /// The pictures of the last frame as they were drawn: with views.scale, smaller than the full size.
  [[nodiscard]] Result<FramePictures> read_drawn();
  [[nodiscard]] FramePictures full_size(const FramePictures& pictures) const;
  /// Draws the last frame again after `change` has modified the world, then calls `restore`.
  [[nodiscard]] Result<FramePictures> redraw(const std::function<void(World&)>& change,
                                             const std::function<void(World&)>& restore);

  /// Of the last frame; without what rays need. frame must outlive it.
  [[nodiscard]] ReferenceInput input_of(const FramePictures& frame, std::uint32_t samples);

  Session& session_;
  const Options& options_;
  ViewRequest request_;
  std::unique_ptr<ReferenceStore> store_;
  std::int32_t index_ = 0;  ///< index of the last frame
};

}  // namespace gloam
