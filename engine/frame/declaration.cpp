// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/declaration.h"

#include "engine/core/hash.h"
#include "engine/gpu/access.h"

namespace gloam::frame {

namespace {

using gpu::Access;
using gpu::AccessMask;
using gpu::mask_of;

/// The read accesses that a write access includes.
AccessMask reads_included_in(Access write, bool is_image) {
  switch (write) {
    case Access::compute_write:
      return mask_of(Access::compute_storage_read) | (is_image ? 0 : mask_of(Access::compute_read));
    case Access::fragment_write:
      return is_image ? 0 : mask_of(Access::fragment_read);
    case Access::depth_target:
      return mask_of(Access::depth_test);
    default:
      return 0;
  }
}

bool is_single_write(AccessMask mask) { return gpu::is_write(gpu::first_of(mask)); }

void hash_resource(Hasher& hasher, const DeclaredResource& resource) {
  hasher.value(resource.is_image).value(resource.imported).text(resource.name());
  if (resource.imported) {
    hasher.value(resource.before).value(resource.after);
    if (resource.is_image) hasher.value(resource.image_desc.mips).value(resource.image_desc.layers);
  } else if (resource.is_image) {
    const gpu::ImageDesc& d = resource.image_desc;
    hasher.text(d.module).value(d.format).value(d.width).value(d.height).value(d.layers).value(d.mips);
    hasher.value(d.usage).value(d.shape).value(d.depth);
  } else {
    const gpu::BufferDesc& d = resource.buffer_desc;
    hasher.text(d.module).value(d.size).value(d.usage).value(d.memory);
  }
}

}  // namespace

AccessMask combine_accesses(AccessMask have, Access more, bool is_image) {
  const AccessMask added = mask_of(more);
  if (have == 0 || (have & added) != 0) return have | added;
  const Access first = gpu::first_of(have);
  if (gpu::is_write(more)) return (have & ~reads_included_in(more, is_image)) == 0 ? added : 0;
  if (is_single_write(have)) return (added & ~reads_included_in(first, is_image)) == 0 ? have : 0;
  if (!is_image || gpu::layout_of(first) == gpu::layout_of(more)) return have | added;
  // A pass may test a depth image and also sample it in its fragments.
  constexpr AccessMask kTestAndSample = mask_of(Access::depth_test) | mask_of(Access::fragment_read);
  return ((have | added) & ~kTestAndSample) == 0 ? mask_of(Access::depth_test) : 0;
}

std::uint64_t structural_hash(const Declaration& declaration) {
  Hasher hasher;
  hasher.value(declaration.resources.size()).value(declaration.passes.size());
  for (const DeclaredResource& resource : declaration.resources.all()) hash_resource(hasher, resource);
  for (const DeclaredPass& pass : declaration.passes.all()) {
    hasher.text(pass.name).text(pass.module).value(pass.keep).value(pass.use_count);
  }
  for (const DeclaredUse& use : declaration.uses) {
    hasher.value(use.resource).value(use.accesses).value(use.reads).value(use.writes);
    if (use.range == gpu::ImageRange()) continue;
    hasher.value(use.range.first_mip).value(use.range.mip_count);
    hasher.value(use.range.first_layer).value(use.range.layer_count);
  }
  return hasher.digest();
}

}  // namespace gloam::frame
