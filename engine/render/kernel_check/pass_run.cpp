// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/kernel_check/pass_run.h"

#include "engine/frame/transfers/upload.h"
#include "engine/render/readback/capture.h"

namespace gloam {
namespace {

constexpr const char* kPassOwner = "kernel_check";

}  // namespace

PassRun::PassRun(const KernelLab& lab, const RenderView& view)
    : device_(lab.device()), frames_(lab.device(), lab.log(), kPassOwner, view) {
  for (const auto& [name, words] : lab.replaced_shaders())
    frames_.pipelines().replace_shader(name, {words.begin(), words.end()});
}

PassRun::~PassRun() {
  static_cast<void>(device_.wait_idle());
  for (const gpu::BufferHandle buffer : buffers_) device_.destroy(buffer);
  for (const gpu::ImageHandle image : images_) device_.destroy(image);
}

Result<gpu::BufferHandle> PassRun::make_buffer(std::uint64_t bytes, gpu::BufferUsage usage, gpu::MemoryKind memory) {
  auto made = device_.create_buffer(
      {.name = "kernel_check", .module = kPassOwner, .size = bytes, .usage = usage, .memory = memory});
  if (noted(made)) buffers_.push_back(*made);
  return made;
}

gpu::ImageHandle PassRun::make_image_of(gpu::Format format, std::uint32_t width, std::uint32_t height,
                                        std::span<const std::byte> texels) {
  using enum gpu::ImageUsage;
  if (!status_.ok()) return {};
  gpu::ImageDesc desc{.name = "kernel_check", .module = kPassOwner, .format = format, .width = width, .height = height};
  desc.usage = sampled | storage | transfer_target | transfer_source;
  const auto image = device_.create_image(desc);
  if (!noted(image)) return {};
  images_.push_back(*image);
  Uploader uploader(device_);
  uploader.image(*image, {texels.begin(), texels.end()}, gpu::Access::compute_read);
  noted(uploader.flush());
  return *image;
}

Status PassRun::draw(const std::function<void(FrameBuilder&)>& declare) {
  if (!status_.ok()) return status_;
  const auto commands = device_.begin_frame();
  if (!noted(commands)) return status_;
  if (noted(frames_.record(**commands, declare))) {
    noted(device_.submit_frame());
  } else {
    static_cast<void>(device_.abandon_frame());
  }
  noted(device_.wait_idle());
  return status_;
}

BufferRef PassRun::input_bytes(const std::string& name, std::span<const std::byte> bytes) {
  using enum gpu::BufferUsage;
  const auto buffer =
      make_buffer(bytes.size(), transfer_source | uniform | storage | indirect, gpu::MemoryKind::upload);
  if (!buffer) return {};
  std::memcpy(device_.mapped(*buffer).data(), bytes.data(), bytes.size());
  return frames_.graph().import_buffer(name, *buffer, gpu::Access::none, gpu::Access::none);
}

ImageRef PassRun::input(const std::string& name, gpu::ImageHandle image) {
  return frames_.graph().import_image(name, image, gpu::Access::compute_read, gpu::Access::compute_read);
}

void PassRun::keep(FrameBuilder& frame, const std::string& name, BufferRef buffer, std::uint64_t bytes) {
  using enum gpu::BufferUsage;
  const auto target = make_buffer(bytes, transfer_target | storage, gpu::MemoryKind::readback);
  if (!target) return;
  kept_[name] = *target;
  PassBuilder pass = frames_.graph().add_pass("keep_" + name, frame.module());
  pass.keep();
  pass.read(buffer, gpu::Access::transfer_read);
  const BufferRef copy =
      pass.write(frames_.graph().import_buffer(name + "_copy", *target, gpu::Access::none, gpu::Access::host_read),
                 gpu::Access::transfer_write);
  pass.execute([buffer, copy, bytes](PassContext& context) {
    context.commands().copy_buffer(context.buffer(buffer), 0, context.buffer(copy), 0, bytes);
  });
}

void PassRun::keep(const std::string& name, ImageRef image) {
  const auto captured = capture_image(frames_.graph(), device_, image);
  if (!noted(captured)) return;
  buffers_.push_back(captured->buffer);
  kept_[name] = captured->buffer;
}

std::span<const std::byte> PassRun::bytes_of(const std::string& name) const {
  const auto found = kept_.find(name);
  return found == kept_.end() || !status_.ok() ? std::span<const std::byte>() : device_.mapped(found->second);
}

}  // namespace gloam
