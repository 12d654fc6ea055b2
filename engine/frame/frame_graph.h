// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/device.h"

namespace gloam {

/// A handle to one version of a resource in this frame's graph. Each write returns a new version. Using an old version
/// in a later pass, or a handle of another frame, asserts.
template <class Kind>
struct FrameRef {
  std::uint32_t resource = ~0u;
  std::uint32_t version = 0;
  std::uint32_t frame = 0;
  [[nodiscard]] explicit operator bool() const { return resource != ~0u; }
};
using ImageRef = FrameRef<struct FrameImageTag>;
using BufferRef = FrameRef<struct FrameBufferTag>;

class FrameGraph;

/// Given to a pass while it records: the command list, and the objects of the resources that it has declared.
class PassContext {
 public:
  PassContext(FrameGraph& graph, gpu::CommandList& commands) : graph_(graph), commands_(commands) {}
  [[nodiscard]] gpu::CommandList& commands() { return commands_; }
  [[nodiscard]] gpu::ImageHandle image(ImageRef ref) const;
  [[nodiscard]] gpu::BufferHandle buffer(BufferRef ref) const;
  /// Reports that the pass could not be recorded. The frame is then given up (FrameGraph::recorded).
  void fail(Error error);

 private:
  FrameGraph& graph_;
  gpu::CommandList& commands_;
};

using PassFunction = std::function<void(PassContext&)>;

/// Declares one pass: the resources that it reads and writes, and the function that records it. Reads and writes must
/// be declared before the next pass is added. A pass may declare one resource several times if one layout and one
/// barrier suffice: several reads, or a write that includes the reads. Other combinations assert. Mips and layers of an
/// image are separate in this respect: a pass may read one mip and write the next. Two ranges of one image in one pass
/// must be equal or disjoint. Passes that write different mips or layers do not wait for each other.
class PassBuilder {
 public:
  PassBuilder(FrameGraph& graph, std::uint32_t pass) : graph_(graph), pass_(pass) {}
  void read(ImageRef image, gpu::Access access, const gpu::ImageRange& range = {});
  void read(BufferRef buffer, gpu::Access access);
  /// Other mips and layers than those of the range keep their contents.
  [[nodiscard]] ImageRef write(ImageRef image, gpu::Access access, const gpu::ImageRange& range = {});
  [[nodiscard]] BufferRef write(BufferRef buffer, gpu::Access access);
  /// Prevents culling, for a pass with effects that the graph does not track.
  void keep();
  void execute(PassFunction function);

 private:
  FrameGraph& graph_;
  std::uint32_t pass_;
};

/// The GPU time and the commands of one pass in one completed frame.
struct PassTime {
  std::string name;
  std::string module;
  double ms = 0.0;  ///< from begin_ns to end_ns; 0 if the pass was not timed
  std::uint32_t dispatches = 0;
  std::uint32_t draws = 0;
  /// Times of gpu::Device::timestamps; both 0 if the pass was not timed. Begin: after the barriers of the pass.
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint32_t view = 0;  ///< FrameGraph::set_view
};

/// The passes of one completed frame in order of execution.
struct GpuFrameTimes {
  std::uint64_t frame = 0;  ///< its gpu::Device::frame_number
  double gpu_ms = 0.0;      ///< from the begin of the first pass to the end of the last; 0 if none was timed
  std::vector<PassTime> passes;
};

/// The passes of one frame as data. They are declared again every frame. The compiled plan (culled passes, barriers,
/// shared memory) is cached by a structural hash. Passes execute in order of declaration.
class FrameGraph {
 public:
  explicit FrameGraph(gpu::Device& device);
  ~FrameGraph();
  FrameGraph(const FrameGraph&) = delete;
  FrameGraph& operator=(const FrameGraph&) = delete;

  /// Begins a frame and clears the declarations of the last one. Earlier handles become invalid.
  void begin();
  /// The number of begin() calls; equals FrameRef::frame of all valid handles.
  [[nodiscard]] std::uint32_t frame() const;

  /// Creates a transient resource: it lives in this frame only and may share memory with other transients. Its usage
  /// flags are derived from the accesses.
  [[nodiscard]] ImageRef create_image(gpu::ImageDesc desc);
  [[nodiscard]] BufferRef create_buffer(gpu::BufferDesc desc);
  /// Imports an object that is owned outside the graph, at most once per frame. `before`: its last access outside the
  /// graph (none: the contents may be discarded). `after`: the access that it is left ready for at the end of the frame
  /// (none: its last access in the graph, which must then be the same for all mips and layers if the contents are
  /// kept). Passes that write an import are never culled.
  [[nodiscard]] ImageRef import_image(std::string_view name, gpu::ImageHandle image, gpu::Access before,
                                      gpu::Access after);
  [[nodiscard]] BufferRef import_buffer(std::string_view name, gpu::BufferHandle buffer, gpu::Access before,
                                        gpu::Access after);

  [[nodiscard]] PassBuilder add_pass(std::string_view name, std::string_view module);
  /// Passes that are added from now on in this frame belong to the view of this number (PassTime::view). 0 at begin().
  void set_view(std::uint32_t view);

  /// Culls passes, places barriers and creates transient memory; a cached plan of the same structure is reused. Fails
  /// if the device cannot create the memory.
  [[nodiscard]] Status compile();
  /// Records every live pass with its label, barriers and timestamps. Call it once per frame, after a successful
  /// compile.
  /// If the function of a pass throws or fails (PassContext::fail), recording stops there, possibly inside rendering:
  /// the commands must be dropped (gpu::Device::abandon_frame).
  void execute(gpu::CommandList& commands);
  /// The error with which a pass failed in the last execute, if one did.
  [[nodiscard]] const Status& recorded() const;
  /// The name of the pass that is recorded now, or whose function stopped the last execute; otherwise empty.
  [[nodiscard]] std::string_view recording() const;

  /// Call it if the GPU does not execute the commands of the last execute().
  void give_up_frame();
  /// Call it if the commands of the frame with this gpu::Device::frame_number were dropped, because they would have
  /// left everything as it is: the frame has no times.
  void drop_times(std::uint64_t frame);

  /// The declared passes that write nothing and are not kept, so they are always culled: a mistake in their
  /// declaration.
  struct UselessPass {
    std::string_view name;
    std::string_view module;
  };
  [[nodiscard]] std::vector<UselessPass> useless_passes() const;

  /// The newest version of the resource after all passes declared so far.
  [[nodiscard]] ImageRef newest(ImageRef image) const;
  [[nodiscard]] BufferRef newest(BufferRef buffer) const;
  /// After compile: whether a pass that is not culled writes the resource, in any version.
  [[nodiscard]] bool writes(ImageRef image) const;
  [[nodiscard]] bool writes(BufferRef buffer) const;
  [[nodiscard]] const gpu::ImageDesc& desc(ImageRef image) const;
  [[nodiscard]] const gpu::BufferDesc& desc(BufferRef buffer) const;

  /// The passes of the newest completed frame in order of execution; empty until a frame has completed.
  [[nodiscard]] std::vector<PassTime> pass_times();
  /// GPU time of the newest completed frame in milliseconds, from the begin of its first pass to the end of its last
  /// pass; 0 until a frame has completed.
  [[nodiscard]] double gpu_ms() const;
  /// Every frame that has completed since the last call, oldest first; at most the last 4.
  [[nodiscard]] std::vector<GpuFrameTimes> take_times();
  /// The same for a second caller, who takes what the first one takes, too: from its first call on.
  [[nodiscard]] std::vector<GpuFrameTimes> take_times_for_profiler();
  [[nodiscard]] std::uint64_t plans_compiled() const;
  [[nodiscard]] std::uint64_t plan_hash() const;
  /// One line per pass: name, module, reads, writes, and after compile its barriers or "culled".
  [[nodiscard]] std::string describe() const;
  /// Bytes of transient memory that the current plan uses, and that it would use without memory sharing. All plans lie
  /// in the same memory, so as much is allocated as the largest plan needs. The bytes that the current plan leaves
  /// unused are accounted to "engine".
  [[nodiscard]] std::uint64_t transient_bytes() const;
  [[nodiscard]] std::uint64_t unshared_bytes() const;
  /// Shrinks transient memory to what the current plan needs; without a current plan (after begin) all is freed. What
  /// only plans need that were not used for 60 frames is freed automatically.
  void free_idle_memory();
  /// Frees all transient memory; the next compile allocates it anew. Not between compile and execute.
  void free_memory();

 private:
  friend class PassBuilder;
  friend class PassContext;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gloam
