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
  std::uint32_t index = 0;  ///< in Document::images; the first of several with the same bytes
  std::uint64_t pixels = 0;
};

/// Images of a document, each file and each range of a buffer once.
struct OpenedImages {
  std::vector<EncodedImage> images;
  std::vector<std::uint32_t> by_index;  ///< index into `images`, by index in Document::images; kNone: a fallback
};

/// Reads every image's file and header. Moves embedded bytes out of document.images. Input error with its place: an
/// unreadable image, images in overlapping ranges of a buffer, or more decoded bytes or decoding work than the files
/// justify.
[[nodiscard]] Result<OpenedImages> open_images(Document& document, const std::string& directory);

/// Decodes one image. Several may be decoded at the same time. The error holds the place.
[[nodiscard]] Result<Image> import_image(const Document& document, const EncodedImage& encoded);

/// Returns the textures with their sampler settings; their images index Document::images. Points each material slot to
/// a texture of the kind that it needs, colours or data; a texture that is used as both is duplicated. Clears slots
/// whose texture has no image.
[[nodiscard]] Result<std::vector<Texture>> import_textures(Document& document);

}  // namespace gloam::gltf
