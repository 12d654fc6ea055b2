// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// A function with two returns, which stays a function, and holds an if with an else. It is called twice.
layout(local_size_x = 1) in;

layout(set = 0, binding = 0) buffer Values { uint values[]; };

uint change(uint at) {
  if (values[at] == 7u) return at;
  if (values[at] > 3u) {
    values[at] = 1u;
  } else {
    values[at + 1u] = 2u;
  }
  return at + 1u;
}

void main() { values[2] = change(change(gl_WorkGroupID.x)); }
