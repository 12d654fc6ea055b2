// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/math/types.h"
#include "engine/render/declare/shader_pass.h"

namespace gloam {

/// A compute shader with its specialisation constants.
struct ComputeProgram {
  gpu::ShaderCode shader;
  gpu::SpecConstants constants = {};
};
/// For Module::pipelines.
[[nodiscard]] gpu::ComputePipelineDesc pipeline_desc(const ComputeProgram& program, std::string_view module);

/// A pass of compute dispatches; see ShaderPass for bindings. Dispatches run without a barrier between them unless
/// barrier() is called.
class ComputePass : public ShaderPass {
 public:
  ComputePass(FrameBuilder& frame, std::string_view name, const ComputeProgram& program);
  ComputePass(FrameBuilder& frame, std::string_view name, gpu::ShaderCode shader)
      : ComputePass(frame, name, ComputeProgram{shader}) {}

  /// Later dispatches use this program.
  void use(const ComputeProgram& program);

  /// Numbers of workgroups.
  void dispatch(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
  /// At least one thread per item: as many workgroups as the shader's workgroup size needs.
  void dispatch_over(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
  void dispatch_over(uvec2 items) { dispatch_over(items.x, items.y); }
  /// The numbers of workgroups are three 32-bit words of the buffer. offset: bytes.
  void dispatch_indirect(BufferRef arguments, std::uint64_t offset);
  /// Later dispatches (not indirect ones) are left out if *wanted is 0 when the pass is recorded, after all passes of
  /// the frame are declared. Null: they are always recorded. Until the frame has ended it must stay where it is.
  void only_if(const std::uint8_t* wanted) { wanted_ = wanted; }
  /// Later dispatches see what earlier dispatches of this pass have written.
  void barrier();

 private:
  [[nodiscard]] std::uint32_t local_size(std::size_t axis) const;
  gpu::SpecConstants constants_;  ///< of the program in use
  const std::uint8_t* wanted_ = nullptr;
};

}  // namespace gloam
