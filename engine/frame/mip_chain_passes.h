// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"

namespace gloam {

/// How the mips of an image are filled from mip 0. Both filters weigh 2×2 texels equally where a side is even or one
/// texel long. Of an odd side the box filter leaves out the last row or column, and a blit spreads its weights over all
/// texels. Each mip is rounded to the format before the next one is made.
enum class MipFilter : std::uint8_t {
  box,   ///< a compute pass a mip
  blit,  ///< a pass with one blit a layer for each mip; also for sRGB formats, in linear light
};

/// The kernel of MipFilter::box for a format; nullopt for formats without one. Its pipeline has no constants.
[[nodiscard]] std::optional<gpu::ShaderCode> mip_chain_shader(gpu::Format format);

/// Whether the device can fill mips of this format in this way: there is a kernel and sampled and storage use, or
/// blits.
[[nodiscard]] bool supports_mip_chain(const gpu::Device& device, gpu::Format format, MipFilter filter);

struct MipChain {
  std::string name;  ///< of the passes
  std::string module;
  ImageRef image;  ///< plain, array or cube, with mip 0 of all layers written; its other mips are written
  MipFilter filter = MipFilter::box;
  gpu::PipelineHandle pipeline;  ///< of MipFilter::box, made from mip_chain_shader
  gpu::SamplerHandle sampler;    ///< of MipFilter::box; any sampler, because the kernel fetches texels
};

/// Adds a pass for each mip but the first. Returns the image with all mips written; they are in the layouts of
/// different accesses, which the next pass that uses all of them joins.
[[nodiscard]] ImageRef add_mip_chain(FrameGraph& graph, const MipChain& chain);

}  // namespace gloam
