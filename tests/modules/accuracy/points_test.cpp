// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "engine/render/knobs/knob_table.h"
#include "modules/accuracy/module.h"
#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

using test::TestFolder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::uint32_t kPointsSide = 4;
constexpr IntegerKnob<std::uint32_t> kSteps{.name = "fake.steps",
                                            .meaning = "",
                                            .min = 1,
                                            .max = 16,
                                            .default_value = 4,
                                            .exact = 16,
                                            .ledger_values = {1, 2, 4, 8}};
constexpr OnOffKnob kGlow{.name = "fake.glow", .meaning = "", .default_value = true, .exact = true};
constexpr IntegerKnob<std::uint32_t> kRays{
    .name = "fake.rays", .meaning = "", .min = 1, .max = 8, .default_value = 2, .exact = 8, .ledger_values = {1, 2, 4}};
constexpr OnOffKnob kCold{.name = "fake.cold", .meaning = "", .is_look = true};
constexpr OnOffKnob kIdle{.name = "fake.idle", .meaning = ""};

/// Effects that interact: without glow its rays take no time and change nothing, and rays cost more with more steps.
class InteractingSubject final : public CostSubject {
 public:
  InteractingSubject() { add_knobs(knobs_, "fake", kSteps, kGlow, kRays, kCold, kIdle); }

  [[nodiscard]] KnobRegistry& knobs() override { return knobs_; }
  [[nodiscard]] std::vector<ReferenceInfo> references() const override { return {}; }
  [[nodiscard]] std::vector<MeasureInfo> measures() const override { return {}; }
  [[nodiscard]] FrameCounters counters() override { return {}; }
  [[nodiscard]] Result<FrameCost> draw(std::int32_t) override {
    ++frames_drawn;
    if (fail_after > 0 && frames_drawn > fail_after) return Error{ErrorKind::failed, "the device is lost"};
    return FrameCost{.cpu_ms = 1.0, .gpu_ms = gpu_ms()};
  }
  [[nodiscard]] Result<std::uint64_t> gpu_bytes() override { return std::uint64_t{100}; }
  [[nodiscard]] Result<FramePictures> read() override {
    const double light = brightness();
    const auto encoded = static_cast<std::uint8_t>(std::lround(255.0 * light));
    return FramePictures{
        .linear = {kPointsSide, kPointsSide,
                   std::vector<float>(kPointsSide * kPointsSide * 4, static_cast<float>(light))},
        .picture = {kPointsSide, kPointsSide, std::vector<std::uint8_t>(kPointsSide * kPointsSide * 4, encoded)}};
  }
  [[nodiscard]] Result<FramePictures> draw_reference(const ReferenceInfo&, const FramePictures&,
                                                     std::uint32_t) override {
    return Error{ErrorKind::failed, "there is none"};
  }
  [[nodiscard]] Result<std::optional<MovedDistance>> measure_distance(const ReferenceInfo&, std::uint32_t) override {
    return std::optional<MovedDistance>();
  }
  [[nodiscard]] std::string no_effect_reason(const Knob&) override { return {}; }

  [[nodiscard]] double gpu_ms() const {
    const double steps = steps_ms * knobs_.value(kSteps);
    return steps + (knobs_.value(kGlow) ? 2.0 + knobs_.value(kRays) * (1.0 + 0.1 * steps) : 0.0);
  }
  [[nodiscard]] double brightness() const {
    const double glow = knobs_.value(kGlow) ? 0.3 - 0.1 / knobs_.value(kRays) : 0.0;
    return 0.4 + 0.2 / knobs_.value(kSteps) + glow - (knobs_.value(kCold) ? 0.2 : 0.0);
  }

  int frames_drawn = 0;
  int fail_after = 0;
  double steps_ms = 1.0;  ///< of a step

 private:
  KnobRegistry knobs_;
};

class PointsProgress final : public CostProgress {
 public:
  void measuring(const std::string&, const std::string&, std::size_t, std::size_t) override {}
  void finished(const LedgerRow&, bool) override {}
  void finished_point(const LedgerPoint&, bool resumed) override { ++(resumed ? found : measured); }
  int measured = 0;
  int found = 0;
};

class Points : public ::testing::Test {
 protected:
  Points() {
    request_.header = {
        .scene = "s", .scene_hash = "h", .width = kPointsSide, .height = kPointsSide, .frames = 2, .samples = 64};
    request_.knobs = {"fake.steps", "fake.glow", "fake.rays", "fake.cold", "fake.idle"};
    request_.points = 16;
    request_.folder = folder_.path();
  }
  Ledger measure() {
    progress_ = {};
    auto ledger = measure_costs(request_, subject_, progress_);
    EXPECT_TRUE(ledger.ok()) << ledger.error().message;
    return ledger.ok() ? *ledger : Ledger{};
  }

  TestFolder folder_;
  CostRequest request_;
  InteractingSubject subject_;
  PointsProgress progress_;
};

const LedgerPoint* default_of(const Ledger& ledger) {
  const auto found = std::ranges::find_if(ledger.points, [](const LedgerPoint& p) { return p.measured.is_default; });
  return found != ledger.points.end() ? &*found : nullptr;
}

TEST_F(Points, rows_have_errors_against_the_whole_frame) {
  const Ledger ledger = measure();
  for (const LedgerRow& row : ledger.rows) {
    EXPECT_EQ(row.whole.has_value(), row.knob != "fake.cold") << row.knob << ": a look is not right or wrong";
    if (row.knob == "fake.steps" && row.value == "16") {
      EXPECT_EQ(row.flip->mean, 0.0) << "equal to its own reference,";
      EXPECT_NEAR(row.whole->rmse, 0.1 / 2 - 0.1 / 8, 1e-6) << "but rays are not exact";
    }
  }
}

TEST_F(Points, the_default_and_the_exact_setting_are_points) {
  for (const std::uint32_t most : {1u, 5u, 16u}) {
    request_.points = most;
    const Ledger ledger = measure();
    EXPECT_LE(ledger.points.size(), std::max(most, 2u));
    ASSERT_NE(default_of(ledger), nullptr);
    EXPECT_THAT(default_of(ledger)->settings, IsEmpty());
    EXPECT_EQ(default_of(ledger)->measured.ms, ledger.rows[2].ms) << "one default for rows and points";
    EXPECT_EQ(std::ranges::count_if(ledger.points, &LedgerPoint::is_exact), 1);
    for (const LedgerPoint& point : ledger.points) {
      EXPECT_EQ(point.measured.flip->mean == 0.0,
                point.is_exact || point.measured.picture == point.measured.reference_picture);
      if (point.is_exact) {
        EXPECT_EQ(point.settings, (std::vector<KnobValue>{{"fake.steps", "16"}, {"fake.rays", "8"}}));
      }
    }
    EXPECT_TRUE(
        std::ranges::is_sorted(ledger.points, {}, [](const LedgerPoint& p) { return p.measured.ms.median_ms; }));
  }
}

TEST_F(Points, no_points_are_measured_if_none_are_wanted) {
  request_.points = 0;
  const Ledger ledger = measure();
  EXPECT_THAT(ledger.points, IsEmpty());
  EXPECT_FALSE(ledger.model);
}

TEST_F(Points, a_look_keeps_the_users_value_and_an_idle_knob_is_not_varied) {
  ASSERT_TRUE(subject_.knobs().set("fake.cold", "on").ok());
  const Ledger ledger = measure();
  for (const LedgerPoint& point : ledger.points) {
    EXPECT_THAT(settings_text(point.settings), HasSubstr("fake.cold=on"));
    EXPECT_THAT(settings_text(point.settings), Not(HasSubstr("fake.idle")));
    if (point.is_exact) {
      EXPECT_EQ(point.measured.flip->mean, 0.0) << "the reference is cold, too";
    }
  }
  EXPECT_TRUE(subject_.knobs().value(kCold));
}

/// By drawing all combinations.
TEST_F(Points, their_front_is_near_that_of_all_combinations) {
  request_.points = 24;
  const Ledger ledger = measure();
  InteractingSubject twin;
  twin.knobs().set(kSteps, 16u);
  twin.knobs().set(kRays, 8u);
  const double exact = twin.brightness();
  for (const std::uint32_t steps : {1u, 2u, 4u, 8u, 16u})
    for (const bool glow : {false, true})
      for (const std::uint32_t rays : {1u, 2u, 4u, 8u}) {
        twin.knobs().set(kSteps, steps);
        twin.knobs().set(kGlow, glow);
        twin.knobs().set(kRays, rays);
        const double ms = 1.0 + twin.gpu_ms(), error = std::abs(twin.brightness() - exact);
        const bool beaten = std::ranges::any_of(ledger.points, [&](const LedgerPoint& point) {
          return point.measured.ms.median_ms <= 1.05 * ms && *point.measured.rmse <= 1.05 * error + 0.003;
        });
        EXPECT_TRUE(beaten) << steps << " steps, glow " << glow << ", " << rays << " rays: " << ms << " ms, " << error;
      }
}

TEST_F(Points, the_model_says_how_well_it_predicted) {
  const Ledger ledger = measure();
  ASSERT_TRUE(ledger.model.has_value());
  EXPECT_EQ(ledger.model->points, ledger.points.size() - 2) << "without the default and the exact setting";
  // Savings of glow and of its rays do not add up.
  EXPECT_NE(ledger.model->time.worst, 1.0);
  EXPECT_LE(std::abs(std::log(ledger.model->time.median)), std::abs(std::log(ledger.model->time.worst)));
  for (const LedgerPoint& point : ledger.points) {
    if (point.measured.is_default) {
      EXPECT_NEAR(point.predicted_flip, point.measured.flip->mean, 1e-12);
    }
  }
}

TEST_F(Points, no_setting_is_measured_twice) {
  request_.points = 24;
  std::set<std::string> settings;
  for (const LedgerPoint& point : measure().points)
    EXPECT_TRUE(settings.insert(settings_text(point.settings)).second) << settings_text(point.settings);
}

TEST_F(Points, a_second_run_draws_nothing) {
  const Ledger first = measure();
  const int drawn = subject_.frames_drawn;
  const Ledger second = measure();
  EXPECT_EQ(subject_.frames_drawn, drawn);
  EXPECT_EQ(progress_.measured, 0);
  EXPECT_EQ(second.points, first.points);
  EXPECT_EQ(second.rows, first.rows);
  EXPECT_EQ(second.model, first.model);
}

TEST_F(Points, go_on_where_they_were_cut_off) {
  const Ledger whole = measure();
  const int needed = subject_.frames_drawn;
  const TestFolder other;
  request_.folder = other.path();
  subject_.frames_drawn = 0;
  subject_.fail_after = needed - 20;
  const auto broken = measure_costs(request_, subject_, progress_);
  ASSERT_FALSE(broken.ok());
  EXPECT_THAT(broken.error().message, HasSubstr("fake.")) << "the error names the setting";
  EXPECT_EQ(subject_.knobs().value(kSteps), 4u) << "put back after a failure, too";
  EXPECT_EQ(subject_.knobs().value(kRays), 2u);
  subject_.fail_after = 0;
  const Ledger resumed = measure();
  EXPECT_GT(progress_.found, 0);
  EXPECT_GT(progress_.measured, 0);
  EXPECT_EQ(resumed.points, whole.points);
}

/// In the second camera, steps take four times as long.
TEST_F(Points, of_several_cameras_have_the_time_of_the_heaviest) {
  InteractingSubject heavy;
  heavy.steps_ms = 4.0;
  std::vector<CostCamera> cameras = {{request_, &subject_}, {request_, &heavy}};
  cameras[0].request.header.camera = "light";
  cameras[1].request.header.camera = "heavy";
  const auto ledger = measure_costs(cameras, progress_);
  ASSERT_TRUE(ledger.ok()) << ledger.error().message;
  EXPECT_EQ(ledger->header.camera, "light,heavy");
  EXPECT_EQ(progress_.measured, static_cast<int>(ledger->points.size())) << "a combination is one, in all cameras";
  EXPECT_GT(ledger->points.size(), 8u);
  const LedgerPoint* standard = default_of(*ledger);
  ASSERT_NE(standard, nullptr);
  for (const LedgerPoint& point : ledger->points) {
    ASSERT_EQ(point.cameras.size(), 2u);
    double slowest_ms = 0.0, greatest = 0.0;
    for (const LedgerRow& row : point.cameras) {
      slowest_ms = std::max(slowest_ms, row.ms.median_ms);
      greatest = std::max(greatest, row.flip->mean);
    }
    EXPECT_EQ(point.measured.ms.median_ms, slowest_ms);
    EXPECT_NEAR(point.measured.ratio, slowest_ms / standard->measured.ms.median_ms, 1e-9);
    EXPECT_LE(point.measured.ratio_low, point.measured.ratio);
    EXPECT_GE(point.measured.ratio_high, point.measured.ratio);
    EXPECT_EQ(point.measured.flip->mean, greatest);
  }
  EXPECT_EQ(subject_.knobs().value(kSteps), 4u);
  EXPECT_EQ(heavy.knobs().value(kSteps), 4u);
  progress_ = {};
  const auto again = measure_costs(cameras, progress_);
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(progress_.measured, 0);
  EXPECT_EQ(again->points, ledger->points);
}

TEST_F(Points, the_console_shows_the_front) {
  const Ledger ledger = measure();
  const std::string table = points_table(ledger);
  EXPECT_THAT(table, HasSubstr("the user's own settings"));
  EXPECT_THAT(table, HasSubstr("the exact setting"));
  EXPECT_THAT(table, HasSubstr("measured / predicted over"));
  EXPECT_EQ(points_table(Ledger{}), "");
}

TEST_F(Points, the_whole_frame_is_drawn_once) {
  request_.points = 0;
  request_.knobs = {"fake.idle"};
  static_cast<void>(measure());
  const int with = subject_.frames_drawn;
  request_.header.frames = 3;  // rows are measured again
  static_cast<void>(measure());
  const int again = subject_.frames_drawn - with;
  EXPECT_EQ(again, with - 4 + 1 + 3) << "without the three frames of the reference, with one more pair and its warm-up";
}

}  // namespace
}  // namespace gloam
