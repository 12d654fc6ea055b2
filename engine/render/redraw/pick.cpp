// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <iterator>
#include <utility>

#include "engine/core/text/formatted.h"
#include "engine/render/redraw/redraw.h"

namespace gloam {
namespace {

std::string vector_text(const vec3& v) {
  return formatted("%.4f %.4f %.4f", static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
}

GeometryTexel geometry_at(const Captures& copies, std::size_t at) {
  return decode_geometry(copies.item<std::uint32_t>("engine.base_color", at),
                         copies.item<glm::uvec2>("engine.normals", at),
                         copies.item<std::uint32_t>("engine.material", at));
}

void add_surface_lines(const GeometryTexel& g, float view_depth_m, std::vector<std::string>& lines) {
  lines.push_back(formatted("view depth %f m", static_cast<double>(view_depth_m)));
  lines.push_back("base colour " + vector_text(g.base_color) + (g.subsurface ? ", subsurface" : ""));
  lines.push_back("normal " + vector_text(g.normal) + ", face normal " + vector_text(g.face_normal));
  lines.push_back("roughness, metallic, occlusion " + vector_text({g.roughness, g.metallic, g.occlusion}));
}

/// Usage error if the view has no images, or if the pixel lies outside the picture. call: for the sentence.
Status check_pixel(const ViewStore& views, ViewId view, const char* call, std::uint32_t x, std::uint32_t y) {
  const ViewImages* images = views.find(view);
  if (images == nullptr)
    return Error{ErrorKind::usage,
                 "view " + std::to_string(view.value) + ": " + call + " needs a view of the last frame"};
  if (x < images->width && y < images->height) return {};
  return Error{ErrorKind::usage, "the picked pixel lies outside the picture"};
}

/// Declares the copies that picked_lines reads: texels of the geometry buffer and data of the modules.
Status add_pick_copies(FrameBuilder& builder, Captures& copies, const ModuleSet& modules) {
  const GeometryOutputs& g = builder.get<GeometryOutputs>();
  GLOAM_TRY(copies.add(builder.graph(), "engine.base_color", g.base_color));
  GLOAM_TRY(copies.add(builder.graph(), "engine.normals", g.normals));
  GLOAM_TRY(copies.add(builder.graph(), "engine.material", g.material));
  GLOAM_TRY(copies.add(builder.graph(), "engine.depth", g.depth));
  for (Module* module : modules.taking_part()) GLOAM_TRY(module->add_pick_copies(builder, copies));
  return {};
}

/// Facts of the engine and the modules about a pixel.
std::vector<std::string> picked_lines(const Redrawn& redrawn, const ModuleSet& modules, std::uint32_t x,
                                      std::uint32_t y) {
  const RenderView& view = redrawn.builder().view();
  const Captures& copies = *redrawn.copies;
  const std::size_t at = std::size_t{y} * view.width + x;
  PickedPixel pixel = {.x = x, .y = y, .depth = copies.item<float>("engine.depth", at)};
  std::vector<std::string> lines = {"pixel " + std::to_string(pixel.x) + "," + std::to_string(pixel.y) + " of tile " +
                                    std::to_string(pixel.x / kTileSize) + "," + std::to_string(pixel.y / kTileSize)};
  if (pixel.depth > 0.0f) {
    const GeometryTexel surface = geometry_at(copies, at);
    pixel.view_depth_m = view.view_depth(pixel.depth);
    pixel.position = vec3(surface_position(view, x, y, pixel.depth));
    pixel.normal = surface.normal;
    add_surface_lines(surface, pixel.view_depth_m, lines);
  } else {
    lines.emplace_back("sky");
  }
  for (const Module* module : modules.taking_part()) {
    std::vector<std::string> more = module->pick(redrawn.builder(), pixel, copies);
    std::move(more.begin(), more.end(), std::back_inserter(lines));
  }
  return lines;
}

}  // namespace

Result<std::vector<std::string>> pick(RendererParts& parts, World& world, ViewId view, std::uint32_t x,
                                      std::uint32_t y) {
  GLOAM_TRY(check_pixel(parts.views, view, "pick", x, y));
  const auto redrawn = redraw(parts, world, view, [&](FrameBuilder& builder, Captures& copies) {
    return add_pick_copies(builder, copies, parts.modules);
  });
  if (!redrawn.ok()) return redrawn.error();
  return picked_lines(*redrawn, parts.modules, x, y);
}

Result<std::optional<dvec3>> pick_position(RendererParts& parts, World& world, ViewId view, std::uint32_t x,
                                           std::uint32_t y) {
  GLOAM_TRY(check_pixel(parts.views, view, "pick_position", x, y));
  const auto redrawn = redraw(parts, world, view, [](FrameBuilder& builder, Captures& copies) {
    return copies.add(builder.graph(), "engine.depth", builder.get<GeometryOutputs>().depth);
  });
  if (!redrawn.ok()) return redrawn.error();
  const RenderView& drawn = redrawn->builder().view();
  const float depth = redrawn->copies->item<float>("engine.depth", std::size_t{y} * drawn.width + x);
  if (!(depth > 0.0f)) return std::optional<dvec3>();
  return std::optional(drawn.position + surface_position(drawn, x, y, depth));
}

}  // namespace gloam
