// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/planes.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/render/declare/compute_pass.h"
#include "modules/shadows/maps/images.h"
#include "modules/shadows/maps/work_groups.h"
#include "shaders/shadows/maps/planes_shared.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kCoarsest = GLOAM_SHADOW_PLANE_BLOCK
                                    << (GLOAM_SHADOW_PLANE_LEVELS - 1);  // texels of a block's side, last level

/// The parts of the view's faces whose planes must be made. kept_planes: the image holds the planes of earlier frames.
std::vector<FacePart> parts_of(const ShadowMaps& maps, const ViewFaces& view_faces, const ViewMapState& kept,
                               bool kept_planes) {
  const ViewMapState::Frame& frame = kept.frame;
  std::vector<FacePart> parts;
  for (const ShadowFace& face : view_faces.faces) {
    if (face.square.size == 0) continue;
    const FaceKey key{face.light, face.index, face.view};
    if (std::ranges::find(frame.planes, key) != frame.planes.end()) continue;
    const std::size_t before = parts.size();
    for (const FacePart& part : maps.drawn)
      if (part.square == face.square) parts.push_back(part);
    const bool own = parts.size() > before;
    const bool by_another = !own && std::ranges::find(frame.drawn, key) != frame.drawn.end();
    if (kept_planes && !frame.atlas_is_empty && !by_another && kept.cache.has_planes(face)) continue;
    parts.resize(before);
    parts.push_back({face.square, whole_face(face)});
  }
  return parts;
}

/// Joins adjacent parts of one face into one.
std::vector<FacePart> joined_by_face(std::span<const FacePart> parts) {
  std::vector<FacePart> joined;
  for (const FacePart& part : parts) {
    if (joined.empty() || joined.back().square != part.square) {
      joined.push_back(part);
      continue;
    }
    TexelRect& texels = joined.back().texels;
    texels = {glm::min(texels.begin, part.texels.begin), glm::max(texels.end, part.texels.end)};
  }
  return joined;
}

/// The dispatches of planes.comp: level 0, then the other levels.
struct PlaneWork {
  std::vector<shaders::ShadowPlaneGroup> groups;
  GroupRange ranges[2];

  /// block: texels of mip 0 per side of the area that one thread processes.
  [[nodiscard]] GroupRange add(std::span<const FacePart> parts, std::uint32_t block) {
    GroupRange range{static_cast<std::uint32_t>(groups.size()), 0};
    for (const FacePart& part : parts)
      add_groups(part.texels.begin / block, (part.texels.end + block - 1u) / block, GLOAM_SHADOW_PLANE_GROUP,
                 [&](uvec2 begin, uvec2 end) {
                   groups.push_back({part.square.origin, begin, end, part.square.size});
                 });
    range.count = static_cast<std::uint32_t>(groups.size()) - range.first;
    return range;
  }
};

PlaneWork work_of(std::span<const FacePart> parts) {
  PlaneWork work;
  work.ranges[0] = work.add(parts, GLOAM_SHADOW_PLANE_BLOCK);
  work.ranges[1] = work.add(joined_by_face(parts), kCoarsest);  // joined, so that none of the few texels is made twice
  return work;
}

// Values of the shader's kLevels.
constexpr std::uint32_t kFinest = 1, kCoarser = 2;

ComputeProgram planes_program(std::uint32_t levels) { return {shaders::shadows::planes_comp, {{"kLevels", levels}}}; }

}  // namespace

void list_shadow_plane_pipelines(PipelineList& list) {
  for (const std::uint32_t levels : {kFinest, kCoarser})
    list.push_back(pipeline_desc(planes_program(levels), "shadows"));
}

ImageRef add_shadow_planes_pass(FrameBuilder& frame, ViewMapState& kept, const ShadowMaps& maps,
                                const ViewFaces& view_faces, const ShadowKnobs& knobs) {
  const HistoryImage used = use_map_image(frame, view_faces, knobs, kept.takes_turns, MapImage::planes);
  if (!used.image) return {};
  ImageRef planes = used.image;
  const std::vector<FacePart> parts = parts_of(maps, view_faces, kept, used.valid());
  std::vector<FaceKey> made;
  for (const ShadowFace& face : view_faces.faces)
    if (face.square.size > 0) made.push_back({face.light, face.index, face.view});
  kept.frame.planes.insert(kept.frame.planes.end(), made.begin(), made.end());
  frame.on_commit([&kept, made = std::move(made), all_new = !used.filled()] {
    if (all_new) kept.cache.forget_planes();
    for (const FaceKey& face : made) kept.cache.set_planes(face);
  });
  if (parts.empty()) return planes;
  const PlaneWork work = work_of(parts);
  ComputePass pass(frame, "shadow_planes", planes_program(kFinest));
  pass.read("atlas", maps.atlas);
  planes = pass.write("planes", planes);
  pass.items<shaders::ShadowPlaneGroup>("groups", work.groups);
  dispatch_groups(pass, shaders::ShadowPlaneConstants{0, knobs.atlas_size, 0}, work.ranges[0]);
  pass.barrier();
  pass.use(planes_program(kCoarser));
  dispatch_groups(pass, shaders::ShadowPlaneConstants{1, knobs.atlas_size, 0}, work.ranges[1]);
  return planes;
}

}  // namespace gloam
