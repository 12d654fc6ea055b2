// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/frame_graph.h"

#include "engine/core/assert.h"
#include "engine/frame/frame_graph_state.h"
#include "engine/gpu/access.h"
#include "engine/gpu/subresources.h"

namespace gloam {

namespace {

using frame::DeclaredPass;
using frame::DeclaredResource;
using frame::DeclaredUse;

std::string in_pass(const DeclaredPass& pass, const DeclaredResource& resource) {
  return "pass '" + pass.name + "', resource '" + resource.name() + "': ";
}

}  // namespace

gpu::ImageRange FrameGraph::State::range_of_use(DeclaredResource& image, const gpu::ImageRange& range) const {
  if (range == gpu::ImageRange()) return range;
  gpu::ImageDesc& desc = image.image_desc;
  if (image.imported) {
    desc.mips = device.desc(image.image).mips;
    desc.layers = device.desc(image.image).layers;
  }
  const gpu::ImageRange resolved = gpu::resolve(range, desc);
  return resolved.mip_count == desc.mips && resolved.layer_count == desc.layers ? gpu::ImageRange() : resolved;
}

template <class Kind>
std::uint32_t FrameGraph::State::add_use(std::uint32_t pass_index, FrameRef<Kind> ref, gpu::Access access, bool write,
                                         const gpu::ImageRange& range) {
  check_declaring();
  GLOAM_ASSERT(pass_index + 1 == declaration.passes.size(),
               "a pass declares its reads and writes before the next pass is added");
  DeclaredPass& pass = declaration.passes[pass_index];
  DeclaredResource& target = resource(ref);
  GLOAM_ASSERT(gpu::is_write(access) == write,
               in_pass(pass, target) + std::string(name_of(access)) + (write ? " writes nothing" : " is no read"));
  GLOAM_ASSERT(target.is_image ? gpu::fits_image(access) : gpu::fits_buffer(access),
               in_pass(pass, target) + "this kind of resource has no access " + std::string(name_of(access)));
  const gpu::ImageRange used = range_of_use(target, range);
  DeclaredUse* use = nullptr;
  bool replaced_here = false;
  for (std::uint32_t i = pass.first_use; i < declaration.uses.size(); ++i) {
    DeclaredUse& other = declaration.uses[i];
    if (other.resource != ref.resource) continue;
    // A pass may read the version that it replaces; it may declare the read before or after the write.
    replaced_here = replaced_here || (!write && ref.version >= other.first_version);
    if (other.range == used) {
      use = &other;
    } else {
      const gpu::ImageDesc& desc = target.image_desc;
      GLOAM_ASSERT(!overlap(gpu::resolve(other.range, desc), gpu::resolve(used, desc)),
                   in_pass(pass, target) + "ranges of mips and layers in one pass are equal or disjoint");
    }
  }
  GLOAM_ASSERT(ref.version == target.version || replaced_here,
               in_pass(pass, target) + "this handle is stale; a pass has written a newer version since");
  GLOAM_ASSERT(write || target.imported || target.version > 0,
               in_pass(pass, target) + "a transient is read that no pass has written");
  if (use == nullptr) {
    use = &declaration.uses.emplace_back(DeclaredUse{
        .resource = ref.resource, .first_version = ref.version, .last_version = ref.version, .range = used});
    ++pass.use_count;
  }
  const gpu::AccessMask combined = frame::combine_accesses(use->accesses, access, target.is_image);
  GLOAM_ASSERT(combined != 0, in_pass(pass, target) + std::string(name_of(access)) + " and " +
                                  std::string(name_of(gpu::first_of(use->accesses))) + " cannot be had in one pass");
  use->accesses = combined;
  use->reads = use->reads || !write;
  use->writes = use->writes || write;
  if (write) use->last_version = ++target.version;
  return target.version;
}

void PassBuilder::read(ImageRef image, gpu::Access access, const gpu::ImageRange& range) {
  graph_.state_->add_use(pass_, image, access, false, range);
}
void PassBuilder::read(BufferRef buffer, gpu::Access access) { graph_.state_->add_use(pass_, buffer, access, false); }

ImageRef PassBuilder::write(ImageRef image, gpu::Access access, const gpu::ImageRange& range) {
  return {image.resource, graph_.state_->add_use(pass_, image, access, true, range), image.frame};
}
BufferRef PassBuilder::write(BufferRef buffer, gpu::Access access) {
  return {buffer.resource, graph_.state_->add_use(pass_, buffer, access, true), buffer.frame};
}

void PassBuilder::keep() {
  graph_.state_->check_declaring();
  graph_.state_->declaration.passes[pass_].keep = true;
}

void PassBuilder::execute(PassFunction function) {
  graph_.state_->check_declaring();
  graph_.state_->declaration.passes[pass_].function = std::move(function);
}

FrameGraph::FrameGraph(gpu::Device& device) : state_(std::make_unique<State>(device)) {}
FrameGraph::~FrameGraph() = default;

void FrameGraph::begin() {
  State& s = *state_;
  // The pass functions of the last frame are destroyed, so that their captures do not outlive that frame.
  for (DeclaredPass& pass : s.declaration.passes.all()) pass.function = nullptr;
  s.declaration.passes.forget();
  s.declaration.resources.forget();
  s.declaration.uses.clear();
  s.stage = State::Stage::declaring;
  s.plan = nullptr;
  s.recording_pass = frame::kNone;
  s.view = 0;
  s.recorded = {};
  ++s.frame_number;
}

namespace {

/// Slots are reused, so every field that is used for this kind of resource is set.
DeclaredResource& add_resource(frame::Declaration& declaration, bool is_image, bool imported) {
  DeclaredResource& resource = declaration.resources.add();
  resource.is_image = is_image;
  resource.imported = imported;
  resource.image = {};
  resource.buffer = {};
  resource.before = gpu::Access::none;
  resource.after = gpu::Access::none;
  resource.version = 0;
  return resource;
}

}  // namespace

std::uint32_t FrameGraph::frame() const { return state_->frame_number; }

ImageRef FrameGraph::create_image(gpu::ImageDesc desc) {
  state_->check_declaring();
  GLOAM_ASSERT(desc.format != gpu::Format::undefined, "a transient image has a format: '" + desc.name + "'");
  GLOAM_ASSERT(desc.width > 0 && desc.height > 0 && desc.depth > 0 && desc.layers > 0 && desc.mips > 0,
               "a transient image has a width, a height, a layer and a mip: '" + desc.name + "'");
  add_resource(state_->declaration, true, false).image_desc = std::move(desc);
  return {state_->declaration.resources.size() - 1, 0, state_->frame_number};
}

BufferRef FrameGraph::create_buffer(gpu::BufferDesc desc) {
  state_->check_declaring();
  GLOAM_ASSERT(desc.size > 0, "a transient buffer has at least one byte: '" + desc.name + "'");
  GLOAM_ASSERT(desc.memory == gpu::MemoryKind::device, "a transient buffer is in device memory: '" + desc.name + "'");
  add_resource(state_->declaration, false, false).buffer_desc = std::move(desc);
  return {state_->declaration.resources.size() - 1, 0, state_->frame_number};
}

namespace {

/// Asserts that the image may be left ready for the access by its usage.
void check_import(std::string_view name, const gpu::ImageDesc& desc, gpu::Access access) {
  if (access == gpu::Access::none) return;
  const std::string subject = "import '" + std::string(name) + "': ";
  GLOAM_ASSERT(gpu::fits_image(access), subject + "images have no access " + std::string(name_of(access)));
  const gpu::ImageUsage needed = gpu::image_usage_of(access);
  const bool allowed = (static_cast<std::uint32_t>(needed) & ~static_cast<std::uint32_t>(desc.usage)) == 0;
  GLOAM_ASSERT(allowed,
               subject + "the usage of image \"" + desc.name + "\" does not allow " + std::string(name_of(access)));
}
void check_import(std::string_view name, const gpu::BufferDesc&, gpu::Access access) {
  GLOAM_ASSERT(access == gpu::Access::none || gpu::fits_buffer(access),
               "import '" + std::string(name) + "': buffers have no access " + std::string(name_of(access)));
}

}  // namespace

ImageRef FrameGraph::import_image(std::string_view name, gpu::ImageHandle image, gpu::Access before,
                                  gpu::Access after) {
  state_->check_declaring();
  GLOAM_ASSERT(image, "an import needs a living image: '" + std::string(name) + "'");
  for (const DeclaredResource& other : state_->declaration.resources.all()) {
    GLOAM_ASSERT(other.image != image, "an image is imported once a frame: '" + std::string(name) + "'");
  }
  for (const gpu::Access access : {before, after}) check_import(name, state_->device.desc(image), access);
  DeclaredResource& resource = add_resource(state_->declaration, true, true);
  resource.image_desc.name = name;
  resource.image_desc.mips = resource.image_desc.layers = 1;
  resource.image = image;
  resource.before = before;
  resource.after = after;
  return {state_->declaration.resources.size() - 1, 0, state_->frame_number};
}

BufferRef FrameGraph::import_buffer(std::string_view name, gpu::BufferHandle buffer, gpu::Access before,
                                    gpu::Access after) {
  state_->check_declaring();
  GLOAM_ASSERT(buffer, "an import needs a living buffer: '" + std::string(name) + "'");
  for (const DeclaredResource& other : state_->declaration.resources.all()) {
    GLOAM_ASSERT(other.buffer != buffer, "a buffer is imported once a frame: '" + std::string(name) + "'");
  }
  for (const gpu::Access access : {before, after}) check_import(name, state_->device.desc(buffer), access);
  DeclaredResource& resource = add_resource(state_->declaration, false, true);
  resource.buffer_desc.name = name;
  resource.buffer = buffer;
  resource.before = before;
  resource.after = after;
  return {state_->declaration.resources.size() - 1, 0, state_->frame_number};
}

void FrameGraph::set_view(std::uint32_t view) { state_->view = view; }

PassBuilder FrameGraph::add_pass(std::string_view name, std::string_view module) {
  state_->check_declaring();
  DeclaredPass& pass = state_->declaration.passes.add();
  pass.name = name;
  pass.module = module;
  pass.view = state_->view;
  pass.first_use = static_cast<std::uint32_t>(state_->declaration.uses.size());
  pass.use_count = 0;
  pass.keep = false;
  pass.function = nullptr;
  return {*this, state_->declaration.passes.size() - 1};
}

ImageRef FrameGraph::newest(ImageRef image) const {
  return {image.resource, state_->resource(image).version, image.frame};
}

BufferRef FrameGraph::newest(BufferRef buffer) const {
  return {buffer.resource, state_->resource(buffer).version, buffer.frame};
}

const gpu::ImageDesc& FrameGraph::desc(ImageRef image) const {
  const DeclaredResource& resource = state_->resource(image);
  return resource.imported ? state_->device.desc(resource.image) : resource.image_desc;
}
const gpu::BufferDesc& FrameGraph::desc(BufferRef buffer) const {
  const DeclaredResource& resource = state_->resource(buffer);
  return resource.imported ? state_->device.desc(resource.buffer) : resource.buffer_desc;
}

}  // namespace gloam
