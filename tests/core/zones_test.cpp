// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/zones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

TEST(Zones, are_taken_in_order_of_their_begin) {
  ZoneRecorder recorder;
  recorder.record("late", "shadows", 30, 40);
  recorder.record("early", "lights", 10, 50);
  recorder.record("middle", "grass", 20, 25);
  const std::vector<Zone> zones = recorder.take();
  ASSERT_EQ(zones.size(), 3u);
  EXPECT_EQ(zones[0].name, "early");
  EXPECT_EQ(zones[0].module, "lights");
  EXPECT_EQ(zones[0].begin_ns, 10u);
  EXPECT_EQ(zones[0].end_ns, 50u);
  EXPECT_EQ(zones[1].name, "middle");
  EXPECT_EQ(zones[2].name, "late");
}

TEST(Zones, that_begin_together_keep_the_order_of_recording) {
  ZoneRecorder recorder;
  for (const char* name : {"a", "b", "c"}) recorder.record(name, "core", 5, 6);
  const std::vector<Zone> zones = recorder.take();
  ASSERT_EQ(zones.size(), 3u);
  EXPECT_EQ(zones[0].name + zones[1].name + zones[2].name, "abc");
}

TEST(Zones, are_taken_once) {
  ZoneRecorder recorder;
  recorder.record("once", "core", 1, 2);
  EXPECT_EQ(recorder.take().size(), 1u);
  EXPECT_TRUE(recorder.take().empty());
}

TEST(Zones, a_scoped_zone_covers_what_it_encloses) {
  ZoneRecorder recorder;
  {
    const ScopedZone outer(&recorder, "outer", "core");
    const ScopedZone inner(&recorder, "inner", "core");
  }
  std::vector<Zone> zones = recorder.take();
  ASSERT_EQ(zones.size(), 2u);
  std::sort(zones.begin(), zones.end(), [](const Zone& a, const Zone& b) { return a.name < b.name; });
  EXPECT_LE(zones[1].begin_ns, zones[0].begin_ns);
  EXPECT_LE(zones[0].begin_ns, zones[0].end_ns);
  EXPECT_LE(zones[0].end_ns, zones[1].end_ns);
}

TEST(Zones, of_threads_that_run_together_end_on_their_own_thread) {
  ZoneRecorder recorder;
  const ScopedZone outer(&recorder, "outer", "core");
  std::thread([&] { const ScopedZone other(&recorder, "other", "core"); }).join();
  const std::vector<Zone> zones = recorder.take();
  ASSERT_EQ(zones.size(), 1u) << "the outer zone has not ended";
  EXPECT_EQ(zones[0].name, "other");
}

TEST(Zones, that_end_before_they_begin_assert) {
  ZoneRecorder recorder;
  EXPECT_ASSERT(recorder.end_zone(), "ZoneRecorder::end_zone needs begin_zone");
}

TEST(Zones, for_both_reach_two_profilers_or_one) {
  ZoneRecorder first, second;
  ZonesForBoth both(&first, &second), one(nullptr, &second);
  { const ScopedZone zone(&both, "both", "core"); }
  { const ScopedZone zone(&one, "one", "core"); }
  EXPECT_EQ(first.take().size(), 1u);
  EXPECT_EQ(second.take().size(), 2u);
}

TEST(Zones, a_null_recorder_records_nothing) { const ScopedZone zone(nullptr, "unseen", "core"); }

TEST(Zones, of_several_threads_are_all_kept_and_numbered_by_thread) {
  constexpr int kThreads = 4;
  constexpr int kZones = 500;
  ZoneRecorder recorder;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&recorder, t] {
      for (int i = 0; i < kZones; ++i) {
        const auto begin = static_cast<std::uint64_t>(i * kThreads + t);
        recorder.record(std::to_string(t), "core", begin, begin + 1);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();

  const std::vector<Zone> zones = recorder.take();
  ASSERT_EQ(zones.size(), std::size_t{kThreads * kZones});
  std::set<std::pair<std::string, std::uint32_t>> numbers;
  for (std::size_t i = 0; i < zones.size(); ++i) {
    EXPECT_EQ(zones[i].begin_ns, i);
    EXPECT_LT(zones[i].thread, std::uint32_t{kThreads});
    numbers.insert({zones[i].name, zones[i].thread});
  }
  // Each thread has one number; a thread that starts after another has ended may be given the same one.
  EXPECT_EQ(numbers.size(), std::size_t{kThreads});
}

TEST(Zones, the_clock_never_runs_backwards) {
  const ZoneRecorder recorder;
  std::uint64_t last = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t now = recorder.now_ns();
    ASSERT_GE(now, last);
    last = now;
  }
}

}  // namespace
}  // namespace gloam
