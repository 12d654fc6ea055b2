// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"

namespace gloam {

/// What the last use wrote, and what this frame shall write in full. When not `valid`, `previous` holds nothing of use:
/// the pass must not rely on it, but may bind it. `age`: frames since `previous` was written, ≥ 1 when valid.
struct HistoryImage {
  ImageRef previous;
  ImageRef current;
  bool valid = false;
  std::uint64_t age = 0;
};
struct HistoryBuffer {
  BufferRef previous;
  BufferRef current;
  bool valid = false;
  std::uint64_t age = 0;
};

/// Resources whose contents pass from frame to frame: pairs that swap roles at every use. A pair belongs to a module
/// and is found by module and name. It starts invalid when it is new, when its description changes, after a reset, and
/// after it was released because nobody asked for it in kFramesKept frames.
class History {
 public:
  static constexpr std::uint64_t kFramesKept = 120;

  explicit History(gpu::Device& device) : device_(device) {}
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// Once a frame, before the first image() or buffer(): releases the pairs that nobody used for kFramesKept frames.
  void begin_frame();

  /// Imports a pair into this frame's graph, once a frame. desc.usage names all flags that the passes need. Both are
  /// left ready for `rest` when the frame ends, so `rest` is best what reads `previous` first.
  [[nodiscard]] Result<HistoryImage> image(FrameGraph& graph, const gpu::ImageDesc& desc, gpu::Access rest);
  [[nodiscard]] Result<HistoryBuffer> buffer(FrameGraph& graph, const gpu::BufferDesc& desc, gpu::Access rest);

  /// The next use of this pair is invalid (a camera cut, a simulation set back).
  void reset(std::string_view module, std::string_view name);
  void reset_all();
  /// Pairs alive.
  [[nodiscard]] std::size_t size() const { return images_.size() + buffers_.size(); }

 private:
  template <class Handle, class Desc>
  struct Pair {
    std::array<Handle, 2> handles;
    std::array<gpu::Access, 2> left = {gpu::Access::none, gpu::Access::none};  ///< by its last frame
    Desc desc;
    std::uint32_t current = 0;
    bool valid = false;
    std::uint64_t last_used = 0;
  };
  using Key = std::pair<std::string, std::string>;  ///< module and name
  template <class Handle, class Desc>
  using Pairs = std::map<Key, Pair<Handle, Desc>>;

  template <class Handle, class Desc>
  [[nodiscard]] Result<Pair<Handle, Desc>*> prepare(Pairs<Handle, Desc>& pairs, const Desc& desc);
  /// `import(name, handle, before, after)` adds one side to the graph.
  template <class Used, class Handle, class Desc, class Import>
  [[nodiscard]] Used use(Pair<Handle, Desc>& pair, gpu::Access rest, Import&& import);
  template <class Handle, class Desc>
  void release_unused(Pairs<Handle, Desc>& pairs);
  template <class Handle, class Desc>
  void release(Pair<Handle, Desc>& pair);

  gpu::Device& device_;
  std::uint64_t frame_ = 0;
  Pairs<gpu::ImageHandle, gpu::ImageDesc> images_;
  Pairs<gpu::BufferHandle, gpu::BufferDesc> buffers_;
};

}  // namespace gloam
