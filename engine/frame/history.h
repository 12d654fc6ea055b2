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

/// `previous`: the resource that the last use wrote. `current`: the resource that this frame must write completely. If
/// not `valid`, the contents of `previous` are undefined: a pass may bind it but must not use its contents. `age`:
/// frames since `previous` was written; ≥ 1 if valid, otherwise 0.
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

/// Resources whose contents are kept from frame to frame: pairs that swap their roles at every use. A pair is
/// identified by module and name. It is invalid at its first use, after its description has changed, after a reset, and
/// after it was released because it was not used for kFramesKept frames.
class History {
 public:
  static constexpr std::uint64_t kFramesKept = 120;

  explicit History(gpu::Device& device) : device_(device) {}
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// Call it once per frame, before the first image() or buffer(). Releases the pairs that were not used for
  /// kFramesKept frames.
  void begin_frame();

  /// Imports a pair into this frame's graph, at most once per frame. desc.usage: all usage flags that the passes need.
  /// At the end of the frame both resources are left ready for `rest`, so `rest` should be the access that reads
  /// `previous` first.
  [[nodiscard]] Result<HistoryImage> image(FrameGraph& graph, const gpu::ImageDesc& desc, gpu::Access rest);
  [[nodiscard]] Result<HistoryBuffer> buffer(FrameGraph& graph, const gpu::BufferDesc& desc, gpu::Access rest);

  /// Makes the next use of this pair invalid, for example after a camera cut or when a simulation is reset.
  void reset(std::string_view module, std::string_view name);
  void reset_all();
  /// The number of live pairs.
  [[nodiscard]] std::size_t size() const { return images_.size() + buffers_.size(); }

 private:
  template <class Handle, class Desc>
  struct Pair {
    std::array<Handle, 2> handles;
    std::array<gpu::Access, 2> left = {gpu::Access::none, gpu::Access::none};  ///< access each was left ready for
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
  /// `import(name, handle, before, after)` imports one resource of the pair into the graph.
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
