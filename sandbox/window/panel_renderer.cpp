// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/panel_renderer.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "shaders/sandbox/shaders.h"

namespace gloam {
namespace {

constexpr const char* kModule = "panel";

std::span<ImDrawList* const> lists_of(const ImDrawData& data) {
  return {data.CmdLists, static_cast<std::size_t>(data.CmdListsCount)};
}

}  // namespace

PanelRenderer::PanelRenderer(gpu::Device& device)
    : device_(device), pipelines_(device), ring_(device, kModule, gpu::BufferUsage::vertex | gpu::BufferUsage::index) {}

PanelRenderer::~PanelRenderer() {
  if (font_) device_.destroy(font_);
}

Result<std::unique_ptr<PanelRenderer>> PanelRenderer::create(gpu::Device& device, const FontTexels& font) {
  std::unique_ptr<PanelRenderer> renderer(new PanelRenderer(device));
  GLOAM_TRY(renderer->prepare(font));
  return renderer;
}

Status PanelRenderer::prepare(const FontTexels& font) {
  auto image = device_.create_image({.name = "panel_font",
                                     .module = kModule,
                                     .format = gpu::Format::r8_unorm,
                                     .width = font.width,
                                     .height = font.height,
                                     .usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target});
  if (!image.ok()) return image.error();
  font_ = *image;
  auto sampler = device_.create_sampler(
      {.address_u = gpu::AddressMode::clamp_to_edge, .address_v = gpu::AddressMode::clamp_to_edge});
  if (!sampler.ok()) return sampler.error();
  sampler_ = *sampler;
  Uploader uploader(device_);
  uploader.image(font_, {font.bytes.begin(), font.bytes.end()}, gpu::Access::fragment_read);
  return uploader.flush();
}

Result<gpu::PipelineHandle> PanelRenderer::pipeline_for(gpu::Format format) {
  gpu::GraphicsPipelineDesc desc;
  desc.name = "panel/" + std::string(gpu::name_of(format));
  desc.module = kModule;
  desc.vertex = shaders::sandbox::panel_vert;
  desc.fragment = shaders::sandbox::panel_frag;
  desc.constants = {{"kDecode", gpu::encodes_srgb(format) ? 1u : 0u}};
  desc.attributes = {{0, 0, gpu::Format::rg32_float, offsetof(ImDrawVert, pos)},
                     {1, 0, gpu::Format::rg32_float, offsetof(ImDrawVert, uv)},
                     {2, 0, gpu::Format::rgba8_unorm, offsetof(ImDrawVert, col)}};
  desc.stream_strides = {sizeof(ImDrawVert)};
  desc.color_formats = {format};
  desc.cull = gpu::CullMode::none;
  desc.blend = gpu::BlendMode::alpha;
  desc.depth_compare = gpu::CompareOp::always;
  desc.depth_write = false;
  return pipelines_.get(desc);
}

std::vector<PanelRenderer::DrawCall> PanelRenderer::draw_calls(const ImDrawData& data, std::uint32_t width,
                                                               std::uint32_t height) {
  std::vector<DrawCall> calls;
  std::uint32_t first_index = 0;
  std::uint32_t first_vertex = 0;
  for (const ImDrawList* list : lists_of(data)) {
    for (const ImDrawCmd& command : list->CmdBuffer) {
      // The window may have been resized since ImGui's layout: clip to the picture.
      const float left = std::max(command.ClipRect.x - data.DisplayPos.x, 0.0f);
      const float top = std::max(command.ClipRect.y - data.DisplayPos.y, 0.0f);
      const float right = std::min(command.ClipRect.z - data.DisplayPos.x, static_cast<float>(width));
      const float bottom = std::min(command.ClipRect.w - data.DisplayPos.y, static_cast<float>(height));
      if (command.ElemCount == 0 || right <= left || bottom <= top) continue;
      calls.push_back({.indices = command.ElemCount,
                       .first_index = first_index + command.IdxOffset,
                       .vertex_offset = static_cast<std::int32_t>(first_vertex + command.VtxOffset),
                       .x = static_cast<std::int32_t>(left),
                       .y = static_cast<std::int32_t>(top),
                       .width = static_cast<std::uint32_t>(right) - static_cast<std::uint32_t>(left),
                       .height = static_cast<std::uint32_t>(bottom) - static_cast<std::uint32_t>(top)});
    }
    first_index += static_cast<std::uint32_t>(list->IdxBuffer.Size);
    first_vertex += static_cast<std::uint32_t>(list->VtxBuffer.Size);
  }
  return calls;
}

Result<UploadSlice> PanelRenderer::upload_vertices(const ImDrawData& data) {
  auto slice = ring_.allocate(static_cast<std::uint64_t>(data.TotalVtxCount) * sizeof(ImDrawVert));
  if (!slice.ok()) return slice;
  std::byte* target = slice->bytes.data();
  for (const ImDrawList* list : lists_of(data)) {
    const auto size = static_cast<std::size_t>(list->VtxBuffer.size_in_bytes());
    if (size != 0) std::memcpy(target, list->VtxBuffer.Data, size);
    target += size;
  }
  return slice;
}

Result<UploadSlice> PanelRenderer::upload_indices(const ImDrawData& data) {
  auto slice = ring_.allocate(static_cast<std::uint64_t>(data.TotalIdxCount) * sizeof(std::uint32_t));
  if (!slice.ok()) return slice;
  std::byte* target = slice->bytes.data();
  for (const ImDrawList* list : lists_of(data)) {
    for (const ImDrawIdx narrow : list->IdxBuffer) {
      const std::uint32_t index = narrow;  // command lists take 32-bit indices
      std::memcpy(target, &index, sizeof(index));
      target += sizeof(index);
    }
  }
  return slice;
}

Status PanelRenderer::add_pass(FrameGraph& graph, ImageRef& picture, const ImDrawData& data) {
  ring_.begin_frame();
  if (data.TotalIdxCount == 0) return {};
  const gpu::ImageDesc& desc = graph.desc(picture);
  auto pipeline = pipeline_for(desc.format);
  if (!pipeline.ok()) return pipeline.error();
  auto vertices = upload_vertices(data);
  if (!vertices.ok()) return vertices.error();
  auto indices = upload_indices(data);
  if (!indices.ok()) return indices.error();

  const std::array size = {data.DisplaySize.x, data.DisplaySize.y};
  PassBuilder pass = graph.add_pass("panel", kModule);
  picture = pass.write(picture, gpu::Access::color_target);
  pass.execute([this, picture, size, width = desc.width, height = desc.height, pipeline = *pipeline,
                vertices = *vertices, indices = *indices,
                calls = draw_calls(data, desc.width, desc.height)](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    commands.begin_rendering({.colors = {{.view = {.image = context.image(picture)}, .load = gpu::LoadOp::load}},
                              .width = width,
                              .height = height});
    commands.set_viewport(0.0f, 0.0f, size[0], size[1]);
    commands.bind_pipeline(pipeline);
    const gpu::Binding font{0, gpu::Binding::Sampled{{.image = font_}, sampler_}};
    commands.bind({&font, 1});
    commands.push(size);
    commands.bind_vertex_stream(0, vertices.buffer, vertices.offset);
    commands.bind_indices(indices.buffer, indices.offset);
    for (const DrawCall& call : calls) {
      commands.set_scissor(call.x, call.y, call.width, call.height);
      commands.draw_indexed(call.indices, 1, call.first_index, call.vertex_offset, 0);
    }
    commands.end_rendering();
  });
  return {};
}

}  // namespace gloam
