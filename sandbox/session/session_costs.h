// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "modules/accuracy/module.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// The frames of a session, for the cost ledger: frame `index` is at --time plus so many --dt.
class SessionCosts final : public CostSubject {
 public:
  /// Both must outlive it.
  SessionCosts(Session& session, const Options& options);

  [[nodiscard]] KnobRegistry& knobs() override { return session_.renderer->knobs(); }
  [[nodiscard]] std::vector<ReferenceInfo> references() const override;
  [[nodiscard]] std::vector<MeasureInfo> measures() const override;
  [[nodiscard]] Result<FrameCost> draw(std::uint32_t index) override;
  [[nodiscard]] Result<std::uint64_t> gpu_bytes() override;
  [[nodiscard]] FrameCounters counters() override { return session_.renderer->report().counters; }
  [[nodiscard]] Result<FramePictures> read() override;
  [[nodiscard]] Result<FramePictures> draw_reference(const ReferenceInfo& reference, const FramePictures& frame,
                                                     std::uint32_t samples) override;

 private:
  /// The last frame once more with something changed in the world, which is restored afterwards.
  [[nodiscard]] Result<FramePictures> redraw(const std::function<void(World&)>& change,
                                             const std::function<void(World&)>& restore);

  Session& session_;
  const Options& options_;
  ViewRequest request_;
  std::unique_ptr<ReferenceStore> store_;
  std::uint32_t index_ = 0;  ///< of the last frame
};

}  // namespace gloam
