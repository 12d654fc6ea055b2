// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/history.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/frame/history_pool.h"

namespace gloam {

std::string_view name_of(HistoryReset reset) {
  switch (reset) {
    case HistoryReset::none:
      return "none";
    case HistoryReset::created:
      return "created";
    case HistoryReset::description:
      return "description";
    case HistoryReset::key:
      return "key";
    case HistoryReset::camera_cut:
      return "camera_cut";
    case HistoryReset::gap:
      return "gap";
  }
  return "?";
}

struct History::State {
  explicit State(gpu::Device& device) : images(device), buffers(device) {}

  template <class Unwanted>
  void release_if(const Unwanted& unwanted) {
    images.release_if(unwanted);
    buffers.release_if(unwanted);
  }

  frame::HistoryPool<frame::HistoryImages> images;
  frame::HistoryPool<frame::HistoryBuffers> buffers;
  std::vector<std::function<void()>> on_commit;
  std::uint64_t frames = 0;  ///< committed frames that count for kFramesKept
};

History::History(gpu::Device& device) : state_(std::make_unique<State>(device)) {}
History::~History() = default;

void History::begin_frame() { give_up(); }

Result<HistoryImage> History::image(FrameGraph& graph, const HistoryView& view, const gpu::ImageDesc& desc,
                                    const HistoryUse& use) {
  auto used = state_->images.use(graph, view, desc, use, 1);
  if (!used.ok()) return used.error();
  return HistoryImage{used->state, used->refs[1]};
}

Result<HistoryBuffer> History::buffer(FrameGraph& graph, const HistoryView& view, const gpu::BufferDesc& desc,
                                      const HistoryUse& use) {
  auto used = state_->buffers.use(graph, view, desc, use, 1);
  if (!used.ok()) return used.error();
  return HistoryBuffer{used->state, used->refs[1]};
}

Result<HistoryImagePair> History::image_pair(FrameGraph& graph, const HistoryView& view, const gpu::ImageDesc& desc,
                                             const HistoryUse& use) {
  auto used = state_->images.use(graph, view, desc, use, 2);
  if (!used.ok()) return used.error();
  return HistoryImagePair{used->state, used->refs[0], used->refs[1]};
}

void History::on_commit(std::function<void()> function) { state_->on_commit.push_back(std::move(function)); }

bool History::owns(gpu::ImageHandle image) const { return state_->images.owns(image); }
bool History::owns(gpu::BufferHandle buffer) const { return state_->buffers.owns(buffer); }
bool History::swaps_pairs(const FrameGraph& graph) const { return state_->images.swaps_pairs(graph); }

void History::commit(const FrameGraph& graph, bool aging) {
  State& s = *state_;
  if (aging) ++s.frames;
  s.images.commit(graph, s.frames);
  s.buffers.commit(graph, s.frames);
  s.images.release_unused(s.frames);
  s.buffers.release_unused(s.frames);
  for (const auto& function : std::exchange(s.on_commit, {})) function();
}

void History::give_up() {
  state_->images.give_up();
  state_->buffers.give_up();
  state_->on_commit.clear();
}

void History::release_world(std::uint64_t world) {
  state_->release_if([&](const frame::HistoryKey& key) { return key.world == world; });
}
void History::release_view(std::uint32_t view) {
  state_->images.release_view(view);
  state_->buffers.release_view(view);
}
void History::release_module(std::string_view module) {
  state_->release_if([&](const frame::HistoryKey& key) { return key.module == module; });
}

std::map<std::string, std::uint64_t> History::bytes_of_view(std::uint32_t view) const {
  std::map<std::string, std::uint64_t> bytes;
  state_->images.add_bytes_of_view(view, bytes);
  state_->buffers.add_bytes_of_view(view, bytes);
  return bytes;
}

std::size_t History::size() const { return state_->images.size() + state_->buffers.size(); }

}  // namespace gloam
