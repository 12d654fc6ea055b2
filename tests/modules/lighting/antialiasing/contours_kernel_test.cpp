// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/math/srgb.h"
#include "modules/accuracy/metrics/flip.h"
#include "tests/modules/lighting/antialiasing/smoothed_picture.h"

// Errors of smoothed contours against pictures with 16 samples a pixel.

namespace gloam::test {
namespace {

using Field = std::function<double(double x, double y)>;

struct Errors {
  double rmse = 0.0;  ///< of displayed linear light
  double flip = 0.0;
};

class SmoothedContours : public AntialiasingTest {
 protected:
  static constexpr int kSide = 128;

  [[nodiscard]] static ShownPicture sampled(const Field& field) {
    return {kSide, kSide, [&](int x, int y) { return field(x + 0.5, y + 0.5); }};
  }
  /// 16 points of each pixel, a row and a column of sixteenths each.
  [[nodiscard]] static std::vector<double> supersampled(const Field& field) {
    std::vector<double> means;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        double sum = 0.0;
        for (int i = 0; i < 16; ++i) sum += field(x + (i + 0.5) / 16.0, y + ((5 * i + 3) % 16 + 0.5) / 16.0);
        means.push_back(sum / 16.0);
      }
    return means;
  }
  [[nodiscard]] static std::vector<double> plain(const ShownPicture& picture) {
    std::vector<double> values;
    for (const vec4& pixel : picture.pixels) values.push_back(static_cast<double>(pixel.x));
    return values;
  }
  [[nodiscard]] static std::vector<std::uint8_t> encoded(const std::vector<double>& grey) {
    std::vector<std::uint8_t> bytes;
    for (const double x : grey) {
      const auto value = static_cast<std::uint8_t>(std::lround(255.0 * linear_to_srgb(x)));
      bytes.insert(bytes.end(), {value, value, value, 255});
    }
    return bytes;
  }
  [[nodiscard]] static Errors errors(const std::vector<double>& right, const std::vector<double>& shown) {
    Errors result;
    for (std::size_t i = 0; i < right.size(); ++i) result.rmse += (right[i] - shown[i]) * (right[i] - shown[i]);
    result.rmse = std::sqrt(result.rmse / static_cast<double>(right.size()));
    const std::vector<std::uint8_t> a = encoded(right), b = encoded(shown);
    const std::vector<float> map = flip_error_map(flip_features({kSide, kSide, a}), flip_features({kSide, kSide, b}));
    for (const float value : map) result.flip += static_cast<double>(value) / static_cast<double>(map.size());
    return result;
  }

  /// The short form of FXAA as a yardstick (Lottes 2009, "FXAA", the filter along the gradient of the four diagonal
  /// neighbours, with two and with four taps).
  [[nodiscard]] static std::vector<double> along_gradient(const ShownPicture& p) {
    const auto pixel = [&](int x, int y) { return p.at(std::clamp(x, 0, kSide - 1), std::clamp(y, 0, kSide - 1)); };
    const auto look = [&](double x, double y) {
      const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
      return glm::mix(glm::mix(dvec4(pixel(left, top)), dvec4(pixel(left + 1, top)), x - left),
                      glm::mix(dvec4(pixel(left, top + 1)), dvec4(pixel(left + 1, top + 1)), x - left), y - top);
    };
    std::vector<double> result;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const double nw = look(x - 0.5, y - 0.5).w, ne = look(x + 0.5, y - 0.5).w, sw = look(x - 0.5, y + 0.5).w,
                     se = look(x + 0.5, y + 0.5).w, own = static_cast<double>(pixel(x, y).w);
        const double low = std::min({nw, ne, sw, se, own}), high = std::max({nw, ne, sw, se, own});
        glm::dvec2 along(sw + se - nw - ne, nw + sw - ne - se);
        along /= std::min(std::abs(along.x), std::abs(along.y)) + std::max((nw + ne + sw + se) / 32.0, 1.0 / 128.0);
        along = glm::clamp(along, glm::dvec2(-8.0), glm::dvec2(8.0));
        const auto tap = [&](double share) { return look(x + along.x * share, y + along.y * share); };
        const dvec4 two = 0.5 * (tap(-1.0 / 6.0) + tap(1.0 / 6.0)), four = 0.5 * two + 0.25 * (tap(-0.5) + tap(0.5));
        result.push_back(four.w < low || four.w > high ? two.x : four.x);
      }
    return result;
  }
};

Field half_plane(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return [=](double x, double y) {
    return (x - 63.7) * std::sin(angle) - (y - 64.2) * std::cos(angle) > 0.0 ? 0.75 : 0.05;
  };
}

TEST_F(SmoothedContours, of_slanted_edges_are_nearer_to_the_supersampled_picture) {
  double plain_sum = 0.0, fxaa_sum = 0.0, smooth_sum = 0.0, plain_flip = 0.0, fxaa_flip = 0.0, smooth_flip = 0.0;
  int count = 0;
  for (double degrees = 3.5; degrees < 180.0; degrees += 9.5, ++count) {
    const Field field = half_plane(degrees);
    const ShownPicture picture = sampled(field);
    const std::vector<double> right = supersampled(field);
    const Errors before = errors(right, plain(picture));
    const Errors fxaa = errors(right, along_gradient(picture));
    const Errors after = errors(right, blended(picture, antialiasing_weights(*device(), picture)));
    EXPECT_LT(after.rmse, 0.7 * before.rmse) << degrees;
    plain_sum += before.rmse;
    fxaa_sum += fxaa.rmse;
    smooth_sum += after.rmse;
    plain_flip += before.flip;
    fxaa_flip += fxaa.flip;
    smooth_flip += after.flip;
  }
  std::printf("half-planes: RMSE plain %.4f, FXAA %.4f, smoothed %.4f; FLIP %.4f, %.4f, %.4f\n", plain_sum / count,
              fxaa_sum / count, smooth_sum / count, plain_flip / count, fxaa_flip / count, smooth_flip / count);
  EXPECT_LT(smooth_sum, 0.42 * plain_sum);
  EXPECT_LT(smooth_sum, 0.7 * fxaa_sum);
  EXPECT_LT(smooth_flip, 0.7 * plain_flip);
  EXPECT_LT(smooth_flip, 0.8 * fxaa_flip);
}

TEST_F(SmoothedContours, of_curves_and_thin_bars_are_nearer_to_the_supersampled_picture) {
  const std::pair<const char*, Field> fields[] = {
      {"disc", [](double x, double y) { return std::hypot(x - 64.3, y - 61.9) < 41.4 ? 0.8 : 0.1; }},
      {"small discs",
       [](double x, double y) {
         return std::hypot(std::fmod(x, 16.3) - 8.0, std::fmod(y, 15.7) - 8.0) < 5.3 ? 0.8 : 0.1;
       }},
      {"bars", [](double x, double y) { return std::fmod(x * 0.31 + y * 0.95 + 2.0, 13.0) < 4.0 ? 0.7 : 0.1; }},
      {"star", [](double x, double y) {
         return std::sin(9.0 * std::atan2(y - 63.8, x - 64.1)) > 0.0 && std::hypot(x - 64.1, y - 63.8) > 20.0 ? 0.7
                                                                                                              : 0.1;
       }}};
  for (const auto& [name, field] : fields) {
    const ShownPicture picture = sampled(field);
    const std::vector<double> right = supersampled(field);
    const Errors before = errors(right, plain(picture)), fxaa = errors(right, along_gradient(picture));
    const Errors after = errors(right, blended(picture, antialiasing_weights(*device(), picture)));
    std::printf("%s: RMSE plain %.4f, FXAA %.4f, smoothed %.4f; FLIP %.4f, %.4f, %.4f\n", name, before.rmse, fxaa.rmse,
                after.rmse, before.flip, fxaa.flip, after.flip);
    EXPECT_LT(after.rmse, 0.8 * before.rmse) << name;
    EXPECT_LT(after.rmse, fxaa.rmse) << name;
  }
}

}  // namespace
}  // namespace gloam::test
