// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/reference/blur_twin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace gloam {
namespace {

class DofTwin {
 public:
  explicit DofTwin(const DofInput& in) : in_(in), scale_(static_cast<int>(in.knobs.scale())) {
    columns_ = (static_cast<int>(in.width) + scale_ - 1) / scale_;
    rows_ = (static_cast<int>(in.height) + scale_ - 1) / scale_;
  }

  /// The light after the module.
  [[nodiscard]] std::vector<dvec4> light() const {
    const Layer far = blurred(filtered(false), false), near = blurred(filtered(true), true);
    const Layer beyond = blurred(filtered(true, true), true);
    std::vector<dvec4> result;
    for (int y = 0; y < static_cast<int>(in_.height); ++y)
      for (int x = 0; x < static_cast<int>(in_.width); ++x) result.push_back(composed(x, y, far, near, beyond));
    return result;
  }

 private:
  using Layer = std::vector<dvec4>;
  static constexpr double kSlanted = 0.88;
  static constexpr int kTile = 16;

  [[nodiscard]] double coc(int x, int y) const {
    const int cx = std::clamp(x, 0, static_cast<int>(in_.width) - 1);
    const int cy = std::clamp(y, 0, static_cast<int>(in_.height) - 1);
    const double value = in_.coc[in_.at(static_cast<std::uint32_t>(cx), static_cast<std::uint32_t>(cy))];
    return std::clamp(value, -static_cast<double>(in_.knobs.radius), static_cast<double>(in_.knobs.radius));
  }
  [[nodiscard]] dvec3 lit(int x, int y) const {
    const int cx = std::clamp(x, 0, static_cast<int>(in_.width) - 1);
    const int cy = std::clamp(y, 0, static_cast<int>(in_.height) - 1);
    return dvec3(
        vec3(dof_light(dof_half(in_.light[in_.at(static_cast<std::uint32_t>(cx), static_cast<std::uint32_t>(cy))]))));
  }
  [[nodiscard]] double share(double circle) const {
    return std::clamp((circle - 0.5) / (scale_ == 2 ? 2.5 : 0.75), 0.0, 1.0);
  }
  static dvec4 rounded(const dvec4& v) { return dvec4(dof_light(dof_half(vec4(v)))); }

  [[nodiscard]] Layer filtered(bool near, bool beyond = false) const {
    Layer layer;
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) {
        dvec3 sum(0.0);
        double weights = 0.0, squares = 0.0;
        for (int dy = 0; dy < scale_; ++dy)
          for (int dx = 0; dx < scale_; ++dx) {
            const int px = x * scale_ + dx, py = y * scale_ + dy;
            const double circle = coc(px, py);
            const double before = beyond ? 1.0 - share(-circle) : share(-circle);
            const double weight = near ? before / (scale_ * scale_) : circle >= 0.5 ? circle : 0.0;
            sum += weight * lit(px, py);
            weights += weight;
            squares += weight * weight;
          }
        if (near)
          layer.push_back(rounded(dvec4(sum, weights)));
        else if (weights > 0.0)
          layer.push_back(rounded(dvec4(sum / weights, squares / weights / static_cast<double>(in_.knobs.radius))));
        else
          layer.push_back(dvec4(0.0));
      }
    return layer;
  }

  [[nodiscard]] dvec4 texel(const Layer& layer, int x, int y) const {
    return layer[static_cast<std::size_t>(std::clamp(y, 0, rows_ - 1) * columns_ + std::clamp(x, 0, columns_ - 1))];
  }

  /// Radius of a kernel as a multiple of the circle's.
  [[nodiscard]] double widening() const { return in_.bokeh == Bokeh::round ? 1.4 : 1.0; }
  /// The greatest kernel before the focus that reaches a tile.
  [[nodiscard]] double reach(int tx, int ty) const {
    const int across = (static_cast<int>(in_.width) + kTile - 1) / kTile;
    const int down = (static_cast<int>(in_.height) + kTile - 1) / kTile;
    tx = std::clamp(tx, 0, across - 1);
    ty = std::clamp(ty, 0, down - 1);
    double most = 0.0;
    for (int y = 0; y < static_cast<int>(in_.height); ++y)
      for (int x = 0; x < static_cast<int>(in_.width); ++x) {
        const int apart = std::max(std::abs(x / kTile - tx), std::abs(y / kTile - ty));
        const double radius = -coc(x, y) * widening();
        if (-coc(x, y) >= 0.5 && radius > kTile * std::max(apart - 1, 0)) most = std::max(most, radius);
      }
    return dof_light(dof_half(vec4(static_cast<float>(most)))).x;
  }
  [[nodiscard]] std::vector<double> near_radii() const {
    const int across = (static_cast<int>(in_.width) + kTile - 1) / kTile;
    const int down = (static_cast<int>(in_.height) + kTile - 1) / kTile;
    std::vector<double> reaches;
    for (int y = 0; y < down; ++y)
      for (int x = 0; x < across; ++x) reaches.push_back(reach(x, y));
    const auto at = [&](int x, int y) {
      return reaches[static_cast<std::size_t>(std::clamp(y, 0, down - 1) * across + std::clamp(x, 0, across - 1))];
    };
    std::vector<double> radii;
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) {
        const double u = (x + 0.5) * scale_ / kTile - 0.5, v = (y + 0.5) * scale_ / kTile - 0.5;
        const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
        const double s = u - left, t = v - top;
        const double radius = (at(left, top) * (1.0 - s) + at(left + 1, top) * s) * (1.0 - t) +
                              (at(left, top + 1) * (1.0 - s) + at(left + 1, top + 1) * s) * t;
        radii.push_back(at(x * scale_ / kTile, y * scale_ / kTile) > 0.0 ? radius / scale_ : 0.0);
      }
    return radii;
  }

  /// The weighted mean of texels of a line. place(n): of the n-th step from (x, y); a place between two rows counts
  /// half for each. weight(n, radius): of a step, for n from `first`. spread: the light of a place is the mean of those
  /// this far above and below it.
  [[nodiscard]] dvec4 line(const Layer& layer, bool near, int x, int y, double radius, int first,
                           const std::function<glm::dvec2(int)>& place,
                           const std::function<double(int, double)>& weight, double spread = 0.0) const {
    dvec4 sum(0.0);
    double total = 0.0;
    for (int n = first; n <= 45; ++n) {
      const double w = weight(n, radius);
      if (w <= 0.0) continue;
      const glm::dvec2 at = place(n);
      for (const double y_at : {at.y - spread, at.y + spread})
        for (const double row : {std::floor(y_at), std::ceil(y_at)}) {
          const dvec4 value = texel(layer, static_cast<int>(at.x), static_cast<int>(row));
          const double counted = 0.25 * w * (near ? 1.0 : value.w);
          sum += counted * value;
          total += counted;
        }
    }
    const dvec4 mean = total > 0.0 ? sum / total : dvec4(0.0);
    return near ? mean : dvec4(dvec3(mean), texel(layer, x, y).w);
  }

  [[nodiscard]] Layer blurred(const Layer& layer, bool near) const {
    const std::vector<double> reaching = near ? near_radii() : std::vector<double>();
    const auto each = [&](const std::function<dvec4(int, int, double)>& filter) {
      Layer result;
      for (int y = 0; y < rows_; ++y)
        for (int x = 0; x < columns_; ++x) {
          const double radius =
              near ? reaching[static_cast<std::size_t>(y * columns_ + x)]
                   : texel(layer, x, y).w * widening() * static_cast<double>(in_.knobs.radius) / scale_;
          result.push_back(rounded(filter(x, y, radius)));
        }
      return result;
    };
    if (in_.bokeh == Bokeh::round) {
      const auto gauss = [](int n, double radius) {
        const double t = n / std::max(radius, 0.001);
        return std::exp(-3.0 * t * t) * std::pow(std::max(1.0 - t * t, 0.0), 2);
      };
      const Layer rows = each([&](int x, int y, double radius) {
        return line(
            layer, near, x, y, radius, -45, [&](int n) { return glm::dvec2(x + n, y); }, gauss);
      });
      return each([&](int x, int y, double radius) {
        return line(
            rows, near, x, y, radius, -45, [&](int n) { return glm::dvec2(x, y + n); }, gauss);
      });
    }
    return hexagon(layer, near, each);
  }

  static double cover(int n, double length) {
    return n == 0 ? std::clamp(length, 1e-3, 0.5) : std::clamp(length + 0.5 - n, 0.0, 1.0);
  }

  template <class Each>
  [[nodiscard]] Layer hexagon(const Layer& layer, bool near, const Each& each) const {
    const auto upright = [&](const Layer& from, int x, int y, double radius) {
      return line(
          from, near, x, y, radius, 0, [&](int n) { return glm::dvec2(x, y - n); }, cover);
    };
    const auto right = [&](const Layer& from, int x, int y, double radius) {
      return line(
          from, near, x, y, kSlanted * radius, 0, [&](int n) { return glm::dvec2(x + n, y + 0.5 * n); }, cover, 0.5);
    };
    const auto left = [&](const Layer& from, int x, int y, double radius) {
      return line(
          from, near, x, y, kSlanted * radius, 0, [&](int n) { return glm::dvec2(x - n, y + 0.5 * n); }, cover, 0.5);
    };
    const Layer up = each([&](int x, int y, double radius) { return upright(layer, x, y, radius); });
    const Layer both = each([&](int x, int y, double radius) {
      return (upright(layer, x, y, radius) + kSlanted * right(layer, x, y, radius)) / (1.0 + kSlanted);
    });
    return each([&](int x, int y, double radius) {
      return (right(up, x, y, radius) + (1.0 + kSlanted) * left(both, x, y, radius)) / (2.0 + kSlanted);
    });
  }

  /// A layer at a pixel, interpolated. Of the far layer, light is weighted by alpha and then divided by it. in_tile:
  /// only between texels of the pixel's tile.
  [[nodiscard]] dvec4 shown(const Layer& layer, bool near, int x, int y, bool in_tile = false) const {
    const double u = (x + 0.5) / scale_ - 0.5, v = (y + 0.5) / scale_ - 0.5;
    const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
    dvec4 sum(0.0);
    for (int dy = 0; dy < 2; ++dy)
      for (int dx = 0; dx < 2; ++dx) {
        const double weight = (dx == 0 ? 1.0 - (u - left) : u - left) * (dy == 0 ? 1.0 - (v - top) : v - top);
        const int side = kTile / scale_, first_x = x / kTile * side, first_y = y / kTile * side;
        const int column = in_tile ? std::clamp(left + dx, first_x, first_x + side - 1) : left + dx;
        const int row = in_tile ? std::clamp(top + dy, first_y, first_y + side - 1) : top + dy;
        const dvec4 value = texel(layer, column, row);
        sum += weight * (near ? value : dvec4(dvec3(value) * value.w, value.w));
      }
    if (near || sum.w <= 0.0) return sum;
    return {dvec3(sum) / sum.w, sum.w};
  }

  [[nodiscard]] dvec4 composed(int x, int y, const Layer& far, const Layer& near, const Layer& beyond) const {
    const dvec4 behind = shown(far, false, x, y), before = shown(near, true, x, y);
    const double blurred = behind.w > 0.0 ? share(coc(x, y)) : 0.0;
    dvec3 light = lit(x, y) * (1.0 - blurred) + dvec3(behind) * blurred;
    if (before.w > 0.0) {
      const dvec4 hidden = shown(beyond, true, x, y, true);
      const double own = share(-coc(x, y));
      const dvec4 filled = hidden.w > 1e-4 ? hidden : before;
      light = (1.0 - own) * light + own * dvec3(filled) / filled.w;
      light = dvec3(before) + (1.0 - before.w) * light;
    }
    return dvec4(light, 1.0);
  }

  const DofInput& in_;
  int scale_ = 2;
  int columns_ = 0;
  int rows_ = 0;
};

}  // namespace

std::vector<dvec4> dof_twin_light(const DofInput& in) { return DofTwin(in).light(); }

}  // namespace gloam
