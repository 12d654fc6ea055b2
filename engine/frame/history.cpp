// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/history.h"

#include <iterator>
#include <tuple>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {

namespace {

bool same_contents(const gpu::ImageDesc& a, const gpu::ImageDesc& b) {
  const auto key = [](const gpu::ImageDesc& d) {
    return std::tuple(d.format, d.width, d.height, d.layers, d.mips, d.usage, d.shape, d.depth);
  };
  return key(a) == key(b);
}
bool same_contents(const gpu::BufferDesc& a, const gpu::BufferDesc& b) {
  return std::tuple(a.size, a.usage, a.memory) == std::tuple(b.size, b.usage, b.memory);
}

Result<gpu::ImageHandle> create(gpu::Device& device, const gpu::ImageDesc& desc) { return device.create_image(desc); }
Result<gpu::BufferHandle> create(gpu::Device& device, const gpu::BufferDesc& desc) {
  return device.create_buffer(desc);
}

}  // namespace

template <class Handle, class Desc>
void History::release(Pair<Handle, Desc>& pair) {
  for (Handle& handle : pair.handles) {
    if (handle) device_.destroy(handle);
    handle = {};
  }
}

History::~History() {
  for (auto& [key, pair] : images_) release(pair);
  for (auto& [key, pair] : buffers_) release(pair);
}

template <class Handle, class Desc>
void History::release_unused(Pairs<Handle, Desc>& pairs) {
  for (auto item = pairs.begin(); item != pairs.end();) {
    const bool unused = item->second.last_used + kFramesKept < frame_;
    if (unused) release(item->second);
    item = unused ? pairs.erase(item) : std::next(item);
  }
}

void History::begin_frame() {
  ++frame_;
  release_unused(images_);
  release_unused(buffers_);
}

template <class Handle, class Desc>
Result<History::Pair<Handle, Desc>*> History::prepare(Pairs<Handle, Desc>& pairs, const Desc& desc) {
  Pair<Handle, Desc>& pair = pairs[{desc.module, desc.name}];
  const bool known = static_cast<bool>(pair.handles[0]);
  GLOAM_ASSERT(!known || pair.last_used != frame_, "history '" + desc.name + "' is asked for once a frame");
  if (known && same_contents(pair.desc, desc)) {
    pair.current ^= 1;
    return &pair;
  }
  release(pair);
  pair = {.desc = desc};
  for (Handle& handle : pair.handles) {
    Result<Handle> made = create(device_, desc);
    if (!made.ok()) {
      release(pair);
      pairs.erase({desc.module, desc.name});
      return made.error();
    }
    handle = *made;
  }
  return &pair;
}

template <class Used, class Handle, class Desc, class Import>
Used History::use(Pair<Handle, Desc>& pair, gpu::Access rest, Import&& import) {
  const auto import_side = [&](std::uint32_t side, const char* suffix) {
    return import(pair.desc.name + suffix, pair.handles[side], std::exchange(pair.left[side], rest), rest);
  };
  Used used;
  used.previous = import_side(1 - pair.current, " (previous)");
  used.current = import_side(pair.current, " (current)");
  used.valid = pair.valid;
  used.age = pair.valid ? frame_ - pair.last_used : 0;
  pair.valid = true;
  pair.last_used = frame_;
  return used;
}

Result<HistoryImage> History::image(FrameGraph& graph, const gpu::ImageDesc& desc, gpu::Access rest) {
  auto pair = prepare(images_, desc);
  if (!pair.ok()) return pair.error();
  return use<HistoryImage>(**pair, rest, [&](const std::string& name, auto image, auto before, auto after) {
    return graph.import_image(name, image, before, after);
  });
}

Result<HistoryBuffer> History::buffer(FrameGraph& graph, const gpu::BufferDesc& desc, gpu::Access rest) {
  auto pair = prepare(buffers_, desc);
  if (!pair.ok()) return pair.error();
  return use<HistoryBuffer>(**pair, rest, [&](const std::string& name, auto buffer, auto before, auto after) {
    return graph.import_buffer(name, buffer, before, after);
  });
}

void History::reset(std::string_view module, std::string_view name) {
  const Key key{module, name};
  if (const auto found = images_.find(key); found != images_.end()) found->second.valid = false;
  if (const auto found = buffers_.find(key); found != buffers_.end()) found->second.valid = false;
}

void History::reset_all() {
  for (auto& [key, pair] : images_) pair.valid = false;
  for (auto& [key, pair] : buffers_) pair.valid = false;
}

}  // namespace gloam
