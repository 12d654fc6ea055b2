// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/drawing/textures.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <set>

#include "engine/ecs/view.h"
#include "engine/scene/decoding/image_file.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

using NamedLayers = std::pair<std::uint32_t, std::uint32_t>;

NamedLayers named_layers(const GrassSurface& surface) { return {surface.texture, surface.texture_layers}; }

Result<std::vector<BladeImage>> read_blade_layers(const std::string& path, const NamedLayers& key, std::size_t room) {
  const auto image = read_image_file(path);
  if (!image.ok()) return image.error();
  auto layers = blade_layers(*image, key.second);
  if (layers.ok() && layers->size() > room)
    return Error{ErrorKind::input, "images of blades have more than " + std::to_string(kMostBladeLayers) +
                                       " layers in all, the most that a scene may have"};
  return layers;
}

}  // namespace

Status load_blade_textures(World& world) {
  std::set<NamedLayers> used;
  world.view<const GrassSurface>().each([&](const GrassSurface& surface) {
    if (surface.texture != 0) used.insert(named_layers(surface));
  });
  BladeTextures& textures = world.ensure_resource<BladeTextures>();
  if (std::ranges::all_of(used, [&](const NamedLayers& key) { return textures.layers.contains(key); })) return {};
  textures.layers.clear();
  textures.faults.clear();
  textures.array.reset();
  ++textures.version;
  std::vector<BladeImage> all;
  Status status;
  for (const NamedLayers& key : used) {
    const std::string& path = world.resource<SceneStrings>().text(key.first);
    auto read = read_blade_layers(path, key, kMostBladeLayers - all.size());
    BladeLayers& layers = textures.layers[key];
    if (read.ok()) {
      layers = {static_cast<std::uint32_t>(all.size()), static_cast<std::uint32_t>(read->size())};
      std::ranges::move(*read, std::back_inserter(all));
      continue;
    }
    textures.faults.push_back("gloam.grass.texture: " + path + ": " + read.error().message);
    if (status.ok()) status = Error{ErrorKind::input, textures.faults.back()};
  }
  if (!all.empty()) textures.array = std::make_shared<const BladeArray>(blade_array(all));
  return status;
}

BladeLayers layers_of(const BladeTextures& textures, const GrassSurface& surface) {
  const auto found = textures.layers.find(named_layers(surface));
  return found == textures.layers.end() ? BladeLayers{} : found->second;
}

bool has_blade_textures(const World& world) {
  const BladeTextures* textures = world.try_resource<BladeTextures>();
  if (textures == nullptr || textures->array == nullptr) return false;
  bool found = false;
  world.view<const GrassSurface>().each([&](const GrassSurface& surface) {
    found = found || (surface.density > 0.0f && layers_of(*textures, surface).count > 0);
  });
  return found;
}

ImageRef add_blade_texture_upload(FrameBuilder& frame, Staging& staging) {
  if (!has_blade_textures(frame.world())) return {};
  const auto& textures = frame.world().resource<BladeTextures>();
  const std::shared_ptr<const BladeArray> array = textures.array;
  gpu::ImageDesc desc;
  desc.name = "grass_textures";
  desc.module = "grass";
  desc.format = gpu::Format::rgba8_srgb;
  desc.width = array->width;
  desc.height = array->height;
  desc.layers = array->layers;
  desc.mips = array->mips;
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
  desc.shape = gpu::ImageShape::array;
  const auto kept = frame.history_image(
      desc,
      {.scope = HistoryScope::world, .final_access = gpu::Access::fragment_read, .reset = {.key = textures.version}});
  if (!frame.check(kept)) return {};
  if (kept->filled()) return kept->image;
  const auto slice = staging.ring(frame.services().device).allocate(array->texels.size());
  if (!frame.check(slice)) return {};
  std::memcpy(slice->bytes.data(), array->texels.data(), array->texels.size());
  PassBuilder pass = frame.graph().add_pass("grass_texture_upload", frame.module());
  const ImageRef written = pass.write(kept->image, gpu::Access::transfer_write);
  pass.execute([written, source = *slice, array](PassContext& context) {
    for (std::uint32_t mip = 0; mip < array->mips; ++mip)
      context.commands().copy_buffer_to_image(source.buffer, source.offset + array->mip_offset(mip),
                                              context.image(written), mip, 0, array->layers);
  });
  return written;
}

}  // namespace gloam
