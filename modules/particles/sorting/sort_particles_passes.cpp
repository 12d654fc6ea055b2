// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/sorting/sort_particles_passes.h"

#include <utility>

#include "engine/render/sort/radix_sort.h"
#include "shaders/particles/shaders.h"

namespace gloam {
namespace {

ComputeProgram digits_program(std::uint32_t shift, bool ordered) {
  return {shaders::particles::digits_comp, {{"kShift", shift}, {"kOrdered", ordered ? 1u : 0u}}};
}
ComputeProgram count_program() { return {shaders::particles::count_comp}; }

/// Eight bits of each key. order: null, or the order in which they are packed.
BufferRef add_digits_pass(FrameBuilder& frame, const char* name, BufferRef keys, std::uint32_t places,
                          std::uint32_t shift, BufferRef order) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = "particles";
  desc.size = packed_key_bytes(places);
  ComputePass pass(frame, name, digits_program(shift, static_cast<bool>(order)));
  pass.push(places);
  pass.read("keys", keys);
  pass.read("order", order);
  const BufferRef digits = pass.write("digits", frame.graph().create_buffer(desc));
  pass.dispatch_over(places / 4);
  return digits;
}

}  // namespace

std::vector<ComputeProgram> particle_sort_programs(bool threads_in_turn) {
  std::vector<ComputeProgram> programs = {digits_program(0, false), digits_program(8, true), count_program()};
  for (const bool implied_values : {true, false})
    for (ComputeProgram& program : radix_sort_programs(threads_in_turn, implied_values))
      programs.push_back(std::move(program));
  return programs;
}

SortedParticles add_particle_sort_passes(FrameBuilder& frame, BufferRef keys, std::uint32_t places, bool two_digits) {
  const BufferRef low = add_digits_pass(frame, "particle_digits", keys, places, 0, {});
  SortedKeys sorted = add_radix_sort_passes(frame, "particle_sort", low, {}, places);
  if (two_digits) {
    const BufferRef high = add_digits_pass(frame, "particle_high_digits", keys, places, 8, sorted.values);
    sorted = add_radix_sort_passes(frame, "particle_high_sort", high, sorted.values, places);
  }
  gpu::BufferDesc desc;
  desc.name = "particle_draws";
  desc.module = "particles";
  desc.size = sizeof(shaders::ParticleDraws);
  ComputePass count(frame, "particle_count", count_program());
  count.read("bins", sorted.bins);
  const BufferRef draws = count.write("draws", frame.graph().create_buffer(desc));
  count.dispatch(1);
  return {sorted.values, draws};
}

}  // namespace gloam
