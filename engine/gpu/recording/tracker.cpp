// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/recording/tracker.h"

#include <algorithm>

#include "engine/gpu/access.h"
#include "engine/gpu/device.h"

namespace gloam::gpu::recording {

namespace {

constexpr AccessMask mask_of_all(std::initializer_list<Access> accesses) {
  AccessMask mask = 0;
  for (Access access : accesses) mask |= mask_of(access);
  return mask;
}
constexpr AccessMask kComputeReads = mask_of_all({Access::compute_read, Access::compute_storage_read});
constexpr AccessMask kShaderReads = kComputeReads | mask_of_all({Access::vertex_read, Access::fragment_read});

/// Adds the reads of the stages in `mask`: a barrier that waits for a stage also waits for the reads of that stage.
AccessMask with_reads_of_same_stages(AccessMask mask) {
  if ((mask & (kComputeReads | mask_of(Access::compute_write))) != 0) mask |= kComputeReads;
  if ((mask & mask_of_all({Access::fragment_write, Access::depth_test})) != 0) mask |= mask_of(Access::fragment_read);
  if ((mask & mask_of(Access::uniform_read)) != 0) mask |= kShaderReads;
  return mask;
}

bool writes(AccessMask mask) {
  bool any = false;
  for_each_access(mask, [&](Access access) { any = any || is_write(access); });
  return any;
}

std::string name_of_object(const Buffer& buffer) { return "buffer '" + buffer.desc.name + "'"; }
std::string name_of_object(const Image& image) { return "image '" + image.desc.name + "'"; }

}  // namespace

std::string text_of(AccessMask mask) {
  if (mask == 0) return "nothing";
  std::string text;
  for_each_access(mask, [&](Access access) {
    if (!text.empty()) text += '|';
    text += name_of(access);
  });
  return text;
}

void Tracker::abandon_frame() {
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change) {
    *change->sync = change->before;
    if (change->memory != nullptr) change->memory->owner = change->owner;
  }
  changes_.clear();
}

void Tracker::idle() {
  changes_.clear();
  objects_.buffers.for_each_alive([](Buffer& buffer) { buffer.sync = {}; });
  objects_.images.for_each_alive([](Image& image) {
    const AccessMask ready = image.memory->sync.ready;
    image.memory->sync = {.ready = ready == 0 ? 0 : accesses_in(layout_of(first_of(ready)))};
  });
}

void Tracker::begin_label() {
  if (label_depth_++ == 0) label_ = ++labels_;
}

bool Tracker::end_label() {
  if (label_depth_ == 0) return false;
  if (--label_depth_ == 0) label_ = 0;
  return true;
}

void Tracker::pass_barrier(SyncState& sync, AccessMask before, AccessMask after, const std::string& object) {
  const AccessMask waited = with_reads_of_same_stages(before);
  const bool still_running = sync.pending_frame + Device::kFramesInFlight > frame_;
  if (before != 0 && still_running && (sync.pending & ~waited) != 0) {
    objects_.fault("barrier: " + object + " waits for " + text_of(before) + " but not for its earlier " +
                   text_of(sync.pending & ~waited));
  }
  remember(sync);
  sync = {.ready = after, .pending = 0, .pending_frame = frame_, .writer = 0};
}

void Tracker::buffer_barriers(std::span<const BufferBarrier> barriers) {
  const BufferHandle handle = barriers.front().buffer;
  Buffer* buffer = objects_.buffers.find(handle);
  if (buffer == nullptr) return objects_.fault("barrier: a buffer that is not alive");
  AccessMask before = 0;
  AccessMask after = 0;
  bool waits_for_all = false;
  for (const BufferBarrier& b : barriers) {
    if (b.buffer != handle) continue;
    const AccessMask own_before = mask_of(b.before) | b.also_before;
    waits_for_all = waits_for_all || own_before == 0;
    before |= own_before;
    after |= mask_of(b.after) | b.also_after;
  }
  if (waits_for_all) before = 0;
  const std::string object = name_of_object(*buffer);
  const AccessMask ready = buffer->sync.ready;
  if (after == 0) objects_.fault("barrier: " + object + " is made ready for nothing");
  if (before != 0 && ready != 0 && (with_reads_of_same_stages(before) & ready) == 0) {
    objects_.fault("barrier: " + object + " waits for " + text_of(before) + " but its last barrier left it ready for " +
                   text_of(ready));
  }
  pass_barrier(buffer->sync, before, after, object);
}

void Tracker::image_barrier(const ImageBarrier& b) {
  Image* image = objects_.images.find(b.image);
  if (image == nullptr) return objects_.fault("barrier: an image that is not alive");
  ImageMemory& memory = *image->memory;
  const std::string object = name_of_object(*image);
  const AccessMask after = mask_of(b.after) | b.also_after;
  if (b.after == Access::none || (after & ~accesses_in(layout_of(b.after))) != 0) {
    objects_.fault("barrier: " + object + " is made ready for " + text_of(after) + ", which is not one layout");
  }
  const AccessMask ready = memory.owner == b.image.index ? memory.sync.ready : 0;
  if (b.before != Access::none && (ready == 0 || layout_of(first_of(ready)) != layout_of(b.before))) {
    objects_.fault("barrier: " + object + " is said to be in " + std::string(name_of(b.before)) +
                   " but its last barrier left it ready for " + text_of(ready));
  }
  changes_.push_back({.sync = &memory.sync, .before = memory.sync, .memory = &memory, .owner = memory.owner});
  memory.owner = b.image.index;
  pass_barrier(memory.sync, mask_of(b.before) | b.also_before, after, object);
}

void Tracker::barrier(std::span<const BufferBarrier> buffers, std::span<const ImageBarrier> images) {
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const auto earlier = buffers.first(i);
    // All barriers on one buffer in one call act together, so they are all applied when the first of them is reached.
    if (std::ranges::find(earlier, buffers[i].buffer, &BufferBarrier::buffer) != earlier.end()) continue;
    buffer_barriers(buffers.subspan(i));
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto earlier = images.first(i);
    if (std::ranges::find(earlier, images[i].image, &ImageBarrier::image) != earlier.end()) {
      objects_.fault("barrier: one image appears twice in one call");
    }
    image_barrier(images[i]);
  }
}

void Tracker::note_use(SyncState& sync, AccessMask possible, const std::string& object, std::string_view command) {
  if (sync.writer != 0 && sync.writer != label_) {
    objects_.fault(std::string(command) + ": " + object +
                   " was written under an earlier label and has had no barrier since");
  }
  // Without a barrier, the access of a binding is unknown. A command with only one possible access is known.
  remember(sync);
  const AccessMask used = sync.ready != 0 ? (sync.ready & possible) : (possible & (possible - 1)) == 0 ? possible : 0;
  if (sync.ready == 0 && writes(used)) sync.ready = used;
  sync.pending |= used;
  sync.pending_frame = frame_;
  if (writes(used)) sync.writer = label_;
}

void Tracker::use(BufferHandle handle, AccessMask possible, std::string_view command) {
  Buffer* buffer = objects_.buffers.find(handle);
  if (buffer == nullptr) {
    objects_.fault(std::string(command) + ": a buffer that is not alive");
    return;
  }
  const std::string object = name_of_object(*buffer);
  if (buffer->sync.ready != 0 && (buffer->sync.ready & possible) == 0) {
    objects_.fault(std::string(command) + ": " + object + " is used as " + text_of(possible) +
                   " but its last barrier left it ready for " + text_of(buffer->sync.ready));
    return;
  }
  note_use(buffer->sync, possible, object, command);
}

void Tracker::use(ImageHandle handle, AccessMask possible, std::string_view command) {
  Image* image = objects_.images.find(handle);
  if (image == nullptr) {
    objects_.fault(std::string(command) + ": an image that is not alive");
    return;
  }
  const std::string object = name_of_object(*image);
  ImageMemory& memory = *image->memory;
  if (memory.owner != handle.index && memory.owner != ImageMemory::kNobody) {
    objects_.fault(std::string(command) + ": " + object + " has lost its memory to another image");
    return;
  }
  if ((memory.sync.ready & possible) == 0) {
    objects_.fault(std::string(command) + ": " + object + " is used as " + text_of(possible) +
                   " but its last barrier left it ready for " + text_of(memory.sync.ready));
    return;
  }
  note_use(memory.sync, possible, object, command);
}

}  // namespace gloam::gpu::recording
