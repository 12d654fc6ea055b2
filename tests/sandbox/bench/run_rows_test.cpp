// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/run_rows.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/log.h"
#include "sandbox/bench/harness/context.h"

namespace gloam {
namespace {

using Run = std::function<Result<BenchValue>(BenchContext&)>;

BenchRow row(const std::string& id, Run run) {
  return {.id = id, .unit = "ms", .bar = {}, .better = Better::lower, .run = std::move(run)};
}

Result<BenchValue> measure_one(BenchContext&) {
  BenchValue value;
  value.value = 1.0;
  return value;
}

struct Outcome {
  RowsRun run;
  std::vector<std::string> finished;
};

Outcome run_all(const std::vector<BenchRow>& rows) {
  const Options options;
  BenchContext context(options, null_log());
  std::vector<const BenchRow*> chosen;
  for (const BenchRow& each : rows) chosen.push_back(&each);
  Outcome outcome;
  outcome.run = run_rows(chosen, context, [&](const MeasuredRow& m) { outcome.finished.push_back(m.row->id); });
  return outcome;
}

TEST(RunRows, gives_all_rows_when_none_fails) {
  const std::vector<BenchRow> rows = {row("a", measure_one), row("b", measure_one)};
  const Outcome outcome = run_all(rows);
  EXPECT_TRUE(outcome.run.status.ok());
  ASSERT_EQ(outcome.run.rows.size(), 2u);
  EXPECT_EQ(outcome.run.rows[1].row, &rows[1]);
  EXPECT_EQ(outcome.finished, (std::vector<std::string>{"a", "b"}));
}

TEST(RunRows, tells_why_a_row_was_skipped) {
  const std::vector<BenchRow> rows = {row("a", [](BenchContext&) -> Result<BenchValue> { return skipped_row("no a"); }),
                                      row("b", measure_one)};
  const Outcome outcome = run_all(rows);
  EXPECT_TRUE(outcome.run.status.ok());
  ASSERT_EQ(outcome.run.rows.size(), 2u);
  EXPECT_TRUE(bench_line(outcome.run.rows[0]).ends_with("skipped: no a\n"));
  const std::string json = bench_json({}, outcome.run.rows);
  EXPECT_NE(json.find("\"skipped\""), std::string::npos);
  EXPECT_NE(json.find("no a"), std::string::npos);
  EXPECT_EQ(json.find("\"skipped\"", json.find("\"skipped\"") + 1), std::string::npos);
}

TEST(RunRows, keeps_the_finished_rows_and_the_error_when_a_later_one_fails) {
  int later_runs = 0;
  const std::vector<BenchRow> rows = {row("a", measure_one),
                                      row("b",
                                          [](BenchContext&) -> Result<BenchValue> {
                                            return Error{ErrorKind::no_device, "no device here"};
                                          }),
                                      row("c", [&](BenchContext& context) {
                                        ++later_runs;
                                        return measure_one(context);
                                      })};
  const Outcome outcome = run_all(rows);
  ASSERT_FALSE(outcome.run.status.ok());
  EXPECT_EQ(outcome.run.status.error().kind, ErrorKind::no_device);
  EXPECT_EQ(outcome.run.status.error().message, "no device here");
  EXPECT_EQ(outcome.finished, (std::vector<std::string>{"a"}));
  EXPECT_EQ(outcome.run.rows.size(), 1u);
  EXPECT_EQ(later_runs, 0);
}

TEST(RunRows, an_exception_of_a_row_is_its_failure) {
  const std::vector<BenchRow> rows = {row("a", measure_one), row("b", [](BenchContext&) -> Result<BenchValue> {
                                        throw std::runtime_error("no room");
                                      })};
  const Outcome outcome = run_all(rows);
  ASSERT_FALSE(outcome.run.status.ok());
  EXPECT_EQ(outcome.run.status.error().message, "b: no room");
  EXPECT_EQ(outcome.run.rows.size(), 1u);
}

}  // namespace
}  // namespace gloam
