// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference/map_run.h"

#include <cstring>
#include <span>
#include <string>

#include "engine/frame/transfers/upload.h"
#include "engine/math/types.h"
#include "modules/shadows/maps/work_groups.h"
#include "shaders/shadows/maps/mips_shared.h"
#include "shaders/shadows/shaders.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {
namespace {

constexpr const char* kMapOwner = "kernel_check";

void turn_map(gpu::CommandList& commands, gpu::ImageHandle image, gpu::Access before, gpu::Access after) {
  const gpu::ImageBarrier barrier{.image = image, .before = before, .after = after};
  commands.barrier({}, {&barrier, 1});
}

struct MipWork {
  std::vector<shaders::ShadowMipGroup> groups;
  std::vector<GroupRange> runs;
};

/// The workgroups that make all mips of a face, and their range for each run.
MipWork mip_work(std::uint32_t side, float gap) {
  MipWork work;
  shaders::ShadowMipGroup group{};
  group.depth_scale = 1.0f;
  group.size = side;
  group.gap = gap;
  for (std::uint32_t first = 0; first == 0 || side >> first > 1; first += GLOAM_SHADOW_MIP_RUN) {
    work.runs.push_back({static_cast<std::uint32_t>(work.groups.size()), 0});
    const std::uint32_t block = std::uint32_t{GLOAM_SHADOW_MIP_BLOCK} << first;
    add_groups(uvec2(0), uvec2((side + block - 1) / block), GLOAM_SHADOW_MIP_GROUP, [&](uvec2 begin, uvec2 end) {
      group.begin = begin;
      group.end = end;
      work.groups.push_back(group);
    });
    work.runs.back().count = static_cast<std::uint32_t>(work.groups.size()) - work.runs.back().first;
  }
  return work;
}

Status make_map_image(gpu::Device& device, gpu::ImageDesc desc, uvec2 size, gpu::ImageHandle& image) {
  desc.name = "kernel_check";
  desc.module = kMapOwner;
  desc.format = gpu::Format::r32_float;
  desc.width = size.x;
  desc.height = size.y;
  const auto made = device.create_image(desc);
  if (!made) return made.error();
  image = *made;
  return {};
}

}  // namespace

MapRun::~MapRun() {
  static_cast<void>(device_.wait_idle());
  for (const gpu::ImageHandle image : {scratch_, atlas_, pyramid_})
    if (image) device_.destroy(image);
  if (groups_) device_.destroy(groups_);
  if (mips_) device_.destroy(mips_);
}

Status MapRun::start(const std::vector<float>& depths, std::uint32_t side) {
  using enum gpu::ImageUsage;
  gpu::SamplerDesc nearest;
  nearest.address_u = nearest.address_v = gpu::AddressMode::clamp_to_edge;
  nearest.min_filter = nearest.mag_filter = nearest.mip_filter = gpu::Filter::nearest;
  const auto sampler = device_.create_sampler(nearest);
  if (!sampler) return sampler.error();
  nearest_ = *sampler;
  const auto pipeline = device_.create_pipeline(
      gpu::ComputePipelineDesc{"shadow_mips", kMapOwner, lab_.current(shaders::shadows::mips_comp), {}});
  if (!pipeline) return pipeline.error();
  mips_ = *pipeline;
  const gpu::ImageDesc kept{.usage = storage | sampled | transfer_target};
  GLOAM_TRY(make_map_image(device_, kept, {side * 3 / 2, side}, atlas_));
  GLOAM_TRY(make_map_image(device_, kept, {side * 3 / 8, side / 2}, pyramid_));
  GLOAM_TRY(make_map_image(device_, {.usage = sampled | transfer_target, .shape = gpu::ImageShape::array}, uvec2(side),
                           scratch_));
  Uploader uploader(device_);
  const auto bytes = std::as_bytes(std::span(depths));
  uploader.image(scratch_, {bytes.begin(), bytes.end()}, gpu::Access::compute_read);
  return uploader.flush();
}

Status MapRun::make(const std::vector<float>& depths, std::uint32_t side, float gap) {
  using enum gpu::Access;
  GLOAM_TRY(start(depths, side));
  const MipWork work = mip_work(side, gap);
  const std::size_t bytes = work.groups.size() * sizeof(shaders::ShadowMipGroup);
  const auto buffer = device_.create_buffer({.name = "kernel_check",
                                             .module = kMapOwner,
                                             .size = bytes,
                                             .usage = gpu::BufferUsage::storage,
                                             .memory = gpu::MemoryKind::upload});
  if (!buffer) return buffer.error();
  groups_ = *buffer;
  std::memcpy(device_.mapped(groups_).data(), work.groups.data(), bytes);
  const auto begun = device_.begin_frame();
  if (!begun) return begun.error();
  gpu::CommandList& commands = **begun;
  for (const gpu::ImageHandle image : {atlas_, pyramid_}) {
    turn_map(commands, image, none, transfer_write);
    commands.clear_color_image(image, {0, 0, 0, 0});
    turn_map(commands, image, transfer_write, compute_write);
  }
  commands.bind_pipeline(mips_);
  commands.bind(std::vector<gpu::Binding>{{0, gpu::Binding::Sampled{{.image = scratch_, .as_array = true}, nearest_}},
                                          {1, gpu::Binding::Storage{{.image = atlas_}}},
                                          {2, gpu::Binding::Storage{{.image = pyramid_}}},
                                          {3, gpu::Binding::BufferRange{groups_}},
                                          {4, gpu::Binding::Sampled{{.image = scratch_, .as_array = true}, nearest_}}});
  shaders::ShadowMipConstants constants{0, GLOAM_SHADOW_MIPS_COVERAGE, side, 0};
  for (const GroupRange& run : work.runs) {
    if (constants.first != 0)
      for (const gpu::ImageHandle image : {atlas_, pyramid_}) turn_map(commands, image, compute_write, compute_write);
    dispatch_groups(commands, constants, run);
    constants.first += GLOAM_SHADOW_MIP_RUN;
  }
  for (const gpu::ImageHandle image : {atlas_, pyramid_}) turn_map(commands, image, compute_write, compute_read);
  GLOAM_TRY(device_.submit_frame());
  return device_.wait_idle();
}

}  // namespace gloam
