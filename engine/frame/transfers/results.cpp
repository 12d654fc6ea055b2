// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/transfers/results.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace gloam {
namespace {

constexpr std::uint64_t kSmallestBuffer = 4096;  // bytes; sizes are powers of two, so that buffers are rarely recreated

}  // namespace

FrameResults::~FrameResults() {
  for (const Slot& slot : slots_)
    if (slot.buffer) device_.destroy(slot.buffer);
}

void FrameResults::begin_frame() {
  const std::uint64_t now = device_.frame_number();
  const std::size_t older = (current_ + 1) % slots_.size();
  for (const std::size_t i : {older, current_})
    if (slots_[i].frame + gpu::Device::kFramesInFlight <= now) settle(slots_[i]);
  std::erase_if(settled_, [&](const auto& entry) { return entry.second.frame + kFramesKept < now; });

  current_ = older;
  Slot& slot = slots_[current_];
  if (slot.buffer && slot.last_used + kFramesKept < now) {
    device_.destroy(slot.buffer);
    slot.buffer = {};
  }
  slot.frame = now;
  slot.bytes = 0;
  slot.recorded = false;
  slot.requests.clear();
}

void FrameResults::keep(ResultKey key, BufferRef buffer, std::uint64_t offset, std::uint64_t size, std::any note) {
  Slot& slot = slots_[current_];
  GLOAM_ASSERT(size > 0 && size % 4 == 0, "a frame's result is some words of a buffer");
  GLOAM_ASSERT(std::ranges::none_of(slot.requests, [&](const Request& r) { return r.key == key; }),
               "a frame keeps one result a key: '" + key.name + "' of " + key.module);
  slot.requests.push_back({std::move(key), buffer, offset, slot.bytes, size, std::move(note)});
  slot.bytes += size;
}

Status FrameResults::reserve(Slot& slot) {
  if (slot.buffer && device_.desc(slot.buffer).size >= slot.bytes) return {};
  if (slot.buffer) device_.destroy(slot.buffer);
  slot.buffer = {};
  auto made = device_.create_buffer({.name = "frame results",
                                     .module = "engine",
                                     .size = std::bit_ceil(std::max(slot.bytes, kSmallestBuffer)),
                                     .usage = gpu::BufferUsage::transfer_target,
                                     .memory = gpu::MemoryKind::readback});
  if (!made.ok()) return made.error();
  slot.buffer = *made;
  return {};
}

Status FrameResults::add_pass(FrameGraph& graph) {
  Slot& slot = slots_[current_];
  if (slot.requests.empty()) return {};
  GLOAM_TRY(reserve(slot));
  slot.last_used = slot.frame;
  BufferRef target = graph.import_buffer("results", slot.buffer, gpu::Access::host_read, gpu::Access::host_read);
  PassBuilder pass = graph.add_pass("results", "engine");
  for (const Request& request : slot.requests) pass.read(request.source, gpu::Access::transfer_read);
  target = pass.write(target, gpu::Access::transfer_write);
  pass.execute([&slot, target](PassContext& context) {
    for (const Request& request : slot.requests)
      context.commands().copy_buffer(context.buffer(request.source), request.source_offset, context.buffer(target),
                                     request.offset, request.size);
    slot.recorded = true;
  });
  return {};
}

void FrameResults::give_up_frame() {
  slots_[current_].recorded = false;
  slots_[current_].requests.clear();
}

FrameResult FrameResults::read(const Slot& slot, const Request& request) const {
  const std::span<const std::byte> bytes = device_.mapped(slot.buffer).subspan(request.offset, request.size);
  return {slot.frame, {bytes.begin(), bytes.end()}, request.note};
}

void FrameResults::settle(Slot& slot) {
  if (slot.recorded)
    for (const Request& request : slot.requests) settled_[request.key] = read(slot, request);
  slot.recorded = false;  // each result is settled once
}

const FrameResult* FrameResults::settled(const ResultKey& key) const {
  const auto found = settled_.find(key);
  return found == settled_.end() ? nullptr : &found->second;
}

std::optional<FrameResult> FrameResults::newest(const ResultKey& key) const {
  std::optional<FrameResult> result;
  if (const FrameResult* there = settled(key)) result = *there;
  for (const Slot& slot : slots_) {
    if (!slot.recorded || slot.frame >= device_.completed_frames() || (result && result->frame >= slot.frame)) continue;
    for (const Request& request : slot.requests)
      if (request.key == key) result = read(slot, request);
  }
  return result;
}

void FrameResults::for_each_settled(std::uint64_t world, std::uint32_t view,
                                    const std::function<void(const ResultKey&, const FrameResult&)>& function) const {
  for (const auto& [key, result] : settled_)
    if (key.world == world && key.view == view) function(key, result);
}

std::vector<ResultKey> FrameResults::kept_keys() const {
  std::vector<ResultKey> keys;
  for (const Request& request : slots_[current_].requests) keys.push_back(request.key);
  return keys;
}

void FrameResults::erase_if(const std::function<bool(const ResultKey&)>& unwanted) {
  std::erase_if(settled_, [&](const auto& entry) { return unwanted(entry.first); });
  for (Slot& slot : slots_) {
    const std::size_t erased =
        std::erase_if(slot.requests, [&](const Request& request) { return unwanted(request.key); });
    if (erased == 0 || !slot.requests.empty()) continue;
    if (slot.buffer) device_.destroy(slot.buffer);
    slot.buffer = {};
    slot.recorded = false;
  }
}

void FrameResults::forget_world(std::uint64_t world) {
  erase_if([&](const ResultKey& key) { return key.world == world; });
}

void FrameResults::forget_view(std::uint32_t view) {
  erase_if([&](const ResultKey& key) { return key.view == view; });
}

void FrameResults::forget_module(std::string_view module) {
  erase_if([&](const ResultKey& key) { return key.module == module; });
}

}  // namespace gloam
