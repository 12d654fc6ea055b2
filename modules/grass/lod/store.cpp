// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/lod/store.h"

#include <algorithm>
#include <array>
#include <vector>

#include "shaders/grass/drawing/pose_shared.h"

namespace gloam {
namespace {

constexpr std::uint64_t kMostBinding = 128ull << 20;  // bytes of a storage buffer that every device can bind
constexpr std::uint64_t kKnotBytes = GLOAM_GRASS_KNOTS * sizeof(vec4);
constexpr std::uint64_t kRowBytes = GLOAM_GRASS_PATCH_BLADES * sizeof(shaders::GrassBladeRow);
constexpr std::uint64_t kPoseBytes = GLOAM_GRASS_PATCH_BLADES * sizeof(shaders::GrassPose);

/// The slots that all buffers have room for within a binding, those of a frame included.
std::uint32_t most_slots(std::uint32_t slot_masters) {
  return static_cast<std::uint32_t>(kMostBinding / std::max({slot_masters * kKnotBytes, kRowBytes, kPoseBytes}));
}

HistoryBuffer kept_buffer(FrameBuilder& frame, const char* name, std::uint64_t bytes, std::uint32_t generation) {
  using enum gpu::BufferUsage;
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = "grass";
  desc.size = bytes;
  desc.usage = storage | transfer_target | transfer_source;
  const auto kept = frame.history_buffer(
      desc, {.scope = HistoryScope::world, .final_access = gpu::Access::compute_read, .instance = generation});
  return frame.check(kept) ? *kept : HistoryBuffer{};
}

HistoryBuffer kept_rows(FrameBuilder& frame, std::uint32_t slots, std::uint32_t generation) {
  return kept_buffer(frame, "grass_rows", slots * kRowBytes, generation);
}

GrassStore store_of(FrameBuilder& frame, std::uint32_t slots, std::uint32_t slot_masters, std::uint32_t generation) {
  const std::uint64_t masters = std::uint64_t{slots} * slot_masters;
  return {kept_rows(frame, slots, generation).buffer,
          kept_buffer(frame, "grass_stamps", masters * sizeof(std::uint32_t), generation).buffer,
          kept_buffer(frame, "grass_knots", masters * kKnotBytes, generation).buffer,
          kept_buffer(frame, "grass_previous_knots", masters * kKnotBytes, generation).buffer};
}

std::array<BufferRef*, 4> buffers_of(GrassStore& store) {
  return {&store.rows, &store.stamps, &store.knots, &store.previous_knots};
}

/// Slots of a store and the masters for which each has room.
struct StoreSize {
  std::uint32_t slots = 0;
  std::uint32_t slot_masters = 0;

  [[nodiscard]] std::uint64_t stride(std::size_t buffer) const {
    const std::uint64_t masters = slot_masters;
    return std::array<std::uint64_t, 4>{kRowBytes, masters * sizeof(std::uint32_t), masters * kKnotBytes,
                                        masters * kKnotBytes}[buffer];
  }
};

/// Copies all slots of a smaller store to the same slots of the other, which it returns.
GrassStore add_growth_pass(FrameBuilder& frame, GrassStore from, StoreSize size, GrassStore to, StoreSize to_size) {
  PassBuilder pass = frame.graph().add_pass("grass_growth", frame.module());
  struct Copy {
    BufferRef from, to;
    std::uint64_t from_stride, to_stride;
  };
  std::vector<Copy> copies;
  const auto sources = buffers_of(from);
  const auto targets = buffers_of(to);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    pass.read(*sources[i], gpu::Access::transfer_read);
    *targets[i] = pass.write(*targets[i], gpu::Access::transfer_write);
    copies.push_back({*sources[i], *targets[i], size.stride(i), to_size.stride(i)});
  }
  pass.execute([copies, slots = size.slots](PassContext& context) {
    for (const Copy& copy : copies) {
      const auto source = context.buffer(copy.from);
      const auto target = context.buffer(copy.to);
      if (copy.from_stride == copy.to_stride) {
        context.commands().copy_buffer(source, 0, target, 0, slots * copy.from_stride);
        continue;
      }
      for (std::uint64_t slot = 0; slot < slots; ++slot)
        context.commands().copy_buffer(source, slot * copy.from_stride, target, slot * copy.to_stride,
                                       copy.from_stride);
    }
  });
  return to;
}

/// Lets the patches of surfaces that both fields have keep their slots.
void renumber_patches(const GrassStoreInput& input, GrassStoreState& state) {
  state.residency.renumber([&](std::uint32_t patch) {
    for (const PlantedPatches& before : state.plantings) {
      if (patch < before.first || patch - before.first >= before.count) continue;
      for (const GrassPlanting& now : input.plantings)
        if (now.number == before.number) return now.first_patch + (patch - before.first);
    }
    return ~0u;
  });
  state.plantings.clear();
  for (const GrassPlanting& now : input.plantings)
    if (!now.origins.empty())
      state.plantings.push_back({now.number, now.first_patch, static_cast<std::uint32_t>(now.origins.size())});
}

/// Uploads stale rows, and clears the stamps of fresh slots.
GrassStore add_upload_pass(FrameBuilder& frame, const GrassStoreInput& input, const StoredPatches& stored) {
  std::vector<shaders::GrassBladeRow> rows;
  std::vector<ResidentPatch> uploaded;
  for (const ResidentPatch& patch : stored.patches) {
    if (!patch.stale_rows) continue;
    const auto first = input.rows.begin() + std::ptrdiff_t{patch.patch} * GLOAM_GRASS_PATCH_BLADES;
    rows.insert(rows.end(), first, first + GLOAM_GRASS_PATCH_BLADES);
    uploaded.push_back(patch);
  }
  if (uploaded.empty()) return stored.store;
  const auto source = frame.upload_items(std::span<const shaders::GrassBladeRow>(rows));
  PassBuilder pass = frame.graph().add_pass("grass_upload", frame.module());
  GrassStore store = stored.store;
  store.rows = pass.write(store.rows, gpu::Access::transfer_write);
  store.stamps = pass.write(store.stamps, gpu::Access::transfer_write);
  pass.execute([store, uploaded = std::move(uploaded), source,
                stamp_bytes = stored.slot_masters * sizeof(std::uint32_t)](PassContext& context) {
    for (std::size_t i = 0; i < uploaded.size(); ++i) {
      const ResidentPatch& patch = uploaded[i];
      context.commands().copy_buffer(source.buffer, source.offset + i * kRowBytes, context.buffer(store.rows),
                                     patch.slot * kRowBytes, kRowBytes);
      if (patch.fresh)
        context.commands().fill_buffer(context.buffer(store.stamps), patch.slot * stamp_bytes, stamp_bytes,
                                       GLOAM_GRASS_NO_STEP);
    }
  });
  return store;
}

}  // namespace

GrassStoreState& GrassStoreStates::of_frame(FrameBuilder& frame, std::uint64_t world) {
  World& own = worlds_[world];
  const std::uint64_t device_frame = frame.services().device.frame_number();
  if (own.device_frame != device_frame) {
    own.device_frame = device_frame;
    own.pending = own.submitted;
  }
  frame.on_commit([&own] { own.submitted = own.pending; });
  return own.pending;
}

std::uint32_t GrassStoreStates::left_out(std::uint64_t world) const {
  const auto found = worlds_.find(world);
  return found == worlds_.end() ? 0 : found->second.pending.residency.left_out();
}

StoredPatches add_store_passes(FrameBuilder& frame, const GrassStoreInput& input, std::span<const VisiblePatch> visible,
                               GrassStoreState& state) {
  if (state.field != input.field) renumber_patches(input, state);
  const std::uint32_t old_masters = state.slot_masters;
  if (state.residency.capacity() > most_slots(input.slot_masters)) state.residency.clear();
  const bool kept = state.residency.capacity() > 0 && old_masters >= input.slot_masters;
  if (!kept) state.slot_masters = input.slot_masters;
  if (state.restarts != input.restarts) state.residency.clear_patches();
  const std::uint32_t old_capacity = state.residency.capacity();
  // The buffers of a world that was released, or not drawn for a while, are new and hold nothing.
  if (old_capacity > 0 && !kept_rows(frame, old_capacity, state.generation).filled()) state.residency.clear_patches();
  StoredPatches stored;
  stored.patches =
      state.residency.place(visible, frame.view().frame, input.row_version, most_slots(state.slot_masters));
  stored.slot_masters = state.slot_masters;
  const std::uint32_t capacity = state.residency.capacity();
  const bool grows = capacity != old_capacity || state.slot_masters != old_masters;
  if (grows) ++state.generation;
  stored.store = store_of(frame, capacity, state.slot_masters, state.generation);
  if (!frame.status().ok()) return stored;
  if (grows && old_capacity > 0)
    stored.store = add_growth_pass(frame, store_of(frame, old_capacity, old_masters, state.generation - 1),
                                   {old_capacity, old_masters}, stored.store, {capacity, state.slot_masters});
  stored.store = add_upload_pass(frame, input, stored);
  state.restarts = input.restarts;
  state.field = input.field;
  return stored;
}

}  // namespace gloam
