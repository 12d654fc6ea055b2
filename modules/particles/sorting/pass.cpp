// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/sorting/pass.h"

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
BufferRef add_digits_pass(FrameBuilder& frame, const char* name, const ParticlesFrame& particles, std::uint32_t shift,
                          BufferRef order) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = "particles";
  desc.size = packed_key_bytes(particles.constants.places);
  ComputePass pass(frame, name, digits_program(shift, static_cast<bool>(order)));
  pass.push(particles.constants.places);
  pass.read("keys", particles.keys);
  pass.read("order", order);
  const BufferRef digits = pass.write("digits", frame.graph().create_buffer(desc));
  pass.dispatch_over(particles.constants.places / 4);
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

void add_particle_sort_passes(FrameBuilder& frame, ParticlesFrame& particles) {
  const std::uint32_t places = particles.constants.places;
  const BufferRef low = add_digits_pass(frame, "particle_digits", particles, 0, {});
  SortedKeys sorted = add_radix_sort_passes(frame, "particle_sort", low, {}, places);
  if (particles.two_digits) {
    const BufferRef high = add_digits_pass(frame, "particle_high_digits", particles, 8, sorted.values);
    sorted = add_radix_sort_passes(frame, "particle_high_sort", high, sorted.values, places);
  }
  particles.order = sorted.values;
  gpu::BufferDesc desc;
  desc.name = "particle_draws";
  desc.module = "particles";
  desc.size = sizeof(shaders::ParticleDraws);
  ComputePass count(frame, "particle_count", count_program());
  count.read("bins", sorted.bins);
  particles.draws = count.write("draws", frame.graph().create_buffer(desc));
  count.dispatch(1);
}

}  // namespace gloam
