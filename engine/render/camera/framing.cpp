// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/camera/framing.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <span>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

constexpr double kFilled = 0.9;  // of the picture's width or height
constexpr int kCenterings = 3;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The pyramid of a camera with fixed axes that holds all points given to it. In double: float rounding far from the
/// world's origin would move points out of the picture.
class Pyramid {
 public:
  /// back: from what is seen to the camera, unit length. tangents: of half the angles of view.
  Pyramid(const dvec3& back, const glm::dvec2& tangents) : back_(back), tangents_(tangents) {
    right_ = glm::normalize(glm::cross(dvec3(0.0, 1.0, 0.0), back));
    up_ = glm::cross(back, right_);
  }

  void add(const dvec3& point) {
    const double height = glm::dot(point, back_);
    const glm::dvec2 across(glm::dot(point, right_), glm::dot(point, up_));
    if (!std::isfinite(height + across.x + across.y)) return;
    highest_ = glm::max(highest_, across + height * tangents_);
    lowest_ = glm::max(lowest_, -across + height * tangents_);
    nearest_ = std::max(nearest_, height);
    farthest_ = std::min(farthest_, height);
  }

  [[nodiscard]] bool empty() const { return !(nearest_ >= farthest_); }
  /// The nearest place of the camera. Points lie on planes with across ± tangent · height = const., so the planes of
  /// the outermost points meet at the camera.
  [[nodiscard]] dvec3 eye() const {
    const glm::dvec2 across = (highest_ - lowest_) * 0.5, heights = (highest_ + lowest_) * 0.5 / tangents_;
    const double size = std::max(heights.x, heights.y) - farthest_;
    // Before the nearest point by a thousandth of the size; a single point is seen from a thousandth of a unit.
    const double least = std::max(1e-3 * (size > 0.0 ? size : 1.0), 1e-12 * std::abs(nearest_));
    const double height = std::max({heights.x, heights.y, nearest_ + least});
    return right_ * across.x + up_ * across.y + back_ * height;
  }
  [[nodiscard]] double nearest_m(const dvec3& eye) const { return glm::dot(eye, back_) - nearest_; }
  [[nodiscard]] const dvec3& right() const { return right_; }
  [[nodiscard]] const dvec3& up() const { return up_; }
  [[nodiscard]] const dvec3& back() const { return back_; }

 private:
  dvec3 back_, right_, up_;
  glm::dvec2 tangents_;
  glm::dvec2 highest_ = glm::dvec2(-kInfinity), lowest_ = glm::dvec2(-kInfinity);
  double nearest_ = -kInfinity, farthest_ = kInfinity;
};

/// The outermost points of a picture, to the right, left, top and bottom.
class Outline {
 public:
  Outline(const Pyramid& camera, const dvec3& eye) : camera_(camera), eye_(eye) {}

  void add(const dvec3& point) {
    const dvec3 from_eye = point - eye_;
    const double depth = -glm::dot(from_eye, camera_.back());
    const glm::dvec2 across(glm::dot(from_eye, camera_.right()), glm::dot(from_eye, camera_.up()));
    if (!(depth > 0.0) || !std::isfinite(across.x + across.y)) return;
    for (int axis = 0; axis < 2; ++axis) {
      if (across[axis] / depth > high_[axis].slope) high_[axis] = {across[axis] / depth, across[axis], depth};
      if (-across[axis] / depth > low_[axis].slope) low_[axis] = {-across[axis] / depth, across[axis], depth};
    }
  }

  /// The place beside the camera from which these points have the same distance from the picture's middle.
  [[nodiscard]] dvec3 centered_eye() const {
    const auto shift = [&](int axis) {
      const Point &high = high_[axis], &low = low_[axis];
      return (high.across * low.depth + low.across * high.depth) / (high.depth + low.depth);
    };
    return eye_ + camera_.right() * shift(0) + camera_.up() * shift(1);
  }

 private:
  struct Point {
    double slope = -kInfinity;
    double across = 0.0;
    double depth = 1.0;
  };
  const Pyramid& camera_;
  dvec3 eye_;
  Point high_[2], low_[2];
};

/// Joint matrices of an instance; none if it is not skinned or has not been posed.
struct Joints {
  std::span<const mat4> matrices;
  dvec3 origin = dvec3(0.0);
};

Joints joints_of(const World& world, Entity instance) {
  const auto* joints = world.try_resource<JointMatrices>();
  if (joints == nullptr) return {};
  const auto found = std::ranges::lower_bound(joints->ranges, instance.index, {},
                                              [](const JointMatrices::Range& range) { return range.instance.index; });
  if (found == joints->ranges.end() || found->instance != instance) return {};
  return {std::span(joints->matrices).subspan(found->first, found->count), found->origin};
}

dvec3 skinned(const Primitive& primitive, std::size_t vertex, const Joints& joints) {
  dvec3 sum(0.0);
  for (int i = 0; i < 4; ++i) {
    const float weight = primitive.weights[vertex][i];
    const std::uint16_t joint = primitive.joints[vertex][static_cast<std::size_t>(i)];
    if (weight <= 0.0f || joint >= joints.matrices.size()) continue;
    sum += dvec3(joints.matrices[joint] * vec4(primitive.positions[vertex], 1.0f)) * static_cast<double>(weight);
  }
  return sum + joints.origin;
}

template <class Visit>
void each_drawn_point(const World& world, const Visit& visit) {
  const SceneAssets* assets = world.try_resource<SceneAssets>();
  if (assets == nullptr) return;
  world.view<const MeshInstance, const WorldTransform>().each(
      [&](Entity entity, const MeshInstance& instance, const WorldTransform& transform) {
        if (instance.mesh >= assets->meshes.size()) return;
        const Joints joints = joints_of(world, entity);
        for (const Primitive& primitive : assets->meshes[instance.mesh].primitives) {
          const bool is_skinned = !joints.matrices.empty() && primitive.joints.size() == primitive.positions.size();
          for (std::size_t i = 0; i < primitive.positions.size(); ++i)
            visit(is_skinned ? skinned(primitive, i, joints)
                             : dvec3(transform.matrix * dvec4(dvec3(primitive.positions[i]), 1.0)));
        }
      });
}

}  // namespace

ViewSettings framed_view(const World& world, std::uint32_t width, std::uint32_t height) {
  ViewSettings settings;
  settings.width = width;
  settings.height = height;
  const double tangent = std::tan(0.5 * static_cast<double>(settings.camera.fov_y));
  const double aspect = static_cast<double>(width) / static_cast<double>(height);
  const dvec3 back = glm::normalize(dvec3(0.6, 0.6, 1.0));
  Pyramid pyramid(back, kFilled * tangent * glm::dvec2(aspect, 1.0));
  each_drawn_point(world, [&](const dvec3& point) { pyramid.add(point); });
  if (pyramid.empty()) pyramid.add(dvec3(0.0)), pyramid.add(dvec3(1.0));
  dvec3 eye = pyramid.eye();
  // The axis that does not decide the distance has room on both sides. Moving the camera changes which points are
  // outermost, so it moves a few times.
  for (int i = 0; i < kCenterings; ++i) {
    Outline outline(pyramid, eye);
    each_drawn_point(world, [&](const dvec3& point) { outline.add(point); });
    eye = outline.centered_eye();
  }
  settings.camera.near_m = static_cast<float>(std::clamp(pyramid.nearest_m(eye) * 0.5, 1e-18, 0.1));
  settings.world_from_camera = glm::inverse(glm::lookAt(dvec3(0.0), -back, pyramid.up()));
  settings.world_from_camera[3] = dvec4(eye, 1.0);
  return settings;
}

}  // namespace gloam
