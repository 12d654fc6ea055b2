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

bool lies_inside(const ImageRange& range, const ImageDesc& desc) {
  return range.first_mip < desc.mips && range.mip_count <= desc.mips - range.first_mip &&
         range.first_layer < desc.layers && range.layer_count <= desc.layers - range.first_layer;
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
  for (const Change& change : changes_) *change.place = change.before;
  changes_.clear();
}

void Tracker::remember(const std::shared_ptr<Placement>& place) {
  if (std::ranges::find(changes_, place, &Change::place) == changes_.end()) changes_.push_back({place, *place});
}

void Tracker::idle() {
  changes_.clear();
  const auto forget = [](Memory& memory) {
    for (const auto& place : memory.placements) {
      place->inherited = 0;
      place->sync.update(place->sync.all(), [](SyncState& sync) { sync.pending = 0; });
    }
  };
  objects_.buffers.for_each_alive([&](Buffer& buffer) {
    forget(*buffer.memory);
    buffer.place->sync.set(buffer.place->sync.all(), {});
  });
  objects_.images.for_each_alive([&](Image& image) {
    forget(*image.memory);
    image.place->sync.update(image.place->sync.all(), [](SyncState& sync) {
      sync = {.ready = sync.ready == 0 ? 0 : accesses_in(layout_of(first_of(sync.ready)))};
    });
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

void Tracker::check_waits(AccessMask before, AccessMask pending, std::uint64_t pending_frame,
                          const std::string& object) {
  const AccessMask missed = pending & ~with_reads_of_same_stages(before);
  const bool still_running = pending_frame + Device::kFramesInFlight > frame_;
  if (before == 0 || !still_running || missed == 0) return;
  objects_.fault("barrier: " + object + " waits for " + text_of(before) + " but not for its earlier " +
                 text_of(missed));
}

void Tracker::pass_barrier(SyncState& sync, AccessMask before, AccessMask after, const std::string& object) {
  check_waits(before, sync.pending, sync.pending_frame, object);
  sync = {.ready = after, .pending = 0, .pending_frame = frame_, .writer = 0};
}

void Tracker::take_over(Memory& memory, Placement& place, AccessMask before, const std::string& object) {
  if (!place.has_contents) {
    place.inherited = 0;
    place.inherited_frame = 0;
    for (const auto& other : memory.placements) {
      if (other.get() == &place || other->offset >= place.end() || place.offset >= other->end()) continue;
      // Later users of memory that `place` covers wait for `place`, which has waited for this resource.
      remember(other);
      const bool covered = place.offset <= other->offset && other->end() <= place.end();
      other->has_contents = false;
      other->lost = true;
      other->sync.update(other->sync.all(), [&](SyncState& sync) {
        if (sync.pending != 0 && sync.pending_frame + Device::kFramesInFlight > frame_) {
          place.inherited |= sync.pending;
          place.inherited_frame = std::max(place.inherited_frame, sync.pending_frame);
        }
        sync.ready = 0;
        sync.writer = 0;
        if (covered) sync.pending = 0;
      });
    }
    place.has_contents = true;
    place.lost = false;
  }
  check_waits(before, place.inherited, place.inherited_frame, object);
}

void Tracker::buffer_barriers(std::span<const BufferBarrier> barriers) {
  const BufferHandle handle = barriers.front().buffer;
  Buffer* buffer = objects_.buffers.find(handle);
  if (buffer == nullptr) return objects_.fault("barrier: a buffer that is not alive");
  AccessMask before = 0;
  AccessMask after = 0;
  bool waits_for_all = false;
  bool discards = false;
  for (const BufferBarrier& b : barriers) {
    if (b.buffer != handle) continue;
    const AccessMask own_before = mask_of(b.before) | b.also_before;
    waits_for_all = waits_for_all || own_before == 0;
    discards = discards || b.before == Access::none;
    before |= own_before;
    after |= mask_of(b.after) | b.also_after;
  }
  if (waits_for_all) before = 0;
  remember(buffer->place);
  const std::string object = name_of_object(*buffer);
  AccessMask ready = 0;
  buffer->place->sync.visit(buffer->place->sync.all(), [&](const SyncState& sync) { ready = sync.ready; });
  if (after == 0) objects_.fault("barrier: " + object + " is made ready for nothing");
  if (before != 0 && ready != 0 && (with_reads_of_same_stages(before) & ready) == 0) {
    objects_.fault("barrier: " + object + " waits for " + text_of(before) + " but its last barrier left it ready for " +
                   text_of(ready));
  }
  if (discards) take_over(*buffer->memory, *buffer->place, before, object);
  buffer->place->sync.update(buffer->place->sync.all(),
                             [&](SyncState& sync) { pass_barrier(sync, before, after, object); });
}

void Tracker::image_barrier(const ImageBarrier& b) {
  Image* image = objects_.images.find(b.image);
  if (image == nullptr) return objects_.fault("barrier: an image that is not alive");
  const std::string object = name_of_object(*image) + gpu::text_of(b.range);
  if (!lies_inside(b.range, image->desc)) return objects_.fault("barrier: " + object + " reaches past its end");
  const AccessMask before = mask_of(b.before) | b.also_before;
  const AccessMask after = mask_of(b.after) | b.also_after;
  if (b.after == Access::none || (after & ~accesses_in(layout_of(b.after))) != 0) {
    objects_.fault("barrier: " + object + " is made ready for " + text_of(after) + ", which is not one layout");
  }
  remember(image->place);
  Placement& place = *image->place;
  if (b.before == Access::none) take_over(*image->memory, place, before, object);
  place.sync.update(resolve(b.range, image->desc), [&](SyncState& sync) {
    if (b.before != Access::none && (sync.ready == 0 || layout_of(first_of(sync.ready)) != layout_of(b.before))) {
      objects_.fault("barrier: " + object + " is said to be in " + std::string(name_of(b.before)) +
                     " but its last barrier left it ready for " + text_of(sync.ready));
    }
    pass_barrier(sync, before, after, object);
  });
}

void Tracker::barrier(std::span<const BufferBarrier> buffers, std::span<const ImageBarrier> images) {
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const auto earlier = buffers.first(i);
    // All barriers on one buffer in one call act together, so they are all applied when the first of them is reached.
    if (std::ranges::find(earlier, buffers[i].buffer, &BufferBarrier::buffer) != earlier.end()) continue;
    buffer_barriers(buffers.subspan(i));
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (const ImageBarrier& earlier : images.first(i)) {
      if (earlier.image != images[i].image) continue;
      const Image* image = objects_.images.find(earlier.image);
      if (image == nullptr || !lies_inside(earlier.range, image->desc) || !lies_inside(images[i].range, image->desc)) {
        continue;
      }
      if (overlap(resolve(earlier.range, image->desc), resolve(images[i].range, image->desc))) {
        objects_.fault("barrier: a part of one image appears twice in one call");
      }
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
  remember(buffer->place);
  Placement& place = *buffer->place;
  if (place.lost) {
    objects_.fault(std::string(command) + ": " + object + " has lost its memory to another resource");
    return;
  }
  place.sync.update(place.sync.all(), [&](SyncState& sync) {
    if (sync.ready == 0 || (sync.ready & possible) != 0) return note_use(sync, possible, object, command);
    objects_.fault(std::string(command) + ": " + object + " is used as " + text_of(possible) +
                   " but its last barrier left it ready for " + text_of(sync.ready));
  });
}

void Tracker::use(ImageHandle handle, const ImageRange& range, AccessMask possible, std::string_view command) {
  Image* image = objects_.images.find(handle);
  if (image == nullptr) {
    objects_.fault(std::string(command) + ": an image that is not alive");
    return;
  }
  if (!lies_inside(range, image->desc)) return;  // the command reports it
  const std::string object = name_of_object(*image) + gpu::text_of(range);
  remember(image->place);
  Placement& place = *image->place;
  if (place.lost) {
    objects_.fault(std::string(command) + ": " + object + " has lost its memory to another resource");
    return;
  }
  bool faulty = false;
  place.sync.update(resolve(range, image->desc), [&](SyncState& sync) {
    if ((sync.ready & possible) != 0) return note_use(sync, possible, object, command);
    if (faulty) return;
    faulty = true;
    objects_.fault(std::string(command) + ": " + object + " is used as " + text_of(possible) +
                   " but its last barrier left it ready for " + text_of(sync.ready));
  });
}

}  // namespace gloam::gpu::recording
