// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/kernel_check/kernel_run.h"

#include <string>

#include "engine/frame/transfers/upload.h"

namespace gloam {
namespace {

constexpr const char* kOwner = "kernel_check";

void turn_image(gpu::CommandList& commands, gpu::ImageHandle image, gpu::Access before, gpu::Access after) {
  const gpu::ImageBarrier barrier = {.image = image, .before = before, .after = after};
  commands.barrier({}, {&barrier, 1});
}

}  // namespace

KernelRun::KernelRun(const KernelLab& lab, const gpu::ShaderCode& shader, gpu::SpecConstants constants)
    : device_(lab.device()) {
  auto made = device_.create_pipeline(
      gpu::ComputePipelineDesc{std::string(shader.name), kOwner, lab.current(shader), std::move(constants)});
  if (keep(made)) pipeline_ = *made;
}

KernelRun::~KernelRun() {
  static_cast<void>(device_.wait_idle());
  for (const gpu::BufferHandle buffer : buffers_) device_.destroy(buffer);
  for (const gpu::ImageHandle image : images_) device_.destroy(image);
  if (pipeline_) device_.destroy(pipeline_);
}

gpu::BufferHandle KernelRun::make_buffer(std::uint64_t bytes, gpu::BufferUsage usage, gpu::MemoryKind memory) {
  if (!status_.ok()) return {};
  const auto made = device_.create_buffer(
      {.name = "kernel_check", .module = kOwner, .size = bytes, .usage = usage, .memory = memory});
  if (!keep(made)) return {};
  buffers_.push_back(*made);
  return *made;
}

gpu::ImageHandle KernelRun::make_image(gpu::Format format, std::uint32_t width, std::uint32_t height,
                                       gpu::ImageUsage usage, gpu::ImageShape shape) {
  if (!status_.ok()) return {};
  gpu::ImageDesc desc{.name = "kernel_check", .module = kOwner, .format = format, .width = width, .height = height};
  desc.usage = usage;
  desc.shape = shape;
  const auto made = device_.create_image(desc);
  if (!keep(made)) return {};
  images_.push_back(*made);
  return *made;
}

void KernelRun::input_bytes(std::uint32_t binding, std::span<const std::byte> bytes) {
  using enum gpu::BufferUsage;
  const gpu::BufferHandle buffer = make_buffer(bytes.size(), uniform | storage, gpu::MemoryKind::upload);
  if (!status_.ok()) return;
  std::memcpy(device_.mapped(buffer).data(), bytes.data(), bytes.size());
  bindings_.push_back({binding, gpu::Binding::BufferRange{buffer}});
}

void KernelRun::output(std::uint32_t binding, std::uint64_t bytes) {
  using enum gpu::BufferUsage;
  const gpu::BufferHandle buffer = make_buffer(bytes, transfer_target | storage, gpu::MemoryKind::readback);
  if (!status_.ok()) return;
  const std::span<std::byte> all = device_.mapped(buffer);
  std::memset(all.data(), static_cast<int>(kUntouched & 0xFFu), all.size());
  bindings_.push_back({binding, gpu::Binding::BufferRange{buffer}});
  results_[binding] = buffer;
}

void KernelRun::in_out_bytes(std::uint32_t binding, std::span<const std::byte> bytes) {
  output(binding, bytes.size());
  if (status_.ok()) std::memcpy(device_.mapped(results_.at(binding)).data(), bytes.data(), bytes.size());
}

void KernelRun::sampled_bytes(std::uint32_t binding, gpu::Format format, std::uint32_t width, std::uint32_t height,
                              std::span<const std::byte> texels, gpu::ImageShape shape) {
  const gpu::ImageHandle image =
      make_image(format, width, height, gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target, shape);
  if (!status_.ok()) return;
  Uploader uploader(device_);
  uploader.image(image, {texels.begin(), texels.end()}, gpu::Access::compute_read);
  if (keep(uploader.flush())) sampled_image(binding, image);
}

void KernelRun::sampled_image(std::uint32_t binding, gpu::ImageHandle image, gpu::Filter filter) {
  gpu::SamplerDesc desc;
  desc.address_u = desc.address_v = gpu::AddressMode::clamp_to_edge;
  desc.min_filter = desc.mag_filter = desc.mip_filter = filter;
  const auto sampler = device_.create_sampler(desc);
  if (keep(sampler)) bindings_.push_back({binding, gpu::Binding::Sampled{{.image = image}, *sampler}});
}

void KernelRun::output_image(std::uint32_t binding, gpu::Format format, std::uint32_t width, std::uint32_t height,
                             bool as_array) {
  using enum gpu::ImageUsage;
  const gpu::ImageHandle image =
      make_image(format, width, height, storage | transfer_source | transfer_target, gpu::ImageShape::plain);
  const std::uint64_t bytes = std::uint64_t{width} * height * gpu::bytes_per_texel(format);
  const gpu::BufferHandle buffer =
      make_buffer(bytes, gpu::BufferUsage::transfer_target | gpu::BufferUsage::storage, gpu::MemoryKind::readback);
  if (!status_.ok()) return;
  bindings_.push_back({binding, gpu::Binding::Storage{{.image = image, .as_array = as_array}}});
  results_[binding] = buffer;
  image_results_.emplace_back(image, buffer);
}

void KernelRun::record(gpu::CommandList& commands, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  using enum gpu::Access;
  for (const auto& [image, buffer] : image_results_) {
    turn_image(commands, image, none, transfer_write);
    commands.clear_color_image(image, {kUntouched, kUntouched, kUntouched, kUntouched});
    turn_image(commands, image, transfer_write, compute_write);
  }
  commands.bind_pipeline(pipeline_);
  commands.bind(bindings_);
  if (!constants_.empty()) commands.push_constants(constants_);
  commands.dispatch(x, y, z);
  for (const auto& [image, buffer] : image_results_) {
    turn_image(commands, image, compute_write, transfer_read);
    commands.copy_image_to_buffer(image, 0, 0, buffer, 0);
  }
  for (const auto& [binding, buffer] : results_) {
    const gpu::BufferBarrier ready = {
        .buffer = buffer, .before = compute_write, .after = host_read, .also_before = gpu::mask_of(transfer_write)};
    commands.barrier({&ready, 1}, {});
  }
}

Status KernelRun::run(std::uint32_t groups_x, std::uint32_t groups_y, std::uint32_t groups_z) {
  if (!status_.ok()) return status_;
  const auto commands = device_.begin_frame();
  if (!keep(commands)) return status_;
  record(**commands, groups_x, groups_y, groups_z);
  if (keep(device_.submit_frame())) keep(device_.wait_idle());
  return status_;
}

std::span<const std::byte> KernelRun::bytes_of(std::uint32_t binding) const {
  const auto found = results_.find(binding);
  return found == results_.end() || !status_.ok() ? std::span<const std::byte>() : device_.mapped(found->second);
}

}  // namespace gloam
