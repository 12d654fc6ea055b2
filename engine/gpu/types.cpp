// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/types.h"

#include <utility>

#include "engine/core/assert.h"

namespace gloam::gpu {
namespace {

struct FormatFacts {
  std::string_view name;
  std::uint32_t bytes = 0;
};

// In the order of Format.
constexpr std::array kFormats = {
    FormatFacts{"undefined", 0},     FormatFacts{"r8_unorm", 1},      FormatFacts{"rgba8_unorm", 4},
    FormatFacts{"rgba8_srgb", 4},    FormatFacts{"bgra8_unorm", 4},   FormatFacts{"bgra8_srgb", 4},
    FormatFacts{"rgb10a2_unorm", 4}, FormatFacts{"rg11b10_float", 4}, FormatFacts{"r16_uint", 2},
    FormatFacts{"r16_float", 2},     FormatFacts{"r16_unorm", 2},     FormatFacts{"rg16_unorm", 4},
    FormatFacts{"rg16_snorm", 4},    FormatFacts{"rg16_float", 4},    FormatFacts{"rgba16_float", 8},
    FormatFacts{"r32_uint", 4},      FormatFacts{"rg32_uint", 8},     FormatFacts{"rgba32_uint", 16},
    FormatFacts{"r32_float", 4},     FormatFacts{"rg32_float", 8},    FormatFacts{"rgb32_float", 12},
    FormatFacts{"rgba32_float", 16}, FormatFacts{"rgba8_uint", 4},    FormatFacts{"rgba16_uint", 8},
    FormatFacts{"d32_float", 4},
};

constexpr std::array<std::string_view, 17> kAccessNames = {
    "none",           "transfer_read", "transfer_write",       "host_read",
    "vertex_input",   "indirect_read", "uniform_read",         "vertex_read",
    "fragment_read",  "compute_read",  "compute_storage_read", "compute_write",
    "fragment_write", "color_target",  "depth_target",         "depth_test",
    "present",
};

const FormatFacts& facts_of(Format format) {
  const auto index = static_cast<std::size_t>(format);
  GLOAM_ASSERT(index < kFormats.size(), "a format must be one of the enumeration");
  return kFormats[index];
}

}  // namespace

static_assert(kFormats.size() == static_cast<std::size_t>(Format::d32_float) + 1);
static_assert(kAccessNames.size() == static_cast<std::size_t>(Access::present) + 1);

std::uint32_t bytes_per_texel(Format format) { return facts_of(format).bytes; }

bool is_depth(Format format) { return format == Format::d32_float; }

bool is_integer(Format format) {
  switch (format) {
    case Format::r16_uint:
    case Format::r32_uint:
    case Format::rg32_uint:
    case Format::rgba32_uint:
    case Format::rgba8_uint:
    case Format::rgba16_uint:
      return true;
    default:
      return false;
  }
}

std::string text_of(ImageUsage usage) {
  constexpr std::array<std::pair<ImageUsage, std::string_view>, 6> kNames = {{
      {ImageUsage::transfer_source, "transfer_source"},
      {ImageUsage::transfer_target, "transfer_target"},
      {ImageUsage::sampled, "sampled"},
      {ImageUsage::storage, "storage"},
      {ImageUsage::color_target, "color_target"},
      {ImageUsage::depth_target, "depth_target"},
  }};
  std::string text;
  for (const auto& [flag, name] : kNames) {
    if (!has(usage, flag)) continue;
    text += text.empty() ? "" : ", ";
    text += name;
  }
  return text.empty() ? "no use" : text;
}

std::string_view name_of(Format format) { return facts_of(format).name; }

bool is_write(Access access) {
  switch (access) {
    case Access::transfer_write:
    case Access::compute_write:
    case Access::fragment_write:
    case Access::color_target:
    case Access::depth_target:
      return true;
    default:
      return false;
  }
}

std::string_view name_of(Access access) {
  const auto index = static_cast<std::size_t>(access);
  GLOAM_ASSERT(index < kAccessNames.size(), "an access must be one of the enumeration");
  return kAccessNames[index];
}

std::string_view name_of(DeviceType type) {
  switch (type) {
    case DeviceType::discrete:
      return "discrete";
    case DeviceType::integrated:
      return "integrated";
    case DeviceType::cpu:
      return "cpu";
    case DeviceType::other:
      break;
  }
  return "other";
}

}  // namespace gloam::gpu
