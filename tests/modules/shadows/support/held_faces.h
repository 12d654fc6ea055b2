// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "engine/render/renderer.h"
#include "modules/shadows/atlas/mip_places.h"
#include "modules/shadows/atlas/view_faces.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {

/// All mips of one face in the atlas, then all of its pyramid.
using FaceTexels = std::vector<std::byte>;

inline void append_texels(FaceTexels& texels, std::span<const std::byte> image, std::uint32_t size, std::uint32_t level,
                          std::uint32_t mip, const AtlasSquare& square) {
  const std::size_t width = size * 3 / 2, texel = image.size() / (width * size);
  const uvec2 corner = mip_corner(size, level) + (square.origin >> mip);
  const std::uint32_t side = square.size >> mip;
  for (std::uint32_t y = 0; y < side; ++y) {
    const auto row = image.subspan(((corner.y + y) * width + corner.x) * texel, side * texel);
    texels.insert(texels.end(), row.begin(), row.end());
  }
}

/// The contents of the first view's faces, in the order of its ViewFaces. Draws the view once more.
[[nodiscard]] inline std::vector<FaceTexels> held_faces(Renderer& renderer, World& world) {
  constexpr std::string_view kNames[] = {"shadow_atlas", "shadow_pyramid"};
  const std::vector<ImageBytes> images = value_of(renderer.read_images(world, ViewId{0}, kNames));
  const std::uint32_t size = world.view_resource<ViewFaces>(ViewId{0}).atlas.size();
  std::vector<FaceTexels> faces;
  for (const ShadowFace& face : world.view_resource<ViewFaces>(ViewId{0}).faces) {
    FaceTexels& texels = faces.emplace_back();
    for (std::uint32_t mip = 0; face.square.size >> mip != 0; ++mip) {
      append_texels(texels, images[0].bytes, size, mip, mip, face.square);
      if (mip < GLOAM_SHADOW_PYRAMID_MIP) continue;
      const std::span pyramid(images[1].bytes);
      for (const auto half : {pyramid.first(pyramid.size() / 2), pyramid.subspan(pyramid.size() / 2)})
        append_texels(texels, half, size / 4, mip - GLOAM_SHADOW_PYRAMID_MIP, mip, face.square);
    }
  }
  return faces;
}

}  // namespace gloam::test
