// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/debug/pick.h"

#include <optional>

#include "engine/core/text/formatted.h"
#include "engine/render/outputs.h"
#include "engine/scene/resources.h"
#include "modules/closeups/debug/visualizers.h"
#include "modules/closeups/pairs/density.h"
#include "modules/lights/outputs.h"

namespace gloam {
namespace {

std::string name_of(const SceneNames& names, Entity entity, const char* kind) {
  const std::string_view name = names.name_of(entity);
  return name.empty() ? std::string(kind) + " " + std::to_string(entity.index) : std::string(name);
}

bool contains(const TileRange& tiles, const PickedPixel& pixel) {
  const uvec2 tile(pixel.x / kShadowTile, pixel.y / kShadowTile);
  return glm::all(glm::greaterThanEqual(tile, tiles.begin)) && glm::all(glm::lessThan(tile, tiles.end));
}

PixelFootprint footprint_of(const RenderView& view, const PickedPixel& pixel, const Captures& copies) {
  const std::size_t at = std::size_t{pixel.y} * view.width + pixel.x;
  const GeometryTexel texel = decode_geometry(0, copies.item<uvec2>("engine.normals", at), 0);
  return pixel_footprint(view, pixel.x, pixel.y, pixel.depth, dvec3(texel.face_normal));
}

std::string density_text(std::optional<double> texels) {
  if (!texels) return "outside its frustum";
  return formatted("in its frustum, %.4g texels a pixel's side", *texels);
}

}  // namespace

std::vector<std::string> closeup_pick_lines(const FrameBuilder& frame, const PickedPixel& pixel,
                                            const Captures& copies) {
  const std::span<const CloseupView> pairs = drawn_closeups(frame);
  if (pairs.empty()) return {};
  const auto& names = frame.world().resource<SceneNames>();
  std::vector<std::string> lines = {""};
  for (const CloseupView& pair : pairs) {
    if (!contains(pair.tiles, pixel)) continue;
    std::string line = "  " + name_of(names, pair.subject, "subject") + " and " + name_of(names, pair.light, "light");
    const std::string size = std::to_string(pair.face.square.size);
    line += ": map " + size + "x" + size;
    if (pixel.depth > 0.0f)
      line += ", " + density_text(texels_per_pixel(pair.face, frame.view(), footprint_of(frame.view(), pixel, copies)));
    lines.push_back(std::move(line));
  }
  const std::size_t listed = lines.size() - 1;
  lines[0] = "close-up pairs of the tile: " + std::to_string(listed) + " of " + std::to_string(pairs.size());
  return lines;
}

}  // namespace gloam
