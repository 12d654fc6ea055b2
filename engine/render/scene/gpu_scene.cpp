// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/scene/gpu_scene.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "engine/core/assert.h"
#include "engine/render/scene/caster_bounds.h"
#include "engine/render/scene/closed_surface.h"
#include "engine/render/scene/material_packing.h"
#include "engine/render/scene/mip_chain.h"
#include "engine/render/scene/smooth_shading.h"
#include "engine/scene/asset_check.h"
#include "shaders/render/shaders.h"

namespace gloam {
namespace {

constexpr std::size_t kVertexAlign = 64;

std::size_t aligned(std::size_t count) { return (count + kVertexAlign - 1) / kVertexAlign * kVertexAlign; }

template <class T>
void append(std::vector<std::byte>& stream, const std::vector<T>& values) {
  const std::size_t at = stream.size();
  const auto bytes = std::as_bytes(std::span(values));
  stream.resize(at + aligned(values.size()) * sizeof(T));
  std::copy(bytes.begin(), bytes.end(), stream.begin() + static_cast<std::ptrdiff_t>(at));
}

/// The scene's materials, and a default one at the end for primitives without a material.
std::vector<Material> materials_of(const SceneAssets& assets) {
  std::vector<Material> materials = assets.materials;
  materials.emplace_back();
  return materials;
}

}  // namespace

SurfaceVariant surface_variant(const GpuMaterial& material, const GpuPrimitive& primitive, bool flipped) {
  const gpu::CullMode one_sided = flipped ? gpu::CullMode::front : gpu::CullMode::back;
  return {material.features | (primitive.colored ? GLOAM_SURFACE_VERTEX_COLOR : 0u),
          material.double_sided ? gpu::CullMode::none : one_sided};
}

/// One packed primitive. Each is packed in its own job.
struct GpuScene::Streams {
  GpuPrimitive primitive;
  std::vector<vec3> positions;
  std::vector<PackedFrame> frames;
  std::vector<PackedSurface> surfaces;
  std::vector<std::uint32_t> indices;
  std::vector<PackedInfluence> influences;
  std::vector<float> morph_offsets;

  void pack(const Primitive& imported, std::uint32_t default_material) {
    primitive.clusters = build_clusters(imported, indices);
    Primitive source = in_fetch_order(imported, indices);
    frames = pack_frames(source);
    surfaces = pack_surfaces(source);
    influences = pack_influences(source);
    morph_offsets = pack_morph_offsets(source, primitive.morph_has_normals);
    primitive.material = source.material == kNone ? default_material : source.material;
    primitive.vertex_count = static_cast<std::uint32_t>(source.positions.size());
    primitive.index_count = static_cast<std::uint32_t>(indices.size());
    primitive.morph_targets = static_cast<std::uint32_t>(source.morph_targets.size());
    primitive.skinned = !influences.empty();
    primitive.colored = !source.colors.empty();
    primitive.closed = is_closed_surface(source.positions, indices);
    primitive.smooth_shaded = is_smooth_shaded(source.positions, source.normals, indices);
    primitive.bounds = source.bounds;
    primitive.joint_bounds = joint_bounds(source, influences);
    primitive.morph_bounds = morph_bounds(source);
    positions = std::move(source.positions);
  }
};

void GpuScene::release() {
  for (const GpuMaterial& material : materials_)
    if (material.set) device_.destroy(material.set);
  for (const gpu::ImageHandle image : images_) device_.destroy(image);
  for (const gpu::BufferHandle buffer : buffers_)
    if (buffer) device_.destroy(buffer);
  if (material_constants_) device_.destroy(material_constants_);
  materials_.clear();
  images_.clear();
  textures_.clear();
  meshes_.clear();
  buffers_ = {};
  material_constants_ = {};
  version_ = 0;
  smooth_shading_ = casters_simplified_ = false;
}

Status GpuScene::sync(const SceneAssets& assets, JobExecutor& executor) {
  const Sizes sizes = {assets.meshes.size(), assets.materials.size(), assets.textures.size(), assets.images.size()};
  if (version_ == assets.version && sizes_ == sizes) return {};
  const std::string fault = asset_fault(assets);
  GLOAM_ASSERT(fault.empty(), fault);
  release();
  Uploader uploader(device_);
  GLOAM_TRY(upload_meshes(assets, executor, uploader));
  GLOAM_TRY(upload_textures(assets, uploader));
  const std::vector<Material> materials = materials_of(assets);
  GLOAM_TRY(upload_materials(materials, uploader));
  GLOAM_TRY(uploader.flush(executor));
  GLOAM_TRY(make_material_sets(assets, materials));
  version_ = assets.version;
  sizes_ = sizes;
  return {};
}

Status GpuScene::upload_meshes(const SceneAssets& assets, JobExecutor& executor, Uploader& uploader) {
  std::vector<const Primitive*> sources;
  for (const Mesh& mesh : assets.meshes)
    for (const Primitive& primitive : mesh.primitives) sources.push_back(&primitive);
  std::vector<Streams> packed(sources.size());
  const auto default_material = static_cast<std::uint32_t>(assets.materials.size());
  executor.parallel_for(sources.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) packed[i].pack(*sources[i], default_material);
  });

  std::array<std::vector<std::byte>, 6> streams;
  std::size_t next = 0;
  for (const Mesh& mesh : assets.meshes) {
    std::vector<GpuPrimitive>& primitives = meshes_.emplace_back();
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p, ++next) {
      Streams& s = packed[next];
      s.primitive.first_vertex = static_cast<std::uint32_t>(streams[0].size() / sizeof(vec3));
      s.primitive.first_index = static_cast<std::uint32_t>(streams[3].size() / sizeof(std::uint32_t));
      s.primitive.first_influence = static_cast<std::uint32_t>(streams[4].size() / sizeof(PackedInfluence));
      s.primitive.first_morph = static_cast<std::uint32_t>(streams[5].size() / sizeof(float));
      append(streams[0], s.positions);
      append(streams[1], s.frames);
      append(streams[2], s.surfaces);
      append(streams[3], s.indices);
      append(streams[4], s.influences);
      append(streams[5], s.morph_offsets);
      smooth_shading_ = smooth_shading_ || s.primitive.smooth_shaded;
      primitives.push_back(std::move(s.primitive));
    }
  }

  static constexpr const char* kNames[] = {"positions", "frames", "surfaces", "indices", "influences", "morph_offsets"};
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (streams[i].empty()) streams[i].resize(256);
    gpu::BufferDesc desc{.name = std::string("scene.") + kNames[i], .module = "engine", .size = streams[i].size()};
    desc.usage = gpu::BufferUsage::transfer_target | gpu::BufferUsage::storage |
                 (i == 3 ? gpu::BufferUsage::index : gpu::BufferUsage::vertex);
    auto buffer = device_.create_buffer(desc);
    if (!buffer.ok()) return buffer.error();
    buffers_[i] = *buffer;
    uploader.buffer(buffers_[i], std::move(streams[i]),
                    i == 3 || i == 2 ? gpu::Access::vertex_input : gpu::Access::compute_read);
  }
  return {};
}

Status GpuScene::upload_textures(const SceneAssets& assets, Uploader& uploader) {
  std::map<std::pair<std::uint32_t, bool>, gpu::ImageHandle> uploaded;  // by image and Texture::srgb
  for (const Texture& texture : assets.textures) {
    if (texture.image == kNone) {
      GLOAM_TRY(add_white_texel(uploader));
      continue;
    }
    gpu::ImageHandle& shared = uploaded[{texture.image, texture.srgb}];
    if (shared) {
      textures_.push_back(shared);
      continue;
    }
    const Image& image = assets.images[texture.image];
    gpu::ImageDesc desc{.name = "texture." + image.name, .module = "engine"};
    desc.format = texture.srgb ? gpu::Format::rgba8_srgb : gpu::Format::rgba8_unorm;
    desc.width = image.width;
    desc.height = image.height;
    desc.mips = mip_count(image.width, image.height);
    desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
    auto made = device_.create_image(desc);
    if (!made.ok()) return made.error();
    shared = *made;
    images_.push_back(*made);
    textures_.push_back(*made);
    uploader.image(
        *made,
        [&image, srgb = texture.srgb](std::span<std::byte> chain) {
          build_mip_chain(image.rgba, image.width, image.height, srgb, chain);
        },
        gpu::Access::fragment_read);
  }
  return add_white_texel(uploader);
}

Status GpuScene::add_white_texel(Uploader& uploader) {
  gpu::ImageDesc desc{.name = "white", .module = "engine", .format = gpu::Format::rgba8_unorm};
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
  auto image = device_.create_image(desc);
  if (!image.ok()) return image.error();
  images_.push_back(*image);
  textures_.push_back(*image);
  uploader.image(*image, std::vector<std::byte>(4, std::byte{255}), gpu::Access::fragment_read);
  return {};
}

Status GpuScene::upload_materials(const std::vector<Material>& sources, Uploader& uploader) {
  std::vector<std::byte> constants;
  for (const Material& material : sources) {
    const shaders::MaterialConstants packed = pack_material(material);
    const auto bytes = std::as_bytes(std::span(&packed, 1));
    constants.insert(constants.end(), bytes.begin(), bytes.end());
    constants.resize((constants.size() + kMaterialStride - 1) / kMaterialStride * kMaterialStride);
    materials_.push_back({{},
                          surface_features(material),
                          material.alpha_mode,
                          material.double_sided,
                          material.subsurface,
                          is_emissive(material)});
  }
  gpu::BufferDesc desc{.name = "scene.materials", .module = "engine", .size = constants.size()};
  desc.usage = gpu::BufferUsage::uniform | gpu::BufferUsage::transfer_target;
  auto buffer = device_.create_buffer(desc);
  if (!buffer.ok()) return buffer.error();
  material_constants_ = *buffer;
  uploader.buffer(material_constants_, std::move(constants), gpu::Access::uniform_read);
  return {};
}

Status GpuScene::make_material_sets(const SceneAssets& assets, const std::vector<Material>& sources) {
  // All pipelines of the surface shaders have the same layout of set 1. The one chosen here is drawn with anyway, so
  // that nothing extra is compiled.
  SurfaceVariant drawn;
  for (const std::vector<GpuPrimitive>& primitives : meshes_)
    for (const GpuPrimitive& primitive : primitives)
      if (materials_[primitive.material].alpha_mode != AlphaMode::blend)
        drawn = surface_variant(materials_[primitive.material], primitive, false);
  auto like = surface_pipeline(pipelines_, geometry_surface_pass(), drawn);
  if (!like.ok()) return like.error();
  for (std::uint32_t i = 0; i < sources.size(); ++i) {
    auto set = material_set(assets, sources[i], i, *like);
    if (!set.ok()) return set.error();
    materials_[i].set = *set;
  }
  return {};
}

Result<gpu::ResourceSetHandle> GpuScene::material_set(const SceneAssets& assets, const Material& material,
                                                      std::uint32_t index, gpu::PipelineHandle like) {
  std::vector<gpu::Binding> bindings;
  bindings.push_back({0, gpu::Binding::BufferRange{material_constants_, std::uint64_t{index} * kMaterialStride,
                                                   sizeof(shaders::MaterialConstants)}});
  const TextureSlot* slots[] = {&material.base_color_texture, &material.normal_texture,
                                &material.metallic_roughness_texture, &material.occlusion_texture,
                                &material.emissive_texture};
  for (std::uint32_t s = 0; s < 5; ++s) {
    const bool used = slots[s]->texture != kNone;
    auto sampler = device_.create_sampler(used ? sampler_desc(assets.textures[slots[s]->texture]) : gpu::SamplerDesc{});
    if (!sampler.ok()) return sampler.error();
    const gpu::ImageHandle image = used ? textures_[slots[s]->texture] : textures_.back();
    bindings.push_back({s + 1, gpu::Binding::Sampled{{.image = image}, *sampler}});
  }
  return device_.create_resource_set(like, 1, bindings);
}

}  // namespace gloam
