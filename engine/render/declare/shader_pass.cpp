// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/shader_pass.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/core/assert.h"
#include "engine/render/declare/recording.h"

namespace gloam {
namespace {

using declare::Item;
using gpu::ResourceKind;

constexpr std::uint64_t kViewKey = binding_key("view");

bool is_image(ResourceKind kind) { return kind == ResourceKind::sampled_image || kind == ResourceKind::storage_image; }

std::string kind_text(const InterfaceBinding& slot) { return "is a " + std::string(gpu::name_of(slot.kind)); }

}  // namespace

ShaderPass::ShaderPass(FrameBuilder& frame, std::string_view name)
    : frame_(frame),
      graph_pass_(frame.graph().add_pass(name, frame.module())),
      recording_(frame.services().declared.recordings.next(name)) {}

std::string ShaderPass::sentence(std::string_view binding, std::string_view fault, std::string_view constant) const {
  std::string text = "pass '" + recording_.name + "'";
  if (interface_ != nullptr) text += ", shader '" + interface_->name + "'";
  if (!binding.empty()) text += ", binding '" + std::string(binding) + "'";
  if (!constant.empty()) text += ", constant '" + std::string(constant) + "'";
  return text + ": " + std::string(fault);
}

void ShaderPass::fail(Error error) {
  recording_.failed = true;
  frame_.fail(std::move(error));
}

void ShaderPass::use(const ShaderInterface* interface) {
  interface_ = interface;
  if (interface == nullptr) recording_.failed = true;
}

void ShaderPass::check_constants(const gpu::SpecConstants& constants) const {
  if (interface_ == nullptr) return;
  const auto fault = gpu::find_fault(constants, interface_->constants);
  GLOAM_ASSERT(!fault, sentence("", fault->clause, fault->name));
}

bool ShaderPass::declares(std::string_view binding) const {
  return interface_ != nullptr && interface_->find(binding_key(binding)) != nullptr;
}

const InterfaceBinding* ShaderPass::expect(std::string_view binding, bool image, bool write) {
  if (recording_.failed) return nullptr;
  GLOAM_ASSERT(interface_ != nullptr, sentence(binding, "a program must be chosen before resources are bound"));
  const InterfaceBinding* slot = interface_->find(binding_key(binding));
  GLOAM_ASSERT(slot != nullptr, sentence(binding, "the shader declares no binding of this name"));
  GLOAM_ASSERT(is_image(slot->kind) == image,
               sentence(binding, kind_text(*slot) + (image ? ", not an image" : ", not a buffer")));
  GLOAM_ASSERT(!write || slot->writable,
               sentence(binding, slot->kind == ResourceKind::sampled_image || slot->kind == ResourceKind::uniform_buffer
                                     ? kind_text(*slot) + " and cannot be written"
                                     : "the shader declares it readonly"));
  return slot;
}

void ShaderPass::set(const InterfaceBinding& slot, const Item& item) {
  const auto index = static_cast<std::uint32_t>(recording_.items.size());
  recording_.items.push_back(item);
  recording_.items.back().key = slot.key;
  for (std::uint32_t& known : recording_.in_force) {
    if (recording_.items[known].key != slot.key) continue;
    known = index;
    return;
  }
  recording_.in_force.push_back(index);
}

void ShaderPass::declare_read(const InterfaceBinding& slot, ImageRef image, const gpu::ImageRange& range) {
  if (slot.kind == ResourceKind::storage_image) {
    GLOAM_ASSERT(interface_->compute && !slot.writable,
                 sentence(slot.name, "the shader may write this image, so the pass must write it"));
    return graph_pass_.read(image, gpu::Access::compute_storage_read, range);
  }
  if (interface_->compute) return graph_pass_.read(image, gpu::Access::compute_read, range);
  if (slot.in_vertex) graph_pass_.read(image, gpu::Access::vertex_read, range);
  if (slot.in_last) graph_pass_.read(image, gpu::Access::fragment_read, range);
}

void ShaderPass::declare_read(const InterfaceBinding& slot, BufferRef buffer) {
  if (slot.kind == ResourceKind::uniform_buffer) return graph_pass_.read(buffer, gpu::Access::uniform_read);
  if (interface_->compute) return graph_pass_.read(buffer, gpu::Access::compute_read);
  if (slot.in_vertex) graph_pass_.read(buffer, gpu::Access::vertex_read);
  if (slot.in_last) graph_pass_.read(buffer, gpu::Access::fragment_read);
}

void ShaderPass::bind_image(const InterfaceBinding& slot, ImageRef image, gpu::SamplerHandle sampler,
                            const gpu::ImageRange& range) {
  Item item;
  item.kind = slot.kind == ResourceKind::storage_image ? Item::Kind::storage : Item::Kind::sampled;
  item.image = image;
  item.part = range;
  item.sampler = sampler;
  set(slot, item);
}

void ShaderPass::bind_buffer(const InterfaceBinding& slot, BufferRef buffer, std::uint64_t offset, std::uint64_t size) {
  Item item;
  item.kind = Item::Kind::buffer;
  item.buffer = buffer;
  item.range = {{}, offset, size};
  set(slot, item);
}

void ShaderPass::read(std::string_view binding, ImageRef image, Sampling sampling, const gpu::ImageRange& range) {
  read(binding, image, frame_.sampler(sampling), range);
}

void ShaderPass::read(std::string_view binding, ImageRef image, gpu::SamplerHandle sampler,
                      const gpu::ImageRange& range) {
  const InterfaceBinding* slot = expect(binding, true, false);
  if (slot == nullptr) return;
  if (!image) {
    auto placeholder = frame_.services().declared.placeholders.image(frame_.graph(), *slot);
    if (!placeholder.ok()) return fail(placeholder.error());
    declare_read(*slot, *placeholder, {});
    return bind_image(*slot, *placeholder, sampler, {});
  }
  declare_read(*slot, image, range);
  bind_image(*slot, image, sampler, range);
}

void ShaderPass::read(std::string_view binding, BufferRef buffer) { read_part(binding, buffer, 0, 0); }

void ShaderPass::read_part(std::string_view binding, BufferRef buffer, std::uint64_t offset, std::uint64_t size) {
  if (!buffer) return read(binding, gpu::Binding::BufferRange{});
  const InterfaceBinding* slot = expect(binding, false, false);
  if (slot == nullptr) return;
  declare_read(*slot, buffer);
  bind_buffer(*slot, buffer, offset, size);
}

void ShaderPass::read(std::string_view binding, const gpu::Binding::BufferRange& range) {
  const InterfaceBinding* slot = expect(binding, false, false);
  if (slot == nullptr) return;
  Item item;
  item.kind = Item::Kind::range;
  item.range = range;
  if (!range.buffer) {
    auto placeholder = frame_.services().declared.placeholders.buffer();
    if (!placeholder.ok()) return fail(placeholder.error());
    item.range = *placeholder;
  }
  set(*slot, item);
}

gpu::Access ShaderPass::write_access(const InterfaceBinding& slot) const {
  GLOAM_ASSERT(interface_->compute || !slot.in_vertex, sentence(slot.name, "vertex shaders write no resources"));
  return interface_->compute ? gpu::Access::compute_write : gpu::Access::fragment_write;
}

ImageRef ShaderPass::write(std::string_view binding, ImageRef image, const gpu::ImageRange& range) {
  const InterfaceBinding* slot = expect(binding, true, true);
  // Also written if the program failed: later passes of a frame that is given up may still declare reads.
  if (slot == nullptr) return graph_pass_.write(image, gpu::Access::compute_write, range);
  image = graph_pass_.write(image, write_access(*slot), range);
  bind_image(*slot, image, {}, range);
  recording_.items.back().written = true;
  return image;
}

BufferRef ShaderPass::write(std::string_view binding, BufferRef buffer) { return write_part(binding, buffer, 0, 0); }

BufferRef ShaderPass::write_part(std::string_view binding, BufferRef buffer, std::uint64_t offset, std::uint64_t size) {
  const InterfaceBinding* slot = expect(binding, false, true);
  if (slot == nullptr) return graph_pass_.write(buffer, gpu::Access::compute_write);
  buffer = graph_pass_.write(buffer, write_access(*slot));
  bind_buffer(*slot, buffer, offset, size);
  recording_.items.back().written = true;
  return buffer;
}

void ShaderPass::upload(std::string_view binding, std::span<const std::byte> bytes) {
  const InterfaceBinding* slot = expect(binding, false, false);
  if (slot == nullptr) return;
  UploadRing& ring =
      slot->kind == ResourceKind::uniform_buffer ? frame_.services().uniforms : frame_.services().storage;
  auto range = ring.write(bytes);
  if (!range.ok()) return fail(range.error());
  read(binding, *range);
}

void ShaderPass::push_bytes(std::span<const std::byte> bytes) {
  recording_.first_push = static_cast<std::uint32_t>(recording_.pushes.size());
  recording_.push_bytes = static_cast<std::uint32_t>(bytes.size());
  recording_.pushes.insert(recording_.pushes.end(), bytes.begin(), bytes.end());
}

void ShaderPass::record(PassFunction function) {
  declare::Step& step = recording_.steps.emplace_back();
  step.function = recording_.functions.size();
  recording_.functions.push_back(std::move(function));
}

void ShaderPass::bind_view_constants() {
  const InterfaceBinding* slot = interface_->find(kViewKey);
  if (slot == nullptr || slot->kind != ResourceKind::uniform_buffer) return;
  for (const std::uint32_t known : recording_.in_force)
    if (recording_.items[known].key == kViewKey) return;
  Item item;
  item.range = std::get<gpu::Binding::BufferRange>(frame_.view_binding().resource);
  set(*slot, item);
}

void ShaderPass::forget_pipeline() {
  pipeline_ = {};
  due_pipeline_ = nullptr;
}

template <class Desc>
void ShaderPass::use_or_await(const Desc& desc) {
  const FrameServices& services = frame_.services();
  forget_pipeline();
  pipeline_ = services.pipelines.find(desc);
  if (!pipeline_) due_pipeline_ = services.declared.due_pipelines.add(desc);
}
template void ShaderPass::use_or_await(const gpu::ComputePipelineDesc&);
template void ShaderPass::use_or_await(const gpu::GraphicsPipelineDesc&);

declare::Step& ShaderPass::add_step(declare::StepKind kind) {
  GLOAM_ASSERT(interface_ != nullptr, sentence("", "a program must be chosen before it is dispatched or drawn"));
  bind_view_constants();
  declare::Step& step = recording_.steps.emplace_back();
  step.kind = kind;
  step.pipeline = pipeline_;
  step.due = due_pipeline_;
  step.first_push = recording_.first_push;
  step.push_bytes = recording_.push_bytes;
  // Each surface has its own push constants.
  GLOAM_ASSERT(kind == declare::StepKind::surfaces || step.push_bytes >= interface_->push_constant_bytes,
               sentence("", "the shader declares " + std::to_string(interface_->push_constant_bytes) +
                                " bytes of push constants, and " + std::to_string(step.push_bytes) + " were given"));
  step.first_bound = static_cast<std::uint32_t>(recording_.bound.size());
  for (const InterfaceBinding& slot : interface_->bindings) {
    const auto at = std::ranges::find_if(recording_.in_force,
                                         [&](std::uint32_t known) { return recording_.items[known].key == slot.key; });
    const bool given = at != recording_.in_force.end();
    GLOAM_ASSERT(given || !slot.used, sentence(slot.name, "nothing was bound to it"));
    if (given) recording_.bound.push_back({slot.binding, *at});
  }
  step.bound_count = static_cast<std::uint32_t>(recording_.bound.size()) - step.first_bound;
  return step;
}

void read_geometry(ShaderPass& pass, const GeometryOutputs& geometry) {
  pass.read_if_declared("base_color_image", geometry.base_color);
  pass.read_if_declared("normal_image", geometry.normals);
  pass.read_if_declared("material_image", geometry.material);
  pass.read_if_declared("emissive_image", geometry.emissive);
  pass.read_if_declared("depth_image", geometry.depth);
  pass.read_if_declared("depth_bounds", geometry.depth_bounds);
  pass.read_if_declared("motion_image", geometry.motion);
  pass.read_if_declared("smooth_surface_image", geometry.smooth_surfaces);
}

}  // namespace gloam
