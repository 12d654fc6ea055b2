// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/pipeline_hash.h"

#include <cstddef>
#include <span>

#include "engine/core/hash.h"

namespace gloam::gpu {
namespace {

void add(Hasher& hash, const ShaderCode& code, ShaderIdentity identity) {
  hash.value(code.words.size());
  if (identity == ShaderIdentity::address) {
    hash.value(reinterpret_cast<std::uintptr_t>(code.words.data()));
  } else {
    hash.bytes(std::as_bytes(code.words));
  }
}

// Sorted by name: the order in which a pass sets them does not count. Types and if_present do not change the pipeline.
void add(Hasher& hash, const SpecConstants& constants) {
  hash.value(constants.size());
  for (const SpecConstant& constant : constants) hash.text(constant.name).value(constant.value.bits);
}

}  // namespace

std::uint64_t description_hash(const ComputePipelineDesc& desc, ShaderIdentity identity) {
  Hasher hash;
  hash.value(1);  // a compute pipeline
  add(hash, desc.shader, identity);
  add(hash, desc.constants);
  return hash.digest();
}

std::uint64_t description_hash(const GraphicsPipelineDesc& desc, ShaderIdentity identity) {
  Hasher hash;
  hash.value(2);  // a graphics pipeline
  add(hash, desc.vertex, identity);
  add(hash, desc.fragment, identity);
  add(hash, desc.constants);
  hash.value(desc.attributes.size());
  for (const VertexAttribute& attribute : desc.attributes)
    hash.value(attribute.location).value(attribute.stream).value(attribute.format).value(attribute.offset);
  hash.value(desc.stream_strides.size());
  for (const std::uint32_t stride : desc.stream_strides) hash.value(stride);
  hash.value(desc.color_formats.size());
  for (const Format format : desc.color_formats) hash.value(format);
  hash.value(desc.depth_format).value(desc.cull).value(desc.blend).value(desc.depth_compare);
  hash.value(desc.depth_write).value(desc.depth_bias);
  return hash.digest();
}

}  // namespace gloam::gpu
