// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/filter/cookies.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/math/srgb.h"
#include "engine/scene/decoding/image_file.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

std::uint8_t srgb_of(float linear) {
  return static_cast<std::uint8_t>(linear_to_srgb(std::clamp(linear, 0.0f, 1.0f)) * 255.0f + 0.5f);
}

/// A pixel of a line and its weight in one pixel of the resampled line. The weights of a resampled pixel sum to 1.
struct Weight {
  std::uint32_t from = 0;
  float share = 0.0f;
};
std::vector<Weight> weights_of(std::uint32_t target, std::uint32_t source_size) {
  const double scale = static_cast<double>(source_size) / kCookieSide;
  const double reach = std::max(scale, 1.0);  // half the width of the tent filter
  const double center = (target + 0.5) * scale - 0.5;
  const auto last = static_cast<double>(source_size - 1);
  std::vector<Weight> weights;
  double sum = 0.0;
  for (double at = std::ceil(center - reach); at <= center + reach; at += 1.0) {
    const double share = 1.0 - std::abs(at - center) / reach;
    if (share <= 0.0) continue;
    weights.push_back({static_cast<std::uint32_t>(std::clamp(at, 0.0, last)), static_cast<float>(share)});
    sum += share;
  }
  for (Weight& weight : weights) weight.share /= static_cast<float>(sum);
  return weights;
}

}  // namespace

std::vector<std::uint8_t> resampled_cookie(const Image& image) {
  const auto& linear = linear_of_srgb();
  // First horizontally: one line of the target's width per line of the source.
  std::vector<vec3> lines(std::size_t{kCookieSide} * image.height);
  for (std::uint32_t x = 0; x < kCookieSide; ++x) {
    const std::vector<Weight> weights = weights_of(x, image.width);
    for (std::uint32_t y = 0; y < image.height; ++y) {
      vec3 sum(0.0f);
      for (const Weight& weight : weights) {
        const std::uint8_t* texel = &image.rgba[4 * (std::size_t{y} * image.width + weight.from)];
        sum += weight.share * vec3(linear[texel[0]], linear[texel[1]], linear[texel[2]]);
      }
      lines[std::size_t{y} * kCookieSide + x] = sum;
    }
  }
  std::vector<std::uint8_t> texels(std::size_t{kCookieSide} * kCookieSide * 4, 255);
  for (std::uint32_t y = 0; y < kCookieSide; ++y) {
    const std::vector<Weight> weights = weights_of(y, image.height);
    for (std::uint32_t x = 0; x < kCookieSide; ++x) {
      vec3 sum(0.0f);
      for (const Weight& weight : weights) sum += weight.share * lines[std::size_t{weight.from} * kCookieSide + x];
      for (int c = 0; c < 3; ++c)
        texels[4 * (std::size_t{y} * kCookieSide + x) + static_cast<std::size_t>(c)] = srgb_of(sum[c]);
    }
  }
  return texels;
}

std::size_t count_cookie_lights(const World& world) {
  std::size_t count = 0;
  world.view<const Light>().each([&](const Light& light) { count += has_cookie(light) ? 1 : 0; });
  return count;
}

Status load_cookies(World& world) {
  if (world.try_resource<Cookies>() == nullptr) world.set_resource(Cookies{});
  std::vector<std::uint32_t> missing;
  const Cookies& there = world.resource<Cookies>();
  std::as_const(world).view<const Light>().each([&](const Light& light) {
    if (has_cookie(light) && !there.layers.contains(light.cookie)) missing.push_back(light.cookie);
  });
  Status status;
  for (const std::uint32_t cookie : missing) {
    Cookies& cookies = world.resource<Cookies>();
    if (cookies.layers.contains(cookie)) continue;
    const std::string& path = world.resource<SceneStrings>().text(cookie);
    const auto image = read_image_file(path);
    cookies.layers.emplace(cookie, static_cast<std::uint32_t>(cookies.texels.size()));
    ++cookies.version;
    if (image.ok()) {
      cookies.texels.push_back(resampled_cookie(*image));
      continue;
    }
    cookies.texels.emplace_back(std::size_t{kCookieSide} * kCookieSide * 4, std::uint8_t{255});
    cookies.faults.push_back("gloam.light.cookie: " + path + ": " + image.error().message);
    if (status.ok()) status = Error{ErrorKind::input, cookies.faults.back()};
  }
  return status;
}

}  // namespace gloam
