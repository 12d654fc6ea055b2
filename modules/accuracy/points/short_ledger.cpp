// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "modules/accuracy/cost/comparison.h"
#include "modules/accuracy/cost/frame_identity.h"
#include "modules/accuracy/cost/knob_overrides.h"
#include "modules/accuracy/cost/settled_frame.h"
#include "modules/accuracy/cost/timing.h"
#include "modules/accuracy/module.h"
#include "modules/accuracy/points/point_measurement.h"

namespace gloam {
namespace {

constexpr std::size_t kLeastFrames = 3;  // timed for each setting
constexpr std::size_t kMostFrames = 10;

double steady_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

class ShortRun {
 public:
  ShortRun(const ShortLedgerRequest& request, CostSubject& subject)
      : request_(request),
        subject_(subject),
        now_s_(request.now_s ? request.now_s : steady_s),
        end_s_(now_s_() + request.seconds) {}

  [[nodiscard]] bool is_over() const { return now_s_() >= end_s_; }

  /// The first one has the user's settings. left: settings that are not measured yet, this one included.
  Status add(const std::vector<KnobOverride>& setting, std::size_t left) {
    KnobOverrides overrides(subject_.knobs());
    GLOAM_TRY(overrides.set(setting));
    Changes changes;
    for (const KnobOverride& change : setting) changes.emplace(change.name, change.value);
    LedgerPoint point = {.settings = settings_with(subject_.knobs(), changes), .measured = {}};
    std::erase_if(point.settings, [&](const KnobValue& own) { return subject_.knobs().find(own.knob)->is_look; });
    const double share_s = (end_s_ - now_s_()) / static_cast<double>(left);
    const double until_s = now_s_() + share_s;
    GLOAM_TRY(judge(point.measured));
    std::vector<FrameCost> frames;
    while (frames.size() < kLeastFrames || (frames.size() < kMostFrames && now_s_() < until_s)) {
      auto cost = subject_.draw(static_cast<std::int32_t>(frames.size()) + 1);
      if (!cost) return cost.error();
      frames.push_back(std::move(cost).value());
    }
    set_times(summarize_frames(frames), point.measured);
    point.measured.pairs = static_cast<std::uint32_t>(frames.size());
    point.measured.value = settings_text(point.settings);
    points_.push_back(std::move(point));
    return {};
  }

  /// The fastest first.
  std::vector<LedgerPoint> finish() {
    points_.front().measured.is_default = true;
    const double users_ms = points_.front().measured.ms.median_ms;
    for (LedgerPoint& point : points_) {
      LedgerRow& row = point.measured;
      if (users_ms > 0.0) row.ratio = row.ratio_low = row.ratio_high = row.ms.median_ms / users_ms;
      point.predicted_ms = row.ms.median_ms;
      point.predicted_flip = row.flip->mean;
    }
    std::ranges::stable_sort(points_, {}, [](const LedgerPoint& point) { return point.measured.ms.median_ms; });
    return std::move(points_);
  }

 private:
  Status judge(LedgerRow& row) {
    auto pictures = draw_settled(subject_);
    if (!pictures) return pictures.error();
    if (!users_) {
      const std::string hash = hash_of(*pictures);
      users_.emplace(NoisyReference{PictureJudge(*pictures), hash});
    }
    row.reference_kind = kWholeFrameKind;
    row.reference_name = "the settings that the program began with";
    CostProgress progress;  // pictures are not kept
    GLOAM_TRY(compare(*users_, *pictures, progress, row));
    row.whole = WholeError{.flip = *row.flip, .rmse = *row.rmse, .psnr_db = *row.psnr_db};
    return {};
  }

  const ShortLedgerRequest& request_;
  CostSubject& subject_;
  std::function<double()> now_s_;
  double end_s_;
  std::optional<NoisyReference> users_;
  std::vector<LedgerPoint> points_;
};

}  // namespace

Result<Ledger> measure_short_ledger(const ShortLedgerRequest& request, CostSubject& subject) {
  ShortRun run(request, subject);
  const std::size_t total = request.settings.size() + 1;
  for (std::size_t i = 0; i < total; ++i) {
    if (i >= 2 && run.is_over()) break;
    if (request.progress) GLOAM_TRY(request.progress(i, total));
    GLOAM_TRY(run.add(i == 0 ? std::vector<KnobOverride>() : request.settings[i - 1], total - i));
  }
  return Ledger{.header = request.header, .rows = {}, .skipped = {}, .points = run.finish()};
}

}  // namespace gloam
