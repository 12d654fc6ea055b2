// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/compose/overlay.h"

#include <algorithm>
#include <set>

#include "engine/render/declare/compute_pass.h"
#include "modules/closeups/compose/transfer.h"
#include "shaders/closeups/shaders.h"

namespace gloam {
namespace {

ComputeProgram transfer_program(bool d16) {
  return {d16 ? shaders::closeups::transfer_r16_comp : shaders::closeups::transfer_comp};
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

void CloseupOverlay::start(FrameBuilder& frame, const OverlayPlan& plan) {
  const auto* maps = frame.find<OverlayMaps>();
  if (!plan.faces().empty() && maps != nullptr) copies_ = maps->start(frame, plan.faces());
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

CloseupOverlay::Transfer CloseupOverlay::transfer_to(std::size_t face, const FrameBuilder& frame,
                                                     const CloseupView& pair, const ShadowFace& from,
                                                     const ExtraAtlas& map) const {
  const ShadowFace to = copies_.faces[face].at_copy();
  Transfer transfer{face, transfer_constants(from, map.size, to, covered_by(subject_of(frame, pair), to))};
  transfer.constants.depth_bits = copies_.depth_bits;
  return transfer;
}

void CloseupOverlay::add_pass(FrameBuilder& frame, std::span<const Transfer> transfers, const ExtraAtlas& map) const {
  if (transfers.empty()) return;
  ImageRef& atlas = frame.get<ShadowsOutputs>().atlas;
  ComputePass pass(frame, "closeup_transfer", transfer_program(copies_.d16));
  pass.read("closeup_map", map.atlas);
  pass.read("closeup_pyramid", map.pyramid);
  atlas = pass.write("atlas", atlas);
  std::set<std::size_t> written;  // faces written since the last barrier
  for (const Transfer& transfer : transfers) {
    // Pairs of one light may write the same face.
    if (!written.insert(transfer.face).second) {
      pass.barrier();
      written = {transfer.face};
    }
    pass.uniform("transfer", transfer.constants);
    pass.dispatch_over(transfer.constants.end - transfer.constants.begin);
  }
}

void CloseupOverlay::draw_and_add(FrameBuilder& frame, const CloseupView& pair, std::span<const std::size_t> faces,
                                  ExtraAtlas& map) {
  std::vector<ExtraMap> maps;
  for (std::size_t i = 0; i < faces.size(); ++i)
    maps.push_back({in_square(copies_.faces[faces[i]].face, i, map.size), subject_of(frame, pair).casters});
  frame.get<ShadowMapDrawer>().draw(frame, "closeup_standard", maps, map);
  std::vector<Transfer> transfers;
  for (std::size_t i = 0; i < faces.size(); ++i)
    transfers.push_back(transfer_to(faces[i], frame, pair, maps[i].face, map));
  add_pass(frame, transfers, map);
}

void CloseupOverlay::add(FrameBuilder& frame, std::span<const CloseupView> pairs, ExtraAtlas& map) {
  if (copies_.empty()) return;
  const auto is_drawn = [&](std::size_t face) { return draws_ && copies_.faces[face].face.square.size <= map.size; };
  std::vector<Transfer> transfers;
  for (const CloseupView& pair : pairs)
    for (const std::size_t face : faces_of(frame, pair))
      if (!is_drawn(face)) transfers.push_back(transfer_to(face, frame, pair, pair.face, map));
  add_pass(frame, transfers, map);
  if (!draws_) return;
  for (const CloseupView& pair : pairs) {
    std::vector<std::size_t> faces = faces_of(frame, pair);
    std::erase_if(faces, [&](std::size_t face) { return !is_drawn(face); });
    const auto size_of = [&](std::size_t face) { return copies_.faces[face].face.square.size; };
    std::ranges::stable_sort(faces, std::ranges::greater(), size_of);
    for (std::span<const std::size_t> left = faces; !left.empty();) {
      const auto same = static_cast<std::size_t>(std::ranges::count(left, size_of(left.front()), size_of));
      const std::size_t count = std::min(same, most_at_a_time(size_of(left.front()), map.size));
      draw_and_add(frame, pair, left.first(count), map);
      left = left.subspan(count);
    }
  }
}

void CloseupOverlay::finish(FrameBuilder& frame) {
  if (!copies_.empty()) frame.get<OverlayMaps>().finish(frame, copies_);
}

void list_closeup_overlay_pipelines(bool d16, PipelineList& list) {
  list.push_back(pipeline_desc(transfer_program(d16), "closeups"));
  list_overlay_map_pipelines(d16, list);
}

}  // namespace gloam
