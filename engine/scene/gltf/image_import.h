// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// An image's file, opened and its header checked, not yet decoded.
struct EncodedImage {
  std::vector<std::uint8_t> file;  ///< empty when `view` says where the bytes are
  std::uint32_t view = kNone;
  std::uint64_t pixels = 0;
};

/// Reads every image's file and header, and charges what decoding will take. Errors hold the place.
[[nodiscard]] Result<std::vector<EncodedImage>> open_images(Document& document, const std::string& directory);

/// Decodes one. Safe to call for several at once. The error holds the place.
[[nodiscard]] Result<Image> import_image(const Document& document, const EncodedImage& encoded, std::size_t index);

/// Textures with their samplers. Materials' slots are set to textures that are read as colours or as data, whichever
/// the slot needs: a texture used as both becomes two.
[[nodiscard]] Result<std::vector<Texture>> import_textures(Document& document);

}  // namespace gloam::gltf
