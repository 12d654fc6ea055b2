// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/images.h"

#include "engine/gpu/image_size.h"
#include "modules/shadows/atlas/mip_places.h"
#include "shaders/shadows/maps/planes_shared.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {
namespace {

gpu::ImageDesc map_image(const char* name, gpu::Format format, std::uint32_t side) {
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = "shadows";
  desc.format = format;
  desc.width = size_with_mips(side).x;
  desc.height = size_with_mips(side).y;
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::storage | gpu::ImageUsage::transfer_source;
  return desc;
}

gpu::ImageDesc desc_of(MapImage image, const ShadowKnobs& knobs) {
  const std::uint32_t side = knobs.atlas_size;
  gpu::ImageDesc desc;
  switch (image) {
    case MapImage::atlas:
      desc = map_image("shadow_atlas", knobs.d16 ? gpu::Format::r16_unorm : gpu::Format::r32_float, side);
      break;
    case MapImage::pyramid:
      desc = map_image("shadow_pyramid", gpu::Format::r32_float, side >> GLOAM_SHADOW_PYRAMID_MIP);
      desc.height *= 2;  // nearest depths above farthest ones
      break;
    case MapImage::planes:
      desc = map_image("shadow_planes", gpu::Format::rgba32_float, side / GLOAM_SHADOW_PLANE_BLOCK);
      break;
    case MapImage::backgrounds:
      desc = map_image("shadow_backgrounds", gpu::Format::r32_float, side);
      desc.width = side;
      desc.shape = gpu::ImageShape::array;  // like the scratch image, which is bound in place of a missing one
      break;
  }
  return desc;
}

}  // namespace

std::uint64_t map_image_bytes(const ShadowKnobs& knobs, bool backgrounds) {
  std::uint64_t bytes = 0;
  for (const MapImage image : {MapImage::atlas, MapImage::pyramid, MapImage::planes, MapImage::backgrounds})
    if (image != MapImage::backgrounds || backgrounds) bytes += gpu::image_bytes(desc_of(image, knobs));
  return bytes;
}

std::uint64_t turn_instance(const ShadowKnobs& knobs) {
  // Above all owners of atlases, which are numbers of views.
  return std::uint64_t{1} << 32 | std::uint64_t{knobs.atlas_size} << 1 | (knobs.d16 ? 1 : 0);
}

HistoryImage use_map_image(FrameBuilder& frame, const ViewFaces& view_faces, const ShadowKnobs& knobs, bool takes_turns,
                           MapImage image) {
  HistoryUse use;
  use.final_access = image == MapImage::backgrounds ? gpu::Access::compute_read : gpu::Access::fragment_read;
  if (view_faces.shared != nullptr) {
    use.scope = HistoryScope::shared;
    use.instance = view_faces.owner.value;
  }
  if (takes_turns) {
    use.scope = HistoryScope::shared;
    use.instance = turn_instance(knobs);
  }
  const auto used = frame.history_image(desc_of(image, knobs), use);
  return frame.check(used) ? *used : HistoryImage{};
}

}  // namespace gloam
