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

/// A version of a resource in this frame's graph. Writing gives a new version; using an old one in a later pass, or a
/// handle of another frame, asserts.
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

/// What a pass sees while it records.
class PassContext {
 public:
  PassContext(FrameGraph& graph, gpu::CommandList& commands) : graph_(graph), commands_(commands) {}
  [[nodiscard]] gpu::CommandList& commands() { return commands_; }
  [[nodiscard]] gpu::ImageHandle image(ImageRef ref) const;
  [[nodiscard]] gpu::BufferHandle buffer(BufferRef ref) const;

 private:
  FrameGraph& graph_;
  gpu::CommandList& commands_;
};

using PassFunction = std::function<void(PassContext&)>;

/// Declares one pass: what it reads and writes, then what it records. Reads and writes come before the next pass is
/// added. A pass may name one resource several times where one layout and one barrier serve: several reads, or a write
/// that includes the read.
class PassBuilder {
 public:
  PassBuilder(FrameGraph& graph, std::uint32_t pass) : graph_(graph), pass_(pass) {}
  void read(ImageRef image, gpu::Access access);
  void read(BufferRef buffer, gpu::Access access);
  [[nodiscard]] ImageRef write(ImageRef image, gpu::Access access);
  [[nodiscard]] BufferRef write(BufferRef buffer, gpu::Access access);
  /// Never culled: its effect is outside the graph.
  void keep();
  void execute(PassFunction function);

 private:
  FrameGraph& graph_;
  std::uint32_t pass_;
};

/// Cost of one pass in one completed frame.
struct PassTime {
  std::string name;
  std::string module;
  double ms = 0.0;
  std::uint32_t dispatches = 0;
  std::uint32_t draws = 0;
};

/// A frame's passes as data. Declared anew every frame; the compiled plan (culled passes, barriers, shared memory) is
/// cached by a structural hash. Order of declaration is order of execution.
class FrameGraph {
 public:
  explicit FrameGraph(gpu::Device& device);
  ~FrameGraph();
  FrameGraph(const FrameGraph&) = delete;
  FrameGraph& operator=(const FrameGraph&) = delete;

  /// Forgets the last frame's declarations.
  void begin();
  /// Counts begin(): FrameRef::frame of the handles that are good now.
  [[nodiscard]] std::uint32_t frame() const;

  /// Transient: lives in this frame only and may share memory with others. Usage flags are derived from the accesses.
  [[nodiscard]] ImageRef create_image(gpu::ImageDesc desc);
  [[nodiscard]] BufferRef create_buffer(gpu::BufferDesc desc);
  /// Owned elsewhere. `before`: its last access outside the graph (none: contents may be thrown away). `after`: the
  /// access it is left ready for when the frame ends (none: whatever came last). Passes that write an import are never
  /// culled.
  [[nodiscard]] ImageRef import_image(std::string_view name, gpu::ImageHandle image, gpu::Access before,
                                      gpu::Access after);
  [[nodiscard]] BufferRef import_buffer(std::string_view name, gpu::BufferHandle buffer, gpu::Access before,
                                        gpu::Access after);

  [[nodiscard]] PassBuilder add_pass(std::string_view name, std::string_view module);

  /// Culls, places barriers and makes transient memory; a plan of the same structure is reused.
  [[nodiscard]] Status compile();
  /// Records every live pass with its label, barriers and timestamps.
  void execute(gpu::CommandList& commands);

  /// The version of the image that the passes declared so far leave.
  [[nodiscard]] ImageRef newest(ImageRef image) const;
  [[nodiscard]] const gpu::ImageDesc& desc(ImageRef image) const;
  [[nodiscard]] const gpu::BufferDesc& desc(BufferRef buffer) const;

  /// The newest completed frame's passes in order of execution; empty until one has completed.
  [[nodiscard]] std::vector<PassTime> pass_times();
  /// First begin to last end of that frame on the GPU, in milliseconds; 0 until one has completed.
  [[nodiscard]] double gpu_ms() const;
  [[nodiscard]] std::uint64_t plans_compiled() const;
  [[nodiscard]] std::uint64_t plan_hash() const;
  /// One line a pass: name, reads, writes, barriers, culled or not.
  [[nodiscard]] std::string describe() const;
  /// Bytes of transient memory in the current plan, and what it would be without sharing.
  [[nodiscard]] std::uint64_t transient_bytes() const;
  [[nodiscard]] std::uint64_t unshared_bytes() const;
  /// Gives back the transient memory of all cached plans but the current one's. Happens by itself to plans that rest
  /// for 60 frames.
  void free_idle_memory();

 private:
  friend class PassBuilder;
  friend class PassContext;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gloam
