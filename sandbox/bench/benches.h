// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sandbox/bench/registry.h"

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
/// The cost of jobs, ranges and graphs.
void add_job_benches(BenchRegistry& registry);

}  // namespace gloam
