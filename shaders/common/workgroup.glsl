// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_COMMON_WORKGROUP_GLSL
#define GLOAM_SHADERS_COMMON_WORKGROUP_GLSL

// Reductions over a workgroup of 64 threads through shared memory; they give the same result for every subgroup width.
// All threads of the workgroup must call. Calls may follow each other directly, and each contains a barrier: shared
// memory written before a call is visible after it.

#define GLOAM_WORKGROUP 64u

shared uint workgroup_values[2][GLOAM_WORKGROUP];

// Exclusive prefix sum: sum of `value` over the threads before this one (Hillis and Steele). total: sum over all
// threads.
uint workgroup_prefix_sum(uint value, out uint total) {
  uint lane = gl_LocalInvocationIndex;
  uint sum = value;
  uint from = 0u;
  workgroup_values[0][lane] = sum;
  barrier();
  for (uint step = 1u; step < GLOAM_WORKGROUP; step <<= 1) {
    if (lane >= step) sum += workgroup_values[from][lane - step];
    from ^= 1u;
    workgroup_values[from][lane] = sum;
    barrier();
  }
  total = workgroup_values[from][GLOAM_WORKGROUP - 1u];
  barrier();
  return sum - value;
}

uint workgroup_sum(uint value) {
  if (gl_LocalInvocationIndex == 0u) workgroup_values[0][0] = 0u;
  barrier();
  if (value != 0u) atomicAdd(workgroup_values[0][0], value);
  barrier();
  uint sum = workgroup_values[0][0];
  barrier();
  return sum;
}

#endif
