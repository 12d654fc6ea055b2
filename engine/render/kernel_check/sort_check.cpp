// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "engine/render/kernel_check/engine_checks.h"
#include "engine/render/kernel_check/pass_run.h"
#include "engine/render/reference/sorted_twin.h"
#include "engine/render/sort/radix_sort.h"

namespace gloam {
namespace {

using SortKeys = std::vector<std::uint8_t>;
using SortValues = std::vector<std::uint32_t>;

/// Items that differ, and those that one side lacks.
template <class T>
double differing(const std::vector<T>& found, const std::vector<T>& expected) {
  std::size_t count = std::max(found.size(), expected.size()) - std::min(found.size(), expected.size());
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) count += found[i] != expected[i] ? 1 : 0;
  return static_cast<double>(count);
}

/// Values, keys and bins that are not those of the twin.
Result<double> misplaced(const KernelLab& lab, const SortKeys& keys, const SortValues& values) {
  const auto count = static_cast<std::uint32_t>(keys.size());
  PassRun frames(lab);
  GLOAM_TRY(frames.draw([&](FrameBuilder& frame) {
    const BufferRef given_keys = frames.input("keys", packed_keys(keys));
    const BufferRef given_values = values.empty() ? BufferRef{} : frames.input("values", values);
    const SortedKeys sorted = add_radix_sort_passes(frame, "checked", given_keys, given_values, count);
    frames.keep(frame, "values", sorted.values, std::uint64_t{count} * sizeof(std::uint32_t));
    frames.keep(frame, "keys", sorted.keys, packed_key_bytes(count));
    frames.keep(frame, "bins", sorted.bins, 257 * sizeof(std::uint32_t));
  }));
  const SortedTwin twin = sorted_twin(keys, values);
  SortKeys found = frames.read<std::uint8_t>("keys");
  found.resize(count);
  return differing(frames.read<std::uint32_t>("values"), twin.values) + differing(found, twin.keys) +
         differing(frames.read<std::uint32_t>("bins"), twin.bins);
}

Result<KernelError> run_sort(KernelLab& lab) {
  KernelError error;
  std::mt19937 random(1);
  for (const std::uint32_t count : {1u, 17u, 4097u, 32769u, 300'007u}) {
    SortKeys keys(count);
    SortValues values(count);
    for (std::uint8_t& key : keys) key = static_cast<std::uint8_t>(random());
    for (std::uint32_t& value : values) value = static_cast<std::uint32_t>(random());
    const auto any = misplaced(lab, keys, values);
    if (!any) return any.error();
    error.add(*any, std::to_string(count) + " keys");
    for (std::uint8_t& key : keys) key = key % 2 == 0 ? 77 : 255;
    const auto alike = misplaced(lab, keys, {});
    if (!alike) return alike.error();
    error.add(*alike, std::to_string(count) + " keys of two kinds");
  }
  return error;
}

}  // namespace

KernelCheck sort_check() {
  return {.name = "kernel.radix_sort",
          .sentence = "sorted keys, values and bins against std::stable_sort",
          .unit = "items",
          .bound = 0.0,  // integers
          .advice = "Report the device, and leave out grass and particles until its driver is fixed: they are sorted",
          .quick = true,
          .run = &run_sort};
}

}  // namespace gloam
