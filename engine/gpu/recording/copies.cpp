// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Copy, fill, clear and blit commands: checks them, and executes copies and fills on plain bytes.
#include <algorithm>
#include <cstring>

#include "engine/gpu/image_size.h"
#include "engine/gpu/recording/command_recorder.h"

namespace gloam::gpu::recording {

std::span<std::byte> bytes_of(Buffer& buffer) {
  if (buffer.bytes.empty()) buffer.bytes.resize(buffer.desc.size);
  return buffer.bytes;
}

Buffer* CommandRecorder::buffer_for(BufferHandle handle, BufferUsage usage, std::uint64_t offset, std::uint64_t size,
                                    std::string_view command) {
  Buffer* buffer = objects_.buffers.find(handle);
  if (buffer == nullptr) {
    fault(command, "a buffer that is not alive");
    return nullptr;
  }
  if (!has(buffer->desc.usage, usage)) {
    fault(command, "buffer '" + buffer->desc.name + "' was not made for this use");
    return nullptr;
  }
  if (offset >= buffer->desc.size || size > buffer->desc.size - offset) {
    fault(command, "out of the range of buffer '" + buffer->desc.name + "'");
    return nullptr;
  }
  return buffer;
}

Image* CommandRecorder::image_for(ImageHandle handle, ImageUsage usage, std::uint32_t mip, std::uint32_t layer_end,
                                  std::string_view command) {
  Image* image = objects_.images.find(handle);
  if (image == nullptr) {
    fault(command, "an image that is not alive");
    return nullptr;
  }
  if (!has(image->desc.usage, usage)) {
    fault(command, "image '" + image->desc.name + "' was not made for this use");
    return nullptr;
  }
  if (mip >= image->desc.mips || layer_end > image->desc.layers) {
    fault(command, "out of the mips or layers of image '" + image->desc.name + "'");
    return nullptr;
  }
  return image;
}

void CommandRecorder::copy_buffer(BufferHandle source, std::uint64_t source_offset, BufferHandle target,
                                  std::uint64_t target_offset, std::uint64_t size) {
  note("copy_buffer",
       name(source) + "+" + std::to_string(source_offset) + " > " + name(target) + "+" + std::to_string(target_offset) +
           ", " + std::to_string(size) + " bytes",
       Place::outside_rendering);
  Buffer* from = buffer_for(source, BufferUsage::transfer_source, source_offset, size, "copy_buffer");
  Buffer* to = buffer_for(target, BufferUsage::transfer_target, target_offset, size, "copy_buffer");
  if (from == nullptr || to == nullptr) return;
  if (from == to || size == 0) return fault("copy_buffer", "copies nothing, or a buffer into itself");
  tracker_.use(source, mask_of(Access::transfer_read), "copy_buffer");
  tracker_.use(target, mask_of(Access::transfer_write), "copy_buffer");
  std::memcpy(bytes_of(*to).data() + target_offset, bytes_of(*from).data() + source_offset, size);
}

void CommandRecorder::copy_buffer_to_image(BufferHandle source, std::uint64_t source_offset, ImageHandle target,
                                           std::uint32_t mip, std::uint32_t first_layer, std::uint32_t layer_count) {
  note("copy_buffer_to_image",
       name(source) + "+" + std::to_string(source_offset) + " > " + name(target) + " mip " + std::to_string(mip) +
           " layers " + std::to_string(first_layer) + "+" + std::to_string(layer_count),
       Place::outside_rendering);
  Image* image = image_for(target, ImageUsage::transfer_target, mip, first_layer + layer_count, "copy_buffer_to_image");
  if (image == nullptr) return;
  const std::uint64_t bytes = mip_bytes(image->desc, mip);
  Buffer* buffer =
      buffer_for(source, BufferUsage::transfer_source, source_offset, bytes * layer_count, "copy_buffer_to_image");
  if (buffer == nullptr) return;
  tracker_.use(source, mask_of(Access::transfer_read), "copy_buffer_to_image");
  tracker_.use(target, {mip, 1, first_layer, layer_count}, mask_of(Access::transfer_write), "copy_buffer_to_image");
  for (std::uint32_t i = 0; i < layer_count; ++i) {
    const auto texels = bytes_of(*buffer).subspan(source_offset + i * bytes, bytes);
    image->texels[{mip, first_layer + i}].assign(texels.begin(), texels.end());
  }
}

void CommandRecorder::copy_rows_to_image(BufferHandle source, std::uint64_t source_offset, ImageHandle target,
                                         std::uint32_t mip, std::uint32_t first_row, std::uint32_t row_count) {
  note("copy_rows_to_image",
       name(source) + "+" + std::to_string(source_offset) + " > " + name(target) + " mip " + std::to_string(mip) +
           " rows " + std::to_string(first_row) + "+" + std::to_string(row_count),
       Place::outside_rendering);
  Image* image = image_for(target, ImageUsage::transfer_target, mip, 1, "copy_rows_to_image");
  if (image == nullptr) return;
  const std::uint32_t height = std::max(image->desc.height >> mip, 1u);
  if (row_count == 0 || first_row >= height || row_count > height - first_row)
    return fault("copy_rows_to_image", "the rows are not in " + name(target));
  const std::uint64_t bytes = mip_bytes(image->desc, mip);
  const std::uint64_t row = bytes / height;
  Buffer* buffer =
      buffer_for(source, BufferUsage::transfer_source, source_offset, row * row_count, "copy_rows_to_image");
  if (buffer == nullptr) return;
  tracker_.use(source, mask_of(Access::transfer_read), "copy_rows_to_image");
  tracker_.use(target, {mip, 1, 0, 1}, mask_of(Access::transfer_write), "copy_rows_to_image");
  auto& texels = image->texels[{mip, 0}];
  texels.resize(bytes);
  std::ranges::copy(bytes_of(*buffer).subspan(source_offset, row * row_count),
                    texels.begin() + static_cast<std::ptrdiff_t>(row * first_row));
}

void CommandRecorder::copy_image_to_buffer(ImageHandle source, std::uint32_t mip, std::uint32_t layer,
                                           BufferHandle target, std::uint64_t target_offset) {
  note("copy_image_to_buffer",
       name(source) + " mip " + std::to_string(mip) + " layer " + std::to_string(layer) + " > " + name(target) + "+" +
           std::to_string(target_offset),
       Place::outside_rendering);
  Image* image = image_for(source, ImageUsage::transfer_source, mip, layer + 1, "copy_image_to_buffer");
  if (image == nullptr) return;
  const std::uint64_t bytes = mip_bytes(image->desc, mip);
  Buffer* buffer = buffer_for(target, BufferUsage::transfer_target, target_offset, bytes, "copy_image_to_buffer");
  if (buffer == nullptr) return;
  tracker_.use(source, {mip, 1, layer, 1}, mask_of(Access::transfer_read), "copy_image_to_buffer");
  tracker_.use(target, mask_of(Access::transfer_write), "copy_image_to_buffer");
  const auto out = bytes_of(*buffer).subspan(target_offset, bytes);
  const auto texels = image->texels.find({mip, layer});
  if (texels == image->texels.end()) {
    std::ranges::fill(out, std::byte{0});
  } else {
    std::ranges::copy(texels->second, out.begin());
  }
}

void CommandRecorder::fill_buffer(BufferHandle handle, std::uint64_t offset, std::uint64_t size, std::uint32_t word) {
  note("fill_buffer",
       name(handle) + "+" + std::to_string(offset) + ", " + std::to_string(size) + " bytes of " + std::to_string(word),
       Place::outside_rendering);
  Buffer* buffer = buffer_for(handle, BufferUsage::transfer_target, offset, size, "fill_buffer");
  if (buffer == nullptr) return;
  if (size == 0 || size % 4 != 0 || offset % 4 != 0) {
    return fault("fill_buffer", "offset and size must be multiples of 4 and size above 0");
  }
  tracker_.use(handle, mask_of(Access::transfer_write), "fill_buffer");
  for (std::uint64_t at = offset; at < offset + size; at += sizeof word) {
    std::memcpy(bytes_of(*buffer).data() + at, &word, sizeof word);
  }
}

void CommandRecorder::clear_color_image(ImageHandle handle, std::array<std::uint32_t, 4> bits, ImageRange range) {
  std::string text = name(handle) + gpu::text_of(range);
  for (std::uint32_t word : bits) text += " " + std::to_string(word);
  note("clear_color_image", std::move(text), Place::outside_rendering);
  const std::uint32_t last_mip = range.first_mip + std::max(range.mip_count, 1u) - 1;
  const std::uint32_t layer_end = range.first_layer + std::max(range.layer_count, 1u);
  Image* image = image_for(handle, ImageUsage::transfer_target, last_mip, layer_end, "clear_color_image");
  if (image == nullptr) return;
  if (is_depth(image->desc.format)) fault("clear_color_image", name(handle) + " is a depth image");
  tracker_.use(handle, range, mask_of(Access::transfer_write), "clear_color_image");
  const ImageRange cleared = resolve(range, image->desc);
  std::erase_if(image->texels, [&](const auto& item) {
    return overlap(cleared, {item.first.first, 1, item.first.second, 1});
  });
}

void CommandRecorder::blit(ImageHandle source, ImageHandle target, ImagePart from, ImagePart to) {
  const auto text_of_part = [](const ImagePart& part) {
    return part.mip == 0 && part.layer == 0
               ? std::string()
               : " mip " + std::to_string(part.mip) + " layer " + std::to_string(part.layer);
  };
  note("blit", name(source) + text_of_part(from) + " > " + name(target) + text_of_part(to), Place::outside_rendering);
  if (image_for(source, ImageUsage::transfer_source, from.mip, from.layer + 1, "blit") == nullptr) return;
  Image* image = image_for(target, ImageUsage::transfer_target, to.mip, to.layer + 1, "blit");
  if (image == nullptr) return;
  tracker_.use(source, {from.mip, 1, from.layer, 1}, mask_of(Access::transfer_read), "blit");
  tracker_.use(target, {to.mip, 1, to.layer, 1}, mask_of(Access::transfer_write), "blit");
  image->texels.erase({to.mip, to.layer});
}

}  // namespace gloam::gpu::recording
