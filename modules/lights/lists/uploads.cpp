// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/lists/uploads.h"

#include <vector>

#include "engine/core/hash.h"

namespace gloam {
namespace {

std::uint64_t mask_hash(const FrameBuilder& frame, const TileLightMasks& masks) {
  TileMaskHash::Computed& known = *frame.world().view_resource<TileMaskHash>(frame.view().id).computed;
  if (known.lists != masks.lists || known.bound != masks.bound || masks.lists == 0)
    known = {masks.lists, masks.bound, hash_bytes(std::as_bytes(std::span(masks.words)))};
  return known.hash;
}

/// A copy from this frame's upload memory into a kept buffer.
struct KeptCopy {
  BufferRef target;
  gpu::Binding::BufferRange source;
};

/// The view's buffer of this name. Adds a copy unless the buffer holds bytes with this hash.
template <class T>
BufferRef kept_items(FrameBuilder& frame, const char* name, std::span<const T> items, std::uint64_t hash,
                     std::vector<KeptCopy>& copies) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = "lights";
  desc.size = items.size_bytes();
  desc.usage = gpu::BufferUsage::storage | gpu::BufferUsage::transfer_target;
  const auto kept = frame.history_buffer(
      desc, {.scope = HistoryScope::view, .final_access = gpu::Access::compute_read, .reset = {.key = hash}});
  if (!frame.check(kept)) return {};
  if (!kept->filled()) copies.push_back({kept->buffer, frame.upload_items(items)});
  return kept->buffer;
}

}  // namespace

void add_light_uploads(FrameBuilder& frame, const ZBins& bins, const TileLightMasks& masks, LightsOutputs& outputs) {
  std::vector<KeptCopy> copies;
  const std::span<const ZBin> all_bins(bins.bins);
  outputs.z_bins = kept_items(frame, "light_z_bins", all_bins, hash_bytes(std::as_bytes(all_bins)), copies);
  outputs.mask_tiles = kept_items(frame, "light_mask_tiles", std::span<const std::uint32_t>(masks.words),
                                  mask_hash(frame, masks), copies);
  if (copies.empty() || !frame.status().ok()) return;
  PassBuilder pass = frame.graph().add_pass("light_uploads", frame.module());
  for (KeptCopy& copy : copies) copy.target = pass.write(copy.target, gpu::Access::transfer_write);
  outputs.z_bins = frame.graph().newest(outputs.z_bins);
  outputs.mask_tiles = frame.graph().newest(outputs.mask_tiles);
  pass.execute([copies](PassContext& context) {
    for (const KeptCopy& copy : copies)
      context.commands().copy_buffer(copy.source.buffer, copy.source.offset, context.buffer(copy.target), 0,
                                     copy.source.size);
  });
}

}  // namespace gloam
