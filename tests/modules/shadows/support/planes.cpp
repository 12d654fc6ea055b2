// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/modules/shadows/support/planes.h"

#include <algorithm>
#include <cmath>

#include "engine/frame/transfers/upload.h"
#include "modules/shadows/atlas/mip_places.h"
#include "shaders/shadows/shaders.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {
namespace {

using gpu::Access;
using shaders::ShadowPlaneGroup;

constexpr std::uint32_t kBlockTexels = GLOAM_SHADOW_PLANE_BLOCK;
constexpr std::uint32_t kLastBlockTexels = kBlockTexels << (GLOAM_SHADOW_PLANE_LEVELS - 1);

// The layout of both images. Nothing else in the tests of planes depends on it.
uvec2 depth_image_size(std::uint32_t atlas) { return size_with_mips(atlas); }
uvec2 plane_image_size(std::uint32_t atlas) { return size_with_mips(atlas / kBlockTexels); }
uvec2 plane_texel(std::uint32_t atlas, const PlaneFace& face, std::uint32_t level, uvec2 block) {
  return mip_corner(atlas / kBlockTexels, level) + face.origin / (kBlockTexels << level) + block;
}

/// Appends the workgroups that make these parts. block: texels per side of the area that one thread processes.
GroupRange add_parts(std::vector<ShadowPlaneGroup>& groups, const std::vector<PlanePart>& parts, std::uint32_t block) {
  const auto first = static_cast<std::uint32_t>(groups.size());
  for (const PlanePart& part : parts)
    add_groups(part.begin / block, (part.end + block - 1u) / block, GLOAM_SHADOW_PLANE_GROUP,
               [&](uvec2 begin, uvec2 end) {
                 groups.push_back({part.face->origin, begin, end, part.face->size});
               });
  return {first, static_cast<std::uint32_t>(groups.size()) - first};
}

}  // namespace

std::size_t MadePlanes::index(const PlaneFace& face, std::uint32_t level, uvec2 block) const {
  const uvec2 at = plane_texel(atlas_size, face, level, block);
  return std::size_t{at.y} * plane_image_size(atlas_size).x + at.x;
}

PlaneImages::PlaneImages(gpu::Device& device, std::uint32_t atlas_size, gpu::Format format)
    : device_(device), atlas_size_(atlas_size) {
  using enum gpu::ImageUsage;
  depths_ = image(format, depth_image_size(atlas_size), sampled | transfer_target);
  planes_ = image(gpu::Format::rgba32_float, plane_image_size(atlas_size), storage | transfer_source | transfer_target);
  gpu::SamplerDesc nearest;
  nearest.address_u = nearest.address_v = gpu::AddressMode::clamp_to_edge;
  nearest.min_filter = nearest.mag_filter = nearest.mip_filter = gpu::Filter::nearest;
  sampler_ = value_of(device.create_sampler(nearest));
  pipeline_ = value_of(
      device.create_pipeline(gpu::ComputePipelineDesc{"shadow_planes", "test", shaders::shadows::planes_comp, {}}));
  run_frame(device_, [&](gpu::CommandList& commands) {
    constexpr std::uint32_t kBits = Kernel::kUntouched;
    turn(commands, Access::none, Access::transfer_write);
    commands.clear_color_image(planes_, {kBits, kBits, kBits, kBits});
    turn(commands, Access::transfer_write, Access::compute_write);
  });
}

PlaneImages::~PlaneImages() {
  static_cast<void>(device_.wait_idle());
  device_.destroy(depths_);
  device_.destroy(planes_);
  device_.destroy(pipeline_);
}

void PlaneImages::draw(const std::vector<PlaneFace>& faces) {
  const uvec2 size = depth_image_size(atlas_size_);
  std::vector<float> depths(std::size_t{size.x} * size.y, 1.0f);
  for (const PlaneFace& face : faces)
    for (std::uint32_t row = 0; row < face.size; ++row)
      std::copy_n(&face.depths[std::size_t{row} * face.size], face.size,
                  &depths[std::size_t{face.origin.y + row} * size.x + face.origin.x]);
  if (device_.desc(depths_).format == gpu::Format::r32_float) {
    upload(std::as_bytes(std::span(depths)));
    return;
  }
  std::vector<std::uint16_t> steps;
  steps.reserve(depths.size());
  for (const float depth : depths) steps.push_back(static_cast<std::uint16_t>(std::lround(depth * 65535.0f)));
  upload(std::as_bytes(std::span(steps)));
}

void PlaneImages::make(const std::vector<PlanePart>& parts) {
  std::vector<ShadowPlaneGroup> groups;
  const GroupRange finest = add_parts(groups, parts, kBlockTexels);
  const GroupRange coarser = add_parts(groups, parts, kLastBlockTexels);
  const gpu::BufferHandle buffer = make_upload(device_, groups);
  run_frame(device_, [&](gpu::CommandList& commands) {
    turn(commands, Access::compute_write, Access::compute_write);
    commands.bind_pipeline(pipeline_);
    commands.bind(std::vector<gpu::Binding>{{0, gpu::Binding::Sampled{{.image = depths_}, sampler_}},
                                            {1, gpu::Binding::Storage{{.image = planes_}}},
                                            {2, gpu::Binding::BufferRange{buffer}}});
    dispatch_groups(commands, shaders::ShadowPlaneConstants{0, atlas_size_, 0}, finest);
    turn(commands, Access::compute_write, Access::compute_write);
    dispatch_groups(commands, shaders::ShadowPlaneConstants{1, atlas_size_, 0}, coarser);
  });
  device_.destroy(buffer);
}

void PlaneImages::make(const std::vector<PlaneFace>& faces) {
  std::vector<PlanePart> parts;
  for (const PlaneFace& face : faces) parts.push_back({&face, uvec2(0), uvec2(face.size)});
  make(parts);
}

MadePlanes PlaneImages::read() const {
  const uvec2 size = plane_image_size(atlas_size_);
  const gpu::BufferHandle buffer = make_readback(device_, std::uint64_t{size.x} * size.y * sizeof(vec4));
  run_frame(device_, [&](gpu::CommandList& commands) {
    turn(commands, Access::compute_write, Access::transfer_read);
    commands.copy_image_to_buffer(planes_, 0, 0, buffer, 0);
    turn(commands, Access::transfer_read, Access::compute_write);
    const gpu::BufferBarrier ready{.buffer = buffer, .before = Access::transfer_write, .after = Access::host_read};
    commands.barrier({&ready, 1}, {});
  });
  MadePlanes made{atlas_size_, items_of<vec4>(device_, buffer)};
  made.texels.resize(std::size_t{size.x} * size.y);
  device_.destroy(buffer);
  return made;
}

gpu::ImageHandle PlaneImages::image(gpu::Format format, uvec2 size, gpu::ImageUsage usage) {
  gpu::ImageDesc desc{.name = "test planes", .module = "test", .format = format, .width = size.x, .height = size.y};
  desc.usage = usage;
  return value_of(device_.create_image(desc));
}

void PlaneImages::upload(std::span<const std::byte> texels) {
  Uploader uploader(device_);
  uploader.image(depths_, {texels.begin(), texels.end()}, Access::compute_read);
  const Status uploaded = uploader.flush();
  EXPECT_TRUE(uploaded.ok()) << (uploaded.ok() ? "" : uploaded.error().message);
}

void PlaneImages::turn(gpu::CommandList& commands, Access before, Access after) const {
  const gpu::ImageBarrier barrier{.image = planes_, .before = before, .after = after};
  commands.barrier({}, {&barrier, 1});
}

}  // namespace gloam::test
