// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/sort/radix_sort.h"

#include <algorithm>
#include <string>

#include "engine/core/assert.h"
#include "shaders/render/shaders.h"
#include "shaders/render/sort/sort_shared.h"

namespace gloam {
namespace {

using shaders::SortConstants;

constexpr std::uint32_t kMostKeys = 1u << 25;  // their values fill a binding of 128 MiB
constexpr std::uint32_t kBlockKeys = GLOAM_SORT_BLOCK_THREADS * GLOAM_SORT_THREAD_KEYS;
// Each column has 256 counters to clear, scan and read: short runs cost more per key. Long ones keep too few cores
// busy.
constexpr std::uint32_t kLeastRun = 1024;
constexpr std::uint32_t kMostRun = 4096;
constexpr std::uint32_t kWantedRuns = 256;

std::uint32_t divided_up(std::uint32_t a, std::uint32_t b) { return a / b + (a % b != 0 ? 1 : 0); }

SortConstants divide_into_columns(std::uint32_t count, bool threads_in_turn) {
  if (!threads_in_turn) return {count, divided_up(count, kBlockKeys), kBlockKeys};
  const std::uint32_t run = std::clamp(divided_up(divided_up(count, kWantedRuns), 16) * 16, kLeastRun, kMostRun);
  // At least one workgroup, which writes the bins.
  const std::uint32_t groups = std::max(divided_up(divided_up(count, run), GLOAM_SORT_RUN_THREADS), 1u);
  return {count, groups * GLOAM_SORT_RUN_THREADS, run};
}

ComputeProgram count_program(bool threads_in_turn) {
  return {threads_in_turn ? shaders::render::count_runs_comp : shaders::render::count_blocks_comp};
}
ComputeProgram scan_program(bool threads_in_turn) {
  return {threads_in_turn ? shaders::render::scan_runs_comp : shaders::render::scan_blocks_comp};
}
ComputeProgram scatter_program(bool threads_in_turn, bool implied_values) {
  return {threads_in_turn ? shaders::render::scatter_runs_comp : shaders::render::scatter_blocks_comp,
          {{"kImpliedValues", implied_values ? 1u : 0u}}};
}

/// Inputs, buffers and sizes that the passes of one sort share.
struct Sort {
  FrameBuilder& frame;
  std::string name;
  bool threads_in_turn;
  SortConstants constants;

  [[nodiscard]] BufferRef create(const char* part, std::uint64_t bytes) const {
    gpu::BufferDesc desc;
    desc.name = name + part;
    desc.module = std::string(frame.module());
    desc.size = std::max<std::uint64_t>(bytes, 16);
    return frame.graph().create_buffer(std::move(desc));
  }
  [[nodiscard]] BufferRef create_bins() const { return create("_bins", (GLOAM_SORT_BINS + 1) * sizeof(std::uint32_t)); }
  /// Workgroups that count or scatter.
  [[nodiscard]] std::uint32_t groups() const {
    return threads_in_turn ? constants.columns / GLOAM_SORT_RUN_THREADS : constants.columns;
  }
};

BufferRef add_count_pass(const Sort& sort, BufferRef keys) {
  ComputePass pass(sort.frame, sort.name + "_count", count_program(sort.threads_in_turn));
  pass.push(sort.constants);
  pass.read("keys", keys);
  const BufferRef counters = pass.write(
      "counters",
      sort.create("_counters", std::uint64_t{sort.constants.columns} * GLOAM_SORT_BINS * sizeof(std::uint32_t)));
  pass.dispatch(sort.groups());
  return counters;
}

/// Turns the counters into sums over the columns before. Returns the sums over all columns.
BufferRef add_scan_pass(const Sort& sort, BufferRef& counters) {
  ComputePass pass(sort.frame, sort.name + "_scan", scan_program(sort.threads_in_turn));
  pass.push(sort.constants);
  counters = pass.write("counters", counters);
  const BufferRef totals = pass.write("totals", sort.create("_totals", GLOAM_SORT_BINS * sizeof(std::uint32_t)));
  const std::uint32_t quads = GLOAM_SORT_BINS / 4;
  pass.dispatch(sort.threads_in_turn ? quads / GLOAM_SORT_RUN_THREADS : quads);
  return totals;
}

BufferRef add_bins_pass(const Sort& sort, BufferRef totals) {
  ComputePass pass(sort.frame, sort.name + "_bins", shaders::render::scan_bins_comp);
  pass.read("totals", totals);
  const BufferRef bins = pass.write("first_of_bin", sort.create_bins());
  pass.dispatch(1);
  return bins;
}

/// Sets the values and the bins.
void add_scatter_pass(const Sort& sort, BufferRef keys, BufferRef values, BufferRef counters, BufferRef totals,
                      SortedKeys& sorted) {
  if (!sort.threads_in_turn) sorted.bins = add_bins_pass(sort, totals);
  ComputePass pass(sort.frame, sort.name + "_scatter", scatter_program(sort.threads_in_turn, !values));
  pass.push(sort.constants);
  pass.read("keys", keys);
  pass.read("counters", counters);
  pass.read("values", values);
  if (sort.threads_in_turn) {
    pass.read("totals", totals);
    sorted.bins = pass.write("first_of_bin", sort.create_bins());
  } else {
    pass.read("first_of_bin", sorted.bins);
  }
  sorted.values =
      pass.write("sorted_values", sort.create("_values", std::uint64_t{sort.constants.count} * sizeof(std::uint32_t)));
  pass.dispatch(sort.groups());
}

BufferRef add_keys_pass(const Sort& sort, BufferRef bins) {
  ComputePass pass(sort.frame, sort.name + "_keys", shaders::render::write_keys_comp);
  pass.push(sort.constants);
  pass.read("first_of_bin", bins);
  const BufferRef keys = pass.write("sorted_keys", sort.create("_keys", packed_key_bytes(sort.constants.count)));
  pass.dispatch_over(divided_up(sort.constants.count, 4));
  return keys;
}

}  // namespace

SortedKeys add_radix_sort_passes(FrameBuilder& frame, std::string_view name, BufferRef keys, BufferRef values,
                                 std::uint32_t count) {
  GLOAM_ASSERT(count <= kMostKeys, "at most 2^25 keys are sorted");
  GLOAM_ASSERT(count == 0 || frame.graph().desc(keys).size >= packed_key_bytes(count),
               "the buffer of keys has packed_key_bytes(count) bytes");
  GLOAM_ASSERT(!values || count == 0 || frame.graph().desc(values).size / sizeof(std::uint32_t) >= count,
               "there is a value for each key");
  const bool threads_in_turn = frame.services().device.info().threads_in_turn;
  const Sort sort{frame, std::string(name), threads_in_turn, divide_into_columns(count, threads_in_turn)};
  BufferRef counters = add_count_pass(sort, keys);
  SortedKeys sorted;
  const BufferRef totals = add_scan_pass(sort, counters);
  add_scatter_pass(sort, keys, values, counters, totals, sorted);
  sorted.keys = add_keys_pass(sort, sorted.bins);
  return sorted;
}

std::vector<ComputeProgram> radix_sort_programs(bool threads_in_turn, bool implied_values) {
  std::vector<ComputeProgram> programs = {count_program(threads_in_turn), scan_program(threads_in_turn),
                                          scatter_program(threads_in_turn, implied_values),
                                          ComputeProgram{shaders::render::write_keys_comp}};
  if (!threads_in_turn) programs.push_back({shaders::render::scan_bins_comp});
  return programs;
}

}  // namespace gloam
