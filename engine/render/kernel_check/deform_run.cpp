// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/kernel_check/deform_run.h"

#include <algorithm>
#include <array>
#include <glm/ext/matrix_transform.hpp>
#include <utility>

#include "engine/render/kernel_check/kernel_run.h"
#include "shaders/render/shaders.h"

namespace gloam {

DeformInput DeformInputs::vertices(std::uint32_t count) {
  DeformInput input;
  Primitive& p = input.primitive;
  for (std::uint32_t i = 0; i < count; ++i) {
    p.positions.push_back(point(3.0f));
    p.normals.push_back(direction());
    p.tangents.push_back(vec4(direction(), random_() % 2 == 0 ? 1.0f : -1.0f));
  }
  input.constants.vertex_count = count;
  return input;
}

void DeformInputs::add_skin(DeformInput& input, std::uint32_t joints, const dvec3& scale) {
  input.constants.skinned = 1;
  input.constants.first_joint = 3;
  input.joints.assign(3, mat4(99.0f));  // of another instance
  for (std::uint32_t j = 0; j < joints; ++j)
    input.joints.push_back(mat4(glm::translate(dmat4(1.0), dvec3(point(5.0f))) *
                                glm::rotate(dmat4(1.0), static_cast<double>(in(0.0f, 0.7f)), dvec3(direction())) *
                                glm::scale(dmat4(1.0), scale * static_cast<double>(in(0.5f, 2.0f)))));
  for (std::size_t v = 0; v < input.primitive.positions.size(); ++v) {
    std::array<std::uint16_t, 4> own{};
    for (std::uint16_t& joint : own) joint = static_cast<std::uint16_t>(random_() % joints);
    vec4 weights(in(0, 1), in(0, 1), in(0, 1), in(0, 1));
    if (v % 3 == 1) weights = vec4(0.0f, 1.0f, 0.0f, 0.0f);
    input.primitive.joints.push_back(own);
    input.primitive.weights.push_back(weights / (weights.x + weights.y + weights.z + weights.w));
  }
}

void DeformInputs::add_morphs(DeformInput& input, std::uint32_t targets, bool normals) {
  input.constants.morph_targets = targets;
  input.constants.morph_has_normals = normals ? 1 : 0;
  input.constants.first_weight = 2;
  input.weights = {50.0f, -50.0f};  // of another instance
  for (std::uint32_t t = 0; t < targets; ++t) {
    input.weights.push_back(in(-0.5f, 1.0f));
    Primitive::MorphTarget target;
    for (std::size_t v = 0; v < input.primitive.positions.size(); ++v) {
      target.positions.push_back(point(1.0f));
      if (normals) target.normals.push_back(point(0.2f));
    }
    input.primitive.morph_targets.push_back(std::move(target));
  }
}

Result<DeformedVertices> run_deform(const KernelLab& lab, const DeformInput& input) {
  bool has_normals = false;
  auto offsets = pack_morph_offsets(input.primitive, has_normals);
  offsets.resize(std::max<std::size_t>(offsets.size(), 1));
  auto influences = pack_influences(input.primitive);
  influences.resize(std::max<std::size_t>(influences.size(), 1));
  std::vector<vec4> rows;
  for (const mat4& joint : input.joints)
    for (int row = 0; row < 3; ++row) rows.push_back(glm::transpose(joint)[row]);
  rows.resize(std::max<std::size_t>(rows.size(), 3));
  auto weights = input.weights;
  weights.resize(std::max<std::size_t>(weights.size(), 1));

  const std::uint64_t count = input.constants.vertex_count;
  KernelRun kernel(lab, shaders::render::deform_comp);
  kernel.input(0, input.primitive.positions);
  kernel.input(1, pack_frames(input.primitive));
  kernel.input(2, influences);
  kernel.input(3, offsets);
  kernel.input(4, rows);
  kernel.input(5, weights);
  kernel.output(6, (count + 1) * sizeof(vec3));
  kernel.output(7, (count + 1) * sizeof(PackedFrame));
  kernel.push(input.constants);
  GLOAM_TRY(kernel.run(static_cast<std::uint32_t>((count + 63) / 64)));
  return DeformedVertices{kernel.read<vec3>(6), kernel.read<PackedFrame>(7)};
}

}  // namespace gloam
