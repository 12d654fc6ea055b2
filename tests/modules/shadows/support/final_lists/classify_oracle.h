// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tests/modules/shadows/support/final_lists/classify_scene.h"

namespace gloam::test {

/// Decides with certainty whether a light's shadow falls on a pixel: brute force over all texels of the light's faces,
/// in double. A texel blocks if its surface is above the pixel's plane by more than the bias, is nearer to the light
/// than the pixel, and is in the cone between the pixel and the emitter. A result that rounding could change is
/// uncertain.
class ClassifyOracle {
 public:
  ClassifyOracle(const ClassifyLight& light, std::uint32_t face_size, double bias_m);

  /// Whether the light is in front of the pixel's shading normal.
  [[nodiscard]] bool is_asked(const ClassifyPixel& pixel) const;
  /// Whether part of the emitter is certainly hidden.
  [[nodiscard]] bool is_partly_hidden(const ClassifyPixel& pixel) const;
  /// Whether part of the emitter is certainly visible: a texel of the filter's kernel does not block, or no map is
  /// read.
  [[nodiscard]] bool is_partly_visible(const ClassifyPixel& pixel) const;
  /// The face whose map the pixel uses; −1: none or not certain.
  [[nodiscard]] int face_of(const ClassifyPixel& pixel) const { return receive(pixel).face; }
  /// The texel of that face that holds the pixel.
  [[nodiscard]] std::size_t texel_of(const ClassifyPixel& pixel) const;
  /// Texels between the pixel and the border of its face.
  [[nodiscard]] double to_border(const ClassifyPixel& pixel) const;

 private:
  struct Receiver {
    int face = -1;
    bool certain = true;  ///< the face is certain
    glm::dvec2 at = glm::dvec2(0.0);
    double depth = 0.0;
    double bias = 0.0;  ///< depth; with a margin for rounding
    double facing_sine = 0.0;
    double emitter_sine = 0.0;
  };
  struct Place {
    glm::dvec2 at;
    double z;  ///< metres along the face's axis
    double depth;
  };

  [[nodiscard]] bool orthographic() const { return light_.kind == CastKind::sun; }
  [[nodiscard]] Place place(int face, const dvec3& point) const;
  [[nodiscard]] glm::dvec2 offset_of(std::size_t texel) const;
  [[nodiscard]] dvec3 point_of(int face, std::size_t texel, double depth) const;
  [[nodiscard]] double plane_depth(int face, const glm::dvec2& at, const ClassifyPixel& pixel) const;
  [[nodiscard]] Receiver receive(const ClassifyPixel& pixel) const;
  void set_bias(Receiver& r, const ClassifyPixel& pixel, double bias_depth) const;
  [[nodiscard]] bool blocks(const ClassifyPixel& pixel, const Receiver& r, int face, std::size_t texel) const;
  [[nodiscard]] bool neighbours_block(const ClassifyPixel& pixel, const Receiver& r, int face, std::size_t texel) const;
  [[nodiscard]] bool hides_emitter(const ClassifyPixel& pixel, const Receiver& r, const dvec3& point) const;

  const ClassifyLight& light_;
  double size_;
  double bias_m_;
};

}  // namespace gloam::test
