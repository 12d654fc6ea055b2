// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Knobs that are judged in other ways than by pictures alone, or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "modules/accuracy/module.h"
#include "tests/modules/accuracy/fake_subject.h"

namespace gloam {
namespace {

using test::kSamples;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class JudgedKnobs : public test::MeasureCosts {};

TEST_F(JudgedKnobs, a_knob_that_changes_nothing_says_why) {
  request_.knobs = {"fake.count"};
  request_.header.frames = 8;
  subject_.reasons["fake.count"] = "nothing is counted";
  const Ledger ledger = measure();
  EXPECT_EQ(ledger.rows[0].no_effect_reason, "nothing is counted");
  EXPECT_EQ(ledger.rows[1].no_effect_reason, "") << "only the default's row";
  EXPECT_THAT(ledger_table(ledger), HasSubstr("fake.count: no effect here: nothing is counted; the pictures of all"));
  EXPECT_THAT(ledger_report(ledger, {}), HasSubstr("nothing is counted"));
}

TEST_F(JudgedKnobs, a_value_that_changes_nothing_for_a_known_reason_is_not_timed) {
  request_.knobs = {"fake.count", "fake.samples"};  // nothing is timed beside the first
  request_.header.frames = 8;
  subject_.reasons["fake.count"] = subject_.reasons["fake.samples"] = "a wrong reason";
  const Ledger ledger = measure();
  ASSERT_EQ(ledger.rows.size(), 6u);
  for (const LedgerRow& row : ledger.rows) {
    if (row.is_default) continue;
    EXPECT_EQ(row.pairs == 0, row.knob == "fake.count") << row.value << ": other pictures are timed";
    if (row.pairs > 0) continue;
    EXPECT_TRUE(row.no_effect);
    EXPECT_EQ(row.ratio, 1.0);
    EXPECT_EQ(row.ms, ledger.rows[0].ms);
    EXPECT_GT(row.ms.median_ms, 0.0) << "the default's";
  }
  const int drawn = subject_.frames_drawn;
  const Ledger again = measure();
  EXPECT_EQ(progress_.measured, 0);
  EXPECT_EQ(subject_.frames_drawn, drawn) << "the default's frames are kept, too";
  EXPECT_EQ(again.rows, ledger.rows);
  subject_.reasons.clear();
  EXPECT_THAT(ledger_table(ledger), HasSubstr("are equal, and they were not timed\n"));
  request_.header.frames = 6;
  for (const LedgerRow& row : measure().rows) EXPECT_GT(row.pairs, 0u) << "without a reason, too";
}

TEST_F(JudgedKnobs, a_taste_has_its_reason_in_place_of_errors) {
  request_.knobs = {"fake.taste"};
  Ledger ledger = measure();
  for (const LedgerRow& row : ledger.rows) {
    EXPECT_EQ(row.no_reference, "a look");
    EXPECT_FALSE(row.error() || row.flip || row.on_front) << row.value;
  }
  EXPECT_THAT(ledger_table(ledger), HasSubstr("fake.taste: no reference: a look\n"));
  for (LedgerRow& row : ledger.rows) row.no_effect = false;  // as with pictures that differ
  ledger.rows[1].ratio = ledger.rows[1].ratio_high = 0.5;
  const std::string report = ledger_report(ledger, {});
  EXPECT_THAT(report, HasSubstr("No reference: a look."));
  EXPECT_THAT(report, HasSubstr("and gives back"));
  EXPECT_THAT(report, Not(HasSubstr("error no reference")));
}

TEST_F(JudgedKnobs, a_method_with_another_picture_is_wrong) {
  request_.knobs = {"fake.method"};
  Ledger ledger = measure();
  ASSERT_EQ(ledger.rows.size(), 3u);
  EXPECT_EQ(ledger.rows[0].wrong, "");
  EXPECT_EQ(ledger.rows[1].wrong, "");
  EXPECT_EQ(ledger.rows[2].wrong, "its picture is not equal to the bit to that of fake.method=a");
  EXPECT_THAT(ledger_table(ledger), HasSubstr("! fake.method=c is wrong"));
  // By a measure, too, and a fault of the measure comes first.
  subject_.measures_ = {{.knob = "fake.method",
                         .kind = "brute force",
                         .name = "all",
                         .picture = {{"fake.method", "b"}},
                         .error = [](const FrameCounters&, const FrameCounters&) { return std::nullopt; },
                         .fault = [](const FrameCounters&) { return std::string(); }}};
  request_.conditions = "another";
  ledger = measure();
  EXPECT_EQ(ledger.rows[1].wrong, "");
  EXPECT_EQ(ledger.rows[2].wrong, "its picture is not equal to the bit to that of all");
  EXPECT_GT(*ledger.rows[2].error(), 0.0) << "without a count, that of the picture";
}

TEST_F(JudgedKnobs, a_distance_is_the_error_and_pictures_are_judged_by_the_exact_value) {
  judge_by({.knob = "fake.samples",
            .kind = "double precision",
            .name = "finer",
            .distance = [](const ReferenceInput&) { return std::optional<MovedDistance>(); },
            .unit = "mm"});
  subject_.distance = [](double brightness) { return MovedDistance{brightness, 2.0 * brightness}; };
  Ledger ledger = measure();
  ASSERT_EQ(ledger.rows.size(), 4u);
  for (const LedgerRow& row : ledger.rows) {
    EXPECT_EQ(row.reference_kind, "double precision");
    EXPECT_EQ(row.reference_name, "finer; pictures against fake.samples=64");
    ASSERT_TRUE(row.counted && row.flip);
    const double expected = 0.25 + (row.value == "64" ? 0.0 : 0.5 / std::stod(row.value));
    EXPECT_EQ(*row.counted, (CountedError{expected, "mm", 2.0 * expected})) << "of the frame with the row's value";
    EXPECT_EQ(row.error(), expected);
  }
  EXPECT_THAT(ledger_table(ledger), HasSubstr("0.750, p99 1.500"));
  EXPECT_THAT(ledger_report(ledger, {}), HasSubstr("0.750 (p99 1.50) mm"));
  subject_.distance = [](double) { return std::nullopt; };
  request_.conditions = "another";
  ledger = measure();
  for (const LedgerRow& row : ledger.rows) EXPECT_FALSE(row.counted) << "nothing to measure";
}

TEST_F(JudgedKnobs, a_reference_is_drawn_with_its_own_knobs) {
  judge_by({.knob = "fake.look",
            .kind = "accumulated",
            .name = "finest",
            .drawn_with = {{"fake.samples", "64"}, {"fake.look", "cold"}}});
  std::vector<std::string> looks;
  subject_.reference = [&](const FramePictures& frame, std::uint32_t) -> Result<FramePictures> {
    looks.push_back(subject_.knobs().text(*subject_.knobs().find("fake.look")));
    return frame;
  };
  request_.knobs = {"fake.look"};
  const Ledger ledger = measure();
  EXPECT_THAT(looks, ElementsAre("cold")) << "while the reference draws, too";
  for (const LedgerRow& row : ledger.rows) EXPECT_NEAR(*row.rmse, 0.125, 1e-6) << "of four samples against 64";
  EXPECT_EQ(subject_.knobs().value(kSamples), 4u) << "put back";
}

}  // namespace
}  // namespace gloam
