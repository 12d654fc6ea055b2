// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/modules/lights/lists/find_lights_kernels.h"

#include <cstring>

#include "engine/frame/transfers/upload.h"
#include "engine/render/camera/view_constants.h"
#include "shaders/lights/shaders.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {
namespace {

using gpu::Access;

/// One dispatch. It owns its resources.
class Dispatch {
 public:
  Dispatch(gpu::Device& device, gpu::SamplerHandle sampler) : device_(device), sampler_(sampler), uploader_(device) {}
  ~Dispatch() {
    for (const gpu::BufferHandle buffer : buffers_) device_.destroy(buffer);
    for (const gpu::ImageHandle image : images_) device_.destroy(image);
  }
  Dispatch(const Dispatch&) = delete;
  Dispatch& operator=(const Dispatch&) = delete;

  template <class T>
  void input(std::uint32_t binding, std::span<const T> items) {
    buffers_.push_back(make_upload(device_, items));
    bindings_.push_back({binding, gpu::Binding::BufferRange{buffers_.back()}});
  }
  /// A buffer that the kernel may read and write.
  template <class T>
  gpu::BufferHandle in_out(std::uint32_t binding, std::span<const T> items) {
    const gpu::BufferHandle buffer = make_readback(device_, items.size_bytes());
    std::memcpy(device_.mapped(buffer).data(), items.data(), items.size_bytes());
    buffers_.push_back(buffer);
    bindings_.push_back({binding, gpu::Binding::BufferRange{buffer}});
    results_.push_back(buffer);
    return buffer;
  }
  template <class T>
  void sampled(std::uint32_t binding, gpu::Format format, uvec2 size, std::span<const T> texels) {
    const gpu::ImageHandle made = image(format, size, texels, Access::compute_read);
    bindings_.push_back({binding, gpu::Binding::Sampled{{.image = made}, sampler_}});
  }
  /// The storage image of the tile lists.
  gpu::BufferHandle lists(std::uint32_t binding, uvec2 size, std::span<const uvec2> texels) {
    image_ = image(gpu::Format::rg32_uint, size, texels, Access::compute_write);
    image_back_ = make_readback(device_, texels.size_bytes());
    buffers_.push_back(image_back_);
    bindings_.push_back({binding, gpu::Binding::Storage{{.image = image_}}});
    return image_back_;
  }
  void run(gpu::PipelineHandle pipeline, uvec2 groups) {
    const Status uploaded = uploader_.flush();
    ASSERT_TRUE(uploaded.ok()) << uploaded.error().message;
    run_frame(device_, [&](gpu::CommandList& commands) {
      commands.bind_pipeline(pipeline);
      commands.bind(bindings_);
      commands.dispatch(groups.x, groups.y, 1);
      if (image_) {
        const gpu::ImageBarrier barrier{image_, Access::compute_write, Access::transfer_read};
        commands.barrier({}, std::span(&barrier, 1));
        commands.copy_image_to_buffer(image_, 0, 0, image_back_, 0);
        const gpu::BufferBarrier done{image_back_, Access::transfer_write, Access::host_read};
        commands.barrier(std::span(&done, 1), {});
      }
      for (const gpu::BufferHandle buffer : results_) {
        const gpu::BufferBarrier done{buffer, Access::compute_write, Access::host_read};
        commands.barrier(std::span(&done, 1), {});
      }
    });
  }

 private:
  template <class T>
  gpu::ImageHandle image(gpu::Format format, uvec2 size, std::span<const T> texels, Access access) {
    using enum gpu::ImageUsage;
    gpu::ImageDesc desc{.name = "test image", .module = "test", .format = format, .width = size.x, .height = size.y};
    desc.usage =
        transfer_target | (access == Access::compute_read ? gpu::ImageUsage::sampled : storage | transfer_source);
    images_.push_back(value_of(device_.create_image(desc)));
    const auto bytes = std::as_bytes(texels);
    uploader_.image(images_.back(), {bytes.begin(), bytes.end()}, access);
    return images_.back();
  }

  gpu::Device& device_;
  gpu::SamplerHandle sampler_;
  Uploader uploader_;
  std::vector<gpu::BufferHandle> buffers_;
  std::vector<gpu::BufferHandle> results_;
  std::vector<gpu::ImageHandle> images_;
  std::vector<gpu::Binding> bindings_;
  gpu::ImageHandle image_;
  gpu::BufferHandle image_back_;
};

/// Sets bindings 0 to 2, and the light texels in the layout of light_texels.comp.
void bind_view(Dispatch& dispatch, const SearchedScene& scene) {
  const shaders::ViewConstants view = view_constants(scene.view);
  dispatch.input(0, std::span<const shaders::ViewConstants>(&view, 1));
  dispatch.input(1, std::span<const shaders::LightBlock>(scene.lights.get(), 1));
  dispatch.input(2, std::span<const shaders::LightGrid>(&scene.grid, 1));
  std::vector<vec4> texels;
  for (std::uint32_t i = 0; i < scene.lights->local_count; ++i) {
    const shaders::LocalLight& light = scene.lights->local[i];
    texels.emplace_back(light.position, light.inverse_range_squared);
    texels.emplace_back(light.color, light.spot_scale);
    texels.emplace_back(light.direction, light.spot_offset);
  }
  if (texels.empty()) texels.resize(3);  // an image needs at least one texel
  dispatch.sampled(4, gpu::Format::rgba32_float, {3, static_cast<std::uint32_t>(texels.size() / 3)},
                   std::span<const vec4>(texels));
}

template <class T>
void read(gpu::Device& device, gpu::BufferHandle buffer, std::vector<T>& items) {
  items = items_of<T>(device, buffer);
}

}  // namespace

FindLights::FindLights(gpu::Device& device, std::uint32_t rows) : device_(device) {
  const auto make = [&](gpu::ShaderCode code, gpu::SpecConstants constants = {}) {
    return value_of(
        device.create_pipeline(gpu::ComputePipelineDesc{std::string(code.name), "test", code, std::move(constants)}));
  };
  approx_ = make(shaders::lights::find_lights_approx_comp);
  accurate_ = make(shaders::lights::find_lights_accurate_comp,
                   rows == 0 ? gpu::SpecConstants{} : gpu::SpecConstants{{"local_size_y", rows}});
  accurate_tiles_ = make(shaders::lights::find_lights_accurate_tiles_comp);
  check_ = make(shaders::lights::check_lists_comp);
  sampler_ = value_of(device.create_sampler(
      {.min_filter = gpu::Filter::nearest, .mag_filter = gpu::Filter::nearest, .mip_filter = gpu::Filter::nearest}));
}

FindLights::~FindLights() {
  for (const gpu::PipelineHandle pipeline : {approx_, accurate_, accurate_tiles_, check_}) device_.destroy(pipeline);
}

FoundLights FindLights::approximate(const SearchedScene& scene) {
  FoundLights found;
  found.group_masks.assign(std::size_t{scene.group_count()} * GLOAM_MASK_WORDS, FoundLights::kUntouched);
  found.tile_lists.assign(scene.tile_count(), uvec2(FoundLights::kUntouched));
  found.early_lists.assign(scene.grid.slot_capacity / 3 + 1, FoundLights::kUntouched);
  found.counters.farthest_depth = 0x3F800000u;
  Dispatch dispatch(device_, sampler_);
  bind_view(dispatch, scene);
  dispatch.sampled(3, gpu::Format::rg32_float, scene.grid.tiles, std::span<const vec2>(scene.bounds));
  dispatch.input(5, std::span<const std::uint32_t>(scene.z_bins));
  dispatch.input(6, std::span<const std::uint32_t>(scene.mask_tiles));
  const auto masks = dispatch.in_out(7, std::span<const std::uint32_t>(found.group_masks));
  const auto lists = dispatch.lists(8, scene.grid.tiles, found.tile_lists);
  const auto counters = dispatch.in_out(9, std::span<const shaders::LightCounters>(&found.counters, 1));
  dispatch.run(approx_, scene.grid.groups);
  read(device_, masks, found.group_masks);
  read(device_, lists, found.tile_lists);
  found.counters = items_of<shaders::LightCounters>(device_, counters).front();
  return found;
}

void FindLights::accurate(const SearchedScene& scene, FoundLights& found) {
  FoundLights by_tiles = found;
  run_accurate(accurate_, scene.grid.tiles, scene, found);
  run_accurate(accurate_tiles_, scene.grid.groups, scene, by_tiles);
  EXPECT_EQ(by_tiles.tile_lists, found.tile_lists) << "one thread a tile and many find other lights";
  EXPECT_EQ(std::memcmp(&by_tiles.counters, &found.counters, sizeof(found.counters)), 0);
  for (std::uint32_t tile = 0; tile < scene.tile_count() && by_tiles.tile_lists == found.tile_lists; ++tile)
    EXPECT_TRUE(!found.has_list(tile) || by_tiles.list(tile) == found.list(tile)) << "tile " << tile;
}

void FindLights::run_accurate(gpu::PipelineHandle pipeline, uvec2 workgroups, const SearchedScene& scene,
                              FoundLights& found) {
  Dispatch dispatch(device_, sampler_);
  bind_view(dispatch, scene);
  dispatch.sampled(3, gpu::Format::r32_float, scene.size(), std::span<const float>(scene.depth));
  dispatch.sampled(5, gpu::Format::rg32_float, scene.grid.tiles, std::span<const vec2>(scene.bounds));
  dispatch.input(6, std::span<const std::uint32_t>(found.group_masks));
  const auto lists = dispatch.lists(7, scene.grid.tiles, found.tile_lists);
  const auto early = dispatch.in_out(8, std::span<const std::uint32_t>(found.early_lists));
  const auto counters = dispatch.in_out(9, std::span<const shaders::LightCounters>(&found.counters, 1));
  dispatch.run(pipeline, workgroups);
  read(device_, lists, found.tile_lists);
  read(device_, early, found.early_lists);
  found.counters = items_of<shaders::LightCounters>(device_, counters).front();
}

void FindLights::check(const SearchedScene& scene, FoundLights& found) {
  Dispatch dispatch(device_, sampler_);
  bind_view(dispatch, scene);
  dispatch.sampled(3, gpu::Format::r32_float, scene.size(), std::span<const float>(scene.depth));
  dispatch.input(5, std::span<const std::uint32_t>(found.group_masks));
  dispatch.sampled(6, gpu::Format::rg32_uint, scene.grid.tiles, std::span<const uvec2>(found.tile_lists));
  dispatch.input(7, std::span<const std::uint32_t>(found.early_lists));
  const auto counters = dispatch.in_out(8, std::span<const shaders::LightCounters>(&found.counters, 1));
  dispatch.run(check_, scene.grid.tiles);
  found.counters = items_of<shaders::LightCounters>(device_, counters).front();
}

}  // namespace gloam::test
