// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/reference/blur_twin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "modules/depth_of_field/levels/levels.h"

namespace gloam {
namespace {

constexpr double kTwinFocus = 0.5;
constexpr double kBesideNear = -1.0, kNoLight = -2.0;  // alpha of far texels
constexpr double kNearFiner = GLOAM_DOF_NEAR_FINER;
constexpr int kTwinTile = GLOAM_DOF_TILE;

bool all_finite(const dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
double brightest(const dvec3& v) { return std::max({v.x, v.y, v.z}); }
double smooth_ramp(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

class DofTwin {
 public:
  explicit DofTwin(const DofInput& in)
      : in_(in), width_(static_cast<int>(in.width)), height_(static_cast<int>(in.height)) {
    static_cast<void>(set_dof_levels({in.width, in.height}, in.knobs, in.bokeh, c_));
  }

  /// The light after the module.
  [[nodiscard]] std::vector<dvec4> light() {
    find_tiles();
    find_sprites();
    for (int k = c_.first_level; k <= c_.last_level; ++k) {
      filter(k);
      gather(k);
    }
    std::vector<dvec4> result;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) result.emplace_back(composed(x, y), 1.0);
    return result;
  }

 private:
  struct Level {
    int columns = 0, rows = 0;
    std::vector<dvec4> far, near, blurred_far, blurred_near;
    std::vector<double> near_radius;
    [[nodiscard]] std::size_t at(int x, int y) const {
      return static_cast<std::size_t>(std::clamp(y, 0, rows - 1) * columns + std::clamp(x, 0, columns - 1));
    }
  };
  struct Sprite {
    double x = 0.0, y = 0.0, coc = 0.0, soft = 1.0;
    dvec3 light{0.0};
  };

  static dvec4 rounded(const dvec4& v) { return dvec4(dof_light(dof_half(vec4(glm::min(v, dvec4(65504.0)))))); }

  [[nodiscard]] std::size_t pixel(int x, int y) const {
    return in_.at(static_cast<std::uint32_t>(std::clamp(x, 0, width_ - 1)),
                  static_cast<std::uint32_t>(std::clamp(y, 0, height_ - 1)));
  }
  [[nodiscard]] double coc(int x, int y) const {
    return std::clamp(static_cast<double>(in_.coc[pixel(x, y)]), -double{c_.radius}, double{c_.radius});
  }
  [[nodiscard]] dvec3 lit(int x, int y) const { return dvec3(vec3(dof_light(dof_half(in_.light[pixel(x, y)])))); }

  [[nodiscard]] double share(int level, double radius) const {
    const auto passed = [&](int k) {
      return std::clamp((radius - double{c_.from[k]}) / (double{c_.to[k]} - double{c_.from[k]}), 0.0, 1.0);
    };
    return (level == c_.first_level ? 1.0 : passed(level - 1)) * (level == c_.last_level ? 1.0 : 1.0 - passed(level));
  }

  [[nodiscard]] double distance(double x, double y) const {
    x = std::abs(x);
    y = std::abs(y);
    if (in_.bokeh == Bokeh::round) return std::sqrt(x * x + y * y);
    return std::max(x, 0.5 * x + std::sqrt(0.75) * y);
  }
  /// Weight of light at a distance from where it is, over an aperture of this radius with an edge of this width.
  [[nodiscard]] double spread(double away, double radius, double soft = 1.0) const {
    const double area =
        (in_.bokeh == Bokeh::round ? 3.14159265358979 : std::sqrt(12.0)) * (radius * radius + soft * soft / 12.0);
    return std::clamp((radius - away) / soft + 0.5, 0.0, 1.0) / area;
  }

  [[nodiscard]] int tile_of(int x, int y) const { return y / kTwinTile * across_ + x / kTwinTile; }
  [[nodiscard]] double sprite_share(int x, int y) const {
    const double around = around_[static_cast<std::size_t>(tile_of(x, y))], bright = brightest(lit(x, y));
    const double circle = coc(x, y);
    const bool is_sprite = around >= 0.0 && std::abs(circle) >= kTwinFocus && bright > 1e-6 &&
                           bright > around * (40.0 + 0.05 * 3.2 * circle * circle);
    return is_sprite ? 1.0 - around / bright : 0.0;
  }
  /// Levels of the pixels of a tile, before and behind the focus, and of those that are composed in it.
  struct Tile {
    unsigned far = 0, near = 0, fill = 0;
    double near_radius = 0.0, least_near = 1e9;
    unsigned composed_far = 0, composed_near = 0;
  };
  [[nodiscard]] double lowest(int k) const { return k == c_.first_level ? kTwinFocus : double{c_.from[k - 1]}; }
  [[nodiscard]] double greatest(int k) const { return k == c_.last_level ? 1e9 : double{c_.to[k]}; }
  void find_tiles() {
    across_ = (width_ + kTwinTile - 1) / kTwinTile;
    down_ = (height_ + kTwinTile - 1) / kTwinTile;
    tiles_.resize(static_cast<std::size_t>(across_ * down_));
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        Tile& tile = tiles_[static_cast<std::size_t>(tile_of(x, y))];
        const double circle = coc(x, y);
        for (int k = c_.first_level; k <= c_.last_level; ++k) {
          const bool is_level = std::abs(circle) >= lowest(k) && std::abs(circle) < greatest(k);
          (circle > 0.0 ? tile.far : tile.fill) |= is_level ? 1u << k : 0u;
          const bool is_near = circle <= -kNearFiner * (k == c_.first_level ? kTwinFocus / kNearFiner : lowest(k)) &&
                               circle > -kNearFiner * greatest(k);
          tile.near |= is_near ? 1u << k : 0u;
        }
        tile.least_near = std::min(tile.least_near, circle > -kTwinFocus ? 0.0 : -circle);
        if (circle <= -kTwinFocus) tile.near_radius = std::max(tile.near_radius, -circle);
      }
    for (int y = 0; y < down_; ++y)
      for (int x = 0; x < across_; ++x) reach_tile(x, y);
  }
  void reach_tile(int tx, int ty) {
    Tile& own = tiles_[static_cast<std::size_t>(ty * across_ + tx)];
    own.composed_far = own.far;
    for (int y = 0; y < down_; ++y)
      for (int x = 0; x < across_; ++x) {
        const Tile& other = tiles_[static_cast<std::size_t>(y * across_ + x)];
        const int apart = std::max(std::abs(x - tx), std::abs(y - ty));
        for (int k = c_.first_level; k <= c_.last_level; ++k) {
          const unsigned bit = 1u << k;
          const double between = k == 0 ? 1.0 : 1.5 * (1 << k),
                       radius = std::min(other.near_radius, kNearFiner * greatest(k));
          if (radius + between > kTwinTile * std::max(apart - 1, 0)) own.composed_near |= other.near & bit;
          if (other.least_near < std::max(0.81 * own.near_radius - 0.25, 1e-3) && kTwinTile * (apart - 1) <= c_.taps[k]
                                                                                                                 << k)
            own.composed_far |= own.fill & bit;
        }
      }
  }

  /// Light that sprites take, and its place and circle, weighted by its brightness.
  struct Bright {
    dvec3 light{0.0};
    dvec4 place{0.0};  ///< x, y, circle, x² + y²
    double weight = 0.0;
    void add(const Bright& other) {
      light += other.light;
      place += other.place;
      weight += other.weight;
    }
    void append_to(std::vector<Sprite>& sprites) const {
      if (weight <= 0.0) return;
      const dvec4 mean = place / weight;
      const double variance = std::max(0.5 * (mean.w - mean.x * mean.x - mean.y * mean.y), 0.0);
      const double soft = std::min(std::sqrt(12.0 * variance + 1.0), std::max(std::abs(mean.z), 1.0));
      sprites.push_back({mean.x, mean.y, mean.z, soft, light});
    }
  };
  [[nodiscard]] Bright bright_block(int left, int top) const {
    Bright sum;
    for (int y = top; y < std::min(top + 2, height_); ++y)
      for (int x = left; x < std::min(left + 2, width_); ++x) {
        const double part = all_finite(lit(x, y)) ? sprite_share(x, y) : 0.0;
        if (part <= 0.0) continue;
        const double weight = part * brightest(lit(x, y));
        sum.add({part * lit(x, y), weight * dvec4(x, y, coc(x, y), x * x + y * y), weight});
      }
    return sum;
  }
  /// Of a block of 16 pixels: one where circles are wide, else one for each 4 of them.
  void add_sprites(int left, int top, std::vector<Sprite>& sprites) const {
    Bright wide;
    for (int j = 0; j < 4; ++j) {
      const Bright found = bright_block(left + 2 * (j & 1), top + 2 * (j >> 1));
      if (std::abs(found.place.z) >= 5.0 * found.weight)
        wide.add(found);
      else
        found.append_to(sprites);
    }
    wide.append_to(sprites);
  }
  void find_sprites() {
    around_.assign(tiles_.size(), -1.0);
    for (int tile = 0; tile < across_ * down_; ++tile) {
      const int left = tile % across_ * kTwinTile, top = tile / across_ * kTwinTile;
      const int right = std::min(left + kTwinTile, width_), bottom = std::min(top + kTwinTile, height_);
      double roots = 0.0;
      for (int y = top; y < top + kTwinTile; y += 2)
        for (int x = left; x < left + kTwinTile; x += 2)
          roots += all_finite(lit(x, y)) ? std::sqrt(std::sqrt(std::max(brightest(lit(x, y)), 0.0))) : 0.0;
      const Tile& levels = tiles_[static_cast<std::size_t>(tile)];
      if ((levels.far | levels.near) <= 1u) continue;
      around_[static_cast<std::size_t>(tile)] = std::pow(roots / 64.0, 4.0);
      std::vector<Sprite> found;
      for (int y = top; y < bottom; y += 4)
        for (int x = left; x < right; x += 4) add_sprites(x, y, found);
      if (found.size() > GLOAM_DOF_TILE_SPRITES || found.empty())
        around_[static_cast<std::size_t>(tile)] = -1.0;
      else
        sprites_.insert(sprites_.end(), found.begin(), found.end());
    }
  }

  [[nodiscard]] double kernel(double circle, int k) const {
    const double greatest = k == c_.last_level ? double{c_.radius} : double{c_.to[k]};
    return dof_kernel_radius(in_.bokeh, std::min(circle, greatest), k);
  }

  void filter(int k) {
    const int scale = 1 << k;
    Level& level = levels_[k];
    level.columns = (width_ + scale - 1) / scale;
    level.rows = (height_ + scale - 1) / scale;
    for (int row = 0; row < level.rows; ++row)
      for (int column = 0; column < level.columns; ++column) filter_texel(k, column, row);
  }
  void filter_texel(int k, int column, int row) {
    Level& level = levels_[k];
    const int scale = 1 << k;
    dvec3 far(0.0), focused(0.0);
    dvec4 near(0.0);
    double far_weight = 0.0, far_circle = 0.0, far_bright = 0.0, focus_weight = 0.0, circles = 0.0;
    double before = 0.0;
    dvec4 before_focus(0.0);
    const double least = k == c_.first_level ? kTwinFocus : std::max(0.5 * c_.from[k - 1], kTwinFocus);
    for (int y = row * scale; y < (row + 1) * scale; ++y)
      for (int x = column * scale; x < (column + 1) * scale; ++x) {
        const int px = std::min(x, width_ - 1), py = std::min(y, height_ - 1);
        const double circle = coc(px, py);
        before = std::max(before, -circle);
        if (!all_finite(lit(px, py))) continue;
        const dvec3 light = lit(px, py) * (1.0 - sprite_share(px, py));
        if (circle >= least) {
          const double weight = std::min(circle, 1.0);
          far += weight * light;
          far_weight += weight;
          far_bright += weight * (brightest(light) + 1e-4);
          far_circle += weight * (brightest(light) + 1e-4) * circle;
        } else if (circle > -kTwinFocus) {
          focused += light;
          focus_weight += 1.0;
        } else {
          before_focus += dvec4(light, 1.0);
          near += share(k, -circle / kNearFiner) * dvec4(light, 1.0);
          circles += share(k, -circle / kNearFiner) * -circle;
        }
      }
    dvec4 texel(0.0, 0.0, 0.0, kNoLight);
    if (before_focus.w > 0.0) texel = dvec4(dvec3(before_focus) / before_focus.w, kNoLight - before);
    if (focus_weight > 0.0) texel = dvec4(focused / focus_weight, before >= kTwinFocus ? kBesideNear : 0.0);
    if (far_weight > 0.0)
      texel = dvec4(far / far_weight, std::floor(kernel(far_circle / far_bright, k) * 16.0 + 0.5) / 16.0);
    level.far.push_back(rounded(texel));
    // The share is stored in twelfths, and the radius in eighths.
    const double part = std::floor(near.w / static_cast<double>(scale * scale) * 12.0 + 0.5);
    const double radius = dof_kernel_radius(in_.bokeh, near.w > 0.0 ? circles / near.w : 0.0, k);
    const dvec3 light = near.w > 0.0 ? dvec3(near) / near.w * (part / 12.0) : dvec3(0.0);
    level.near.emplace_back(dvec3(rounded(dvec4(light, 0.0))), part / 12.0);
    level.near_radius.push_back(std::floor(radius * 8.0 + 0.5) / 8.0);
  }

  void gather(int k) {
    Level& level = levels_[k];
    for (int y = 0; y < level.rows; ++y)
      for (int x = 0; x < level.columns; ++x) {
        level.blurred_far.push_back(rounded(gather_far(k, x, y)));
        level.blurred_near.push_back(rounded(gather_near(k, x, y)));
      }
  }
  [[nodiscard]] dvec4 gather_far(int k, int x, int y) const {
    const Level& level = levels_[k];
    const dvec4 own = level.far[level.at(x, y)];
    dvec4 front(0.0), back(0.0), fill(0.0);
    const int texels = fill_texels(tiles_[static_cast<std::size_t>(tile_of(x << k, y << k))].near_radius, k);
    for (int dy = -c_.taps[k]; dy <= c_.taps[k]; ++dy)
      for (int dx = -c_.taps[k]; dx <= c_.taps[k]; ++dx) {
        const dvec4 other = level.far[level.at(x + dx, y + dy)];
        const dvec4 counted(dvec3(other), 1.0);
        if (other.w > 0.0 && own.w > 0.0)
          (other.w < own.w ? front : back) += spread(distance(dx, dy), std::min(other.w, own.w)) * counted;
        const bool behind = other.w > kNoLight || other.w - kNoLight > 0.8 * (own.w - kNoLight) + 0.25;
        if (behind && dx * dx + dy * dy <= texels) fill += counted / std::pow(dx * dx + dy * dy + 0.25, 2);
      }
    if (own.w > 0.0) {
      front /= std::max(front.w, 1.0);
      return dvec4(dvec3(front) + (1.0 - front.w) * dvec3(back) / back.w, 1.0) * (own.w / GLOAM_DOF_ROOM);
    }
    return own.w < 0.0 && fill.w > 0.0 ? fill / fill.w / 256.0 : dvec4(0.0);
  }
  /// Light is filled in as far as the circles of the tile reach.
  [[nodiscard]] int fill_texels(double radius, int k) const { return dof_texels(in_.bokeh, kernel(radius, k)); }
  [[nodiscard]] dvec4 gather_near(int k, int x, int y) const {
    const Level& level = levels_[k];
    dvec4 front(0.0), back(0.0);
    double radii = 0.0;
    const double own = level.near[level.at(x, y)].w > 0.0 ? level.near_radius[level.at(x, y)] : 0.0;
    for (int dy = -c_.taps[k]; dy <= c_.taps[k]; ++dy)
      for (int dx = -c_.taps[k]; dx <= c_.taps[k]; ++dx) {
        const std::size_t other = level.at(x + dx, y + dy);
        const dvec4 counted = spread(distance(dx, dy), level.near_radius[other]) * level.near[other];
        (level.near_radius[other] > 1.5 * own ? front : back) += counted;
        radii += counted.w * level.near_radius[other];
      }
    if (front.w + back.w <= 0.0) return back;
    // Below a radius of 2.4 the weights of a whole kernel are made to sum to 1.
    const double radius = radii / (front.w + back.w);
    double whole = 0.0;
    for (int dy = -3; dy <= 3; ++dy)
      for (int dx = -3; dx <= 3; ++dx) whole += spread(distance(dx, dy), radius);
    if (radius < 2.4) front /= whole, back /= whole;
    return under(under(dvec4(0.0), front), back);
  }
  /// Light multiplied by its coverage, and that of what lies behind it.
  [[nodiscard]] static dvec4 under(const dvec4& front, const dvec4& behind) {
    return front + behind * std::clamp((1.0 - front.w) / std::max(behind.w, 1e-9), 0.0, 1.0);
  }

  /// A gathered layer at a pixel, interpolated.
  /// Texels in tiles that do not compose the level are zero.
  [[nodiscard]] dvec4 at_pixel(unsigned Tile::*composed, const std::vector<dvec4>& layer, int k, int x, int y) const {
    const Level& level = levels_[k];
    const auto is_composed = [&](int px, int py) {
      return (tiles_[static_cast<std::size_t>(tile_of(px, py))].*composed >> k & 1u) != 0;
    };
    if (!is_composed(x, y)) return dvec4(0.0);
    const auto at = [&](int column, int row) {
      column = std::clamp(column, 0, level.columns - 1);
      row = std::clamp(row, 0, level.rows - 1);
      return is_composed(column << k, row << k) ? layer[level.at(column, row)] : dvec4(0.0);
    };
    const double u = (x + 0.5) / (1 << k) - 0.5, v = (y + 0.5) / (1 << k) - 0.5;
    const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
    const double s = u - left, t = v - top;
    return (1.0 - t) * ((1.0 - s) * at(left, top) + s * at(left + 1, top)) +
           t * ((1.0 - s) * at(left, top + 1) + s * at(left + 1, top + 1));
  }

  [[nodiscard]] dvec3 composed(int x, int y) const {
    const double signed_circle = coc(x, y), circle = std::abs(signed_circle);
    const bool counts = all_finite(lit(x, y));
    dvec4 far(0.0), near(0.0);
    for (int k = c_.first_level; k <= c_.last_level; ++k) {
      const Level& level = levels_[k];
      const double scale = 1 << k;
      double part = k == 0 ? 1.0 : std::clamp((circle * circle - 0.25) / (scale * scale - 0.25), 0.0, 1.0);
      part *= circle >= kTwinFocus ? share(k, circle) : 0.0;
      const dvec4 found = at_pixel(&Tile::composed_far, level.blurred_far, k, x, y);
      if (found.w > 0.0) far += part * found / found.w;
    }
    for (int k = c_.last_level; k >= c_.first_level; --k)
      near = under(near, at_pixel(&Tile::composed_near, levels_[k].blurred_near, k, x, y));
    if (!counts && far.w > 0.0) far /= far.w;
    const dvec3 sharp = counts ? lit(x, y) * (1.0 - sprite_share(x, y)) : dvec3(0.0);
    dvec3 behind = dvec3(far) + (1.0 - far.w) * sharp, before(0.0);
    for (const Sprite& sprite : sprites_) {
      const double radius = dof_kernel_radius(in_.bokeh, std::abs(sprite.coc), 0);
      const dvec3 light = spread(distance(x - sprite.x, y - sprite.y), radius, sprite.soft) * sprite.light;
      if (sprite.coc > 0.0)
        behind += light *
                  (signed_circle <= -kTwinFocus ? 1.0 : smooth_ramp(0.5 * sprite.coc, 0.8 * sprite.coc, signed_circle));
      else
        before += light * (1.0 - smooth_ramp(1.25, 1.6, signed_circle / sprite.coc));
    }
    const bool alone = signed_circle <= -kTwinFocus && near.w > 1e-4 && far.w <= 0.0;
    if (alone && !counts) return dvec3(near) / near.w + before;
    return dvec3(near) + (1.0 - near.w) * behind + before;
  }

  const DofInput& in_;
  int width_, height_;
  shaders::DofConstants c_{};
  Level levels_[GLOAM_DOF_LEVELS];
  int across_ = 0, down_ = 0;  ///< tiles
  std::vector<Tile> tiles_;
  std::vector<double> around_;  ///< light around bright pixels of each tile; < 0: it has no sprites
  std::vector<Sprite> sprites_;
};

}  // namespace

std::vector<dvec4> dof_twin_light(const DofInput& in) { return DofTwin(in).light(); }

}  // namespace gloam
