// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <vector>

#include "engine/math/srgb.h"
#include "engine/render/knobs/knob_table.h"
#include "modules/accuracy/module.h"
#include "tests/modules/accuracy/fake_subject.h"
#include "tests/support/expect_assert.h"
#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

using test::FakeSubject;
using test::kCount;
using test::kSamples;
using test::kSide;
using test::MeasureCosts;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(MeasureCosts, gives_every_picture_of_every_row) {
  const Ledger ledger = measure();
  for (const LedgerRow& row : ledger.rows) {
    EXPECT_EQ(row_pictures(row).size(), row.value == "64" ? 2u : 4u) << row.value << ": without error, no heat map";
    for (const std::string& name : row_pictures(row)) EXPECT_TRUE(progress_.pictures.contains(name)) << name;
    EXPECT_EQ(row.picture == row.reference_picture, row.value == "64") << "the exact value is its own reference";
    const std::vector<PictureArea> whole = {{0, 0, kSide, kSide}};
    EXPECT_EQ(row.worst, row.value == "64" ? std::vector<PictureArea>() : whole);
  }
}

TEST_F(MeasureCosts, measures_a_row_again_if_its_picture_is_lost) {
  const Ledger ledger = measure();
  progress_ = {};
  progress_.lost = ledger.rows[1].picture;
  ASSERT_TRUE(measure_costs(request_, subject_, progress_).ok());
  EXPECT_EQ(progress_.measured, 1);
  EXPECT_EQ(progress_.found, 3);
  EXPECT_TRUE(progress_.pictures.contains(progress_.lost));
}

TEST_F(MeasureCosts, holds_every_value_against_the_most_exact_one) {
  const Ledger ledger = measure();
  ASSERT_EQ(ledger.rows.size(), 4u);
  for (const LedgerRow& row : ledger.rows) {
    EXPECT_EQ(row.reference_kind, "brute force");
    EXPECT_EQ(row.reference_name, "fake.samples=64");
    const double samples = std::stod(row.value);
    EXPECT_NEAR(*row.rmse, row.value == "64" ? 0.0 : 0.5 / samples, 1e-6) << row.value;
    EXPECT_DOUBLE_EQ(row.ms.median_ms, 1.0 + samples);
    EXPECT_DOUBLE_EQ(row.gpu_ms, samples);
    EXPECT_DOUBLE_EQ(row.module_cpu_ms, 0.5) << "of the knob's module alone";
    EXPECT_DOUBLE_EQ(row.module_gpu_ms, samples / 2.0);
    EXPECT_FALSE(row.counted);
    EXPECT_DOUBLE_EQ(row.ratio, (1.0 + samples) / 5.0);
    EXPECT_EQ(row.is_default, row.value == "4");
    EXPECT_EQ(row.gpu_bytes, std::stoull(row.value) * 100) << "of the value, not of the default";
    EXPECT_TRUE(row.on_front) << "each is dearer and righter than the one before";
    EXPECT_FALSE(row.temporal);
  }
  EXPECT_GT(ledger.rows[0].flip->mean, ledger.rows[1].flip->mean);
  EXPECT_EQ(ledger.rows[3].flip->mean, 0.0);
}

TEST_F(MeasureCosts, the_default_has_one_time_and_one_memory) {
  subject_.slower_by = 0.25;  // each frame slower than the one before
  request_.knobs = {"fake.samples", "fake.look", "fake.count"};
  const Ledger ledger = measure();
  for (const LedgerRow& row : ledger.rows) {
    if (row.is_default) {
      EXPECT_EQ(row.ms, ledger.rows[1].ms);
      EXPECT_EQ(row.pairs, 4u * 5u) << "of all rows but its own, two of which were timed together";
      EXPECT_EQ(row.gpu_bytes, ledger.rows[1].gpu_bytes);
    } else {
      EXPECT_EQ(row.pairs, 5u);
      EXPECT_NEAR(row.ms.median_ms, row.ratio * ledger.rows[1].ms.median_ms, 1e-9);
    }
  }
  const Ledger again = measure();
  EXPECT_EQ(progress_.measured, 0);
  EXPECT_EQ(again.rows, ledger.rows) << "also when the rows were measured before";
  // A knob that the user has set to another value has a default of its own.
  ASSERT_TRUE(subject_.knobs().set("fake.samples", "16").ok());
  const Ledger other = measure();
  std::vector<TimeSummary> defaults;
  for (const LedgerRow& row : other.rows)
    if (row.is_default) defaults.push_back(row.ms);
  ASSERT_EQ(defaults.size(), 3u);
  EXPECT_NE(defaults[0], defaults[1]);
  EXPECT_EQ(defaults[1], defaults[2]);
}

TEST_F(MeasureCosts, a_knob_that_changes_nothing_has_no_effect) {
  request_.knobs = {"fake.count"};
  request_.header.frames = 8;
  Ledger ledger = measure();
  ASSERT_EQ(ledger.rows.size(), 2u);
  EXPECT_TRUE(ledger.rows[0].no_effect && ledger.rows[1].no_effect);
  EXPECT_THAT(ledger_table(ledger), HasSubstr("fake.count: no effect here"));
  EXPECT_THAT(ledger_table(ledger), Not(HasSubstr("fake.count  ")));
  request_.knobs = {"fake.samples"};
  ledger = measure();
  for (const LedgerRow& row : ledger.rows) EXPECT_EQ(row.no_effect, row.is_default) << row.value;
}

TEST_F(MeasureCosts, leaves_the_users_value_and_tells_progress) {
  ASSERT_TRUE(subject_.knobs().set("fake.samples", "7").ok());
  static_cast<void>(measure());
  EXPECT_EQ(subject_.knobs().value(kSamples), 7u);
  EXPECT_THAT(progress_.lines,
              ElementsAre("fake.samples=1 0/4", "fake.samples=4 1/4", "fake.samples=16 2/4", "fake.samples=64 3/4"));
  EXPECT_EQ(progress_.measured, 4);
}

TEST_F(MeasureCosts, time_goes_on_up_to_a_picture_and_while_frames_are_timed) {
  request_.header.frames = 2;
  static_cast<void>(measure());
  const std::vector<std::int32_t>& drawn = subject_.indices;
  ASSERT_GT(drawn.size(), 24u);
  EXPECT_THAT(std::vector(drawn.begin(), drawn.begin() + 9), ElementsAre(-2, -1, 0, -2, -1, 0, -2, -1, 0))
      << "the whole frame, the reference, and the first value";
  std::size_t repeated = 0;
  for (std::size_t i = 1; i < drawn.size(); ++i) repeated += drawn[i] == drawn[i - 1] ? 1 : 0;
  EXPECT_EQ(repeated, 1u) << "where times begin; the picture of the exact value is known from the reference";
}

TEST_F(MeasureCosts, pictures_that_are_accumulated_come_to_rest_before_they_are_read) {
  subject_.rest = 5;
  measure();
  const std::vector<std::int32_t> settled = {-2, -1, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(std::ranges::search(subject_.indices, settled).size(), settled.size());
}

TEST_F(MeasureCosts, memory_settles_once_before_it_is_asked_for) {
  request_.knobs = {"fake.samples", "fake.look"};
  static_cast<void>(measure());
  EXPECT_EQ(subject_.frames_before_settling, std::vector<int>{3}) << "the frames with exact values";
}

TEST_F(MeasureCosts, a_second_run_draws_nothing) {
  const Ledger first = measure();
  const int drawn = subject_.frames_drawn;
  const Ledger second = measure();
  EXPECT_EQ(subject_.frames_drawn, drawn);
  EXPECT_EQ(progress_.found, 4);
  EXPECT_EQ(second.rows, first.rows);
}

TEST_F(MeasureCosts, goes_on_where_it_was_cut_off) {
  // A picture; the times of two values, together; the last value.
  const struct {
    int fail_after;
    const char* message;
    int measured;
  } cases[] = {{10, "fake.samples=4: ", 0}, {30, "fake.samples=1 and 16: ", 0}, {45, "fake.samples=64: ", 3}};
  for (const auto& own : cases) {
    const test::TestFolder folder;
    request_.folder = folder.path();
    progress_ = {};
    subject_.frames_drawn = 0;
    subject_.fail_after = own.fail_after;
    const auto broken = measure_costs(request_, subject_, progress_);
    ASSERT_FALSE(broken.ok());
    EXPECT_EQ(broken.error().message, own.message + std::string("the device is lost"));
    EXPECT_EQ(progress_.measured, own.measured);
    EXPECT_EQ(subject_.knobs().value(kSamples), 4u) << "put back after a failure, too";
    subject_.fail_after = 0;
    static_cast<void>(measure());
    EXPECT_EQ(progress_.found, own.measured);
    EXPECT_EQ(progress_.measured, 4 - own.measured);
  }
}

TEST_F(MeasureCosts, measures_again_when_anything_a_row_depends_on_has_changed) {
  static_cast<void>(measure());
  const std::vector<std::function<void()>> changes = {
      [&] { request_.header.scene_hash = "other"; },
      [&] { request_.header.width = kSide + 1; },
      [&] { request_.header.camera = "other"; },
      [&] { request_.header.time_s = 1e-9; },
      [&] { request_.header.device = "other"; },
      [&] { request_.header.driver = "other"; },
      [&] { request_.header.version = "other"; },
      [&] { request_.header.build = "other"; },
      [&] { request_.header.frames = 6; },
      [&] { request_.header.samples = 65; },
      [&] { request_.conditions = "seed 2"; },
      [&] { request_.sequence = 2; },
      [&] { EXPECT_TRUE(subject_.knobs().set("fake.look", "cold").ok()); }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    changes[i]();
    static_cast<void>(measure());
    EXPECT_EQ(progress_.measured, 4) << "change " << i;
  }
  ASSERT_TRUE(subject_.knobs().set("fake.samples", "9").ok());
  static_cast<void>(measure());
  EXPECT_EQ(progress_.found, 4) << "how the measured knob itself was set does not matter";
}

TEST_F(MeasureCosts, a_knob_without_a_reference_has_times_alone) {
  request_.knobs = {"fake.look"};
  const Ledger ledger = measure();
  ASSERT_EQ(ledger.rows.size(), 2u);
  for (const LedgerRow& row : ledger.rows) {
    EXPECT_EQ(row.reference_kind, "");
    EXPECT_FALSE(row.error());
    EXPECT_FALSE(row.on_front);
    EXPECT_GT(row.ms.median_ms, 0.0);
  }
  EXPECT_THAT(ledger_table(ledger), HasSubstr("fake.look: no reference"));
}

TEST_F(MeasureCosts, a_sequence_shows_flicker) {
  request_.sequence = 3;
  const Ledger ledger = measure();
  EXPECT_NEAR(ledger.rows[0].temporal->mean, 0.25, 1e-6);
  EXPECT_NEAR(ledger.rows[2].temporal->mean, 0.25 / 16.0, 1e-6);
  EXPECT_EQ(ledger.rows[3].temporal->mean, 0.0);
  EXPECT_NEAR(*ledger.rows[0].rmse, 0.5, 1e-6) << "the picture is of the first moment";
}

TEST_F(MeasureCosts, accumulated_references_of_a_sequence_show_flicker) {
  judge_by({.knob = "fake.samples", .kind = "accumulated", .name = "many frames", .samples = true});
  subject_.reference = [](const FramePictures&, std::uint32_t) -> Result<FramePictures> {
    FramePictures result = FakeSubject::pictures(0.25);
    result.linear = {};
    return result;
  };
  EXPECT_FALSE(measure().rows[0].temporal);
  request_.sequence = 3;
  const Ledger ledger = measure();
  // The light that codes of sRGB stand for; the reference does not change.
  const auto light = [](double brightness) { return srgb_to_linear(std::round(255.0 * brightness) / 255.0); };
  EXPECT_NEAR(ledger.rows[0].temporal->mean, light(0.75) - light(0.5), 1e-6);
  EXPECT_NEAR(ledger.rows[2].temporal->mean, light(0.25 + 0.5 / 16.0) - light(0.25 + 0.25 / 16.0), 1e-6);
  EXPECT_THAT(ledger_table(ledger), HasSubstr("temporal"));
}

TEST_F(MeasureCosts, a_modules_reference_serves_all_values_and_tells_its_noise) {
  judge_by({.knob = "fake.samples", .kind = "traced", .name = "sums", .samples = true});
  subject_.reference = [](const FramePictures& frame, std::uint32_t samples) -> Result<FramePictures> {
    EXPECT_NEAR(frame.linear.rgba[0], 0.25f + 0.125f, 1e-6f) << "computed from the default's frame";
    FramePictures result = FakeSubject::pictures(0.25 + 1.0 / samples);
    result.picture = {};
    return result;
  };
  const Ledger ledger = measure();
  EXPECT_EQ(subject_.references_drawn, 2) << "half and all samples";
  for (const LedgerRow& row : ledger.rows) {
    EXPECT_EQ(row.reference_kind, "traced");
    EXPECT_NEAR(row.reference_noise, 1.0 / 32.0 - 1.0 / 64.0, 1e-6);
    EXPECT_FALSE(row.flip) << "the reference has no picture";
  }
  EXPECT_NEAR(*ledger.rows[0].rmse, 0.5 - 1.0 / 64.0, 1e-6);
  EXPECT_FALSE(ledger.rows[0].below_noise);
  EXPECT_NEAR(*ledger.rows[3].rmse, 1.0 / 64.0, 1e-6);
  request_.header.frames = 6;  // another identity: rows are measured again …
  static_cast<void>(measure());
  EXPECT_EQ(subject_.references_drawn, 2) << "… the reference is not computed again";
}

TEST_F(MeasureCosts, an_error_below_the_references_noise_says_so) {
  judge_by({.knob = "fake.samples", .kind = "traced", .name = "sums", .samples = true});
  subject_.reference = [](const FramePictures&, std::uint32_t samples) -> Result<FramePictures> {
    return FakeSubject::pictures(0.25 + 8.0 / samples);
  };
  const Ledger ledger = measure();
  EXPECT_FALSE(ledger.rows[0].below_noise);
  EXPECT_TRUE(ledger.rows[1].below_noise) << "wrong by nothing, 0.125 of noise";
}

TEST_F(MeasureCosts, a_twin_follows_each_value) {
  judge_by({.knob = "fake.samples", .kind = "double precision", .name = "twin", .follows_value = true});
  subject_.reference = [](const FramePictures& frame, std::uint32_t) -> Result<FramePictures> {
    FramePictures result = FakeSubject::pictures(frame.linear.rgba[0]);
    result.linear = {};
    return result;
  };
  const Ledger ledger = measure();
  EXPECT_EQ(subject_.references_drawn, 4);
  for (const LedgerRow& row : ledger.rows) {
    EXPECT_EQ(row.flip->mean, 0.0);
    EXPECT_EQ(row.reference_noise, 0.0);
    EXPECT_FALSE(row.below_noise);
    EXPECT_FALSE(row.rmse);
  }
}

TEST_F(MeasureCosts, an_effects_model_is_judged_beside_each_value_s_own_error) {
  judge_by({.knob = "fake.samples", .kind = "traced", .name = "sums"});
  subject_.reference = [](const FramePictures& frame, std::uint32_t) -> Result<FramePictures> { return frame; };
  for (const LedgerRow& row : measure().rows) EXPECT_FALSE(row.effect_model);
  subject_.references_.front().draw_model = [](const ReferenceInput&) -> Result<FramePictures> {
    return FramePictures{};
  };
  subject_.references_.front().model_name = FakeSubject::kModelName;
  request_.header.frames = 6;  // another identity: rows are measured again
  const Ledger ledger = measure();
  EXPECT_EQ(subject_.models_drawn, 2) << "half and all samples";
  for (const LedgerRow& row : ledger.rows) {
    ASSERT_TRUE(row.effect_model);
    EXPECT_EQ(row.effect_model->name, FakeSubject::kModelName);
    EXPECT_GT(row.effect_model->flip.mean, 0.0);
    const double samples = std::stod(row.value), drawn = row.value == "64" ? 0.25 : 0.25 + 0.5 / samples;
    EXPECT_NEAR(row.effect_model->rmse, std::abs(0.5 + 0.1 / 64.0 - drawn), 1e-6);
    EXPECT_NEAR(*row.rmse, std::abs(0.375 - drawn), 1e-6) << "the value's own error";
  }
  request_.header.frames = 7;
  static_cast<void>(measure());
  EXPECT_EQ(subject_.models_drawn, 2) << "the picture is kept";
}

TEST_F(MeasureCosts, a_reference_that_fails_names_the_row) {
  judge_by({.knob = "fake.samples", .kind = "traced", .name = "sums"});
  subject_.reference = [](const FramePictures&, std::uint32_t) -> Result<FramePictures> {
    return Error{ErrorKind::failed, "out of memory"};
  };
  const auto ledger = measure_costs(request_, subject_, progress_);
  ASSERT_FALSE(ledger.ok());
  EXPECT_EQ(ledger.error().message, "fake.samples=1: out of memory");
}

/// Counts the work beyond that of the default. The value 16 is wrong.
MeasureInfo work_measure() {
  MeasureInfo info = {.knob = "fake.samples", .kind = "brute force", .name = "the least work", .unit = "steps"};
  info.judged_with = {override_of(kCount, true)};
  info.picture = {override_of(kSamples, 64)};
  info.error = [](const FrameCounters& frame, const FrameCounters& standard) -> std::optional<double> {
    if (!frame.contains("fake.work") || frame.at("fake.work") == 1.0) return std::nullopt;
    return frame.at("fake.work") - standard.at("fake.work");
  };
  info.fault = [](const FrameCounters& frame) {
    return frame.at("fake.work") == 16.0 ? std::string("16 of them") : std::string();
  };
  return info;
}

TEST_F(MeasureCosts, a_measure_counts_in_place_of_pictures) {
  subject_.measures_ = {work_measure()};
  request_.sequence = 2;
  const Ledger ledger = measure();
  ASSERT_EQ(ledger.rows.size(), 4u);
  EXPECT_FALSE(ledger.rows[0].counted) << "not counted this time";
  EXPECT_EQ(ledger.rows[1].counted, (CountedError{0.0, "steps"}));
  EXPECT_EQ(ledger.rows[3].counted, (CountedError{60.0, "steps"}));
  for (const LedgerRow& row : ledger.rows) {
    EXPECT_EQ(row.reference_name, "the least work");
    EXPECT_EQ(row.wrong, row.value == "16" ? "16 of them" : "");
    EXPECT_NEAR(*row.rmse, row.value == "64" ? 0.0 : 0.5 / std::stod(row.value), 1e-6) << "against the right picture";
    EXPECT_TRUE(row.flip && row.temporal) << "pictures are compared all the same";
  }
  EXPECT_FALSE(ledger.rows[2].on_front) << "wrong";
  EXPECT_EQ(ledger.rows[0].error(), ledger.rows[0].flip->mean);
  EXPECT_EQ(ledger.rows[3].error(), 60.0);
}

TEST_F(MeasureCosts, what_counting_needs_is_set_for_judging_alone) {
  subject_.measures_ = {work_measure()};
  static_cast<void>(measure());
  EXPECT_EQ(subject_.counted_frames, 3 * 4) << "four values, three frames each to settle; the standard is one of them";
  EXPECT_FALSE(subject_.knobs().value(kCount));
  EXPECT_EQ(subject_.knobs().value(kSamples), 4u);
}

TEST_F(MeasureCosts, a_measure_that_needs_an_unknown_knob_fails) {
  subject_.measures_ = {work_measure()};
  subject_.measures_[0].judged_with.push_back({"fake.nothing", "1"});
  const auto ledger = measure_costs(request_, subject_, progress_);
  ASSERT_FALSE(ledger.ok());
  EXPECT_THAT(ledger.error().message, HasSubstr("fake.nothing"));
  EXPECT_FALSE(subject_.knobs().value(kCount)) << "put back after a failure, too";
}

TEST_F(MeasureCosts, of_no_knobs_is_an_empty_ledger) {
  request_.knobs = {};
  request_.skipped = {{"fake.look", "not called for"}};
  const Ledger ledger = measure();
  EXPECT_TRUE(ledger.rows.empty());
  EXPECT_EQ(ledger.skipped, request_.skipped);
  EXPECT_EQ(subject_.frames_drawn, 0);
}

TEST_F(MeasureCosts, values_of_a_ledger_hold_the_default_and_the_exact_one_once) {
  EXPECT_THAT(ledger_values(*subject_.knobs().find("fake.samples")), ElementsAre("1", "4", "16", "64"));
  EXPECT_THAT(ledger_values(*subject_.knobs().find("fake.look")), ElementsAre("warm", "cold"));
  Knob bare = {.name = "bare", .type = Knob::Type::number, .min = 0.0, .max = 1.0, .default_number = 0.5};
  EXPECT_THAT(ledger_values(bare), ElementsAre("0.5"));
}

TEST_F(MeasureCosts, knobs_are_chosen_by_name) {
  const KnobRegistry& knobs = subject_.knobs();
  EXPECT_THAT(*choose_knobs(knobs, ""),
              ElementsAre("fake.samples", "fake.look", "fake.count", "fake.taste", "fake.method"));
  EXPECT_THAT(*choose_knobs(knobs, "fake.look,fake.samples,fake.look"), ElementsAre("fake.look", "fake.samples"));
  EXPECT_THAT(*choose_knobs(knobs, "fake.*"),
              ElementsAre("fake.samples", "fake.look", "fake.count", "fake.taste", "fake.method"));
  EXPECT_THAT(*choose_knobs(knobs, "*.look,f*s"), ElementsAre("fake.look", "fake.samples"));
  EXPECT_THAT(*choose_knobs(knobs, "*"),
              ElementsAre("fake.samples", "fake.look", "fake.count", "fake.taste", "fake.method"));
  EXPECT_THAT(*choose_knobs(knobs, "fake.**t"), ElementsAre("fake.count"));
  EXPECT_FALSE(choose_knobs(knobs, "fake.samples*s").ok()) << "no character stands for two";
  for (const char* list : {"nope", "fog.*", "*.loo", "ake*", "fake.look,", ",fake.look", "fake.look,,fake.samples",
                           "fake.look fake.samples"}) {
    const auto chosen = choose_knobs(knobs, list);
    ASSERT_FALSE(chosen.ok()) << list;
    EXPECT_EQ(chosen.error().kind, ErrorKind::usage);
    EXPECT_THAT(chosen.error().message, HasSubstr("there are fake.samples, fake.look"));
    EXPECT_THAT(chosen.error().message, Not(HasSubstr("did you mean")));
  }
  EXPECT_THAT(choose_knobs(knobs, "fake.lok").error().message,
              HasSubstr("unknown knob 'fake.lok'; did you mean fake.look? there are fake.samples, fake.look"));
}

}  // namespace
}  // namespace gloam
