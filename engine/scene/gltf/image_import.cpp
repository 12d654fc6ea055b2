// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/image_import.h"

#include <array>
#include <span>
#include <utility>

#include "engine/scene/gltf/place.h"
#include "engine/scene/image_file.h"
#include "engine/scene/scene_path.h"

namespace gloam::gltf {
namespace {

// Limit for all decoded images of a scene.
constexpr std::uint64_t kMaxImageBytes = std::uint64_t{8} << 30;

std::span<const std::uint8_t> bytes_of(const Document& document, const EncodedImage& encoded) {
  if (encoded.view == kNone) return encoded.file;
  const BufferView& view = document.views[encoded.view];
  return std::span(document.buffers[view.buffer]).subspan(view.offset, view.length);
}

Result<EncodedImage> open_image(ImageSource& source, const std::string& directory) {
  EncodedImage encoded;
  encoded.view = source.view;
  if (source.view != kNone) return encoded;
  encoded.file = std::move(source.bytes);
  if (!encoded.file.empty()) return encoded;
  if (source.uri.empty()) return Error{ErrorKind::input, "it has neither a uri nor a bufferView"};
  if (source.uri.starts_with("data:"))
    return Error{ErrorKind::input, "its data URI is not image/png or image/jpeg in base64"};
  const Result<std::string> path = resolve_scene_path(directory, source.uri);
  if (!path) return path.error();
  Result<std::vector<std::uint8_t>> file = read_scene_file(*path);
  if (!file) return file.error();
  encoded.file = std::move(*file);
  return encoded;
}

std::string image_place(const Document& document, std::size_t index) {
  const ImageSource& image = document.images[index];
  return place("image", index, image.uri.empty() || image.uri.starts_with("data:") ? image.name : image.uri);
}

Result<WrapMode> wrap_mode(int value) {
  switch (value) {
    case 10497:
      return WrapMode::repeat;
    case 33071:
      return WrapMode::clamp_to_edge;
    case 33648:
      return WrapMode::mirrored_repeat;
    default:
      return Error{ErrorKind::input, "its wrap mode must be 10497, 33071 or 33648, is " + std::to_string(value)};
  }
}

/// Points slots to textures of colours or of data. A texture that is used as both is duplicated.
class SlotResolver {
 public:
  explicit SlotResolver(std::vector<Texture>& textures) : textures_(textures), uses_(textures.size()) {}

  void resolve(TextureSlot& slot, bool srgb) {
    if (slot.texture == kNone) return;
    Use& use = uses_[slot.texture];
    std::uint32_t& index = use.index[srgb ? 1 : 0];
    if (index == kNone) {
      const bool first = use.index[srgb ? 0 : 1] == kNone;
      index = first ? slot.texture : static_cast<std::uint32_t>(textures_.size());
      if (!first) textures_.push_back(Texture(textures_[slot.texture]));
      textures_[index].srgb = srgb;
    }
    slot.texture = index;
  }

 private:
  struct Use {
    std::array<std::uint32_t, 2> index = {kNone, kNone};  ///< texture for data, texture for colours
  };
  std::vector<Texture>& textures_;
  std::vector<Use> uses_;
};

}  // namespace

Result<std::vector<EncodedImage>> open_images(Document& document, const std::string& directory) {
  std::vector<EncodedImage> images;
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < document.images.size(); ++i) {
    Result<EncodedImage> opened = open_image(document.images[i], directory);
    if (!opened) return fault_at(image_place(document, i), opened.error().message);
    const Result<ImageSize> size = image_size(bytes_of(document, *opened));
    if (!size) return fault_at(image_place(document, i), size.error().message);
    opened->pixels = std::uint64_t{size->width} * size->height;
    total += opened->pixels * 4;
    if (total > kMaxImageBytes)
      return fault_at(image_place(document, i), "the scene's images take more than 8 GiB up to here");
    images.push_back(std::move(*opened));
  }
  return images;
}

Result<Image> import_image(const Document& document, const EncodedImage& encoded, std::size_t index) {
  Result<Image> image = decode_image(bytes_of(document, encoded));
  if (!image) return fault_at(image_place(document, index), image.error().message);
  const ImageSource& source = document.images[index];
  image->name = source.name.empty() ? source.uri : source.name;
  return image;
}

Result<std::vector<Texture>> import_textures(Document& document) {
  std::vector<Texture> textures;
  for (std::size_t i = 0; i < document.textures.size(); ++i) {
    const TextureSource& source = document.textures[i];
    Texture texture;
    texture.name = source.name;
    texture.image = source.image;
    if (source.image == kNone)
      document.warnings.push_back(place("texture", i, source.name) + ": it has no PNG or JPEG image, it is left out");
    if (source.sampler != kNone) {
      const SamplerSource& sampler = document.samplers[source.sampler];
      const Result<WrapMode> wrap_u = wrap_mode(sampler.wrap_u);
      const Result<WrapMode> wrap_v = wrap_mode(sampler.wrap_v);
      if (!wrap_u || !wrap_v)
        return fault_at(place("sampler", source.sampler), (wrap_u ? wrap_v : wrap_u).error().message);
      texture.wrap_u = *wrap_u;
      texture.wrap_v = *wrap_v;
      texture.nearest = sampler.nearest;
    }
    textures.push_back(std::move(texture));
  }
  SlotResolver resolver(textures);
  for (std::size_t i = 0; i < document.materials.size(); ++i) {
    Material& material = document.materials[i];
    TextureSlot* const slots[] = {&material.base_color_texture, &material.emissive_texture,
                                  &material.metallic_roughness_texture, &material.normal_texture,
                                  &material.occlusion_texture};
    for (TextureSlot* slot : slots) {
      if (slot->texture != kNone && textures[slot->texture].image == kNone) slot->texture = kNone;
      if (slot->uv_set > 1) {
        document.warnings.push_back(place("material", i, material.name) + ": only texCoord 0 and 1 are read, not " +
                                    std::to_string(slot->uv_set) + "; 0 is taken");
        slot->uv_set = 0;
      }
      resolver.resolve(*slot, slot == &material.base_color_texture || slot == &material.emissive_texture);
    }
  }
  return textures;
}

}  // namespace gloam::gltf
