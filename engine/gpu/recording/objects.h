// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "engine/gpu/subresources.h"
#include "engine/gpu/types.h"

/// The objects that the recording device keeps instead of GPU objects.
namespace gloam::gpu::recording {

/// The synchronisation state of a buffer or of one mip of one layer of an image.
struct SyncState {
  AccessMask ready = 0;             ///< accesses that the last barrier made it ready for; 0: no barrier yet
  AccessMask pending = 0;           ///< accesses since that barrier
  std::uint64_t pending_frame = 0;  ///< frame of the newest pending access
  std::uint32_t writer = 0;         ///< number of the outermost label that wrote since that barrier; 0: none
  bool operator==(const SyncState&) const = default;
};

/// The bytes that one resource takes in a piece of memory, and the resource's state. It outlives the resource, because
/// the frames that use it may still run.
struct Placement {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  Subresources<SyncState> sync;
  bool has_contents = false;          ///< its contents are in the memory
  bool lost = false;                  ///< another resource has taken the memory over since
  AccessMask inherited = 0;           ///< accesses to resources from which it took the memory over
  std::uint64_t inherited_frame = 0;  ///< frame of the newest of them

  [[nodiscard]] std::uint64_t end() const { return offset + bytes; }
};

/// A piece of memory with all resources that were placed in it.
struct Memory {
  std::string module;
  std::uint64_t bytes = 0;  ///< 0: bytes of a block, which are accounted with the block
  std::vector<std::shared_ptr<Placement>> placements;
};

/// A memory block into which callers place resources.
struct Block {
  MemoryDesc desc;
  bool alive = true;
  std::shared_ptr<Memory> memory;
  std::vector<ModuleMemory> shares;
};

struct Buffer {
  BufferDesc desc;
  bool alive = true;
  std::vector<std::byte> bytes;  ///< allocated on first use
  std::shared_ptr<Memory> memory;
  std::shared_ptr<Placement> place;
};

struct Image {
  ImageDesc desc;
  bool alive = true;
  std::shared_ptr<Memory> memory;
  std::shared_ptr<Placement> place;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::byte>> texels;  ///< by mip and layer, as copied in
};

struct Pipeline {
  std::string name;
  std::string module;
  bool compute = false;
  std::uint32_t vertex_streams = 0;
  bool alive = true;
};

struct ResourceSet {
  std::uint32_t set = 0;
  std::vector<Binding> bindings;
  bool alive = true;
};

/// A table of objects addressed by handles. All methods may be called from any thread. Objects never move and indices
/// are never reused, so a stale handle finds a dead object.
template <class Object>
class Table {
 public:
  std::uint32_t add(Object object) {
    const std::lock_guard lock(mutex_);
    objects_.push_back(std::move(object));
    return static_cast<std::uint32_t>(objects_.size() - 1);
  }
  /// The object of this handle if it is alive, otherwise null.
  template <class Tag>
  [[nodiscard]] Object* find(Handle<Tag> handle) const {
    const std::lock_guard lock(mutex_);
    if (handle.generation != 1 || handle.index >= objects_.size()) return nullptr;
    Object& object = objects_[handle.index];
    return object.alive ? &object : nullptr;
  }
  template <class Function>
  void for_each_alive(Function&& function) const {
    const std::lock_guard lock(mutex_);
    for (Object& object : objects_) {
      if (object.alive) function(object);
    }
  }

 private:
  mutable std::mutex mutex_;
  mutable std::deque<Object> objects_;
};

struct Objects {
  Table<Buffer> buffers;
  Table<Image> images;
  Table<Pipeline> pipelines;
  Table<ResourceSet> resource_sets;
  Table<Block> blocks;

  void fault(std::string text) {
    const std::lock_guard lock(fault_mutex);
    faults.push_back(std::move(text));
  }
  std::mutex fault_mutex;
  std::vector<std::string> faults;
};

}  // namespace gloam::gpu::recording
