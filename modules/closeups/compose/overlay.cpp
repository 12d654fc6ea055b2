// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/compose/overlay.h"

#include <algorithm>
#include <set>
#include <utility>

#include "modules/closeups/compose/transfer.h"
#include "shaders/closeups/shaders.h"

namespace gloam {
namespace {

constexpr const char* kModule = "closeups";
constexpr std::uint32_t kGroup = 8;  // side of transfer.comp's workgroup, in threads

gpu::ComputePipelineDesc transfer_pipeline(bool d16) {
  if (d16) return {"closeup_transfer/d16", kModule, shaders::closeups::transfer_r16_comp, {}};
  return {"closeup_transfer/d32", kModule, shaders::closeups::transfer_comp, {}};
}

const CloseupSubjects::Subject& subject_of(const FrameBuilder& frame, const CloseupView& pair) {
  return frame.world().resource<CloseupSubjects>().subjects[pair.subject_index];
}

TexelRect covered_by(const CloseupSubjects::Subject& subject, const ShadowFace& face) {
  return covered_texels(face, subject.low, subject.high);
}

/// Number of faces of side `size` that are drawn at a time into a map of side `map_size`.
std::size_t most_at_a_time(std::uint32_t size, std::uint32_t map_size) {
  const std::size_t squares = std::size_t{map_size / size} * (map_size / size);
  return std::min<std::size_t>(squares, ShadowMapDrawer::most_maps(size));
}

/// The face, placed in the i-th square of its size in a map of side `map_size`.
ShadowFace in_square(ShadowFace face, std::size_t i, std::uint32_t map_size) {
  const std::uint32_t a_row = map_size / face.square.size, at = static_cast<std::uint32_t>(i);
  face.square.origin = uvec2(at % a_row, at / a_row) * face.square.size;
  return face;
}

}  // namespace

Status CloseupOverlay::start(FrameBuilder& frame, const OverlayPlan& plan) {
  const auto* maps = frame.find<OverlayMaps>();
  if (plan.faces().empty() || maps == nullptr) return {};
  auto copies = maps->start(frame, plan.faces());
  if (!copies.ok()) return copies.error();
  copies_ = std::move(*copies);
  return {};
}

std::vector<std::size_t> CloseupOverlay::faces_of(const FrameBuilder& frame, const CloseupView& pair) const {
  const CloseupSubjects::Subject& subject = subject_of(frame, pair);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < copies_.faces.size(); ++i) {
    const ShadowFace& face = copies_.faces[i].face;
    if (face.light == pair.light && face_may_see(face, subject.low, subject.high) && !covered_by(subject, face).empty())
      found.push_back(i);
  }
  return found;
}

Status CloseupOverlay::add_transfer(FrameBuilder& frame, const CloseupView& pair, const ShadowFace& from,
                                    std::size_t face, const ExtraAtlas& map, Transfers& transfers) const {
  const ShadowFace to = copies_.faces[face].at_copy();
  const TexelRect texels = covered_by(subject_of(frame, pair), to);
  shaders::CloseupTransfer constants = transfer_constants(from, map.size, to, texels);
  constants.depth_bits = copies_.depth_bits;
  auto range = frame.services().uniforms.write_value(constants);
  if (!range.ok()) return range.error();
  transfers.push_back({*range, face, (texels.end - texels.begin + kGroup - 1u) / kGroup});
  return {};
}

Status CloseupOverlay::add_pass(FrameBuilder& frame, Transfers transfers, const ExtraAtlas& map) const {
  if (transfers.empty()) return {};
  auto pipeline = frame.services().pipelines.get(transfer_pipeline(copies_.d16));
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  ImageRef& atlas = frame.get<ShadowsOutputs>().atlas;
  PassBuilder pass = frame.graph().add_pass("closeup_transfer", kModule);
  pass.read(map.atlas, gpu::Access::compute_read);
  pass.read(map.pyramid, gpu::Access::compute_read);
  atlas = pass.write(atlas, gpu::Access::compute_write);
  pass.execute(
      [transfers = std::move(transfers), atlas, map, pipeline = *pipeline, sampler = *sampler](PassContext& context) {
        gpu::CommandList& commands = context.commands();
        commands.bind_pipeline(pipeline);
        const gpu::ImageHandle image = context.image(atlas);
        std::set<std::size_t> written;  // faces written since the last barrier
        for (const Transfer& transfer : transfers) {
          // Pairs of one light may write the same face.
          if (!written.insert(transfer.face).second) {
            const gpu::ImageBarrier again{image, gpu::Access::compute_write, gpu::Access::compute_write};
            commands.barrier({}, {&again, 1});
            written = {transfer.face};
          }
          const gpu::Binding bindings[] = {{0, transfer.constants},
                                           {1, gpu::Binding::Sampled{{.image = context.image(map.atlas)}, sampler}},
                                           {2, gpu::Binding::Sampled{{.image = context.image(map.pyramid)}, sampler}},
                                           {3, gpu::Binding::Storage{{.image = image}}}};
          commands.bind(bindings);
          commands.dispatch(transfer.groups.x, transfer.groups.y, 1);
        }
      });
  return {};
}

Status CloseupOverlay::draw_and_add(FrameBuilder& frame, const CloseupView& pair, std::span<const std::size_t> faces,
                                    ExtraAtlas& map) {
  std::vector<ExtraMap> maps;
  for (std::size_t i = 0; i < faces.size(); ++i)
    maps.push_back({in_square(copies_.faces[faces[i]].face, i, map.size), subject_of(frame, pair).casters});
  GLOAM_TRY(frame.get<ShadowMapDrawer>().draw(frame, "closeup_standard", kModule, maps, map));
  Transfers transfers;
  for (std::size_t i = 0; i < faces.size(); ++i)
    GLOAM_TRY(add_transfer(frame, pair, maps[i].face, faces[i], map, transfers));
  return add_pass(frame, std::move(transfers), map);
}

Status CloseupOverlay::add(FrameBuilder& frame, std::span<const CloseupView> pairs, ExtraAtlas& map) {
  if (copies_.empty()) return {};
  const auto is_drawn = [&](std::size_t face) { return draws_ && copies_.faces[face].face.square.size <= map.size; };
  Transfers transfers;
  for (const CloseupView& pair : pairs)
    for (const std::size_t face : faces_of(frame, pair))
      if (!is_drawn(face)) GLOAM_TRY(add_transfer(frame, pair, pair.face, face, map, transfers));
  GLOAM_TRY(add_pass(frame, std::move(transfers), map));
  if (!draws_) return {};
  for (const CloseupView& pair : pairs) {
    std::vector<std::size_t> faces = faces_of(frame, pair);
    std::erase_if(faces, [&](std::size_t face) { return !is_drawn(face); });
    const auto size_of = [&](std::size_t face) { return copies_.faces[face].face.square.size; };
    std::ranges::stable_sort(faces, std::ranges::greater(), size_of);
    for (std::span<const std::size_t> left = faces; !left.empty();) {
      const auto same = static_cast<std::size_t>(std::ranges::count(left, size_of(left.front()), size_of));
      const std::size_t count = std::min(same, most_at_a_time(size_of(left.front()), map.size));
      GLOAM_TRY(draw_and_add(frame, pair, left.first(count), map));
      left = left.subspan(count);
    }
  }
  return {};
}

Status CloseupOverlay::finish(FrameBuilder& frame) {
  return copies_.empty() ? Status{} : frame.get<OverlayMaps>().finish(frame, copies_);
}

void list_closeup_overlay_pipelines(bool d16, PipelineList& list) {
  list.push_back(transfer_pipeline(d16));
  list_overlay_map_pipelines(d16, list);
}

}  // namespace gloam
