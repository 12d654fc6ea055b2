// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <random>

#include "engine/render/packing/mesh_packing.h"
#include "shaders/render/deform_shared.h"
#include "shaders/render/shaders.h"
#include "tests/support/kernel.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

constexpr std::uint32_t kHandednessBit = 0x10000u;
constexpr double kAngleBound = 0.012;  // degrees: 0.01 for the packed code, the rest for float arithmetic

double angle_degrees(const dvec3& a, const dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / 3.14159265358979323846;
}

dvec3 decoded(std::uint32_t packed) {
  const auto snorm = [](std::uint32_t bits) {
    return std::max(static_cast<std::int16_t>(bits & 0xFFFFu) / 32767.0, -1.0);
  };
  dvec3 n(snorm(packed), snorm(packed >> 16), 0.0);
  n.z = 1.0 - std::abs(n.x) - std::abs(n.y);
  if (n.z < 0.0) {
    const double x = (1.0 - std::abs(n.y)) * (n.x < 0.0 ? -1.0 : 1.0);
    n.y = (1.0 - std::abs(n.x)) * (n.y < 0.0 ? -1.0 : 1.0);
    n.x = x;
  }
  return glm::normalize(n);
}

/// A deformed vertex.
struct Moved {
  dvec3 position;
  dvec3 normal;   ///< unit; zero: has no direction
  dvec3 tangent;  ///< unit; zero: has no direction
  bool left_handed = false;
};

/// Input of the kernel.
struct Job {
  Primitive primitive;
  std::vector<mat4> joints;    ///< used from constants.first_joint
  std::vector<float> weights;  ///< used from constants.first_weight
  shaders::DeformConstants constants{};
};

/// CPU twin of the kernel in double precision. Reads the packed vertices, as the kernel does; normals use cofactors.
class Twin {
 public:
  explicit Twin(const Job& job)
      : job_(job), frames_(pack_frames(job.primitive)), influences_(pack_influences(job.primitive)) {}

  [[nodiscard]] Moved move(std::size_t v) const {
    Moved moved{dvec3(job_.primitive.positions[v]), decoded(frames_[v].normal),
                decoded(frames_[v].tangent & ~kHandednessBit), (frames_[v].tangent & kHandednessBit) != 0};
    for (std::uint32_t t = 0; t < job_.constants.morph_targets; ++t) {
      const double weight = job_.weights[job_.constants.first_weight + t];
      moved.position += weight * dvec3(job_.primitive.morph_targets[t].positions[v]);
      if (job_.constants.morph_has_normals != 0)
        moved.normal += weight * dvec3(job_.primitive.morph_targets[t].normals[v]);
    }
    if (job_.constants.skinned != 0) skin(v, moved);
    moved.normal = unit(moved.normal);
    moved.tangent = unit(moved.tangent);
    return moved;
  }

 private:
  void skin(std::size_t v, Moved& moved) const {
    const PackedInfluence& p = influences_[v];
    const std::uint32_t joints[] = {p.joints01 & 0xFFFFu, p.joints01 >> 16, p.joints23 & 0xFFFFu, p.joints23 >> 16};
    const std::uint32_t weights[] = {p.weights01 & 0xFFFFu, p.weights01 >> 16, p.weights23 & 0xFFFFu,
                                     p.weights23 >> 16};
    dmat4 blended(0.0);
    for (std::size_t k = 0; k < 4; ++k)
      blended += weights[k] / 65535.0 * dmat4(job_.joints[job_.constants.first_joint + joints[k]]);
    const glm::dmat3 linear(blended);
    // Cofactor matrix: the inverse transpose times the determinant, but without a division.
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    const double side = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
    moved.position = dvec3(blended * dvec4(moved.position, 1.0));
    moved.normal = side * (cofactors * moved.normal);
    moved.tangent = linear * moved.tangent;
    moved.left_handed = moved.left_handed != (side < 0.0);
  }
  static dvec3 unit(const dvec3& v) { return glm::length(v) > 1e-12 ? glm::normalize(v) : dvec3(0.0); }

  const Job& job_;
  std::vector<PackedFrame> frames_;
  std::vector<PackedInfluence> influences_;
};

class DeformKernel : public test::KernelTest {
 protected:
  [[nodiscard]] float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  [[nodiscard]] vec3 point(float reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  [[nodiscard]] vec3 direction() { return glm::normalize(point(1.0f) + vec3(0.0f, 1e-3f, 0.0f)); }

  [[nodiscard]] Job job_of(std::uint32_t vertices) {
    Job job;
    Primitive& p = job.primitive;
    for (std::uint32_t i = 0; i < vertices; ++i) {
      p.positions.push_back(point(3.0f));
      p.normals.push_back(direction());
      p.tangents.push_back(vec4(direction(), random_() % 2 == 0 ? 1.0f : -1.0f));
    }
    job.constants.vertex_count = vertices;
    return job;
  }
  void add_skin(Job& job, std::uint32_t joints, const dvec3& scale) {
    job.constants.skinned = 1;
    job.constants.first_joint = 3;
    job.joints.assign(3, mat4(99.0f));  // of another instance
    for (std::uint32_t j = 0; j < joints; ++j) {
      // Rotations that differ by less than a right angle, so that no mix of the joints collapses.
      job.joints.push_back(mat4(glm::translate(dmat4(1.0), dvec3(point(5.0f))) *
                                glm::rotate(dmat4(1.0), static_cast<double>(in(0.0f, 0.7f)), dvec3(direction())) *
                                glm::scale(dmat4(1.0), scale * static_cast<double>(in(0.5f, 2.0f)))));
    }
    for (std::size_t v = 0; v < job.primitive.positions.size(); ++v) {
      std::array<std::uint16_t, 4> own{};
      for (std::uint16_t& joint : own) joint = static_cast<std::uint16_t>(random_() % joints);
      vec4 weights(in(0, 1), in(0, 1), in(0, 1), in(0, 1));
      if (v % 3 == 1) weights = vec4(0.0f, 1.0f, 0.0f, 0.0f);
      job.primitive.joints.push_back(own);
      job.primitive.weights.push_back(weights / (weights.x + weights.y + weights.z + weights.w));
    }
  }
  void add_morphs(Job& job, std::uint32_t targets, bool normals) {
    job.constants.morph_targets = targets;
    job.constants.morph_has_normals = normals ? 1 : 0;
    job.constants.first_weight = 2;
    job.weights = {50.0f, -50.0f};  // of another instance
    for (std::uint32_t t = 0; t < targets; ++t) {
      job.weights.push_back(in(-0.5f, 1.0f));
      Primitive::MorphTarget target;
      for (std::size_t v = 0; v < job.primitive.positions.size(); ++v) {
        target.positions.push_back(point(1.0f));
        if (normals) target.normals.push_back(point(0.2f));
      }
      job.primitive.morph_targets.push_back(std::move(target));
    }
  }

  struct Result {
    std::vector<vec3> positions;
    std::vector<PackedFrame> frames;
  };
  [[nodiscard]] Result run(const Job& job) {
    bool has_normals = false;
    auto offsets = pack_morph_offsets(job.primitive, has_normals);
    offsets.resize(std::max<std::size_t>(offsets.size(), 1));
    auto influences = pack_influences(job.primitive);
    influences.resize(std::max<std::size_t>(influences.size(), 1));
    std::vector<vec4> rows;
    for (const mat4& joint : job.joints)
      for (int row = 0; row < 3; ++row) rows.push_back(glm::transpose(joint)[row]);
    rows.resize(std::max<std::size_t>(rows.size(), 3));
    auto weights = job.weights;
    weights.resize(std::max<std::size_t>(weights.size(), 1));

    const std::uint64_t count = job.constants.vertex_count;
    test::Kernel kernel(device(), shaders::render::deform_comp);
    kernel.input(0, job.primitive.positions);
    kernel.input(1, pack_frames(job.primitive));
    kernel.input(2, influences);
    kernel.input(3, offsets);
    kernel.input(4, rows);
    kernel.input(5, weights);
    kernel.output(6, (count + 1) * sizeof(vec3));
    kernel.output(7, (count + 1) * sizeof(PackedFrame));
    kernel.push(job.constants);
    kernel.run(static_cast<std::uint32_t>((count + 63) / 64));
    Result result{kernel.read<vec3>(6), kernel.read<PackedFrame>(7)};
    EXPECT_EQ(result.frames.back().normal, test::Kernel::kUntouched) << "the kernel wrote past the last vertex";
    EXPECT_EQ(kernel.read<std::uint32_t>(6).back(), test::Kernel::kUntouched)
        << "the kernel wrote past the last vertex";
    return result;
  }
  void expect_the_same(const Job& job) {
    const Result result = run(job);
    const Twin twin(job);
    for (std::size_t v = 0; v < job.constants.vertex_count; ++v) {
      const Moved expected = twin.move(v);
      ASSERT_LT(glm::length(dvec3(result.positions[v]) - expected.position), 3e-5) << "vertex " << v;
      const dvec3 normal = glm::length(expected.normal) > 0.0 ? expected.normal : dvec3(0.0, 1.0, 0.0);
      const dvec3 tangent = glm::length(expected.tangent) > 0.0 ? expected.tangent : dvec3(1.0, 0.0, 0.0);
      ASSERT_LT(angle_degrees(decoded(result.frames[v].normal), normal), kAngleBound) << "vertex " << v;
      ASSERT_LT(angle_degrees(decoded(result.frames[v].tangent & ~kHandednessBit), tangent), kAngleBound)
          << "vertex " << v;
      ASSERT_EQ((result.frames[v].tangent & kHandednessBit) != 0, expected.left_handed) << "vertex " << v;
    }
  }

  std::mt19937 random_{31};
};

TEST_F(DeformKernel, without_skin_and_targets_vertices_rest) {
  for (const std::uint32_t count : {1u, 63u, 64u, 65u, 1000u}) expect_the_same(job_of(count));
}

TEST_F(DeformKernel, skins_with_four_influences) {
  for (const std::uint32_t count : {1u, 64u, 129u, 500u}) {
    Job job = job_of(count);
    add_skin(job, 9, dvec3(1.0));
    expect_the_same(job);
  }
}

TEST_F(DeformKernel, uneven_scales_turn_normals_by_cofactors) {
  Job job = job_of(300);
  add_skin(job, 5, dvec3(0.3, 2.0, 1.0));
  expect_the_same(job);
}

TEST_F(DeformKernel, mirrored_joints_flip_handedness_and_keep_normals_outside) {
  Job job = job_of(300);
  add_skin(job, 5, dvec3(-1.0, 1.0, 1.0));
  expect_the_same(job);

  Job box;
  box.primitive = test::box(vec3(1.0f, 2.0f, 3.0f));
  box.constants.vertex_count = 24;
  add_skin(box, 1, dvec3(1.0, -1.0, 1.0));
  const Result result = run(box);
  const dvec3 center(box.joints[3][3]);
  for (std::size_t v = 0; v < 24; ++v) {
    EXPECT_GT(glm::dot(decoded(result.frames[v].normal), dvec3(result.positions[v]) - center), 0.1) << "vertex " << v;
    EXPECT_NE(result.frames[v].tangent & kHandednessBit, 0u);
  }
}

TEST_F(DeformKernel, morphs_positions_with_and_without_normals) {
  for (const bool normals : {false, true}) {
    for (const std::uint32_t targets : {1u, 2u, 7u}) {
      Job job = job_of(130);
      add_morphs(job, targets, normals);
      expect_the_same(job);
    }
  }
}

TEST_F(DeformKernel, morphs_before_it_skins) {
  for (const bool normals : {false, true}) {
    Job job = job_of(200);
    add_morphs(job, 3, normals);
    add_skin(job, 4, dvec3(1.0, 0.5, 1.5));
    expect_the_same(job);
  }
}

TEST_F(DeformKernel, degenerate_weights_follow_the_first_joint) {
  Job job = job_of(64);
  add_skin(job, 4, dvec3(1.0));
  for (std::size_t v = 0; v < 64; ++v) job.primitive.weights[v] = vec4(v % 2 == 0 ? 0.0f : -1.0f);
  expect_the_same(job);
  const Result result = run(job);
  for (std::size_t v = 0; v < 64; ++v) {
    const dmat4 first(job.joints[job.constants.first_joint + job.primitive.joints[v][0]]);
    EXPECT_LT(glm::length(dvec3(result.positions[v]) - dvec3(first * dvec4(dvec3(job.primitive.positions[v]), 1.0))),
              3e-5);
  }
}

TEST_F(DeformKernel, directions_that_vanish_become_the_axes) {
  Job job = job_of(70);
  add_skin(job, 2, dvec3(1.0));
  for (mat4& joint : job.joints) joint = mat4(0.0f);
  const Result result = run(job);
  for (std::size_t v = 0; v < 70; ++v) {
    EXPECT_EQ(result.positions[v], vec3(0.0f));
    EXPECT_LT(angle_degrees(decoded(result.frames[v].normal), dvec3(0.0, 1.0, 0.0)), kAngleBound);
    EXPECT_LT(angle_degrees(decoded(result.frames[v].tangent & ~kHandednessBit), dvec3(1.0, 0.0, 0.0)), kAngleBound);
  }
}

}  // namespace
}  // namespace gloam
