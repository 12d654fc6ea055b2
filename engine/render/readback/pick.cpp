// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <iterator>

#include "engine/render/readback/geometry_picture.h"
#include "engine/render/renderer_state.h"

namespace gloam {
namespace {

std::string vector_text(const vec3& v) {
  char line[96];
  std::snprintf(line, sizeof(line), "%.4f %.4f %.4f", static_cast<double>(v.x), static_cast<double>(v.y),
                static_cast<double>(v.z));
  return line;
}

GeometryTexel geometry_at(const Captures& copies, std::size_t at) {
  return decode_geometry(copies.item<std::uint32_t>("engine.base_color", at),
                         copies.item<glm::uvec2>("engine.normals", at),
                         copies.item<std::uint32_t>("engine.material", at));
}

void add_surface_lines(const GeometryTexel& g, float view_depth_m, std::vector<std::string>& lines) {
  lines.push_back("view depth " + std::to_string(view_depth_m) + " m");
  lines.push_back("base colour " + vector_text(g.base_color) + (g.subsurface ? ", subsurface" : ""));
  lines.push_back("normal " + vector_text(g.normal) + ", face normal " + vector_text(g.face_normal));
  lines.push_back("roughness, metallic, occlusion " + vector_text({g.roughness, g.metallic, g.occlusion}));
}

}  // namespace

Status Renderer::State::add_pick_copies(FrameBuilder& builder) {
  const GeometryOutputs& g = builder.get<GeometryOutputs>();
  GLOAM_TRY(copies->add(graph, "engine.base_color", g.base_color));
  GLOAM_TRY(copies->add(graph, "engine.normals", g.normals));
  GLOAM_TRY(copies->add(graph, "engine.material", g.material));
  GLOAM_TRY(copies->add(graph, "engine.depth", g.depth));
  for (std::size_t i = 0; i < options.modules.size(); ++i)
    if (runtimes[i].in_last_view) GLOAM_TRY(options.modules[i]->add_pick_copies(builder, *copies));
  return {};
}

std::vector<std::string> Renderer::State::picked_lines(std::uint32_t x, std::uint32_t y) {
  FrameBuilder& frame = *builders.back();
  const RenderView& view = frame.view();
  const std::size_t at = std::size_t{y} * view.width + x;
  PickedPixel pixel = {.x = x, .y = y, .depth = copies->item<float>("engine.depth", at)};
  std::vector<std::string> lines = {"pixel " + std::to_string(pixel.x) + "," + std::to_string(pixel.y) + " of tile " +
                                    std::to_string(pixel.x / kTileSize) + "," + std::to_string(pixel.y / kTileSize)};
  if (pixel.depth > 0.0f) {
    const GeometryTexel surface = geometry_at(*copies, at);
    pixel.view_depth_m = view.view_depth(pixel.depth);
    pixel.position = vec3(surface_position(view, x, y, pixel.depth));
    pixel.normal = surface.normal;
    add_surface_lines(surface, pixel.view_depth_m, lines);
  } else {
    lines.emplace_back("sky");
  }
  for (std::size_t i = 0; i < options.modules.size(); ++i) {
    if (!runtimes[i].in_last_view) continue;
    std::vector<std::string> more = options.modules[i]->pick(frame, pixel, *copies);
    std::move(more.begin(), more.end(), std::back_inserter(lines));
  }
  return lines;
}

Result<std::vector<std::string>> Renderer::pick(World& world, ViewId view, std::uint32_t x, std::uint32_t y) {
  State& s = *state_;
  const auto images = s.images.find(view.value);
  GLOAM_ASSERT(images != s.images.end(),
               "view " + std::to_string(view.value) + ": pick needs a view of the last frame");
  if (x >= images->second.width || y >= images->second.height)
    return Error{ErrorKind::usage, "the picked pixel lies outside the picture"};
  GLOAM_TRY(draw_again(world, view, [&s](FrameBuilder& frame) { return s.add_pick_copies(frame); }));
  std::vector<std::string> lines = s.picked_lines(x, y);
  s.copies.reset();
  return lines;
}

Result<std::optional<dvec3>> Renderer::pick_position(World& world, ViewId view, std::uint32_t x, std::uint32_t y) {
  State& s = *state_;
  const auto images = s.images.find(view.value);
  GLOAM_ASSERT(images != s.images.end(), "pick_position needs a view of the last frame");
  if (x >= images->second.width || y >= images->second.height)
    return Error{ErrorKind::usage, "the picked pixel lies outside the picture"};
  GLOAM_TRY(draw_again(world, view, [&s](FrameBuilder& frame) {
    return s.copies->add(s.graph, "engine.depth", frame.get<GeometryOutputs>().depth);
  }));
  const RenderView& drawn = s.builders.back()->view();
  const float depth = s.copies->item<float>("engine.depth", std::size_t{y} * drawn.width + x);
  s.copies.reset();
  if (!(depth > 0.0f)) return std::optional<dvec3>();
  return std::optional(drawn.position + surface_position(drawn, x, y, depth));
}

}  // namespace gloam
