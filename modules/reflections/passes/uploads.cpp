// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/uploads.h"

#include <cstddef>
#include <cstring>
#include <string>

namespace gloam {

ImageRef upload_captures(FrameBuilder& frame, Staging& staging, const char* name, const CapturedLayers& layers,
                         std::uint64_t version, bool* uploaded) {
  if (layers.count == 0) return {};
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = "reflections";
  desc.format = gpu::Format::rgba16_float;
  desc.width = desc.height = layers.side;
  desc.layers = layers.count;
  desc.mips = layers.mips;
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
  desc.shape = gpu::ImageShape::array;
  const auto kept = frame.history_image(
      desc, {.scope = HistoryScope::world, .final_access = gpu::Access::fragment_read, .reset = {.key = version}});
  if (!frame.check(kept)) return {};
  if (kept->filled()) return kept->image;
  if (uploaded != nullptr) *uploaded = true;
  const auto slice = staging.ring(frame.services().device).allocate(layers.texels.size() * sizeof(std::uint16_t));
  if (!frame.check(slice)) return {};
  std::memcpy(slice->bytes.data(), layers.texels.data(), slice->bytes.size());
  PassBuilder pass = frame.graph().add_pass(std::string(name) + "_upload", frame.module());
  const ImageRef written = pass.write(kept->image, gpu::Access::transfer_write);
  pass.execute([written, source = *slice, &layers](PassContext& context) {
    for (std::uint32_t layer = 0; layer < layers.count; ++layer)
      for (std::uint32_t mip = 0; mip < layers.mips; ++mip) {
        const std::size_t halves = layer * layers.layer_halves() + layers.mip_offset(mip);
        context.commands().copy_buffer_to_image(source.buffer, source.offset + halves * sizeof(std::uint16_t),
                                                context.image(written), mip, layer, 1);
      }
  });
  return written;
}

ImageRef upload_traced(FrameBuilder& frame, Staging& staging, const char* name, const TracedPixels& traced) {
  const auto slice = staging.ring(frame.services().device).allocate(traced.radiance.size() * sizeof(float));
  if (!frame.check(slice)) return {};
  std::memcpy(slice->bytes.data(), traced.radiance.data(), slice->bytes.size());
  PassBuilder pass = frame.graph().add_pass(std::string(name) + "_upload", frame.module());
  const ImageRef written =
      pass.write(create_view_image(frame, name, gpu::Format::rgba32_float), gpu::Access::transfer_write);
  pass.execute([written, source = *slice](PassContext& context) {
    context.commands().copy_buffer_to_image(source.buffer, source.offset, context.image(written), 0, 0, 1);
  });
  return written;
}

}  // namespace gloam
