// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/render/declare/due_pipelines.h"
#include "engine/render/declare/placeholders.h"
#include "engine/render/declare/shader_interface.h"
#include "engine/render/draws/draw_lists.h"
#include "engine/render/scene/draw_pipelines.h"

/// Declared passes as data, from declaration until they are recorded.
namespace gloam::declare {

/// A resource bound by name.
struct Item {
  enum class Kind : std::uint8_t { sampled, storage, buffer, range };
  std::uint64_t key = 0;
  Kind kind = Kind::range;
  bool written = false;
  ImageRef image;
  gpu::ImageRange part;  ///< of the image
  BufferRef buffer;
  gpu::SamplerHandle sampler;
  gpu::Binding::BufferRange range;  ///< kind buffer: offset and size only
};

/// An item at the binding number of one program.
struct BoundItem {
  std::uint32_t binding = 0;
  std::uint32_t item = 0;  ///< index into Recording::items
};

enum class StepKind : std::uint8_t {
  dispatch,
  dispatch_indirect,
  draw,
  draw_indirect,
  draw_indexed_indirect,
  surfaces,
  barrier,
  custom
};

struct Step {
  StepKind kind = StepKind::custom;
  gpu::PipelineHandle pipeline;              ///< null: *due
  const gpu::PipelineHandle* due = nullptr;  ///< of DuePipelines
  std::uint32_t first_bound = 0;
  std::uint32_t bound_count = 0;
  std::uint32_t first_push = 0;  ///< bytes
  std::uint32_t push_bytes = 0;
  std::uint32_t counts[3] = {0, 0, 0};   ///< workgroups; or vertices, instances
  const std::uint8_t* wanted = nullptr;  ///< of a dispatch: it is left out if this is 0 when the pass is recorded
  BufferRef arguments;                   ///< of indirect steps
  std::uint64_t offset = 0;              ///< bytes into `arguments`
  BufferRef indices;                     ///< of indexed draws; counts[0]: number of draws
  std::size_t function = 0;              ///< index into Recording::functions
  std::span<const Draw> draws;
  std::size_t surface_pass = 0;  ///< index into Recording::surface_passes
};

struct Target {
  ImageRef image;
  gpu::LoadOp load = gpu::LoadOp::discard;
  std::uint32_t mip = 0;
  std::uint32_t layer = 0;
};

/// Everything that a pass records. Memory is reused from frame to frame.
struct Recording {
  std::string name;
  std::vector<Item> items;
  std::vector<std::uint32_t> in_force;  ///< indices of the items bound last under their names
  std::vector<BoundItem> bound;
  std::vector<std::byte> pushes;
  std::uint32_t first_push = 0;
  std::uint32_t push_bytes = 0;
  std::vector<Step> steps;
  std::vector<PassFunction> functions;
  std::vector<SurfacePass> surface_passes;
  std::vector<Target> colors;  ///< draw passes only, as the members below
  Target depth;
  bool depth_read_only = false;
  bool failed = false;

  void clear(std::string_view new_name);
  /// Gives back memory that the pass does not need. What it records stays.
  void shrink();
};

/// Recordings of the current frame.
class Recordings {
 public:
  /// Call it after the graph has dropped the pass functions of the last frame.
  void begin_frame() { used_ = 0; }
  [[nodiscard]] Recording& next(std::string_view name);
  /// Between frames: gives back memory that the last frame did not need.
  void free_idle_memory();

 private:
  std::vector<std::unique_ptr<Recording>> all_;
  std::size_t used_ = 0;
};

/// Objects of passes declared by name that live longer than a frame. Belongs to a renderer.
struct State {
  explicit State(gpu::Device& device) : placeholders(device) {}
  ShaderInterfaces interfaces;
  Placeholders placeholders;
  Recordings recordings;
  DuePipelines due_pipelines;
};

/// The bindings of a step. The span is valid until the next call with the same storage.
[[nodiscard]] std::span<const gpu::Binding> bindings_of(const Recording& recording, const Step& step,
                                                        const PassContext& context, std::vector<gpu::Binding>& storage);
/// Binds pipeline, resources and push constants of a step.
void begin_step(const Recording& recording, const Step& step, PassContext& context, std::vector<gpu::Binding>& storage);

}  // namespace gloam::declare
