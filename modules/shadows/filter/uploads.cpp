// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/filter/uploads.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <utility>

#include "modules/lights/outputs.h"
#include "modules/shadows/filter/cookies.h"
#include "modules/shadows/views/cascade_rows.h"

namespace gloam {
namespace {

constexpr std::uint32_t kFewestRows = 16;

static_assert(sizeof(shaders::ShadowRow) == GLOAM_SHADOW_ROW_TEXELS * sizeof(vec4));

/// A copy from staging memory into an image.
struct Copy {
  ImageRef target;
  UploadSlice source;
  std::uint32_t layers = 1;
};

UploadSlice stage(FrameBuilder& frame, UploadRing& staging, std::span<const std::byte> bytes) {
  auto slice = staging.allocate(bytes.size());
  if (!frame.check(slice)) return {};
  std::memcpy(slice->bytes.data(), bytes.data(), bytes.size());
  return *slice;
}

void record_copy(PassContext& context, const Copy& copy) {
  context.commands().copy_buffer_to_image(copy.source.buffer, copy.source.offset, context.image(copy.target), 0, 0,
                                          copy.layers);
}

float cookie_layer(const World& world, Entity entity, const Cookies& cookies) {
  const Light* light = world.try_get<Light>(entity);
  if (light == nullptr || !has_cookie(*light)) return -1.0f;
  const auto layer = cookies.layers.find(light->cookie);
  return layer == cookies.layers.end() ? -1.0f : static_cast<float>(layer->second);
}

float traced_layer(const TracedVisibility* traced, Entity light) {
  const auto layer = traced == nullptr ? std::nullopt : traced->layer_of(light);
  return layer ? static_cast<float>(*layer) : -1.0f;
}

std::vector<shaders::ShadowRow> rows_of(const FrameBuilder& frame, const ViewFaces& view_faces,
                                        const TracedVisibility* traced) {
  const auto& visible = frame.world().view_resource<VisibleLights>(frame.view().id);
  const Cookies& cookies = frame.world().resource<Cookies>();
  std::vector<shaders::ShadowRow> rows = view_faces.rows;
  const std::span<const Entity> lights = local_lights(visible);
  rows.resize(lights.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].cookie_layer = cookie_layer(frame.world(), lights[i], cookies);
    rows[i].traced_layer = traced_layer(traced, lights[i]);
  }
  return rows;
}

/// Fills block.cookie_lights with the lights that have cookies, as far as there is room. All fit when the scene has at
/// most GLOAM_COOKIE_LIGHTS of them.
void name_cookies(std::span<const shaders::ShadowRow> rows, shaders::ShadowBlock& block) {
  std::fill(std::begin(block.cookie_lights), std::end(block.cookie_lights), ~0u);
  std::size_t named = 0;
  for (std::size_t i = 0; i < rows.size() && named < std::size(block.cookie_lights); ++i)
    if (rows[i].cookie_layer >= 0.0f) block.cookie_lights[named++] = static_cast<std::uint32_t>(i);
}

shaders::ShadowBlock block_of(const FrameBuilder& frame, const ViewFaces& view_faces, const ShadowKnobs& knobs,
                              const TracedVisibility* traced, std::span<const shaders::ShadowRow> rows) {
  shaders::ShadowBlock block = view_faces.block;
  name_cookies(rows, block);
  block.atlas_size = static_cast<float>(knobs.atlas_size);
  block.bias_m = knobs.bias_m;
  block.depth_quantum = knobs.d16 ? 1.0f / 65535.0f : 0.0f;
  const int bits = knobs.mip_operator == GLOAM_SHADOW_MIPS_COVERAGE ? 17 : 23;
  block.relative_quantum = 1.0f / static_cast<float>(1 << bits);
  const std::span<const Entity> lights =
      directional_lights(frame.world().view_resource<VisibleLights>(frame.view().id));
  for (std::size_t i = 0; i < std::size(block.directional); ++i)
    block.directional[i].traced_layer = i < lights.size() ? traced_layer(traced, lights[i]) : -1.0f;
  return block;
}

Copy add_rows(FrameBuilder& frame, ShadowStates& states, std::span<const shaders::ShadowRow> rows) {
  gpu::ImageDesc desc;
  desc.name = "shadow_rows";
  desc.module = "shadows";
  desc.format = gpu::Format::rgba32_float;
  desc.width = GLOAM_SHADOW_ROW_TEXELS;
  desc.height = static_cast<std::uint32_t>(rows.size());
  return {frame.graph().create_image(desc), stage(frame, states.staging(), std::as_bytes(rows))};
}

/// The world's cookies, with a copy into their image when it is not up to date: one layer per cookie. Null, and the
/// frame is given up, if the image cannot be created.
ImageRef add_cookies(FrameBuilder& frame, ShadowStates& states, std::vector<Copy>& copies) {
  const Cookies& cookies = frame.world().resource<Cookies>();
  gpu::ImageDesc desc;
  desc.name = "shadow_cookies";
  desc.module = "shadows";
  desc.format = gpu::Format::rgba8_srgb;
  desc.width = desc.height = cookies.texels.empty() ? 1 : kCookieSide;
  desc.layers = std::max(static_cast<std::uint32_t>(cookies.texels.size()), 1u);
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
  desc.shape = gpu::ImageShape::array;
  const auto kept = frame.history_image(
      desc,
      {.scope = HistoryScope::world, .final_access = gpu::Access::fragment_read, .reset = {.key = cookies.version}});
  if (!frame.check(kept)) return {};
  if (kept->filled()) return kept->image;
  std::vector<std::uint8_t> texels;
  for (const auto& layer : cookies.texels) texels.insert(texels.end(), layer.begin(), layer.end());
  if (texels.empty()) texels.assign(4, 255);
  copies.push_back({kept->image, stage(frame, states.staging(), std::as_bytes(std::span(texels))), desc.layers});
  return kept->image;
}

Copy add_traced(FrameBuilder& frame, ShadowStates& states, const TracedVisibility& traced) {
  gpu::ImageDesc desc;
  desc.name = "shadow_traced";
  desc.module = "shadows";
  desc.format = gpu::Format::r8_unorm;
  desc.width = traced.width;
  desc.height = traced.height;
  desc.layers = static_cast<std::uint32_t>(traced.lights.size());
  desc.shape = gpu::ImageShape::array;
  return {frame.graph().create_image(desc),
          stage(frame, states.traced_staging(), std::as_bytes(std::span(traced.visibility))), desc.layers};
}

}  // namespace

const TracedVisibility* traced_visibility_of(const World& world, const RenderView& view) {
  const TracedVisibility* traced = world.try_resource<TracedVisibility>();
  return traced != nullptr && traced->width == view.width && traced->height == view.height ? traced : nullptr;
}

ImageRef upload_shadow_rows(FrameBuilder& frame, ShadowStates& states, std::string_view pass_name,
                            std::span<const shaders::ShadowRow> rows) {
  Copy copy = add_rows(frame, states, rows);
  PassBuilder pass = frame.graph().add_pass(pass_name, frame.module());
  copy.target = pass.write(copy.target, gpu::Access::transfer_write);
  pass.execute([copy](PassContext& context) { record_copy(context, copy); });
  return copy.target;
}

ShadowUploads add_shadow_uploads(FrameBuilder& frame, ShadowStates& states, const ViewFaces& view_faces,
                                 const ShadowKnobs& knobs) {
  const TracedVisibility* traced = traced_visibility_of(frame.world(), frame.view());
  std::vector<shaders::ShadowRow> rows_now = rows_of(frame, view_faces, traced);
  shaders::ShadowBlock block_now = block_of(frame, view_faces, knobs, traced, rows_now);
  // Rounded up, so that few different heights occur and cached frame-graph plans can be reused when the number of
  // lights changes.
  rows_now.resize(std::bit_ceil(std::max<std::size_t>(rows_now.size(), kFewestRows)));
  append_cascade_rows(directional_looks(frame.world().view_resource<VisibleLights>(frame.view().id)), block_now,
                      rows_now);
  ShadowUploads uploads;
  auto block = frame.services().uniforms.write_value(block_now);
  if (frame.check(block)) uploads.block = *block;
  uploads.block_values = block_now;

  uploads.row_values = std::make_shared<const std::vector<shaders::ShadowRow>>(std::move(rows_now));
  std::vector<Copy> copies = {add_rows(frame, states, *uploads.row_values)};
  uploads.cookies = add_cookies(frame, states, copies);
  if (!uploads.cookies) return uploads;
  const bool has_traced = traced != nullptr && !traced->lights.empty();
  if (has_traced) copies.push_back(add_traced(frame, states, *traced));

  PassBuilder pass = frame.graph().add_pass("shadow_rows", frame.module());
  for (Copy& copy : copies) copy.target = pass.write(copy.target, gpu::Access::transfer_write);
  uploads.rows = copies.front().target;
  uploads.cookies = frame.graph().newest(uploads.cookies);
  if (has_traced) uploads.traced = copies.back().target;
  pass.execute([copies](PassContext& context) {
    for (const Copy& copy : copies) record_copy(context, copy);
  });
  return uploads;
}

}  // namespace gloam
