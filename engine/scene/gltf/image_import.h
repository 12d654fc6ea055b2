// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// The encoded file of an image; its header is checked.
struct EncodedImage {
  std::vector<std::uint8_t> file;  ///< empty if the bytes are in the buffer view `view`
  std::uint32_t view = kNone;
  std::uint64_t pixels = 0;
};

/// Reads every image's file and header. Moves embedded bytes out of document.images. Input error with its place: an
/// unreadable image, or more than 8 GiB for all decoded images.
[[nodiscard]] Result<std::vector<EncodedImage>> open_images(Document& document, const std::string& directory);

/// Decodes one image. Several may be decoded at the same time. The error holds the place.
[[nodiscard]] Result<Image> import_image(const Document& document, const EncodedImage& encoded, std::size_t index);

/// Returns the textures with their sampler settings. Points each material slot to a texture of the kind that it needs,
/// colours or data; a texture that is used as both is duplicated. Clears slots whose texture has no image.
[[nodiscard]] Result<std::vector<Texture>> import_textures(Document& document);

}  // namespace gloam::gltf
