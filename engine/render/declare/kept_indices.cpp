// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/kept_indices.h"

#include <string>

namespace gloam {

BufferRef kept_indices(FrameBuilder& frame, const char* name, std::span<const std::uint32_t> indices) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = std::string(frame.module());
  desc.size = indices.size_bytes();
  desc.usage = gpu::BufferUsage::index | gpu::BufferUsage::transfer_target;
  const auto kept =
      frame.history_buffer(desc, {.scope = HistoryScope::world, .final_access = gpu::Access::vertex_input});
  if (!frame.check(kept)) return {};
  if (kept->filled()) return kept->buffer;
  const auto source = frame.upload_items(indices);
  PassBuilder pass = frame.graph().add_pass(name, frame.module());
  const BufferRef written = pass.write(kept->buffer, gpu::Access::transfer_write);
  pass.execute([source, written](PassContext& context) {
    context.commands().copy_buffer(source.buffer, source.offset, context.buffer(written), 0, source.size);
  });
  return written;
}

}  // namespace gloam
