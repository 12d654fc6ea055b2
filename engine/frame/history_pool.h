// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "engine/core/assert.h"
#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/frame/history.h"
#include "engine/gpu/device.h"
#include "engine/gpu/image_size.h"

namespace gloam::frame {

struct HistoryKey {
  std::uint64_t world = 0;
  std::optional<std::uint32_t> view;  ///< only with HistoryScope::view
  std::string module;
  std::string name;
  std::uint64_t instance = 0;
  auto operator<=>(const HistoryKey&) const = default;
};

/// Types and functions of one kind of resource.
struct HistoryImages {
  using Handle = gpu::ImageHandle;
  using Desc = gpu::ImageDesc;
  using Ref = ImageRef;
  [[nodiscard]] static bool same(const Desc& a, const Desc& b) {
    const auto tie = [](const Desc& d) {
      return std::tie(d.format, d.width, d.height, d.layers, d.mips, d.usage, d.shape, d.depth);
    };
    return tie(a) == tie(b);
  }
  [[nodiscard]] static std::uint64_t bytes(const Desc& desc) { return gpu::image_bytes(desc); }
  [[nodiscard]] static Result<Handle> create(gpu::Device& device, const Desc& desc) {
    return device.create_image(desc);
  }
  [[nodiscard]] static Ref import(FrameGraph& graph, const std::string& name, Handle image, gpu::Access before,
                                  gpu::Access after) {
    return graph.import_image(name, image, before, after);
  }
};
struct HistoryBuffers {
  using Handle = gpu::BufferHandle;
  using Desc = gpu::BufferDesc;
  using Ref = BufferRef;
  [[nodiscard]] static bool same(const Desc& a, const Desc& b) {
    return std::tie(a.size, a.usage, a.memory) == std::tie(b.size, b.usage, b.memory);
  }
  [[nodiscard]] static std::uint64_t bytes(const Desc& desc) { return desc.size; }
  [[nodiscard]] static Result<Handle> create(gpu::Device& device, const Desc& desc) {
    return device.create_buffer(desc);
  }
  [[nodiscard]] static Ref import(FrameGraph& graph, const std::string& name, Handle buffer, gpu::Access before,
                                  gpu::Access after) {
    return graph.import_buffer(name, buffer, before, after);
  }
};

/// The history resources of one kind. Each has committed contents, and the contents that it would have if the frame
/// that is being declared were committed.
template <class Kind>
class HistoryPool {
 public:
  using Ref = typename Kind::Ref;
  using Desc = typename Kind::Desc;
  using Handle = typename Kind::Handle;

  /// previous and current; equal for a resource in place.
  struct Used {
    HistoryState state;
    std::array<Ref, 2> refs;
  };

  explicit HistoryPool(gpu::Device& device) : device_(device) {}
  ~HistoryPool() {
    release_if([](const HistoryKey&) { return true; });
  }
  HistoryPool(const HistoryPool&) = delete;
  HistoryPool& operator=(const HistoryPool&) = delete;

  /// sides: 1 for a resource in place, 2 for a pair.
  [[nodiscard]] Result<Used> use(FrameGraph& graph, const HistoryView& view, const Desc& desc, const HistoryUse& use,
                                 std::uint32_t sides);
  [[nodiscard]] bool owns(Handle handle) const;
  /// Whether `graph` writes the current side of a pair.
  [[nodiscard]] bool swaps_pairs(const FrameGraph& graph) const;
  void commit(const FrameGraph& graph, std::uint64_t now);
  void give_up();
  void release_unused(std::uint64_t now);
  void release_if(const std::function<bool(const HistoryKey&)>& unwanted);
  void release_view(std::uint32_t view);
  /// Adds the bytes of a view's own resources to those of their modules.
  void add_bytes_of_view(std::uint32_t view, std::map<std::string, std::uint64_t>& bytes) const {
    for (const auto& [key, item] : items_)
      if (key.view == view && item.contents.sides > 0)
        bytes[key.module] += item.contents.sides * Kind::bytes(item.contents.desc);
  }
  [[nodiscard]] std::size_t size() const { return items_.size(); }

 private:
  struct Contents {
    Desc desc;
    std::uint32_t sides = 0;  ///< 0: no resource
    std::array<Handle, 2> handles;
    std::array<gpu::Access, 2> left = {gpu::Access::none, gpu::Access::none};  ///< access each was left ready for
    std::uint32_t newest = 0;                                                  ///< the side that was written last
    HistoryReset reset = HistoryReset::created;  ///< none if written; otherwise created or description
    std::uint64_t frame = 0;                     ///< the world's frame that wrote last
    std::uint64_t key = 0;                       ///< HistoryRule::key of that frame
    HistoryState told;                           ///< the state that the frame got
  };
  /// The use of a resource in the frame that is being declared.
  struct Pending {
    Contents contents;   ///< before the frame's write
    bool fresh = false;  ///< the frame created the handles
    HistoryUse use;
    std::uint64_t frame = 0;
    std::uint32_t current = 0;
    HistoryState state;
    std::array<Ref, 2> refs;  ///< by side
  };
  struct Item {
    Contents contents;
    std::optional<Pending> pending;
    std::uint64_t last_used = 0;
    std::set<std::uint32_t> sharers;  ///< views that use it with HistoryScope::shared
  };

  [[nodiscard]] Status create(Contents& contents);
  void destroy(Contents& contents);
  [[nodiscard]] Result<Pending> prepare(Item& item, const HistoryView& view, const Desc& desc, const HistoryUse& use,
                                        std::uint32_t sides);
  [[nodiscard]] static HistoryReset reset_of(const Contents& contents, const HistoryView& view,
                                             const HistoryRule& rule);
  [[nodiscard]] static Used used(const FrameGraph& graph, const Pending& pending);

  gpu::Device& device_;
  std::map<HistoryKey, Item> items_;
};

template <class Kind>
Status HistoryPool<Kind>::create(Contents& contents) {
  for (std::uint32_t side = 0; side < contents.sides; ++side) {
    auto made = Kind::create(device_, contents.desc);
    if (!made.ok()) {
      destroy(contents);
      return made.error();
    }
    contents.handles[side] = *made;
  }
  return {};
}

template <class Kind>
void HistoryPool<Kind>::destroy(Contents& contents) {
  for (const Handle handle : contents.handles)
    if (handle) device_.destroy(handle);
  contents = {};
}

template <class Kind>
HistoryReset HistoryPool<Kind>::reset_of(const Contents& contents, const HistoryView& view, const HistoryRule& rule) {
  if (contents.reset != HistoryReset::none) return contents.reset;
  if (contents.key != rule.key) return HistoryReset::key;
  if (rule.camera_cut && contents.frame < view.cut_frame) return HistoryReset::camera_cut;
  if (view.frame - contents.frame - 1 > rule.most_missed) return HistoryReset::gap;
  return HistoryReset::none;
}

template <class Kind>
Result<typename HistoryPool<Kind>::Pending> HistoryPool<Kind>::prepare(Item& item, const HistoryView& view,
                                                                       const Desc& desc, const HistoryUse& use,
                                                                       std::uint32_t sides) {
  const Contents& kept = item.contents;
  Pending pending{.contents = kept, .use = use, .frame = view.frame};
  if (kept.sides != sides || !Kind::same(kept.desc, desc)) {
    pending.fresh = true;
    pending.contents = {.desc = desc, .sides = sides};
    if (kept.sides != 0) pending.contents.reset = HistoryReset::description;
    GLOAM_TRY(create(pending.contents));
  }
  const Contents& contents = pending.contents;
  const bool written = contents.reset == HistoryReset::none;
  GLOAM_ASSERT(!written || contents.frame <= view.frame,
               "history '" + desc.name + "': the frames of a world are numbered in their order");
  if (written && contents.frame == view.frame) {  // the frame is drawn again
    pending.state = contents.told;
    pending.state.written = true;
    pending.current = contents.newest;
    if (contents.key != use.reset.key) pending.state = {.reset = HistoryReset::key};
    return pending;
  }
  pending.state.reset = reset_of(contents, view, use.reset);
  if (pending.state.valid()) pending.state.age = view.frame - contents.frame;
  pending.current = sides == 2 ? contents.newest ^ 1 : 0;
  return pending;
}

template <class Kind>
typename HistoryPool<Kind>::Used HistoryPool<Kind>::used(const FrameGraph& graph, const Pending& pending) {
  const std::uint32_t previous = pending.contents.sides == 2 ? pending.current ^ 1 : pending.current;
  Used used{pending.state, {graph.newest(pending.refs[previous]), graph.newest(pending.refs[pending.current])}};
  used.state.written = used.state.written || used.refs[1].version > 0;
  return used;
}

template <class Kind>
Result<typename HistoryPool<Kind>::Used> HistoryPool<Kind>::use(FrameGraph& graph, const HistoryView& view,
                                                                const Desc& desc, const HistoryUse& use,
                                                                std::uint32_t sides) {
  const bool of_view = use.scope == HistoryScope::view;
  GLOAM_ASSERT(of_view || !use.reset.camera_cut,
               "history '" + desc.name + "': only a view has a camera that could be cut");
  GLOAM_ASSERT(use.final_access != gpu::Access::none && !gpu::is_write(use.final_access),
               "history '" + desc.name + "' rests in an access that reads");
  const HistoryKey key{view.world, of_view ? std::optional(view.view) : std::nullopt, desc.module, desc.name,
                       use.instance};
  const auto [at, added] = items_.try_emplace(key);
  Item& item = at->second;
  if (use.scope == HistoryScope::shared) item.sharers.insert(view.view);
  if (item.pending) {
    const Pending& pending = *item.pending;
    GLOAM_ASSERT(pending.contents.sides == sides && Kind::same(pending.contents.desc, desc) &&
                     pending.use.final_access == use.final_access && pending.frame == view.frame,
                 "history '" + desc.name + "' has one description in all uses of a frame");
    return used(graph, pending);
  }
  auto prepared = prepare(item, view, desc, use, sides);
  if (!prepared.ok()) {
    if (added) items_.erase(at);
    return prepared.error();
  }
  item.pending = std::move(*prepared);
  Pending& pending = *item.pending;
  for (std::uint32_t side = 0; side < sides; ++side) {
    const std::string suffix = sides == 1 ? "" : side == pending.current ? " (current)" : " (previous)";
    pending.refs[side] = Kind::import(graph, desc.name + suffix, pending.contents.handles[side],
                                      pending.contents.left[side], use.final_access);
  }
  return used(graph, pending);
}

template <class Kind>
bool HistoryPool<Kind>::owns(Handle handle) const {
  return std::ranges::any_of(items_, [&](const auto& entry) {
    const Item& item = entry.second;
    const auto& handles = item.pending ? item.pending->contents.handles : item.contents.handles;
    return std::ranges::find(handles, handle) != handles.end();
  });
}

template <class Kind>
bool HistoryPool<Kind>::swaps_pairs(const FrameGraph& graph) const {
  return std::ranges::any_of(items_, [&](const auto& entry) {
    const std::optional<Pending>& pending = entry.second.pending;
    return pending && pending->contents.sides == 2 && graph.writes(pending->refs[pending->current]);
  });
}

template <class Kind>
void HistoryPool<Kind>::commit(const FrameGraph& graph, std::uint64_t now) {
  for (auto& [key, item] : items_) {
    if (!item.pending) continue;
    Pending& pending = *item.pending;
    if (pending.fresh) destroy(item.contents);
    Contents& contents = item.contents;
    contents = std::move(pending.contents);
    for (std::uint32_t side = 0; side < contents.sides; ++side) contents.left[side] = pending.use.final_access;
    if (graph.writes(pending.refs[pending.current])) {
      contents.newest = pending.current;
      contents.reset = HistoryReset::none;
      contents.frame = pending.frame;
      contents.key = pending.use.reset.key;
      contents.told = pending.state;
    }
    item.last_used = now;
    item.pending.reset();
  }
}

template <class Kind>
void HistoryPool<Kind>::give_up() {
  for (auto at = items_.begin(); at != items_.end();) {
    Item& item = at->second;
    if (item.pending && item.pending->fresh) destroy(item.pending->contents);
    item.pending.reset();
    at = item.contents.sides == 0 ? items_.erase(at) : std::next(at);
  }
}

template <class Kind>
void HistoryPool<Kind>::release_unused(std::uint64_t now) {
  for (auto at = items_.begin(); at != items_.end();) {
    const bool unused = at->second.last_used + History::kFramesKept < now;
    if (unused) destroy(at->second.contents);
    at = unused ? items_.erase(at) : std::next(at);
  }
}

template <class Kind>
void HistoryPool<Kind>::release_if(const std::function<bool(const HistoryKey&)>& unwanted) {
  for (auto at = items_.begin(); at != items_.end();) {
    if (!unwanted(at->first)) {
      ++at;
      continue;
    }
    Item& item = at->second;
    if (item.pending && item.pending->fresh) destroy(item.pending->contents);
    destroy(item.contents);
    at = items_.erase(at);
  }
}

template <class Kind>
void HistoryPool<Kind>::release_view(std::uint32_t view) {
  release_if([&](const HistoryKey& key) {
    if (key.view) return key.view == view;
    std::set<std::uint32_t>& sharers = items_.at(key).sharers;
    return sharers.erase(view) > 0 && sharers.empty();
  });
}

}  // namespace gloam::frame
