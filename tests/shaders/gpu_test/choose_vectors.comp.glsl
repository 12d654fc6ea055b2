// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Choices between constant vectors by specialisation constants.
layout(local_size_x = 1) in;
layout(constant_id = 0) const uint kFlag = 0u;
layout(constant_id = 1) const float kFactor = 1.5;

const ivec2 kStep = kFlag != 0u ? ivec2(1, 2) : ivec2(3, 4);
const vec3 kScale = kFlag > 1u ? vec3(kFactor, 5.0, 6.0) : vec3(7.0, 8.0, kFactor);
const vec3 kNested = kFlag == 1u ? vec3(9.0) : kScale;
const float kNumber = kFlag == 2u ? kFactor : 10.0;

layout(set = 0, binding = 0, scalar) writeonly buffer Target { float target[]; };

void main() {
  target[0] = float(kStep.x);
  target[1] = float(kStep.y);
  for (uint i = 0u; i < 3u; ++i) {
    target[2u + i] = kScale[i];
    target[5u + i] = kNested[i];
  }
  target[8] = kNumber;
}
