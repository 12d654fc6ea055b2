// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/frame/transfers/upload.h"
#include "engine/render/declare/pass_frames.h"
#include "engine/render/sort/radix_sort.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"

// The radix sort of 1 M keys on the device against std::sort of as many pairs on one thread of the CPU, and against a
// copy of as many bytes as the sort has to move.

namespace gloam {
namespace {

constexpr const char* kSortScene = "builtin:plain";  // opens a device; nothing of it is drawn
constexpr std::uint32_t kSortKeys = 1'000'000;
constexpr int kSortPairs = 21;
constexpr int kSortWarmUp = 2;
/// Each key is read twice, for its counter and for its place, and each value is written; value i is i. Half of the
/// bytes of a copy are read and half are written.
constexpr std::uint64_t kMovedBytes = std::uint64_t{kSortKeys} * (1 + 1 + 4);

/// Pseudo-random keys with all 256 values, the same on every platform.
std::vector<std::uint8_t> random_keys() {
  std::vector<std::uint8_t> keys(packed_key_bytes(kSortKeys), 0);
  std::uint32_t state = 1;
  for (std::uint32_t i = 0; i < kSortKeys; ++i) {
    state = state * 1664525u + 1013904223u;
    keys[i] = static_cast<std::uint8_t>(state >> 24);
  }
  return keys;
}

struct SortTimes {
  double sort_ns = 0.0;
  double copy_ns = 0.0;
};

/// Frames that sort the keys, and then copy kMovedBytes / 2 bytes.
class SortFrames {
 public:
  explicit SortFrames(gpu::Device& device) : device_(device), frames_(device, null_log(), "bench") {}
  ~SortFrames() {
    static_cast<void>(device_.wait_idle());
    for (const gpu::BufferHandle buffer : {keys_, sorted_, source_, target_})
      if (buffer) device_.destroy(buffer);
  }
  SortFrames(const SortFrames&) = delete;
  SortFrames& operator=(const SortFrames&) = delete;

  [[nodiscard]] Status prepare(std::span<const std::uint8_t> keys) {
    using enum gpu::BufferUsage;
    const auto create = [&](gpu::BufferHandle& buffer, gpu::BufferDesc desc) -> Status {
      desc.module = "bench";
      const auto created = device_.create_buffer(desc);
      if (!created) return created.error();
      buffer = *created;
      return {};
    };
    GLOAM_TRY(create(keys_, {.name = "sort_keys", .size = keys.size(), .usage = storage | transfer_target}));
    GLOAM_TRY(create(sorted_, {.name = "sort_result",
                               .size = std::uint64_t{kSortKeys} * 4,
                               .usage = transfer_target,
                               .memory = gpu::MemoryKind::readback}));
    GLOAM_TRY(
        create(source_, {.name = "copy_source", .size = kMovedBytes / 2, .usage = transfer_source | transfer_target}));
    GLOAM_TRY(create(target_, {.name = "copy_target", .size = kMovedBytes / 2, .usage = transfer_target}));
    Uploader uploader(device_);
    const auto bytes = std::as_bytes(keys);
    uploader.buffer(keys_, {bytes.begin(), bytes.end()}, gpu::Access::compute_read);
    uploader.buffer(source_, std::vector<std::byte>(kMovedBytes / 2, std::byte{1}), gpu::Access::transfer_read);
    return uploader.flush();
  }
  [[nodiscard]] Result<SortTimes> draw() {
    auto commands = device_.begin_frame();
    if (!commands) return commands.error();
    const Status drawn = frames_.record(**commands, [this](FrameBuilder& frame) { declare(frame); });
    if (!drawn.ok()) {
      static_cast<void>(device_.abandon_frame());
      frames_.graph().give_up_frame();
      return drawn.error();
    }
    GLOAM_TRY(device_.submit_frame());
    GLOAM_TRY(device_.wait_idle());
    SortTimes times;
    const std::vector<PassTime> passes = frames_.graph().pass_times();
    for (const PassTime& pass : passes) {
      if (pass.name.starts_with("sort_")) times.sort_ns += pass.ms * kNsPerMs;
      if (pass.name == "copy_moved_bytes") times.copy_ns += pass.ms * kNsPerMs;
    }
    return times;
  }
  /// The values as the last frame has sorted them.
  [[nodiscard]] std::vector<std::uint32_t> sorted() {
    std::vector<std::uint32_t> values(kSortKeys);
    std::memcpy(values.data(), device_.mapped(sorted_).data(), values.size() * sizeof(std::uint32_t));
    return values;
  }

 private:
  void declare(FrameBuilder& frame) {
    FrameGraph& graph = frame.graph();
    const BufferRef keys =
        graph.import_buffer("sort_keys", keys_, gpu::Access::compute_read, gpu::Access::compute_read);
    const SortedKeys sorted = add_radix_sort_passes(frame, "sort", keys, {}, kSortKeys);
    add_copy(graph, "copy_moved_bytes",
             graph.import_buffer("copy_source", source_, gpu::Access::transfer_read, gpu::Access::transfer_read),
             target_, kMovedBytes / 2);
    add_copy(graph, "keep_sorted", sorted.values, sorted_, std::uint64_t{kSortKeys} * 4);
  }
  void add_copy(FrameGraph& graph, const char* name, BufferRef from, gpu::BufferHandle to, std::uint64_t bytes) {
    PassBuilder pass = graph.add_pass(name, "bench");
    pass.read(from, gpu::Access::transfer_read);
    const bool host = device_.desc(to).memory == gpu::MemoryKind::readback;
    const BufferRef target = pass.write(graph.import_buffer(std::string(name) + "_target", to, gpu::Access::none,
                                                            host ? gpu::Access::host_read : gpu::Access::none),
                                        gpu::Access::transfer_write);
    pass.execute([=](PassContext& context) {
      context.commands().copy_buffer(context.buffer(from), 0, context.buffer(target), 0, bytes);
    });
  }

  gpu::Device& device_;
  PassFrames frames_;
  gpu::BufferHandle keys_;
  gpu::BufferHandle sorted_;  ///< copy of the values
  gpu::BufferHandle source_;
  gpu::BufferHandle target_;
};

struct Sorts {
  std::vector<double> std_sort_ns;
  std::vector<double> sort_ns;
  std::vector<double> copy_ns;
  std::uint64_t hash = 0;  ///< of the sorted values
};

using Pair = std::pair<std::uint32_t, std::uint32_t>;  // key, value

bool by_key(const Pair& a, const Pair& b) { return a.first < b.first; }

std::vector<Pair> pairs_of(std::span<const std::uint8_t> keys) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < kSortKeys; ++i) pairs.emplace_back(keys[i], i);
  return pairs;
}

double std_sort_once_ns(std::vector<Pair> pairs) {
  const auto begin = std::chrono::steady_clock::now();
  std::sort(pairs.begin(), pairs.end(), by_key);
  const auto end = std::chrono::steady_clock::now();
  keep(pairs[kSortKeys / 2].second);
  return std::chrono::duration<double, std::nano>(end - begin).count();
}

/// Sorts on the CPU and on the device, alternately. ErrorKind::failed unless the device's sort is the stable one.
Result<Sorts> measure_sorts(BenchContext& context) {
  auto session = context.open_builtin(kSortScene);
  if (!session) return session.error();
  const std::vector<std::uint8_t> keys = random_keys();
  const std::vector<Pair> pairs = pairs_of(keys);
  std::vector<Pair> expected = pairs;
  std::stable_sort(expected.begin(), expected.end(), by_key);
  SortFrames frames(*(*session)->device);
  GLOAM_TRY(frames.prepare(keys));
  Sorts sorts;
  for (int i = -kSortWarmUp; i < kSortPairs; ++i) {
    const double std_sort_ns = std_sort_once_ns(pairs);
    const auto times = frames.draw();
    if (!times) return times.error();
    if (i < 0) continue;
    sorts.std_sort_ns.push_back(std_sort_ns);
    sorts.sort_ns.push_back(times->sort_ns);
    sorts.copy_ns.push_back(times->copy_ns);
  }
  const std::vector<std::uint32_t> sorted = frames.sorted();
  if (!std::ranges::equal(sorted, expected, {}, {}, &Pair::second))
    return Error{ErrorKind::failed, "grass.sort: the device sorts otherwise than std::stable_sort"};
  sorts.hash = hash_bytes(std::as_bytes(std::span(sorted)));
  return sorts;
}

template <class Value>
BenchRow sort_row(std::string id, const char* unit, const std::shared_ptr<Once<Sorts>>& shared, Value value) {
  BenchRow row;
  row.id = "grass." + std::move(id);
  row.unit = unit;
  row.run = [shared, value](BenchContext& context) -> Result<BenchValue> {
    const auto sorts = shared->get([&] { return measure_sorts(context); });
    if (!sorts) return sorts.error();
    return value(**sorts);
  };
  return row;
}

}  // namespace

void add_grass_sort_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<Sorts>>();
  BenchRow over = sort_row("sort_over_std_sort", "ratio", shared,
                           [](const Sorts& sorts) { return ratio_of(sorts.std_sort_ns, sorts.sort_ns, sorts.hash); });
  over.bar = 10.0;
  over.better = Better::higher;
  registry.add(std::move(over));
  registry.add(sort_row("sort.ms", "ms", shared,
                        [](const Sorts& sorts) { return per_item(sorts.sort_ns, kNsPerMs, sorts.hash); }));
  BenchRow share = sort_row("sort.bandwidth_share", "ratio", shared,
                            [](const Sorts& sorts) { return ratio_of(sorts.copy_ns, sorts.sort_ns, sorts.hash); });
  share.better = Better::higher;
  registry.add(std::move(share));
}

}  // namespace gloam
