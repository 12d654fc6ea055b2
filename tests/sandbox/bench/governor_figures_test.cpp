// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>

#include "sandbox/bench/governor/case.h"

namespace gloam {
namespace {

/// Frames of 20 ms at point 2, budget 25 ms, three seconds.
GovernedRun steady_run() {
  GovernedRun run = {.budget_ms = 25.0, .name = "standing", .step_at = 0, .frames = {}};
  run.frames.assign(150, {.ms = 20.0, .wall_ms = 20.0, .point = 2, .error = 0.02});
  return run;
}

TEST(GovernorFigures, the_first_second_does_not_count) {
  GovernedRun run = steady_run();
  run.frames[10] = {.ms = 500.0, .wall_ms = 500.0, .point = 0, .error = 0.1};
  const GovernedFigures figures = figures_of(run);
  EXPECT_DOUBLE_EQ(figures.percentile_90, 0.8);
  EXPECT_DOUBLE_EQ(figures.longest, 0.8);
  EXPECT_EQ(figures.changes_a_second, 0.0);
}

TEST(GovernorFigures, later_frames_and_changes_do) {
  GovernedRun run = steady_run();
  for (std::size_t i = 80; i < 100; ++i) run.frames[i].ms = run.frames[i].wall_ms = 30.0;  // 1 in 5 of those that count
  run.frames[120].ms = run.frames[120].wall_ms = 75.0;
  run.frames[130].point = 1;  // one change, and back
  const GovernedFigures figures = figures_of(run);
  EXPECT_DOUBLE_EQ(figures.percentile_90, 1.2);
  EXPECT_DOUBLE_EQ(figures.longest, 3.0);
  EXPECT_NEAR(figures.changes_a_second, 2.0 / 1.26, 0.05);
}

TEST(GovernorFigures, a_step_of_load_is_settled_with_the_last_change_to_a_cheaper_point) {
  GovernedRun run = steady_run();
  run.step_at = 75;
  for (std::size_t i = 75; i < 150; ++i) run.frames[i].ms = run.frames[i].wall_ms = 40.0;
  for (std::size_t i = 85; i < 150; ++i) run.frames[i].point = 1;
  for (std::size_t i = 95; i < 150; ++i) run.frames[i].point = 0;
  for (std::size_t i = 140; i < 150; ++i) run.frames[i].point = 1;
  EXPECT_NEAR(figures_of(run).settled_s, 21 * 0.04, 1e-9);
}

TEST(GovernorFigures, the_error_is_compared_with_the_best_setting_that_fits_on_the_wall) {
  GovernedScene scene;
  scene.front = {{.ms = 2.0, .error = 0.1}, {.ms = 5.0, .error = 0.05}, {.ms = 10.0, .error = 0.02}};
  // Frames of 20 ms at a point of 10: what takes up to 12.5 by the ledger fits into 25.
  scene.tried = {{.ms = 4.0, .error = 0.06}, {.ms = 12.4, .error = 0.016}, {.ms = 12.6, .error = 0.001}};
  EXPECT_DOUBLE_EQ(error_over_best(scene, steady_run()), 0.02 / 0.016);
  EXPECT_DOUBLE_EQ(error_over_best(scene, steady_run(), 0.9), 1.0) << "12.4 leave no 10 % to spare";
  scene.tried[1].error = 0.03;
  EXPECT_DOUBLE_EQ(error_over_best(scene, steady_run()), 1.0) << "the governor's is the best";
  GovernedRun exact = steady_run();
  for (GovernedFrame& frame : exact.frames) frame.error = 9e-4;
  scene.tried[1].error = 1e-6;
  EXPECT_DOUBLE_EQ(error_over_best(scene, exact), 1.0) << "nobody sees that";
}

TEST(GovernorFigures, seconds_are_those_of_the_wall_when_the_budget_is_for_an_effect) {
  GovernedRun run = steady_run();
  for (GovernedFrame& frame : run.frames) frame.ms = 5.0;
  run.frames[40].ms = 12.5;  // within the first second of the wall
  run.frames[60].ms = 7.5;
  EXPECT_DOUBLE_EQ(figures_of(run).longest, 0.3);
}

TEST(GovernorFigures, settings_have_a_line_each) {
  GovernedScene scene;
  scene.front = {{.ms = 2.0, .error = 0.1}};
  scene.tried = {{.ms = 4.0, .error = 0.06}};
  EXPECT_EQ(settings_csv(scene), "kind,ms,error\nfront,2,0.1\ntried,4,0.06\n");
}

TEST(GovernorFigures, traces_have_a_line_for_each_frame) {
  GovernedScene scene;
  scene.runs = {steady_run()};
  scene.runs[0].frames.resize(2);
  EXPECT_EQ(trace_csv(scene), "run,budget_ms,frame,ms,point,error\nstanding,25,0,20,2,0.02\nstanding,25,1,20,2,0.02\n");
}

}  // namespace
}  // namespace gloam
