// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/lobe.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/math/low_discrepancy.h"

namespace gloam {
namespace {

constexpr double kLeastViewCosine = 1e-3;  // as ShadingPoint::n_dot_v
constexpr double kLeastAboveFace = 1e-4;   // cosine of a moved mirror direction
constexpr double kFullTurn = 6.28318530717958647692;

}  // namespace

ReflectionLobe::ReflectionLobe(const dvec3& normal, const dvec3& face_normal, const dvec3& to_eye, double roughness)
    : normal_(normal), face_normal_(face_normal), to_eye_(to_eye), alpha_(std::max(roughness * roughness, 1e-3)) {
  const dvec3 helper = std::abs(normal.x) < 0.6 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
  across_ = glm::normalize(glm::cross(helper, normal));
  along_ = glm::cross(normal, across_);
  view_ =
      dvec3(glm::dot(to_eye, across_), glm::dot(to_eye, along_), std::max(glm::dot(to_eye, normal), kLeastViewCosine));
  view_ = glm::normalize(view_);
}

dvec3 ReflectionLobe::mirror() const {
  const dvec3 mirrored = glm::reflect(-to_eye_, normal_);
  const double above = glm::dot(mirrored, face_normal_);
  if (above >= kLeastAboveFace) return mirrored;
  return glm::normalize(mirrored + (kLeastAboveFace - above) * face_normal_);
}

LobeDirection ReflectionLobe::sample(double u1, double u2) const {
  // The hemisphere of visible normals of the stretched surface, projected along the view.
  const dvec3 stretched = glm::normalize(dvec3(alpha_ * view_.x, alpha_ * view_.y, view_.z));
  const double flat = std::hypot(stretched.x, stretched.y);
  const dvec3 t1 = flat > 1e-12 ? dvec3(-stretched.y, stretched.x, 0.0) / flat : dvec3(1.0, 0.0, 0.0);
  const dvec3 t2 = glm::cross(stretched, t1);
  const double radius = std::sqrt(u1), angle = kFullTurn * u2;
  const double a = radius * std::cos(angle);
  const double split = 0.5 * (1.0 + stretched.z);
  const double b = (1.0 - split) * std::sqrt(std::max(1.0 - a * a, 0.0)) + split * radius * std::sin(angle);
  const dvec3 on = a * t1 + b * t2 + std::sqrt(std::max(1.0 - a * a - b * b, 0.0)) * stretched;
  const dvec3 half = glm::normalize(dvec3(alpha_ * on.x, alpha_ * on.y, std::max(on.z, 1e-9)));

  const dvec3 local = 2.0 * glm::dot(view_, half) * half - view_;
  LobeDirection found;
  found.direction = glm::normalize(local.x * across_ + local.y * along_ + local.z * normal_);
  if (!(local.z > 0.0) || !(glm::dot(found.direction, face_normal_) > 0.0)) return found;
  // Height-correlated masking and shadowing, divided by masking alone.
  const double a2 = alpha_ * alpha_;
  const auto smith = [&](double cosine) { return std::sqrt(a2 + (1.0 - a2) * cosine * cosine); };
  found.weight = local.z * (view_.z + smith(view_.z)) / (local.z * smith(view_.z) + view_.z * smith(local.z));
  return found;
}

LobeDirection ReflectionLobe::one(const PixelSequence& sequence, std::uint32_t index, double choice) const {
  std::array<LobeDirection, kLobeCandidates> candidates;
  double total = 0.0;
  for (std::uint32_t i = 0; i < kLobeCandidates; ++i) {
    const PixelSequence::Pair at = sequence.direction(index * kLobeCandidates + i);
    candidates[i] = sample(at.x, at.y);
    total += candidates[i].weight;
  }
  double left = choice * total;
  const LobeDirection* chosen = nullptr;
  for (const LobeDirection& candidate : candidates) {
    if (!(candidate.weight > 0.0)) continue;
    chosen = &candidate;
    left -= candidate.weight;
    if (left < 0.0) break;
  }
  return chosen != nullptr ? LobeDirection{chosen->direction, total / kLobeCandidates} : LobeDirection{};
}

PixelSequence::PixelSequence(std::uint32_t pixel, std::uint32_t stream) {
  const std::uint32_t seed = stream == 0 ? pixel * 5u : permuted(pixel * 5u + 4u) ^ permuted(stream);
  scramble_x_ = permuted(seed + 1u);
  scramble_y_ = permuted(seed + 2u);
  for (int axis = 0; axis < 3; ++axis)
    shift_[axis] = unit_fraction(permuted(permuted(seed + 3u) + static_cast<std::uint32_t>(axis)));
}

PixelSequence::Pair PixelSequence::direction(std::uint32_t index) const {
  return {unit_fraction(reversed_bits(index) ^ scramble_x_), unit_fraction(second_sobol(index) ^ scramble_y_)};
}

double PixelSequence::choice(std::uint32_t index) const {
  return glm::fract(shift_.x + static_cast<double>(index) * 0.61803398874989484820);  // golden ratio
}

PixelSequence::Pair PixelSequence::emitter(std::uint32_t index) const {
  constexpr double kRoot = 1.32471795724474602596;  // of x³ = x + 1 (Roberts 2018)
  const auto i = static_cast<double>(index);
  return {glm::fract(shift_.y + i / kRoot), glm::fract(shift_.z + i / (kRoot * kRoot))};
}

}  // namespace gloam
