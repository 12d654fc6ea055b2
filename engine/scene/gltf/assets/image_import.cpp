// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/assets/image_import.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <map>
#include <span>
#include <system_error>
#include <utility>

#include "engine/scene/decoding/image_file.h"
#include "engine/scene/gltf/place.h"
#include "engine/scene/scene_path.h"

namespace gloam::gltf {
namespace {

// Limits for all decoded images of a scene: kFreeImageBytes, plus kImageBytesPerByte for each byte of their files, but
// at most kMaxImageBytes. A flat image of any size has hardly any bytes, so some must be free.
constexpr std::uint64_t kMaxImageBytes = std::uint64_t{8} << 30;
constexpr std::uint64_t kFreeImageBytes = std::uint64_t{1} << 30;
constexpr std::uint64_t kImageBytesPerByte = 256;

std::span<const std::uint8_t> bytes_of(const Document& document, const EncodedImage& encoded) {
  if (encoded.view == kNone) return encoded.file;
  const BufferView& view = document.views[encoded.view];
  return std::span(document.buffers[view.buffer]).subspan(view.offset, view.length);
}

std::string image_place(const Document& document, std::size_t index) {
  const ImageSource& image = document.images[index];
  return place("image", index, image.uri.empty() || image.uri.starts_with("data:") ? image.name : image.uri);
}

Error image_fault(std::string sentence) { return {ErrorKind::input, std::move(sentence)}; }

/// Opens images one by one. An image whose bytes are already open is not opened again: a file is known by its canonical
/// path, a range of a buffer by its place.
class ImageOpener {
 public:
  ImageOpener(Document& document, const std::string& directory) : document_(document), directory_(directory) {}

  Status open(std::uint32_t index) {
    ImageSource& source = document_.images[index];
    if (source.fallback) return repeat(kNone);
    if (source.view != kNone) return open_view(index, source.view);
    if (!source.bytes.empty()) return add({.file = std::move(source.bytes), .index = index});
    if (source.uri.empty()) return image_fault("it has neither a uri nor a bufferView");
    if (source.uri.starts_with("data:"))
      return image_fault("its data URI is not image/png, image/jpeg or image/webp in base64");
    return open_file(index, source.uri);
  }

  [[nodiscard]] OpenedImages& opened() { return opened_; }

 private:
  Status open_view(std::uint32_t index, std::uint32_t view_index) {
    const BufferView& view = document_.views[view_index];
    const auto [known, added] = ranges_.try_emplace({view.buffer, view.offset}, view.length, next());
    if (!added && known->second.first == view.length) return repeat(known->second.second);
    const auto touches = [](const auto& low, const auto& high) {
      return low.first.first == high.first.first && low.first.second + low.second.first > high.first.second;
    };
    const bool overlaps = !added || (known != ranges_.begin() && touches(*std::prev(known), *known)) ||
                          (std::next(known) != ranges_.end() && touches(*known, *std::next(known)));
    if (overlaps) return image_fault("its buffer view overlaps that of another image");
    return add({.view = view_index, .index = index});
  }

  Status open_file(std::uint32_t index, const std::string& uri) {
    const Result<std::string> path = resolve_scene_path(directory_, uri);
    if (!path) return path.error();
    std::error_code code;
    const std::filesystem::path canonical = std::filesystem::canonical(*path, code);
    const auto [known, added] = files_.try_emplace(code ? *path : canonical.string(), next());
    if (!added) return repeat(known->second);
    Result<std::vector<std::uint8_t>> file = read_scene_file(*path);
    if (!file) return file.error();
    return add({.file = std::move(*file), .index = index});
  }

  [[nodiscard]] std::uint32_t next() const { return static_cast<std::uint32_t>(opened_.images.size()); }

  Status repeat(std::uint32_t image) {
    opened_.by_index.push_back(image);
    return {};
  }

  Status add(EncodedImage image) {
    const std::span<const std::uint8_t> bytes = bytes_of(document_, image);
    const Result<ImageSize> size = image_size(bytes);
    if (!size) return size.error();
    image.pixels = size->pixels();
    encoded_bytes_ += bytes.size();
    decoded_bytes_ += size->pixels() * 4;
    work_ += size->work();
    const std::uint64_t most = kFreeImageBytes + kImageBytesPerByte * encoded_bytes_;
    if (decoded_bytes_ > std::min(most, kMaxImageBytes) || work_ > decoding_work_limit(encoded_bytes_))
      return image_fault("the scene's images up to here have " + std::to_string(decoded_bytes_ / 4) +
                         " pixels, more than their " + std::to_string(encoded_bytes_) + " bytes justify");
    opened_.by_index.push_back(next());
    opened_.images.push_back(std::move(image));
    return {};
  }

  Document& document_;
  const std::string& directory_;
  OpenedImages opened_;
  std::map<std::string, std::uint32_t> files_;  ///< image of each canonical path
  /// Length and image of each range, by buffer and offset.
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::pair<std::uint64_t, std::uint32_t>> ranges_;
  std::uint64_t encoded_bytes_ = 0;
  std::uint64_t decoded_bytes_ = 0;
  std::uint64_t work_ = 0;
};

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

Result<OpenedImages> open_images(Document& document, const std::string& directory) {
  ImageOpener opener(document, directory);
  for (std::uint32_t i = 0; i < document.images.size(); ++i)
    if (const Status status = opener.open(i); !status)
      return fault_at(image_place(document, i), status.error().message);
  return std::move(opener.opened());
}

Result<Image> import_image(const Document& document, const EncodedImage& encoded) {
  Result<Image> image = decode_image(bytes_of(document, encoded));
  if (!image) return fault_at(image_place(document, encoded.index), image.error().message);
  const ImageSource& source = document.images[encoded.index];
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
      document.warnings.push_back(place("texture", i, source.name) +
                                  ": it has no PNG, JPEG or WebP image, it is left out");
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
