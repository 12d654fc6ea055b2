// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/render/declare/shader_interface.h"
#include "engine/render/frame_builder.h"

namespace gloam {

namespace declare {
struct Item;
struct Recording;
struct Step;
enum class StepKind : std::uint8_t;
}  // namespace declare

/// Common part of ComputePass and DrawPass: a pass of the frame graph whose resources are bound by the names that its
/// shaders use. Access, barriers, binding numbers and descriptor kinds follow from reflection.
///
/// A binding stays in force for all later dispatches or draws of the pass until the same name is bound again; programs
/// take over what was bound for earlier ones. A null resource stands for data that this frame does not have: the shader
/// gets a placeholder with undefined content and must not use it. The binding "view" (ViewConstants) is bound by the
/// engine.
///
/// Misuse asserts, with pass, shader and binding in the sentence: a name that the shader does not declare, a used
/// binding that was left out at a dispatch or draw, a write to a read-only binding, a resource of another kind, a
/// specialisation constant that the program does not have (see gpu::SpecConstants). If a pipeline or an upload fails,
/// FrameBuilder::fail keeps the error and the pass records nothing.
///
/// Names of bindings: see gpu::ReflectedBinding::name. Declare a pass completely before the next one.
class ShaderPass {
 public:
  ShaderPass(const ShaderPass&) = delete;
  ShaderPass& operator=(const ShaderPass&) = delete;

  /// Whether the program in use declares a binding of this name.
  [[nodiscard]] bool declares(std::string_view binding) const;

  /// range: the mips and layers that the shader sees; by default all.
  void read(std::string_view binding, ImageRef image, Sampling sampling = Sampling::nearest,
            const gpu::ImageRange& range = {});
  void read(std::string_view binding, ImageRef image, gpu::SamplerHandle sampler, const gpu::ImageRange& range = {});
  void read(std::string_view binding, BufferRef buffer);
  /// A part of a buffer of the graph. offset, size: bytes; size 0: to the end.
  void read_part(std::string_view binding, BufferRef buffer, std::uint64_t offset, std::uint64_t size);
  /// Memory outside the graph: uploaded data, or a buffer that no pass of the frame writes.
  void read(std::string_view binding, const gpu::Binding::BufferRange& range);
  /// Returns the version that later passes read.
  [[nodiscard]] ImageRef write(std::string_view binding, ImageRef image, const gpu::ImageRange& range = {});
  [[nodiscard]] BufferRef write(std::string_view binding, BufferRef buffer);
  [[nodiscard]] BufferRef write_part(std::string_view binding, BufferRef buffer, std::uint64_t offset,
                                     std::uint64_t size);
  /// The same as read(), if the program in use declares the binding. For groups of bindings that many shaders share.
  template <class... Arguments>
  void read_if_declared(std::string_view binding, const Arguments&... arguments) {
    if (declares(binding)) read(binding, arguments...);
  }

  /// Uploads a value, or items, for this frame and binds the range.
  template <class T>
  void uniform(std::string_view binding, const T& value) {
    upload(binding, std::as_bytes(std::span(&value, 1)));
  }
  template <class T>
  void items(std::string_view binding, std::span<const T> values) {
    upload(binding, std::as_bytes(values));
  }
  /// Push constants of later dispatches or draws.
  template <class T>
  void push(const T& constants) {
    push_bytes(std::as_bytes(std::span(&constants, 1)));
  }
  void push_bytes(std::span<const std::byte> bytes);

  /// Records commands between the dispatches or draws declared before and after this call.
  void record(PassFunction function);
  /// Never cull: the pass has effects that the graph does not track.
  void keep() { graph_pass_.keep(); }
  /// The graph's pass, for accesses that are no bindings (copies, vertex streams).
  [[nodiscard]] PassBuilder& graph_pass() { return graph_pass_; }

 protected:
  ShaderPass(FrameBuilder& frame, std::string_view name);
  ~ShaderPass() = default;

  /// Later bindings and steps are for this program. null: the program failed, nothing is recorded.
  void use(const ShaderInterface* interface);
  [[nodiscard]] bool has_program() const { return interface_ != nullptr; }
  [[nodiscard]] const ShaderInterface& interface() const { return *interface_; }
  /// Adds a dispatch or draw with the bindings and push constants in force. Asserts that every used binding is bound.
  declare::Step& add_step(declare::StepKind kind);
  /// Later dispatches or draws use this pipeline. If it does not exist, it is compiled before the frame is recorded,
  /// together with all others that the frame needs.
  void use_pipeline(const gpu::ComputePipelineDesc& desc) { use_or_await(desc); }
  void use_pipeline(const gpu::GraphicsPipelineDesc& desc) { use_or_await(desc); }
  void forget_pipeline();
  /// Asserts that the program in use takes these constants.
  void check_constants(const gpu::SpecConstants& constants) const;
  [[nodiscard]] bool has_pipeline() const { return pipeline_ || due_pipeline_ != nullptr; }
  [[nodiscard]] FrameBuilder& frame() { return frame_; }
  [[nodiscard]] declare::Recording& recording() { return recording_; }
  [[nodiscard]] std::string sentence(std::string_view binding, std::string_view fault,
                                     std::string_view constant = {}) const;
  void fail(Error error);

 private:
  template <class Desc>
  void use_or_await(const Desc& desc);
  [[nodiscard]] const InterfaceBinding* expect(std::string_view binding, bool image, bool write);
  void set(const InterfaceBinding& slot, const declare::Item& item);
  void bind_image(const InterfaceBinding& slot, ImageRef image, gpu::SamplerHandle sampler,
                  const gpu::ImageRange& range);
  void bind_buffer(const InterfaceBinding& slot, BufferRef buffer, std::uint64_t offset, std::uint64_t size);
  void declare_read(const InterfaceBinding& slot, ImageRef image, const gpu::ImageRange& range);
  void declare_read(const InterfaceBinding& slot, BufferRef buffer);
  [[nodiscard]] gpu::Access write_access(const InterfaceBinding& slot) const;
  void upload(std::string_view binding, std::span<const std::byte> bytes);
  void bind_view_constants();

  FrameBuilder& frame_;
  PassBuilder graph_pass_;
  declare::Recording& recording_;
  const ShaderInterface* interface_ = nullptr;
  gpu::PipelineHandle pipeline_;                       ///< null: the one that is due
  const gpu::PipelineHandle* due_pipeline_ = nullptr;  ///< of DuePipelines
};

/// Binds images of the geometry buffer for nearest sampling: those of base_color_image, normal_image, material_image,
/// emissive_image, depth_image, depth_bounds, motion_image and smooth_surface_image that the program in use declares.
void read_geometry(ShaderPass& pass, const GeometryOutputs& geometry);

}  // namespace gloam
