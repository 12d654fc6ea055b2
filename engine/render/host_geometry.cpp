// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/host_geometry.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "engine/gpu/device.h"

namespace gloam {
namespace {

using gpu::Format;

/// One of the host's images and the formats that it may have.
struct Checked {
  const char* name;
  gpu::ImageHandle image;
  bool required;
  std::initializer_list<Format> formats;
};

std::string size_text(const gpu::ImageDesc& desc) {
  return std::to_string(desc.width) + "x" + std::to_string(desc.height);
}

Status check_image(const gpu::Device& device, const Checked& checked, const gpu::ImageDesc& depth) {
  const auto fault = [&](const std::string& what) {
    return Error{ErrorKind::usage, "host geometry: the image of " + std::string(checked.name) + " " + what};
  };
  if (!checked.image) {
    if (checked.required) return fault("is missing");
    return {};
  }
  const gpu::ImageDesc& desc = device.desc(checked.image);
  if (std::ranges::find(checked.formats, desc.format) == checked.formats.end())
    return fault("has the format " + std::string(gpu::name_of(desc.format)) + ", which it may not have");
  if (desc.width != depth.width || desc.height != depth.height)
    return fault("has " + size_text(desc) + " pixels, depth has " + size_text(depth));
  if (desc.shape != gpu::ImageShape::plain || desc.layers != 1 || desc.mips != 1)
    return fault("is not two-dimensional with one layer and one mip");
  if (!gpu::has(desc.usage, gpu::ImageUsage::sampled)) return fault("was not made with ImageUsage::sampled");
  return {};
}

}  // namespace

Result<HostGeometry> HostGeometry::create(const gpu::Device& device, const HostGeometryDesc& desc) {
  const std::initializer_list<Format> depths = {Format::d32_float, Format::r32_float, Format::r16_float,
                                                Format::r16_unorm};
  const std::initializer_list<Format> vectors = {Format::rgba8_unorm, Format::rgb10a2_unorm, Format::rgba16_float,
                                                 Format::rgba32_float};
  const std::initializer_list<Format> pairs = {Format::rgba8_unorm,  Format::rgb10a2_unorm, Format::rgba16_float,
                                               Format::rgba32_float, Format::rg16_unorm,    Format::rg16_snorm,
                                               Format::rg16_float,   Format::rg32_float};
  const std::initializer_list<Format> colors = {Format::rgba8_unorm,  Format::rgba8_srgb,    Format::bgra8_unorm,
                                                Format::bgra8_srgb,   Format::rgb10a2_unorm, Format::rg11b10_float,
                                                Format::rgba16_float, Format::rgba32_float};
  const bool octahedral = desc.normals_kind == HostNormals::octahedral;
  if (!desc.depth) return Error{ErrorKind::usage, "host geometry: the image of depth is missing"};
  const gpu::ImageDesc& depth = device.desc(desc.depth);
  for (const Checked& checked :
       {Checked{"depth", desc.depth, true, depths},
        Checked{"normals", desc.normals, true, octahedral ? pairs : vectors},
        Checked{"face normals", desc.face_normals, false, octahedral ? pairs : vectors},
        Checked{"base colour", desc.base_color, true, colors}, Checked{"material", desc.material, true, colors},
        Checked{"emitted light", desc.emissive, false, colors}})
    GLOAM_TRY(check_image(device, checked, depth));
  if (desc.depth_kind != HostDepth::metres) {
    if (!(desc.near_m > 0.0f) || !std::isfinite(desc.near_m))
      return Error{ErrorKind::usage, "host geometry: near_m must be above 0"};
    if (!(desc.far_m == 0.0f || desc.far_m > desc.near_m) || !std::isfinite(desc.far_m))
      return Error{ErrorKind::usage, "host geometry: far_m must be 0 (infinitely far) or above near_m"};
  }
  if (desc.roughness == HostChannel::none)
    return Error{ErrorKind::usage, "host geometry: roughness needs a channel of the image of material"};
  HostGeometry geometry;
  geometry.desc_ = desc;
  geometry.width_ = depth.width;
  geometry.height_ = depth.height;
  return geometry;
}

}  // namespace gloam
