// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/modules/accuracy/fake_subject.h"

namespace gloam {
namespace {

/// A fake subject whose frames take their time on a clock of the test.
class ShortLedger : public ::testing::Test {
 protected:
  ShortLedger() {
    request_.header = {.scene = "s", .scene_hash = "h", .device = "d", .width = test::kSide, .height = test::kSide};
    request_.settings = {
        {{"fake.samples", "1"}}, {{"fake.samples", "2"}, {"fake.look", "cold"}}, {{"fake.samples", "3"}}};
    request_.now_s = [this] { return s_ += 0.01; };
    request_.progress = [this](std::size_t done, std::size_t total) -> Status {
      told_.push_back(std::to_string(done) + "/" + std::to_string(total));
      s_ += setting_s_;
      if (done == stop_at_) return Error{ErrorKind::failed, "the window was closed"};
      return {};
    };
  }

  test::FakeSubject subject_;
  ShortLedgerRequest request_;
  std::vector<std::string> told_;
  double s_ = 0.0;
  double setting_s_ = 0.0;
  std::size_t stop_at_ = 100;
};

TEST_F(ShortLedger, points_have_times_and_errors_against_the_users_settings) {
  const auto ledger = measure_short_ledger(request_, subject_);
  ASSERT_TRUE(ledger.ok()) << ledger.error().message;
  ASSERT_EQ(ledger->points.size(), 4u);
  EXPECT_EQ(told_, (std::vector<std::string>{"0/4", "1/4", "2/4", "3/4"}));
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_DOUBLE_EQ(ledger->points[i].measured.ms.median_ms, 2.0 + static_cast<double>(i)) << "the fastest first";
  EXPECT_TRUE(ledger->points[3].measured.is_default);
  EXPECT_EQ(ledger->points[3].measured.flip->mean, 0.0);
  EXPECT_TRUE(ledger->points[3].settings.empty());
  EXPECT_GT(ledger->points[0].measured.flip->mean, ledger->points[1].measured.flip->mean) << "1 sample is less right";
  EXPECT_DOUBLE_EQ(ledger->points[0].measured.ratio, 2.0 / 5.0);
  EXPECT_EQ(settings_text(ledger->points[1].settings), "fake.samples=2 fake.look=cold");
  EXPECT_EQ(subject_.knobs().text(*subject_.knobs().find("fake.samples")), "4") << "as before";

  const auto again = parse_ledger_json(ledger_json(*ledger));
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(front_points(*again).size(), 4u);
}

TEST_F(ShortLedger, looks_are_nobodys_business_but_the_users) {
  ASSERT_TRUE(subject_.knobs().set("fake.samples", "3").ok());
  ASSERT_TRUE(subject_.knobs().set("fake.taste", "cold").ok());
  const auto ledger = measure_short_ledger(request_, subject_);
  ASSERT_TRUE(ledger.ok());
  EXPECT_EQ(settings_text(ledger->points[0].settings), "fake.samples=1");
  EXPECT_EQ(settings_text(ledger->points[2].settings), "fake.samples=3") << "a value of the user's that has a cost";
}

TEST_F(ShortLedger, what_does_not_fit_into_the_time_is_left_out) {
  request_.seconds = 5.0;
  setting_s_ = 2.5;
  const auto ledger = measure_short_ledger(request_, subject_);
  ASSERT_TRUE(ledger.ok());
  EXPECT_EQ(ledger->points.size(), 2u);
  EXPECT_LT(subject_.frames_drawn, 2 * 14);
  setting_s_ = 1000.0;
  const auto late = measure_short_ledger(request_, subject_);
  ASSERT_TRUE(late.ok());
  EXPECT_EQ(late->points.size(), 2u) << "there is something to choose in any case";
}

TEST_F(ShortLedger, an_error_of_the_caller_or_the_device_ends_it) {
  stop_at_ = 2;
  EXPECT_EQ(measure_short_ledger(request_, subject_).error().message, "the window was closed");
  EXPECT_EQ(subject_.knobs().text(*subject_.knobs().find("fake.samples")), "4");
  stop_at_ = 100;
  subject_.fail_after = subject_.frames_drawn + 2;
  EXPECT_EQ(measure_short_ledger(request_, subject_).error().message, "the device is lost");
  request_.settings[0] = {{"fake.nothing", "1"}};
  subject_.fail_after = 0;
  EXPECT_EQ(measure_short_ledger(request_, subject_).error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace gloam
