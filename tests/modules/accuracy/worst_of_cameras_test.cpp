// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/accuracy/outputs.h"

namespace gloam {
namespace {

using testing::HasSubstr;

LedgerRow row(const char* value, double flip, double ratio, const char* picture) {
  LedgerRow row = {.knob = "k", .value = value, .is_default = std::string_view(value) == "b"};
  row.reference_kind = "brute force";
  row.flip = ErrorPair{flip, 2.0 * flip};
  row.ms = {10.0 * ratio, 9.0 * ratio, 11.0 * ratio};
  row.ratio = row.ratio_low = row.ratio_high = row.sure_low = row.sure_high = ratio;
  row.gpu_bytes = static_cast<std::uint64_t>(1000.0 * ratio);
  row.picture = picture;
  return row;
}

Ledger ledger(const char* camera, std::vector<LedgerRow> rows) {
  mark_pareto_front(rows);
  return {.header = {.scene = "s", .camera = camera}, .rows = std::move(rows), .skipped = {{"other", "absent"}}};
}

TEST(WorstOfCameras, every_figure_is_from_the_camera_where_it_is_worst) {
  const Ledger near = ledger("near", {row("a", 0.5, 0.25, "near a"), row("b", 0.0, 1.0, "near b")});
  const Ledger far = ledger("far", {row("a", 0.25, 0.5, "far a"), row("b", 0.0, 1.0, "far b")});
  const Ledger worst = worst_of_cameras({near, far});
  ASSERT_EQ(worst.rows.size(), 2u);
  EXPECT_EQ(worst.header.camera, "near,far");
  EXPECT_EQ(worst.rows[0].flip->mean, 0.5);
  EXPECT_EQ(worst.rows[0].picture, "near a");
  EXPECT_EQ(worst.rows[0].ratio, 0.5);
  EXPECT_EQ(worst.rows[0].sure_high, 0.5);
  EXPECT_EQ(worst.rows[0].ms.median_ms, 5.0);
  EXPECT_EQ(worst.rows[0].gpu_bytes, 500u);
  EXPECT_EQ(worst.skipped, near.skipped);
  ASSERT_EQ(worst.cameras.size(), 2u);
  EXPECT_EQ(worst.cameras[0].rows, near.rows);
  EXPECT_EQ(worst.cameras[1].camera, "far");
}

TEST(WorstOfCameras, the_effect_s_model_is_judged_by_the_camera_where_it_is_worst) {
  Ledger near = ledger("near", {row("b", 0.5, 1.0, "near b")}), far = ledger("far", {row("b", 0.0, 1.0, "far b")});
  far.rows[0].effect_model = EffectModelError{"marched rays", {0.25, 0.5}, 2.5, 0.0};
  EXPECT_EQ(worst_of_cameras({near, far}).rows[0].effect_model, far.rows[0].effect_model);
  near.rows[0].effect_model = EffectModelError{"marched rays", {0.125, 0.75}, 7.5, 0.0};
  EXPECT_EQ(worst_of_cameras({near, far}).rows[0].effect_model, far.rows[0].effect_model);
}

TEST(WorstOfCameras, a_value_that_is_dearer_in_one_camera_is_on_no_front) {
  const Ledger near = ledger("near", {row("a", 0.5, 0.5, "near a"), row("b", 0.0, 1.0, "near b")});
  const Ledger far = ledger("far", {row("a", 0.5, 2.0, "far a"), row("b", 0.0, 1.0, "far b")});
  EXPECT_TRUE(near.rows[0].on_front);
  const Ledger worst = worst_of_cameras({near, far});
  EXPECT_FALSE(worst.rows[0].on_front);
  EXPECT_TRUE(worst.rows[1].on_front);
}

TEST(WorstOfCameras, no_effect_is_no_effect_in_every_camera) {
  const Ledger same = ledger("same", {row("a", 0.0, 1.0, "p"), row("b", 0.0, 1.0, "p")});
  ASSERT_TRUE(same.rows[0].no_effect);
  const Ledger other = ledger("other", {row("a", 0.5, 1.0, "q"), row("b", 0.0, 1.0, "p")});
  EXPECT_TRUE(worst_of_cameras({same, same}).rows[0].no_effect);
  EXPECT_FALSE(worst_of_cameras({same, other}).rows[0].no_effect);
  EXPECT_FALSE(worst_of_cameras({other, same}).rows[0].no_effect);
}

TEST(WorstOfCameras, a_value_that_is_wrong_in_one_camera_is_wrong) {
  Ledger wrong = ledger("wrong", {row("a", 0.0, 0.5, "p"), row("b", 0.0, 1.0, "p")});
  wrong.rows[0].wrong = "3 lights are missing";
  const Ledger worst = worst_of_cameras({ledger("right", {row("a", 0.1, 0.5, "q"), row("b", 0.0, 1.0, "p")}), wrong});
  EXPECT_EQ(worst.rows[0].wrong, "3 lights are missing");
  EXPECT_FALSE(worst.rows[0].on_front);
}

TEST(WorstOfCameras, of_one_camera_is_its_ledger) {
  const Ledger one = ledger("one", {row("a", 0.1, 0.5, "q"), row("b", 0.0, 1.0, "p")});
  const Ledger worst = worst_of_cameras({one});
  EXPECT_EQ(worst.rows, one.rows);
  EXPECT_TRUE(worst.cameras.empty());
  EXPECT_EQ(ledger_json(worst).find("\"cameras\""), std::string::npos);
}

TEST(WorstOfCameras, its_texts_have_every_camera) {
  const Ledger worst =
      worst_of_cameras({ledger("near", {row("b", 0.5, 1.0, "p")}), ledger("far", {row("b", 0.1, 1.0, "q")})});
  const auto read = parse_ledger_json(ledger_json(worst));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->cameras, worst.cameras);
  EXPECT_THAT(ledger_table(worst), HasSubstr("worst of 2 cameras"));
  const std::string csv = ledger_csv(worst);
  EXPECT_THAT(csv, HasSubstr(",\"near,far\"\n"));
  EXPECT_THAT(csv, HasSubstr(",far\n"));
}

TEST(WorstPoint, has_the_time_of_the_slowest_camera_and_the_greatest_error) {
  // Frames of the default: 40 ms in the first camera, 10 in the second, where the value is dearer than the default.
  std::vector<LedgerRow> rows = {row("a", 0.25, 0.5, "first"), row("a", 0.5, 1.5, "second")};
  rows[0].ms.median_ms = 20.0;
  rows[0].ratio_low = 0.4;
  rows[1].ms.median_ms = 15.0;
  const double default_ms[] = {40.0, 10.0};
  LedgerRow worst = worst_point(rows, default_ms, 0);
  EXPECT_EQ(worst.ms.median_ms, 20.0);
  EXPECT_EQ(worst.ratio, 0.5);
  EXPECT_EQ(worst.ratio_low, 0.4);
  EXPECT_EQ(worst.flip->mean, 0.5);
  EXPECT_EQ(worst.gpu_bytes, 1500u);
  EXPECT_EQ(worst.picture, "first");
  EXPECT_EQ(worst_point(rows, default_ms, 1).picture, "second");
  // Much faster in the first: now the second is the slowest. Its ratio is to the default's 40 ms.
  rows[0].ratio = 0.125;
  rows[0].ms.median_ms = 5.0;
  worst = worst_point(rows, default_ms, 0);
  EXPECT_EQ(worst.ms.median_ms, 15.0);
  EXPECT_EQ(worst.ratio, 0.375);
  EXPECT_EQ(worst.ratio_high, 0.375);
}

TEST(WorstPoint, of_one_camera_is_its_row) {
  const std::vector<LedgerRow> rows = {row("a", 0.25, 0.5, "p")};
  const double default_ms[] = {40.0};
  EXPECT_EQ(worst_point(rows, default_ms, 0), rows.front());
}

}  // namespace
}  // namespace gloam
