// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"

namespace gloam {

/// Owner of a history resource, in one world. shared: the views that use the same HistoryUse::instance of it; it is
/// destroyed with the last of them.
enum class HistoryScope { view, shared, world };

/// Reason why the contents of a history resource are undefined; none: they are defined.
enum class HistoryReset {
  none,
  created,      ///< no frame has written the resource since it was created
  description,  ///< size, format or another part of the description changed
  key,          ///< HistoryRule::key changed
  camera_cut,   ///< the view's camera was cut since the last write
  gap,          ///< too many frames since the last write
};
[[nodiscard]] std::string_view name_of(HistoryReset reset);

/// Events that invalidate contents, as the owner chooses. Creation and a changed description always do. The contents
/// stay invalid, for this reason, until a committed frame writes them.
struct HistoryRule {
  static constexpr std::uint64_t kAnyNumber = std::numeric_limits<std::uint64_t>::max();

  bool camera_cut = false;  ///< of the view; only with HistoryScope::view
  /// Frames of the world that may pass between two writes: 0 if every frame must write, kAnyNumber for no limit.
  std::uint64_t most_missed = kAnyNumber;
  std::uint64_t key = 0;  ///< the owner's value; contents that were written with another value are invalid
};

/// Parameters of one use of a history resource.
struct HistoryUse {
  HistoryScope scope = HistoryScope::view;
  /// The access that the resource is left ready for at the end of the frame: the one that the next frame begins with.
  gpu::Access final_access = gpu::Access::compute_read;
  HistoryRule reset;
  std::uint64_t instance = 0;  ///< distinguishes resources of one name, for example by camera
};

/// The state of a history resource at its use in a frame.
struct HistoryState {
  HistoryReset reset = HistoryReset::none;
  /// Frames of the world since the contents were written; ≥ 1 if valid, otherwise 0.
  std::uint64_t age = 0;
  /// The contents of this frame exist already: an earlier view of the frame has declared a write, or a frame is drawn
  /// again (Renderer::read_image) with the same HistoryRule::key. A simulation must not step again. Passes that draw
  /// over a pair's `current` may repeat: `previous`, `reset` and `age` are those of the first time.
  bool written = false;
  [[nodiscard]] bool valid() const { return reset == HistoryReset::none; }
  /// Whether the newest version of a resource in place has defined contents.
  [[nodiscard]] bool filled() const { return valid() || written; }
};

/// One object in place. If not valid(), a pass may bind it but must not use its contents before it writes them. Views
/// of one frame share the object of their world: each gets the newest version.
struct HistoryImage : HistoryState {
  ImageRef image;
};
struct HistoryBuffer : HistoryState {
  BufferRef buffer;
};

/// Two objects that swap their roles. `previous`: what the last committed write left. `current`: what this frame must
/// write completely. If not valid(), a pass may bind `previous` but must not use its contents. A frame without a write
/// to `current` changes nothing: the next frame gets the same pair.
struct HistoryImagePair : HistoryState {
  ImageRef previous;
  ImageRef current;
};

/// The view of a world for which passes are declared. `frame`: number among the world's frames; a higher one than that
/// of the last committed frame of this world, or the same if that frame is drawn again. `cut_frame`: the newest frame
/// of the view with a camera cut, ≤ frame.
struct HistoryView {
  std::uint64_t world = 0;
  std::uint32_t view = 0;
  std::uint64_t frame = 0;
  std::uint64_t cut_frame = 0;
};

/// Images and buffers whose contents live over frames. A resource is found by world, view (with HistoryScope::view),
/// module, name and instance.
///
/// A frame is a transaction: begin_frame, uses, then commit. Roles, validity and layouts change in commit only, which
/// belongs after FrameGraph::execute has recorded the passes and Device::submit_frame has succeeded. A frame without
/// commit is given up: the GPU must not execute any of its commands. It leaves all contents as they were, and resources
/// that it created are destroyed.
class History {
 public:
  /// A resource that no committed frame of this many has used is destroyed.
  static constexpr std::uint64_t kFramesKept = 120;

  explicit History(gpu::Device& device);
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// Call it once per frame, after FrameGraph::begin and before the first use. Gives up a frame that was not committed.
  void begin_frame();
  /// Imports the resource into the frame's graph; further uses in the same frame return its newest versions and must
  /// have the same parameters, except that `reset` of the first use counts. desc.module, desc.name: owner and name.
  /// desc.usage: all usage flags that the passes and `final_access` need. Fails if the device cannot create the
  /// resource.
  [[nodiscard]] Result<HistoryImage> image(FrameGraph& graph, const HistoryView& view, const gpu::ImageDesc& desc,
                                           const HistoryUse& use);
  [[nodiscard]] Result<HistoryBuffer> buffer(FrameGraph& graph, const HistoryView& view, const gpu::BufferDesc& desc,
                                             const HistoryUse& use);
  [[nodiscard]] Result<HistoryImagePair> image_pair(FrameGraph& graph, const HistoryView& view,
                                                    const gpu::ImageDesc& desc, const HistoryUse& use);
  /// Calls the function in this frame's commit, and never if the frame is given up: for state of the CPU that describes
  /// contents on the GPU.
  void on_commit(std::function<void()> function);

  /// Whether the object is one of the frame that is being declared, or of a frame before it.
  [[nodiscard]] bool owns(gpu::ImageHandle image) const;
  [[nodiscard]] bool owns(gpu::BufferHandle buffer) const;
  /// Whether a pass that `graph` has compiled writes the `current` of a pair: what the frame writes then depends on
  /// what the frames before it have left.
  [[nodiscard]] bool swaps_pairs(const FrameGraph& graph) const;
  /// Ends the frame that `graph` has executed and the device has accepted. `aging`: whether the frame counts for
  /// kFramesKept.
  void commit(const FrameGraph& graph, bool aging = true);
  /// Ends the frame without effects.
  void give_up();

  /// Destroy the resources of a world, of a view (in all worlds; shared ones if no other view uses them), or of a
  /// module.
  void release_world(std::uint64_t world);
  void release_view(std::uint32_t view);
  void release_module(std::string_view module);
  /// Bytes of the resources with HistoryScope::view of this view, in all worlds, by module.
  [[nodiscard]] std::map<std::string, std::uint64_t> bytes_of_view(std::uint32_t view) const;
  /// The number of resources; a pair counts as one.
  [[nodiscard]] std::size_t size() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gloam
