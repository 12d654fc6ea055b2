// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/drawing/part_casters.h"

#include <algorithm>
#include <cstddef>
#include <glm/ext/matrix_transform.hpp>

#include "modules/grass/lod/detail.h"
#include "shaders/grass/shaders.h"

namespace gloam {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{32} << 20;  ///< of the lists of one call
constexpr std::uint32_t kRoomStep = 64;                        // lists begin at multiples of 256 bytes
static_assert(PartLists::kPartBytes >= sizeof(shaders::GrassCasting) &&
              offsetof(shaders::GrassCasting, draw.instances) == 4 &&
              offsetof(shaders::GrassCasting, draw.first_index) == 8 && offsetof(shaders::GrassCasting, count) == 20 &&
              offsetof(shaders::GrassCasting, wider) == 24);

vec4 normalised(const dvec4& plane) {
  const double length = glm::length(dvec3(plane));
  return length > 0.0 ? vec4(plane / length) : vec4(0.0f, 0.0f, 0.0f, 1.0f);
}

BufferRef part_buffer(FrameBuilder& frame, const char* name, std::uint64_t bytes) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = "grass";
  desc.size = bytes;
  return frame.graph().create_buffer(desc);
}

}  // namespace

ComputeProgram grass_part_casters_program() {
  return {shaders::grass::part_casters_comp, {{"kSegments", kClassSegments[GLOAM_GRASS_CAST_CLASS]}}};
}

shaders::GrassCasterPart caster_part(const CasterSourcePart& part, const dvec3& eye) {
  const dmat4 rows =
      glm::transpose(part.projection.clip_from_relative * glm::translate(dmat4(1.0), eye - part.projection.origin));
  const dvec4 clip(part.clip);
  shaders::GrassCasterPart planes{};
  planes.planes[0] = normalised(rows[0] - rows[3] * clip.x);
  planes.planes[1] = normalised(rows[1] - rows[3] * clip.y);
  planes.planes[2] = normalised(rows[3] * clip.z - rows[0]);
  planes.planes[3] = normalised(rows[3] * clip.w - rows[1]);
  planes.planes[4] = normalised(rows[3]);  // behind a perspective light; orthographic: everywhere
  planes.reach = vec4(vec3(part.projection.origin - eye), part.reach_m);
  return planes;
}

std::uint32_t add_part_lists(FrameBuilder& frame, const DrawnBlades& blades, std::uint64_t most,
                             std::span<const CasterSourcePart> parts, std::vector<PartLists>& lists) {
  const std::uint64_t room = (most + kRoomStep - 1) / kRoomStep * kRoomStep;
  if (parts.empty() || room == 0 || room * parts.size() * sizeof(std::uint32_t) > kMostBytes)
    return CasterSourceDraw::kNoPart;
  PartLists made;
  made.first = lists.empty() ? 0 : lists.back().first + lists.back().count;
  made.count = static_cast<std::uint32_t>(parts.size());
  made.room = static_cast<std::uint32_t>(room);
  std::vector<shaders::GrassCasterPart> planes;
  for (const CasterSourcePart& part : parts) planes.push_back(caster_part(part, frame.view().position));
  made.casting = part_buffer(frame, "grass_part_casting", made.count * PartLists::kPartBytes);
  made.casters = part_buffer(frame, "grass_part_casters", room * made.count * sizeof(std::uint32_t));
  PassBuilder clear = frame.graph().add_pass("grass_part_start", frame.module());
  made.casting = clear.write(made.casting, gpu::Access::transfer_write);
  clear.execute([casting = made.casting, bytes = made.count * PartLists::kPartBytes](PassContext& context) {
    context.commands().fill_buffer(context.buffer(casting), 0, bytes, 0);
  });
  ComputePass pass(frame, "grass_part_casters", grass_part_casters_program());
  pass.items<shaders::GrassCasterPart>("parts", planes);
  pass.read("poses", blades.poses);
  pass.read("knots", blades.knots);
  pass.read("casting", blades.casting);
  pass.read("casters", blades.casters);
  pass.read("draws", blades.draws);
  made.casting = pass.write("part_casting", made.casting);
  made.casters = pass.write("part_casters", made.casters);
  pass.push(uvec2(made.count, made.room));
  pass.dispatch_indirect(blades.casting, offsetof(shaders::GrassCasting, groups));
  lists.push_back(made);
  return made.first;
}

const PartLists* find_part(std::span<const PartLists> lists, std::uint32_t part) {
  const auto found = std::ranges::find_if(
      lists, [&](const PartLists& one) { return part >= one.first && part - one.first < one.count; });
  return found == lists.end() ? nullptr : &*found;
}

}  // namespace gloam
