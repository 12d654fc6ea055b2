// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <iterator>

#include "engine/render/renderer_state.h"

namespace gloam {
namespace {

std::string vector_text(const vec3& v) {
  char line[96];
  std::snprintf(line, sizeof(line), "%.4f %.4f %.4f", static_cast<double>(v.x), static_cast<double>(v.y),
                static_cast<double>(v.z));
  return line;
}

void add_surface_lines(const Captures& copies, std::size_t at, float view_depth_m, std::vector<std::string>& lines) {
  const GeometryTexel g =
      decode_geometry(copies.item<std::uint32_t>("engine.base_color", at),
                      copies.item<glm::uvec2>("engine.normals", at), copies.item<std::uint32_t>("engine.material", at));
  lines.push_back("view depth " + std::to_string(view_depth_m) + " m");
  lines.push_back("base colour " + vector_text(g.base_color) + (g.subsurface ? ", subsurface" : ""));
  lines.push_back("normal " + vector_text(g.normal) + ", face normal " + vector_text(g.face_normal));
  lines.push_back("roughness, metallic, occlusion " + vector_text({g.roughness, g.metallic, g.occlusion}));
}

}  // namespace

Status Renderer::State::add_pick_copies(FrameBuilder& builder) {
  copies = std::make_unique<Captures>(*options.device);
  const GeometryOutputs& g = builder.get<GeometryOutputs>();
  GLOAM_TRY(copies->add(graph, "engine.base_color", g.base_color));
  GLOAM_TRY(copies->add(graph, "engine.normals", g.normals));
  GLOAM_TRY(copies->add(graph, "engine.material", g.material));
  GLOAM_TRY(copies->add(graph, "engine.depth", g.depth));
  for (std::size_t i = 0; i < options.modules.size(); ++i)
    if (runtimes[i].in_last_view) GLOAM_TRY(options.modules[i]->add_pick_copies(builder, *copies));
  return {};
}

std::vector<std::string> Renderer::State::picked_lines(const PickRequest& request) {
  FrameBuilder& frame = *builders.back();
  const RenderView& view = frame.view();
  const std::size_t at = std::size_t{request.y} * view.width + request.x;
  PickedPixel pixel{request.x, request.y, copies->item<float>("engine.depth", at), 0.0f};
  std::vector<std::string> lines = {"pixel " + std::to_string(pixel.x) + "," + std::to_string(pixel.y) + " of tile " +
                                    std::to_string(pixel.x / kTileSize) + "," + std::to_string(pixel.y / kTileSize)};
  if (pixel.depth > 0.0f) {
    pixel.view_depth_m = view.view_depth(pixel.depth);
    add_surface_lines(*copies, at, pixel.view_depth_m, lines);
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
  const auto last = std::find_if(s.last_requests.begin(), s.last_requests.end(),
                                 [&](const ViewRequest& r) { return r.settings.id == view; });
  GLOAM_ASSERT(last != s.last_requests.end(), "pick needs a view of the last frame");
  // The same frame once more, with its geometry copied out; into a picture of the renderer's own, since a window's is gone.
  ViewRequest again = *last;
  again.target = {};
  again.settings.width = s.images.at(view.value).width;
  again.settings.height = s.images.at(view.value).height;
  if (x >= again.settings.width || y >= again.settings.height)
    return Error{ErrorKind::usage, "the picked pixel lies outside the picture"};
  const std::vector<ViewRequest> all = s.last_requests;
  s.pick = PickRequest{view, x, y};
  Status drawn = render(world, std::span(&again, 1));
  const PickRequest request = *s.pick;
  s.pick.reset();
  s.last_requests = all;
  if (drawn.ok()) drawn = wait();
  std::vector<std::string> lines;
  if (drawn.ok()) {
    s.copies->finish();
    lines = s.picked_lines(request);
  }
  s.copies.reset();
  if (!drawn.ok()) return drawn.error();
  return lines;
}

}  // namespace gloam
