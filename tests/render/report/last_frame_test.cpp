// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/report/last_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "engine/gpu/recording/device.h"
#include "tests/render/modules_in_use/counting_module.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;

struct Reported {
  Reported() {
    ModuleList list;
    list.push_back(std::make_unique<test::CountingModule>(calls));
    modules = std::make_unique<ModuleSet>(std::move(list));
  }
  [[nodiscard]] FrameReport report() { return last.report(*modules, resources, *device); }

  std::unique_ptr<gpu::RecordingDevice> device = gpu::make_recording_device();
  test::CountedCalls calls;
  FrameResources resources{*device};
  std::unique_ptr<ModuleSet> modules;
  LastFrame last;
};

TEST(LastFrame, a_report_before_the_first_frame_names_the_engine_and_all_modules) {
  Reported reported;
  const FrameReport report = reported.report();
  ASSERT_THAT(report.modules, SizeIs(2));
  EXPECT_EQ(report.modules[0].name, "engine");
  EXPECT_TRUE(report.modules[0].demanded);
  EXPECT_EQ(report.modules[1].name, "counting");
  EXPECT_FALSE(report.modules[1].demanded);
  EXPECT_THAT(report.counters, IsEmpty());
  EXPECT_THAT(report.views, IsEmpty());
}

TEST(LastFrame, counters_of_the_report_are_those_of_the_last_view) {
  Reported reported;
  reported.last.commit({{ViewId{1}, {{"lights.visible", 3.0}}}, {ViewId{2}, {{"lights.visible", 5.0}}}},
                       reported.resources.results);
  FrameReport report = reported.report();
  EXPECT_THAT(report.counters, ElementsAre(Pair("lights.visible", 5.0)));
  ASSERT_THAT(report.views, SizeIs(2));
  EXPECT_EQ(report.views[0].counters.at("lights.visible"), 3.0);
  reported.last.commit({}, reported.resources.results);
  report = reported.report();
  EXPECT_THAT(report.counters, IsEmpty()) << "a frame without views has no counters";
}

TEST(LastFrame, times_and_pending_assets_are_passed_on) {
  Reported reported;
  reported.last.cpu_ms = 2.5;
  reported.last.submitted_ns = 77;
  reported.last.assets_pending = 4;
  const FrameReport report = reported.report();
  EXPECT_EQ(report.cpu_ms, 2.5);
  EXPECT_EQ(report.submitted_ns, 77u);
  EXPECT_EQ(report.assets_pending, 4u);
}

}  // namespace
}  // namespace gloam
