// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sandbox/bench/harness/registry.h"

namespace gloam {

/// Entities and components against plain arrays (`…_over_bare`).
void add_ecs_benches(BenchRegistry& registry);
/// Whole frames of the scene against a pass of 48 gathers a pixel.
void add_frame_benches(BenchRegistry& registry);
/// What finding the lights of tiles costs and saves: against brute force, against the yardstick, by number of lights.
void add_light_gpu_benches(BenchRegistry& registry);
/// The CPU's light systems: bounds, sorting, zBins, tile masks; against a memset of what they write.
void add_light_cpu_benches(BenchRegistry& registry);
/// Lights a tile that each phase keeps beyond those that reach a pixel of it.
void add_light_false_positive_benches(BenchRegistry& registry);
/// Shadow filters against traced shadows: what each costs and how far it is off.
void add_shadow_benches(BenchRegistry& registry);
/// FF table 2: oriented bias against hardware bias.
void add_shadow_bias_benches(BenchRegistry& registry);
/// Widths of penumbrae against the analytic ones.
void add_shadow_penumbra_benches(BenchRegistry& registry);
/// The contact-hardening filter against the bare gathers of the same footprints.
void add_shadow_gather_benches(BenchRegistry& registry);
/// FF table 1 and figure 13: shadows in the lighting pass against shadows before it, with tiles classified and without.
void add_shadow_deferred_benches(BenchRegistry& registry);
/// Memory of light lists and visibilities against a fixed number of lights a tile (FF §2).
void add_shadow_memory_benches(BenchRegistry& registry);
/// Cost of each phase against the number of shadowed lights and against resolution.
void add_shadow_curve_benches(BenchRegistry& registry);
/// Whole frames with moving casters against a pass of 48 gathers a pixel, and what they consist of.
void add_shadow_frame_benches(BenchRegistry& registry);
/// Shadows of close-up subjects against traced ones, beside those of standard maps with as many texels.
void add_closeup_benches(BenchRegistry& registry);
/// What close-ups cost: memory by number of pairs, FF figure 14, batches of pairs and ways to let forward-lit things
/// see them.
void add_closeup_cost_benches(BenchRegistry& registry);
/// Shadows of a walking subject from frame to frame, likewise beside standard maps.
void add_closeup_flicker_benches(BenchRegistry& registry);
/// The cost of jobs, ranges and graphs.
void add_job_benches(BenchRegistry& registry);

}  // namespace gloam
