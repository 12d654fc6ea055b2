// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>

#include "engine/render/kernel_check/deform_run.h"
#include "engine/render/kernel_check/engine_checks.h"
#include "tests/support/kernel.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

constexpr double kAngleBound = 0.012;  // degrees: 0.01 for the packed code, the rest for float arithmetic

class DeformKernel : public test::KernelTest {
 protected:
  [[nodiscard]] DeformedVertices run(const DeformInput& input) {
    DeformedVertices result = test::value_of(run_deform(KernelLab(device(), test::gpu_log()), input));
    EXPECT_EQ(result.frames.back().normal, test::Kernel::kUntouched) << "the kernel wrote past the last vertex";
    EXPECT_EQ(std::bit_cast<std::uint32_t>(result.positions.back().x), test::Kernel::kUntouched)
        << "the kernel wrote past the last vertex";
    return result;
  }
  void expect_the_same(const DeformInput& input) {
    const DeformedVertices result = run(input);
    const DeformTwin twin(input);
    for (std::size_t v = 0; v < input.constants.vertex_count; ++v) {
      const DeformedVertex expected = twin.move(v);
      ASSERT_LT(glm::length(dvec3(result.positions[v]) - expected.position), 3e-5) << "vertex " << v;
      const dvec3 normal = glm::length(expected.normal) > 0.0 ? expected.normal : dvec3(0.0, 1.0, 0.0);
      const dvec3 tangent = glm::length(expected.tangent) > 0.0 ? expected.tangent : dvec3(1.0, 0.0, 0.0);
      ASSERT_LT(degrees_between(decoded_direction(result.frames[v].normal), normal), kAngleBound) << "vertex " << v;
      ASSERT_LT(degrees_between(decoded_direction(result.frames[v].tangent & ~kHandednessBit), tangent), kAngleBound)
          << "vertex " << v;
      ASSERT_EQ((result.frames[v].tangent & kHandednessBit) != 0, expected.left_handed) << "vertex " << v;
    }
  }

  DeformInputs inputs{31};
};

TEST_F(DeformKernel, without_skin_and_targets_vertices_rest) {
  for (const std::uint32_t count : {1u, 63u, 64u, 65u, 1000u}) expect_the_same(inputs.vertices(count));
}

// Hard case: selftest.skinning
TEST_F(DeformKernel, skins_with_four_influences) {
  for (const std::uint32_t count : {1u, 64u, 129u, 500u}) {
    DeformInput input = inputs.vertices(count);
    inputs.add_skin(input, 9, dvec3(1.0));
    expect_the_same(input);
  }
}

TEST_F(DeformKernel, uneven_scales_turn_normals_by_cofactors) {
  DeformInput input = inputs.vertices(300);
  inputs.add_skin(input, 5, dvec3(0.3, 2.0, 1.0));
  expect_the_same(input);
}

TEST_F(DeformKernel, mirrored_joints_flip_handedness_and_keep_normals_outside) {
  DeformInput input = inputs.vertices(300);
  inputs.add_skin(input, 5, dvec3(-1.0, 1.0, 1.0));
  expect_the_same(input);

  DeformInput box;
  box.primitive = test::box(vec3(1.0f, 2.0f, 3.0f));
  box.constants.vertex_count = 24;
  inputs.add_skin(box, 1, dvec3(1.0, -1.0, 1.0));
  const DeformedVertices result = run(box);
  const dvec3 center(box.joints[3][3]);
  for (std::size_t v = 0; v < 24; ++v) {
    EXPECT_GT(glm::dot(decoded_direction(result.frames[v].normal), dvec3(result.positions[v]) - center), 0.1)
        << "vertex " << v;
    EXPECT_NE(result.frames[v].tangent & kHandednessBit, 0u);
  }
}

TEST_F(DeformKernel, morphs_positions_with_and_without_normals) {
  for (const bool normals : {false, true}) {
    for (const std::uint32_t targets : {1u, 2u, 7u}) {
      DeformInput input = inputs.vertices(130);
      inputs.add_morphs(input, targets, normals);
      expect_the_same(input);
    }
  }
}

TEST_F(DeformKernel, morphs_before_it_skins) {
  for (const bool normals : {false, true}) {
    DeformInput input = inputs.vertices(200);
    inputs.add_morphs(input, 3, normals);
    inputs.add_skin(input, 4, dvec3(1.0, 0.5, 1.5));
    expect_the_same(input);
  }
}

TEST_F(DeformKernel, degenerate_weights_follow_the_first_joint) {
  DeformInput input = inputs.vertices(64);
  inputs.add_skin(input, 4, dvec3(1.0));
  for (std::size_t v = 0; v < 64; ++v) input.primitive.weights[v] = vec4(v % 2 == 0 ? 0.0f : -1.0f);
  expect_the_same(input);
  const DeformedVertices result = run(input);
  for (std::size_t v = 0; v < 64; ++v) {
    const dmat4 first(input.joints[input.constants.first_joint + input.primitive.joints[v][0]]);
    EXPECT_LT(glm::length(dvec3(result.positions[v]) - dvec3(first * dvec4(dvec3(input.primitive.positions[v]), 1.0))),
              3e-5);
  }
}

TEST_F(DeformKernel, directions_that_vanish_become_the_axes) {
  DeformInput input = inputs.vertices(70);
  inputs.add_skin(input, 2, dvec3(1.0));
  for (mat4& joint : input.joints) joint = mat4(0.0f);
  const DeformedVertices result = run(input);
  for (std::size_t v = 0; v < 70; ++v) {
    EXPECT_EQ(result.positions[v], vec3(0.0f));
    EXPECT_LT(degrees_between(decoded_direction(result.frames[v].normal), dvec3(0.0, 1.0, 0.0)), kAngleBound);
    EXPECT_LT(degrees_between(decoded_direction(result.frames[v].tangent & ~kHandednessBit), dvec3(1.0, 0.0, 0.0)),
              kAngleBound);
  }
}

TEST_F(DeformKernel, holds_in_the_self_test) { expect_holds(deform_checks()); }

}  // namespace
}  // namespace gloam
