// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/frame/random_frames.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "engine/core/assert.h"

namespace gloam::test {

namespace {

using gpu::Access;

constexpr std::array kImageAccesses = {Access::compute_write, Access::compute_read,  Access::compute_storage_read,
                                       Access::color_target,  Access::fragment_read, Access::transfer_write,
                                       Access::transfer_read};
constexpr std::array kBufferAccesses = {Access::compute_write, Access::compute_read,  Access::uniform_read,
                                        Access::indirect_read, Access::vertex_input,  Access::transfer_write,
                                        Access::transfer_read, Access::fragment_read, Access::fragment_write};
constexpr std::uint32_t kBufferUnit = 16;
constexpr std::uint64_t kScratchBytes = std::uint64_t{1} << 18;
constexpr std::uint64_t kScratchStep = 1024;  ///< largest size of one copy, in bytes
constexpr std::uint32_t kMostPasses = 80;     ///< each makes at most 3 copies
constexpr Access kRest = Access::compute_read;
constexpr auto kAllImageUsage = static_cast<gpu::ImageUsage>(0x1f);  // all but depth_target
constexpr auto kAllBufferUsage = static_cast<gpu::BufferUsage>(0x7f);

/// The value that a pass writes: never 0, and different from those of its neighbours.
std::uint8_t value_of(std::uint32_t pass) { return static_cast<std::uint8_t>(1 + pass % 255); }

/// An endless sequence of numbers made from a finite list.
class Numbers {
 public:
  explicit Numbers(const std::vector<std::uint32_t>& numbers) : numbers_(numbers) {}
  std::uint32_t below(std::uint32_t bound) {
    const std::uint32_t n = numbers_.empty() ? 0 : numbers_[at_ % numbers_.size()];
    const auto turn = static_cast<std::uint32_t>(at_++ * 2654435761u);
    return ((n ^ turn) >> 8) % bound;
  }

 private:
  const std::vector<std::uint32_t>& numbers_;
  std::size_t at_ = 0;
};

}  // namespace

RandomFrame RandomFrame::from(const std::vector<std::uint32_t>& numbers) {
  Numbers next(numbers);
  RandomFrame frame;
  const std::uint32_t resource_count = 2 + next.below(10);
  for (std::uint32_t r = 0; r < resource_count; ++r) {
    Resource& resource = frame.resources.emplace_back(Resource{.is_image = next.below(2) == 0,
                                                               .imported = next.below(4) == 0,
                                                               .content_kept = next.below(2) == 0,
                                                               .size = 4 + 4 * next.below(3)});
    if (!resource.is_image || next.below(2) == 0) continue;
    resource.mips = 1 + next.below(3);
    resource.layers = 1 + next.below(3);
  }
  std::vector<gpu::Subresources<int>> written;  // 0 or 1
  for (const Resource& resource : frame.resources) written.emplace_back(resource.mips, resource.layers);
  for (std::size_t p = 0; p < std::min<std::size_t>(numbers.size() / 2 + 1, kMostPasses); ++p) {
    Pass& pass = frame.passes.emplace_back();
    pass.keep = next.below(8) == 0;
    const std::uint32_t use_count = 1 + next.below(3);
    for (std::uint32_t u = 0; u < use_count; ++u) {
      const std::uint32_t r = next.below(resource_count);
      const Resource& resource = frame.resources[r];
      Use use{.resource = r};
      if (next.below(3) != 0) use.range = {next.below(resource.mips), 1, next.below(resource.layers), 1};
      if (resource.mips * resource.layers == 1) use.range = {};
      const bool taken = std::ranges::any_of(
          pass.uses, [&](const Use& other) { return other.resource == r && resource.overlap(other.range, use.range); });
      if (taken) continue;
      use.access = resource.is_image ? kImageAccesses[next.below(kImageAccesses.size())]
                                     : kBufferAccesses[next.below(kBufferAccesses.size())];
      const gpu::ImageRange range = gpu::resolve(use.range, resource.mips, resource.layers);
      bool readable = true;
      written[r].visit(range, [&](int part) { readable = readable && (part != 0 || resource.imported); });
      if (!readable && !gpu::is_write(use.access)) use.access = Access::transfer_write;
      if (gpu::is_write(use.access)) written[r].set(range, 1);
      pass.uses.push_back(use);
    }
  }
  return frame;
}

bool RandomFrame::Resource::overlap(const gpu::ImageRange& a, const gpu::ImageRange& b) const {
  return gpu::overlap(gpu::resolve(a, mips, layers), gpu::resolve(b, mips, layers));
}

std::vector<bool> RandomFrame::reachable() const {
  const auto count = passes.size();
  std::vector<std::size_t> open;
  std::vector<bool> reached(count, false);
  for (std::size_t p = 0; p < count; ++p) {
    bool root = passes[p].keep;
    for (const Use& use : passes[p].uses)
      root = root || (gpu::is_write(use.access) && resources[use.resource].imported);
    if (root) open.push_back(p);
  }
  while (!open.empty()) {
    const std::size_t p = open.back();
    open.pop_back();
    if (reached[p]) continue;
    reached[p] = true;
    for (std::size_t earlier = 0; earlier < p; ++earlier) {
      for (const Use& use : passes[earlier].uses) {
        const bool feeds =
            gpu::is_write(use.access) && std::ranges::any_of(passes[p].uses, [&](const Use& later) {
              return later.resource == use.resource && resources[use.resource].overlap(later.range, use.range);
            });
        if (feeds) open.push_back(earlier);
      }
    }
  }
  return reached;
}

frame::Declaration RandomFrame::declaration() const {
  frame::Declaration declaration;
  for (const Resource& resource : resources) {
    frame::DeclaredResource& r = declaration.resources.add();
    r.is_image = resource.is_image;
    r.imported = resource.imported;
    r.image_desc = {.format = gpu::Format::rgba8_unorm,
                    .width = resource.size,
                    .height = resource.size,
                    .layers = resource.layers,
                    .mips = resource.mips};
    r.buffer_desc = {.size = std::uint64_t{resource.size} * kBufferUnit};
  }
  for (const Pass& pass : passes) {
    frame::DeclaredPass& p = declaration.passes.add();
    p.keep = pass.keep;
    p.first_use = static_cast<std::uint32_t>(declaration.uses.size());
    p.use_count = static_cast<std::uint32_t>(pass.uses.size());
    for (const Use& use : pass.uses) {
      const bool write = gpu::is_write(use.access);
      declaration.uses.push_back({.resource = use.resource,
                                  .accesses = gpu::mask_of(use.access),
                                  .reads = !write,
                                  .writes = write,
                                  .range = use.range});
    }
  }
  return declaration;
}

RandomFrameRunner::RandomFrameRunner(const RandomFrame& frame, gpu::Device& device, bool with_shaders)
    : frame_(frame), device_(device), with_shaders_(with_shaders) {
  for (const RandomFrame::Resource& resource : frame.resources) contents_.emplace_back(resource.mips, resource.layers);
  scratch_ = device_
                 .create_buffer({.name = "scratch",
                                 .module = "test",
                                 .size = kScratchBytes,
                                 .usage = gpu::BufferUsage::transfer_target,
                                 .memory = gpu::MemoryKind::readback})
                 .value();
  make_imports();
  if (!with_shaders_) return;
  compute_ = device_.create_pipeline(gpu::ComputePipelineDesc{.name = "kernel"}).value();
  paint_ = device_.create_pipeline(gpu::GraphicsPipelineDesc{.name = "paint"}).value();
  paint_stream_ =
      device_.create_pipeline(gpu::GraphicsPipelineDesc{.name = "paint stream", .stream_strides = {4}}).value();
}

RandomFrameRunner::~RandomFrameRunner() {
  for (const Imported& imported : imports_) {
    if (imported.image) device_.destroy(imported.image);
    if (imported.buffer) device_.destroy(imported.buffer);
  }
  for (gpu::PipelineHandle pipeline : {compute_, paint_, paint_stream_}) {
    if (pipeline) device_.destroy(pipeline);
  }
  device_.destroy(scratch_);
}

gpu::ImageDesc RandomFrameRunner::image_desc(const RandomFrame::Resource& resource, std::string name) const {
  return {.name = std::move(name),
          .module = "test",
          .format = gpu::Format::rgba8_unorm,
          .width = resource.size,
          .height = resource.size,
          .layers = resource.layers,
          .mips = resource.mips,
          .shape = gpu::ImageShape::array};
}

void RandomFrameRunner::make_imports() {
  for (std::size_t r = 0; r < frame_.resources.size(); ++r) {
    const RandomFrame::Resource& resource = frame_.resources[r];
    Imported& imported = imports_.emplace_back();
    if (!resource.imported) continue;
    const std::string name = "import " + std::to_string(r);
    if (resource.is_image) {
      gpu::ImageDesc desc = image_desc(resource, name);
      desc.usage = kAllImageUsage;
      imported.image = device_.create_image(desc).value();
    } else {
      imported.buffer = device_
                            .create_buffer({.name = name,
                                            .module = "test",
                                            .size = std::uint64_t{resource.size} * kBufferUnit,
                                            .usage = kAllBufferUsage})
                            .value();
    }
  }
}

void RandomFrameRunner::declare_resources(std::vector<ImageRef>& images, std::vector<BufferRef>& buffers) {
  images.resize(frame_.resources.size());
  buffers.resize(frame_.resources.size());
  for (std::size_t r = 0; r < frame_.resources.size(); ++r) {
    const RandomFrame::Resource& resource = frame_.resources[r];
    const std::string name = "resource " + std::to_string(r);
    const Access before = resource.content_kept && imports_[r].used ? kRest : Access::none;
    const Access after = resource.content_kept ? kRest : Access::none;
    if (!resource.imported || before == Access::none) contents_[r].set(contents_[r].all(), {});
    if (resource.imported && resource.is_image) {
      images[r] = graph_.import_image(name, imports_[r].image, before, after);
    } else if (resource.imported) {
      buffers[r] = graph_.import_buffer(name, imports_[r].buffer, before, after);
    } else if (resource.is_image) {
      images[r] = graph_.create_image(image_desc(resource, name));
    } else {
      buffers[r] =
          graph_.create_buffer({.name = name, .module = "test", .size = std::uint64_t{resource.size} * kBufferUnit});
    }
    imports_[r].used = true;
  }
}

std::vector<std::string> RandomFrameRunner::run(std::uint32_t pass_count) {
  ran_.clear();
  expected_.clear();
  scratch_used_ = 0;
  gpu::CommandList* commands = device_.begin_frame().value();
  graph_.begin();
  std::vector<ImageRef> images;
  std::vector<BufferRef> buffers;
  declare_resources(images, buffers);
  for (std::uint32_t p = 0; p < pass_count; ++p) {
    const RandomFrame::Pass& pass = frame_.passes[p];
    PassBuilder builder = graph_.add_pass("p" + std::to_string(p), "test");
    if (pass.keep) builder.keep();
    for (const RandomFrame::Use& use : pass.uses) {
      const bool write = gpu::is_write(use.access);
      const bool is_image = frame_.resources[use.resource].is_image;
      if (write && is_image) images[use.resource] = builder.write(images[use.resource], use.access, use.range);
      if (write && !is_image) buffers[use.resource] = builder.write(buffers[use.resource], use.access);
      if (!write && is_image) builder.read(images[use.resource], use.access, use.range);
      if (!write && !is_image) builder.read(buffers[use.resource], use.access);
    }
    // Captures the resource versions of this pass for the time when it records.
    builder.execute([this, p, images, buffers](PassContext& context) { record(context, p, images, buffers); });
  }
  const Status compiled = graph_.compile();
  GLOAM_ASSERT(compiled.ok(), "a small frame finds its memory");
  graph_.execute(*commands);
  make_scratch_ready(*commands, Access::host_read);
  const Status submitted = device_.submit_frame();
  GLOAM_ASSERT(submitted.ok(), "a small frame can be submitted");
  return ran_;
}

void RandomFrameRunner::record(PassContext& context, std::uint32_t pass, const std::vector<ImageRef>& images,
                               const std::vector<BufferRef>& buffers) {
  ran_.push_back("p" + std::to_string(pass));
  for (const RandomFrame::Use& use : frame_.passes[pass].uses) {
    follow_contents(pass, use);
    if (frame_.resources[use.resource].is_image) {
      touch_image(context.commands(), context.image(images[use.resource]), use, value_of(pass));
    } else {
      touch_buffer(context.commands(), context.buffer(buffers[use.resource]), use.access, value_of(pass));
    }
  }
}

void RandomFrameRunner::follow_contents(std::uint32_t pass, const RandomFrame::Use& use) {
  const RandomFrame::Resource& resource = frame_.resources[use.resource];
  auto& contents = contents_[use.resource];
  const gpu::ImageRange range = gpu::resolve(use.range, resource.mips, resource.layers);
  if (use.access == Access::transfer_write || use.access == Access::color_target) {
    contents.set(range, value_of(pass));
  } else if (gpu::is_write(use.access)) {
    contents.set(range, {});
  } else if (use.access == Access::transfer_read) {
    contents.visit({range.first_mip, 1, range.first_layer, 1}, [&](std::optional<std::uint8_t> content) {
      if (!content.has_value()) return;
      expected_.push_back(
          {scratch_used_, *content,
           "pass " + std::to_string(pass) + ", resource " + std::to_string(use.resource) + text_of(use.range)});
    });
  }
}

std::string RandomFrameRunner::wrong_contents() {
  std::string wrong;
  for (const Expected& e : expected_) {
    const auto seen = static_cast<int>(device_.mapped(scratch_)[e.offset]);
    if (seen != e.value) wrong += e.text + ": " + std::to_string(seen) + " for " + std::to_string(e.value) + "\n";
  }
  return wrong;
}

void RandomFrameRunner::make_scratch_ready(gpu::CommandList& commands, Access access) {
  const gpu::BufferBarrier barrier{.buffer = scratch_, .after = access};
  commands.barrier({&barrier, 1}, {});
}

void RandomFrameRunner::dispatch(gpu::CommandList& commands, const gpu::Binding& binding) {
  if (!with_shaders_) return;
  commands.bind_pipeline(compute_);
  commands.bind({&binding, 1});
  commands.dispatch(1, 1, 1);
}

void RandomFrameRunner::draw(gpu::CommandList& commands, const gpu::Binding& binding) {
  if (!with_shaders_) return;
  commands.begin_rendering({.width = 4, .height = 4});
  commands.bind_pipeline(paint_);
  commands.bind({&binding, 1});
  commands.draw(3, 1, 0, 0);
  commands.end_rendering();
}

void RandomFrameRunner::touch_image(gpu::CommandList& commands, gpu::ImageHandle image, const RandomFrame::Use& use,
                                    std::uint8_t value) {
  const float color = static_cast<float>(value) / 255.0f;
  const gpu::ImageDesc& desc = device_.desc(image);
  const gpu::ImageRange range = gpu::resolve(use.range, desc);
  gpu::ImageView view{image, range.first_mip, range.mip_count, range.first_layer, range.layer_count};
  switch (use.access) {
    case Access::compute_write:
    case Access::compute_storage_read:
      return dispatch(commands, {0, gpu::Binding::Storage{.view = view}});
    case Access::compute_read:
      return dispatch(commands, {0, gpu::Binding::Sampled{.view = view}});
    case Access::fragment_read:
      return draw(commands, {0, gpu::Binding::Sampled{.view = view}});
    case Access::color_target:
      for (view.mip_count = 1; view.first_mip < range.first_mip + range.mip_count; ++view.first_mip) {
        const std::uint32_t side = 4u >> view.first_mip;
        commands.begin_rendering(
            {.colors = {{.view = view, .clear = {color, color, color, color}}}, .width = side, .height = side});
        commands.end_rendering();
      }
      return;
    case Access::transfer_write: {
      const auto bits = std::bit_cast<std::uint32_t>(color);
      return commands.clear_color_image(image, {bits, bits, bits, bits}, use.range);
    }
    default:
      make_scratch_ready(commands, Access::transfer_write);
      commands.copy_image_to_buffer(image, range.first_mip, range.first_layer, scratch_, scratch_used_);
      scratch_used_ += kScratchStep;
  }
}

void RandomFrameRunner::touch_buffer(gpu::CommandList& commands, gpu::BufferHandle buffer, Access access,
                                     std::uint8_t value) {
  switch (access) {
    case Access::compute_write:
    case Access::compute_read:
    case Access::uniform_read:
      return dispatch(commands, {0, gpu::Binding::BufferRange{.buffer = buffer}});
    case Access::fragment_read:
    case Access::fragment_write:
      return draw(commands, {0, gpu::Binding::BufferRange{.buffer = buffer}});
    case Access::indirect_read:
      if (!with_shaders_) return;
      commands.bind_pipeline(compute_);
      return commands.dispatch_indirect(buffer, 0);
    case Access::vertex_input:
      if (!with_shaders_) return;
      commands.begin_rendering({.width = 4, .height = 4});
      commands.bind_pipeline(paint_stream_);
      commands.bind_vertex_stream(0, buffer, 0);
      commands.draw(3, 1, 0, 0);
      return commands.end_rendering();
    case Access::transfer_write:
      return commands.fill_buffer(buffer, 0, kBufferUnit, value);
    default:
      make_scratch_ready(commands, Access::transfer_write);
      commands.copy_buffer(buffer, 0, scratch_, scratch_used_, kBufferUnit);
      scratch_used_ += kScratchStep;
  }
}

}  // namespace gloam::test
