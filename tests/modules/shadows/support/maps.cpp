// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/modules/shadows/support/maps.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>

#include "engine/frame/transfers/upload.h"
#include "modules/shadows/views/cascade_rows.h"
#include "shaders/shadows/maps/mips_shared.h"
#include "shaders/shadows/shaders.h"
#include "shaders/shadows_test/shaders.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {
namespace {

using gpu::Access;
using gpu::ImageUsage;

void turn(gpu::CommandList& commands, gpu::ImageHandle image, Access before, Access after) {
  const gpu::ImageBarrier barrier{.image = image, .before = before, .after = after};
  commands.barrier({}, {&barrier, 1});
}

struct ProbePipelines {
  gpu::Device* device = nullptr;
  std::map<std::vector<std::uint32_t>, gpu::PipelineHandle> by_constants;
};
ProbePipelines& probe_pipelines() {
  static ProbePipelines pipelines;
  return pipelines;
}

gpu::PipelineHandle probe_pipeline(gpu::Device& device, const ProbeSettings& settings) {
  const auto constants = settings.constants();
  std::vector<std::uint32_t> key = {settings.standard ? 1u : 0u};
  for (const gpu::SpecConstant& constant : constants) key.push_back(constant.value.bits);
  probe_pipelines().device = &device;
  gpu::PipelineHandle& pipeline = probe_pipelines().by_constants[key];
  if (!pipeline)
    pipeline = value_of(device.create_pipeline(gpu::ComputePipelineDesc{
        "shadow_probe", "test",
        settings.standard ? shaders::shadows_test::probe_standard_comp : shaders::shadows_test::probe_comp,
        constants}));
  return pipeline;
}

/// The workgroups that make all mips of a face, and their range for each run.
struct MipRuns {
  std::vector<shaders::ShadowMipGroup> groups;
  std::vector<GroupRange> runs;
};

MipRuns mip_runs(uvec2 origin, std::uint32_t size, bool orthographic, float gap) {
  MipRuns made;
  shaders::ShadowMipGroup group{};
  group.depth_scale = 1.0f;
  group.origin = origin;
  group.size = size;
  group.orthographic = orthographic ? 1u : 0u;
  group.gap = gap;
  for (std::uint32_t first = 0; first == 0 || size >> first > 1; first += GLOAM_SHADOW_MIP_RUN) {
    made.runs.push_back({static_cast<std::uint32_t>(made.groups.size()), 0});
    const std::uint32_t block = std::uint32_t{GLOAM_SHADOW_MIP_BLOCK} << first;
    add_groups(uvec2(0), uvec2((size + block - 1) / block), GLOAM_SHADOW_MIP_GROUP, [&](uvec2 begin, uvec2 end) {
      group.begin = begin;
      group.end = end;
      made.groups.push_back(group);
    });
    made.runs.back().count = static_cast<std::uint32_t>(made.groups.size()) - made.runs.back().first;
  }
  return made;
}

}  // namespace

void forget_probe_pipelines() {
  for (const auto& [constants, pipeline] : probe_pipelines().by_constants) probe_pipelines().device->destroy(pipeline);
  probe_pipelines() = {};
}

RayScene nearest_of(std::vector<RayScene> scenes) {
  return [scenes = std::move(scenes)](const dvec3& origin, const dvec3& direction) {
    double nearest = 0.0;
    for (const RayScene& scene : scenes) {
      const double t = scene(origin, direction);
      if (t > 0.0 && (nearest <= 0.0 || t < nearest)) nearest = t;
    }
    return nearest;
  };
}

RayScene plane(dvec3 point, dvec3 normal, std::function<bool(const dvec3&)> inside) {
  return [=, inside = std::move(inside)](const dvec3& origin, const dvec3& direction) {
    const double along = dot(normal, direction);
    const double t = along == 0.0 ? 0.0 : dot(normal, point - origin) / along;
    return t > 0.0 && (!inside || inside(origin + direction * t)) ? t : 0.0;
  };
}

glm::dmat3 cube_axes() { return {dvec3(GLOAM_CUBE_X), dvec3(GLOAM_CUBE_Y), dvec3(GLOAM_CUBE_Z)}; }

FacePose cube_face(int face, dvec3 origin, double tan_half) {
  constexpr std::array<dvec3, 6> kForward = {dvec3(1, 0, 0),  dvec3(-1, 0, 0), dvec3(0, 1, 0),
                                             dvec3(0, -1, 0), dvec3(0, 0, 1),  dvec3(0, 0, -1)};
  constexpr std::array<dvec3, 6> kUp = {dvec3(0, 1, 0), dvec3(0, 1, 0), dvec3(0, 0, -1),
                                        dvec3(0, 0, 1), dvec3(0, 1, 0), dvec3(0, 1, 0)};
  const auto i = static_cast<std::size_t>(face);
  const glm::dmat3 cube = cube_axes();
  return {.origin = origin,
          .right = cube * cross(kForward[i], kUp[i]),
          .up = cube * kUp[i],
          .forward = cube * kForward[i],
          .tan_half = tan_half};
}

std::vector<float> draw_face(const FacePose& pose, std::uint32_t size, const RayScene& scene) {
  std::vector<float> depths;
  depths.reserve(std::size_t{size} * size);
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      const glm::dvec2 ndc = glm::dvec2(x + 0.5, y + 0.5) * (2.0 / size) - 1.0;
      if (pose.tan_half > 0.0) {
        const dvec3 ray = pose.forward + (pose.right * ndc.x - pose.up * ndc.y) * pose.tan_half;
        const double z = scene(pose.origin, ray);
        depths.push_back(z > pose.near_m ? static_cast<float>(pose.near_m / z) : 0.0f);
      } else {
        const double z = scene(pose.origin + (pose.right * ndc.x - pose.up * ndc.y) * pose.half_extent_m, pose.forward);
        depths.push_back(z > 0.0 && z < pose.depth_m ? static_cast<float>(1.0 - z / pose.depth_m) : 0.0f);
      }
    }
  }
  return depths;
}

gpu::SpecConstants ProbeSettings::constants() const {
  gpu::SpecConstants constants;
  constants.set_if_present("kFilter", filter);
  constants.set_if_present("kKernel", static_cast<std::int32_t>(kernel));
  constants.set("kMips", mips);
  constants.set("kReceiverPlane", receiver_plane);
  constants.set("kBias", bias);
  constants.set("kKernelShape", shape);
  constants.set("kLevels", levels);
  constants.set("kFullPenumbra", full_penumbra);
  constants.set("kCoverage", coverage);
  constants.set("kNear", near);
  return constants;
}

ShadowMaps::ShadowMaps(gpu::Device& device, std::uint32_t atlas_size, gpu::Format format)
    : device_(device), size_(atlas_size), format_(format) {
  gpu::SamplerDesc sampler;
  sampler.address_u = sampler.address_v = gpu::AddressMode::clamp_to_edge;
  linear_ = value_of(device.create_sampler(sampler));
  sampler.min_filter = sampler.mag_filter = sampler.mip_filter = gpu::Filter::nearest;
  nearest_ = value_of(device.create_sampler(sampler));
  const ImageUsage usage =
      ImageUsage::storage | ImageUsage::sampled | ImageUsage::transfer_source | ImageUsage::transfer_target;
  atlas_ = image(format, {size_ * 3 / 2, size_}, usage, gpu::ImageShape::plain);
  pyramid_ = image(gpu::Format::r32_float, {size_ * 3 / 8, size_ / 2}, usage, gpu::ImageShape::plain);
  const gpu::ShaderCode code =
      format == gpu::Format::r32_float ? shaders::shadows::mips_comp : shaders::shadows::mips_r16_comp;
  mips_ = value_of(device.create_pipeline(gpu::ComputePipelineDesc{"shadow_mips", "test", code, {}}));
  run_frame(device_, [&](gpu::CommandList& commands) {
    for (const gpu::ImageHandle cleared : {atlas_, pyramid_}) {
      turn(commands, cleared, Access::none, Access::transfer_write);
      commands.clear_color_image(cleared, {0, 0, 0, 0});
      turn(commands, cleared, Access::transfer_write, Access::compute_read);
    }
  });
}

ShadowMaps::~ShadowMaps() {
  static_cast<void>(device_.wait_idle());
  device_.destroy(atlas_);
  device_.destroy(pyramid_);
  device_.destroy(mips_);
}

void ShadowMaps::add_face(const std::vector<float>& depths, uvec2 origin, std::uint32_t size, bool orthographic,
                          std::uint32_t mip_operator, float gap) {
  const gpu::ImageHandle scratch =
      texture(gpu::Format::r32_float, uvec2(size), std::as_bytes(std::span(depths)), gpu::ImageShape::array);
  const MipRuns work = mip_runs(origin, size, orthographic, gap);
  const gpu::BufferHandle buffer = make_upload(device_, work.groups);
  const std::vector<gpu::Binding> bindings = {
      {0, gpu::Binding::Sampled{{.image = scratch, .as_array = true}, nearest_}},
      {1, gpu::Binding::Storage{{.image = atlas_}}},
      {2, gpu::Binding::Storage{{.image = pyramid_}}},
      {3, gpu::Binding::BufferRange{buffer}},
      {4, gpu::Binding::Sampled{{.image = scratch, .as_array = true}, nearest_}}};
  run_frame(device_, [&](gpu::CommandList& commands) {
    turn(commands, atlas_, Access::compute_read, Access::compute_write);
    turn(commands, pyramid_, Access::compute_read, Access::compute_write);
    commands.bind_pipeline(mips_);
    commands.bind(bindings);
    record_mips(commands, work.runs, mip_operator);
    turn(commands, atlas_, Access::compute_write, Access::compute_read);
    turn(commands, pyramid_, Access::compute_write, Access::compute_read);
  });
  device_.destroy(buffer);
  device_.destroy(scratch);
}

void ShadowMaps::record_mips(gpu::CommandList& commands, std::span<const GroupRange> runs,
                             std::uint32_t mip_operator) const {
  shaders::ShadowMipConstants constants{0, mip_operator, size_, 0};
  for (const GroupRange& run : runs) {
    if (constants.first != 0) {
      turn(commands, atlas_, Access::compute_write, Access::compute_write);
      turn(commands, pyramid_, Access::compute_write, Access::compute_write);
    }
    dispatch_groups(commands, constants, run);
    constants.first += GLOAM_SHADOW_MIP_RUN;
  }
}

void ShadowMaps::copy_face(uvec2 origin, uvec2 copy, std::uint32_t size, bool orthographic, std::uint32_t mip_operator,
                           float gap) {
  using namespace shaders::shadows;
  const bool d16 = format_ == gpu::Format::r16_unorm;
  const gpu::PipelineHandle copying = value_of(device_.create_pipeline(
      gpu::ComputePipelineDesc{"shadow_overlay_copy", "test", d16 ? overlay_copy_r16_comp : overlay_copy_comp, {}}));
  const gpu::PipelineHandle mips = value_of(device_.create_pipeline(
      gpu::ComputePipelineDesc{"shadow_mips_in_place", "test", d16 ? mips_in_place_r16_comp : mips_in_place_comp, {}}));
  std::vector<shaders::ShadowCopyGroup> parts;
  add_groups(uvec2(0), uvec2(size / GLOAM_SHADOW_MIP_BLOCK), GLOAM_SHADOW_MIP_GROUP, [&](uvec2 begin, uvec2 end) {
    parts.push_back({origin, copy, begin, end});
  });
  const MipRuns work = mip_runs(copy, size, orthographic, gap);
  const gpu::BufferHandle part_buffer = make_upload(device_, parts), buffer = make_upload(device_, work.groups);
  run_frame(device_, [&](gpu::CommandList& commands) {
    turn(commands, atlas_, Access::compute_read, Access::compute_write);
    turn(commands, pyramid_, Access::compute_read, Access::compute_write);
    commands.bind_pipeline(copying);
    commands.bind(std::vector<gpu::Binding>{{0, gpu::Binding::Storage{{.image = atlas_}}},
                                            {1, gpu::Binding::BufferRange{part_buffer}}});
    dispatch_groups(commands, shaders::ShadowCopyConstants{}, {0, static_cast<std::uint32_t>(parts.size())});
    turn(commands, atlas_, Access::compute_write, Access::compute_write);
    commands.bind_pipeline(mips);
    commands.bind(std::vector<gpu::Binding>{{1, gpu::Binding::Storage{{.image = atlas_}}},
                                            {2, gpu::Binding::Storage{{.image = pyramid_}}},
                                            {3, gpu::Binding::BufferRange{buffer}}});
    record_mips(commands, work.runs, mip_operator);
    turn(commands, atlas_, Access::compute_write, Access::compute_read);
    turn(commands, pyramid_, Access::compute_write, Access::compute_read);
  });
  for (const gpu::BufferHandle used : {part_buffer, buffer}) device_.destroy(used);
  for (const gpu::PipelineHandle used : {copying, mips}) device_.destroy(used);
}

void ShadowMaps::write_atlas(const std::vector<float>& texels) {
  Uploader uploader(device_);
  const auto bytes = std::as_bytes(std::span(texels));
  uploader.image(atlas_, {bytes.begin(), bytes.end()}, Access::compute_read);
  const Status uploaded = uploader.flush();
  EXPECT_TRUE(uploaded.ok()) << (uploaded.ok() ? "" : uploaded.error().message);
}

gpu::ImageHandle ShadowMaps::image(gpu::Format format, uvec2 size, ImageUsage usage, gpu::ImageShape shape) {
  gpu::ImageDesc desc{.name = "test map", .module = "test", .format = format, .width = size.x, .height = size.y};
  desc.usage = usage;
  desc.shape = shape;
  return value_of(device_.create_image(desc));
}

gpu::ImageHandle ShadowMaps::texture(gpu::Format format, uvec2 size, std::span<const std::byte> texels,
                                     gpu::ImageShape shape) {
  const gpu::ImageHandle made = image(format, size, ImageUsage::sampled | ImageUsage::transfer_target, shape);
  Uploader uploader(device_);
  uploader.image(made, {texels.begin(), texels.end()}, Access::compute_read);
  const Status uploaded = uploader.flush();
  EXPECT_TRUE(uploaded.ok()) << (uploaded.ok() ? "" : uploaded.error().message);
  return made;
}

std::vector<std::byte> ShadowMaps::read(gpu::ImageHandle source) const {
  const gpu::ImageDesc& desc = device_.desc(source);
  const std::uint64_t bytes = std::uint64_t{desc.width} * desc.height * gpu::bytes_per_texel(desc.format);
  const gpu::BufferHandle buffer = make_readback(device_, bytes);
  run_frame(device_, [&](gpu::CommandList& commands) {
    turn(commands, source, Access::compute_read, Access::transfer_read);
    commands.copy_image_to_buffer(source, 0, 0, buffer, 0);
    turn(commands, source, Access::transfer_read, Access::compute_read);
    const gpu::BufferBarrier ready{.buffer = buffer, .before = Access::transfer_write, .after = Access::host_read};
    commands.barrier({&ready, 1}, {});
  });
  std::vector<std::byte> items = items_of<std::byte>(device_, buffer);
  items.resize(bytes);
  device_.destroy(buffer);
  return items;
}

std::vector<float> ShadowMaps::atlas() const {
  const std::vector<std::byte> bytes = read(atlas_);
  std::vector<float> texels(std::size_t{size_} * size_ * 3 / 2);
  if (format_ == gpu::Format::r32_float) {
    std::memcpy(texels.data(), bytes.data(), bytes.size());
  } else {
    for (std::size_t i = 0; i < texels.size(); ++i) {
      std::uint16_t steps = 0;
      std::memcpy(&steps, &bytes[i * 2], 2);
      texels[i] = static_cast<float>(steps) / 65535.0f;
    }
  }
  return texels;
}

std::vector<vec2> ShadowMaps::pyramid() const {
  const std::vector<std::byte> bytes = read(pyramid_);
  std::vector<float> depths(bytes.size() / sizeof(float));
  std::memcpy(depths.data(), bytes.data(), bytes.size());
  std::vector<vec2> texels(depths.size() / 2);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = {depths[texels.size() + i], depths[i]};
  return texels;
}

std::vector<shaders::ShadowProbeResult> ShadowMaps::probe(std::span<const shaders::ShadowProbe> probes,
                                                          const std::vector<shaders::ShadowRow>& rows,
                                                          const shaders::ShadowBlock& without_cascade_rows,
                                                          const ProbeSettings& settings) {
  static_assert(sizeof(shaders::ShadowRow) == GLOAM_SHADOW_ROW_TEXELS * sizeof(vec4));
  const gpu::PipelineHandle pipeline = probe_pipeline(device_, settings);
  std::vector<shaders::ShadowRow> some_rows = rows.empty() ? std::vector<shaders::ShadowRow>(1) : rows;
  shaders::ShadowBlock block = without_cascade_rows;
  append_cascade_rows({}, block, some_rows);
  const gpu::ImageHandle row_image =
      texture(gpu::Format::rgba32_float, {GLOAM_SHADOW_ROW_TEXELS, static_cast<std::uint32_t>(some_rows.size())},
              std::as_bytes(std::span(some_rows)));
  // A cookie whose red grows to the right and whose green grows downward.
  constexpr std::array<std::uint8_t, 16> kCookie = {0, 0, 0, 255, 255, 0, 0, 255, 0, 255, 0, 255, 255, 255, 0, 255};
  const gpu::ImageHandle cookie =
      texture(gpu::Format::rgba8_unorm, {2, 2}, std::as_bytes(std::span(kCookie)), gpu::ImageShape::array);
  const gpu::BufferHandle inputs = make_upload(device_, probes);
  const gpu::BufferHandle constants = make_upload(device_, std::span<const shaders::ShadowBlock>(&block, 1));
  const gpu::BufferHandle outputs = make_readback(device_, probes.size() * sizeof(shaders::ShadowProbeResult));
  const std::vector<gpu::Binding> bindings = {
      {0, gpu::Binding::BufferRange{inputs}},
      {1, gpu::Binding::BufferRange{outputs}},
      {2, gpu::Binding::BufferRange{constants}},
      {3, gpu::Binding::Sampled{{.image = row_image}, nearest_}},
      {4, gpu::Binding::Sampled{{.image = atlas_}, nearest_}},
      {5, gpu::Binding::Sampled{{.image = pyramid_}, nearest_}},
      {6, gpu::Binding::Sampled{{.image = cookie}, linear_}},
      {7, gpu::Binding::Sampled{{.image = cookie}, nearest_}},
  };
  const auto count = static_cast<std::uint32_t>(probes.size());
  run_frame(device_, [&](gpu::CommandList& commands) {
    commands.bind_pipeline(pipeline);
    commands.bind(bindings);
    commands.push_constants(std::as_bytes(std::span(&count, 1)));
    commands.dispatch((count + GLOAM_SHADOW_PROBE_GROUP - 1) / GLOAM_SHADOW_PROBE_GROUP, 1, 1);
    const gpu::BufferBarrier done{.buffer = outputs, .before = Access::compute_write, .after = Access::host_read};
    commands.barrier({&done, 1}, {});
  });
  std::vector<shaders::ShadowProbeResult> results = items_of<shaders::ShadowProbeResult>(device_, outputs);
  results.resize(probes.size());
  for (const gpu::BufferHandle buffer : {inputs, constants, outputs}) device_.destroy(buffer);
  for (const gpu::ImageHandle used : {row_image, cookie}) device_.destroy(used);
  return results;
}

shaders::ShadowRow spot_row(const FacePose& pose, double tan_inner, double width_m, uvec2 origin, std::uint32_t size) {
  shaders::ShadowRow row{};
  row.kind = GLOAM_SHADOW_SPOT;
  row.near_m = static_cast<float>(pose.near_m);
  row.emitter_diameter_m = static_cast<float>(width_m);
  row.size = static_cast<float>(size);
  row.right = vec3(pose.right);
  row.up = vec3(pose.up);
  row.tan_half = static_cast<float>(pose.tan_half);
  row.tan_inner = static_cast<float>(tan_inner);
  row.origins[0] = vec2(origin);
  row.mirrored = dot(cross(pose.up, pose.right), pose.forward) < 0.0 ? 1.0f : 0.0f;
  row.cookie_layer = row.traced_layer = -1.0f;
  row.cookie_tan = 1.0f;
  return row;
}

shaders::ShadowBlock shadow_block(const ShadowMaps& maps, float bias_m, bool d16) {
  shaders::ShadowBlock block{};
  block.atlas_size = static_cast<float>(maps.atlas_size());
  block.bias_m = bias_m;
  block.depth_quantum = d16 ? 1.0f / 65535.0f : 0.0f;
  block.relative_quantum = d16 ? 0.0f : 1.0f / 16777216.0f;
  return block;
}

}  // namespace gloam::test
