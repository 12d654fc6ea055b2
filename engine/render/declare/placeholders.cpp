// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/placeholders.h"

namespace gloam {
namespace {

gpu::ImageDesc desc_for(const InterfaceBinding& binding) {
  const bool cube = binding.dimension == gpu::ImageDimension::cube;
  gpu::ImageDesc desc;
  desc.name = "placeholder";
  desc.module = "engine";
  desc.format = binding.texels == gpu::TexelKind::floats ? gpu::Format::rgba8_unorm : gpu::Format::r32_uint;
  desc.layers = cube ? 6 : 1;
  desc.shape = cube ? gpu::ImageShape::cube : binding.arrayed ? gpu::ImageShape::array : gpu::ImageShape::plain;
  if (binding.dimension == gpu::ImageDimension::volume) desc.shape = gpu::ImageShape::volume;
  desc.usage = binding.kind == gpu::ResourceKind::storage_image ? gpu::ImageUsage::storage : gpu::ImageUsage::sampled;
  return desc;
}

}  // namespace

Placeholders::~Placeholders() { release(); }

void Placeholders::release() {
  for (auto& [key, image] : images_)
    if (image.image) device_.destroy(image.image);
  images_.clear();
  if (buffer_) device_.destroy(buffer_);
  buffer_ = {};
}

Result<ImageRef> Placeholders::image(FrameGraph& graph, const InterfaceBinding& binding) {
  const bool storage = binding.kind == gpu::ResourceKind::storage_image;
  Image& known = images_[{binding.dimension, binding.arrayed, binding.texels, storage}];
  if (!known.image) {
    auto made = device_.create_image(desc_for(binding));
    if (!made.ok()) return made.error();
    known.image = *made;
  }
  if (!known.imported || known.imported.frame != graph.frame())
    known.imported = graph.import_image("placeholder", known.image, gpu::Access::none, gpu::Access::none);
  return known.imported;
}

Result<gpu::Binding::BufferRange> Placeholders::buffer() {
  if (!buffer_) {
    gpu::BufferDesc desc;
    desc.name = "placeholder";
    desc.module = "engine";
    desc.size = kBufferBytes;
    desc.usage = gpu::BufferUsage::uniform | gpu::BufferUsage::storage;
    auto made = device_.create_buffer(desc);
    if (!made.ok()) return made.error();
    buffer_ = *made;
  }
  return gpu::Binding::BufferRange{buffer_};
}

}  // namespace gloam
