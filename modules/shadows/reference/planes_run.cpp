// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference/planes_run.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/frame/transfers/upload.h"
#include "modules/shadows/atlas/mip_places.h"
#include "modules/shadows/maps/work_groups.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kLastBlockTexels = kPlaneBlock << (GLOAM_SHADOW_PLANE_LEVELS - 1);
constexpr const char* kPlanesOwner = "kernel_check";

// The layout of both images. Nothing else in the checks of planes depends on it.
uvec2 depth_image_size(std::uint32_t atlas) { return size_with_mips(atlas); }
uvec2 plane_image_size(std::uint32_t atlas) { return size_with_mips(atlas / kPlaneBlock); }
uvec2 plane_texel(std::uint32_t atlas, const PlaneFace& face, std::uint32_t level, uvec2 block) {
  return mip_corner(atlas / kPlaneBlock, level) + face.origin / (kPlaneBlock << level) + block;
}

/// Appends the workgroups that make these parts. block: texels per side of the area that one thread processes.
GroupRange add_parts(std::vector<shaders::ShadowPlaneGroup>& groups, const std::vector<PlanePart>& parts,
                     std::uint32_t block) {
  const auto first = static_cast<std::uint32_t>(groups.size());
  for (const PlanePart& part : parts)
    add_groups(part.begin / block, (part.end + block - 1u) / block, GLOAM_SHADOW_PLANE_GROUP,
               [&](uvec2 begin, uvec2 end) {
                 groups.push_back({part.face->origin, begin, end, part.face->size});
               });
  return {first, static_cast<std::uint32_t>(groups.size()) - first};
}

Result<gpu::ImageHandle> plane_image(gpu::Device& device, gpu::Format format, uvec2 size, gpu::ImageUsage usage) {
  gpu::ImageDesc desc{
      .name = "kernel_check", .module = kPlanesOwner, .format = format, .width = size.x, .height = size.y};
  desc.usage = usage;
  return device.create_image(desc);
}

Result<gpu::BufferHandle> plane_buffer(gpu::Device& device, std::uint64_t bytes, gpu::BufferUsage usage,
                                       gpu::MemoryKind memory) {
  return device.create_buffer(
      {.name = "kernel_check", .module = kPlanesOwner, .size = bytes, .usage = usage, .memory = memory});
}

}  // namespace

std::size_t MadePlanes::index(const PlaneFace& face, std::uint32_t level, uvec2 block) const {
  const uvec2 at = plane_texel(atlas_size, face, level, block);
  return std::size_t{at.y} * plane_image_size(atlas_size).x + at.x;
}

PlaneRun::~PlaneRun() {
  static_cast<void>(device_.wait_idle());
  if (depths_) device_.destroy(depths_);
  if (planes_) device_.destroy(planes_);
  if (pipeline_) device_.destroy(pipeline_);
}

Status PlaneRun::start(std::uint32_t atlas_size, gpu::Format format) {
  using enum gpu::ImageUsage;
  atlas_size_ = atlas_size;
  const auto depths = plane_image(device_, format, depth_image_size(atlas_size), sampled | transfer_target);
  if (!depths) return depths.error();
  depths_ = *depths;
  const auto planes = plane_image(device_, gpu::Format::rgba32_float, plane_image_size(atlas_size),
                                  storage | transfer_source | transfer_target);
  if (!planes) return planes.error();
  planes_ = *planes;
  gpu::SamplerDesc nearest;
  nearest.address_u = nearest.address_v = gpu::AddressMode::clamp_to_edge;
  nearest.min_filter = nearest.mag_filter = nearest.mip_filter = gpu::Filter::nearest;
  const auto sampler = device_.create_sampler(nearest);
  if (!sampler) return sampler.error();
  sampler_ = *sampler;
  const auto pipeline = device_.create_pipeline(
      gpu::ComputePipelineDesc{"shadow_planes", kPlanesOwner, lab_.current(shaders::shadows::planes_comp), {}});
  if (!pipeline) return pipeline.error();
  pipeline_ = *pipeline;
  const auto commands = device_.begin_frame();
  if (!commands) return commands.error();
  constexpr std::uint32_t kBits = KernelRun::kUntouched;
  turn(**commands, gpu::Access::none, gpu::Access::transfer_write);
  (*commands)->clear_color_image(planes_, {kBits, kBits, kBits, kBits});
  turn(**commands, gpu::Access::transfer_write, gpu::Access::compute_write);
  return submit();
}

Status PlaneRun::draw(const std::vector<PlaneFace>& faces) {
  const uvec2 size = depth_image_size(atlas_size_);
  std::vector<float> depths(std::size_t{size.x} * size.y, 1.0f);
  for (const PlaneFace& face : faces)
    for (std::uint32_t row = 0; row < face.size; ++row)
      std::copy_n(&face.depths[std::size_t{row} * face.size], face.size,
                  &depths[std::size_t{face.origin.y + row} * size.x + face.origin.x]);
  if (device_.desc(depths_).format == gpu::Format::r32_float) return upload(std::as_bytes(std::span(depths)));
  std::vector<std::uint16_t> steps;
  steps.reserve(depths.size());
  for (const float depth : depths) steps.push_back(static_cast<std::uint16_t>(std::lround(depth * 65535.0f)));
  return upload(std::as_bytes(std::span(steps)));
}

Status PlaneRun::make(const std::vector<PlanePart>& parts) {
  std::vector<shaders::ShadowPlaneGroup> groups;
  const GroupRange finest = add_parts(groups, parts, kPlaneBlock);
  const GroupRange coarser = add_parts(groups, parts, kLastBlockTexels);
  const auto buffer = plane_buffer(device_, groups.size() * sizeof(shaders::ShadowPlaneGroup),
                                   gpu::BufferUsage::storage, gpu::MemoryKind::upload);
  if (!buffer) return buffer.error();
  std::memcpy(device_.mapped(*buffer).data(), groups.data(), groups.size() * sizeof(shaders::ShadowPlaneGroup));
  const auto begun = device_.begin_frame();
  if (!begun) return begun.error();
  gpu::CommandList& commands = **begun;
  turn(commands, gpu::Access::compute_write, gpu::Access::compute_write);
  commands.bind_pipeline(pipeline_);
  commands.bind(std::vector<gpu::Binding>{{0, gpu::Binding::Sampled{{.image = depths_}, sampler_}},
                                          {1, gpu::Binding::Storage{{.image = planes_}}},
                                          {2, gpu::Binding::BufferRange{*buffer}}});
  dispatch_groups(commands, shaders::ShadowPlaneConstants{0, atlas_size_, 0}, finest);
  turn(commands, gpu::Access::compute_write, gpu::Access::compute_write);
  dispatch_groups(commands, shaders::ShadowPlaneConstants{1, atlas_size_, 0}, coarser);
  const Status submitted = submit();
  device_.destroy(*buffer);
  return submitted;
}

Status PlaneRun::make(const std::vector<PlaneFace>& faces) {
  std::vector<PlanePart> parts;
  for (const PlaneFace& face : faces) parts.push_back({&face, uvec2(0), uvec2(face.size)});
  return make(parts);
}

Result<MadePlanes> PlaneRun::read() {
  const uvec2 size = plane_image_size(atlas_size_);
  const auto buffer = plane_buffer(device_, std::uint64_t{size.x} * size.y * sizeof(vec4),
                                   gpu::BufferUsage::transfer_target, gpu::MemoryKind::readback);
  if (!buffer) return buffer.error();
  const auto commands = device_.begin_frame();
  if (!commands) return commands.error();
  turn(**commands, gpu::Access::compute_write, gpu::Access::transfer_read);
  (*commands)->copy_image_to_buffer(planes_, 0, 0, *buffer, 0);
  turn(**commands, gpu::Access::transfer_read, gpu::Access::compute_write);
  const gpu::BufferBarrier ready{
      .buffer = *buffer, .before = gpu::Access::transfer_write, .after = gpu::Access::host_read};
  (*commands)->barrier({&ready, 1}, {});
  GLOAM_TRY(submit());
  MadePlanes made{atlas_size_, std::vector<vec4>(std::size_t{size.x} * size.y)};
  std::memcpy(made.texels.data(), device_.mapped(*buffer).data(), made.texels.size() * sizeof(vec4));
  device_.destroy(*buffer);
  return made;
}

Status PlaneRun::upload(std::span<const std::byte> texels) {
  Uploader uploader(device_);
  uploader.image(depths_, {texels.begin(), texels.end()}, gpu::Access::compute_read);
  return uploader.flush();
}

Status PlaneRun::submit() {
  GLOAM_TRY(device_.submit_frame());
  return device_.wait_idle();
}

void PlaneRun::turn(gpu::CommandList& commands, gpu::Access before, gpu::Access after) const {
  const gpu::ImageBarrier barrier{.image = planes_, .before = before, .after = after};
  commands.barrier({}, {&barrier, 1});
}

}  // namespace gloam
