// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>

#include "engine/core/assert.h"
#include "engine/core/hash.h"
#include "modules/reflections/override.h"
#include "modules/reflections/reference/pixel_surface.h"
#include "modules/reflections/reference/reflection_tracing.h"

namespace gloam {

/// Traces all pixels of the input's picture with a surface for which wanted(surface) holds; the others are 0.
/// make_tracer: called once a job, gives an object with trace(surface, pixel) → dvec3.
template <class MakeTracer, class Wanted>
void trace_rows(const RadianceInput& input, TracedPixels& traced, const MakeTracer& make_tracer, const Wanted& wanted) {
  const GeometryPicture& geometry = input.geometry;
  GLOAM_ASSERT(geometry.depth.size() == std::size_t{geometry.view.width} * geometry.view.height, "a depth a pixel");
  GLOAM_ASSERT(input.settings.rays > 0 && input.settings.light_samples > 0, "at least one sample");
  traced.width = geometry.view.width;
  traced.height = geometry.view.height;
  traced.samples = input.settings.rays;
  traced.radiance.assign(4 * traced.pixels(), 0.0f);
  std::mutex mutex;
  std::size_t done = 0;
  input.executor.parallel_for(traced.height, 1, [&](JobRange rows) {
    auto tracer = make_tracer();
    for (auto y = static_cast<std::uint32_t>(rows.begin); y < rows.end; ++y) {
      for (std::uint32_t x = 0; x < traced.width; ++x) {
        const PixelSurface surface = pixel_surface(geometry, x, y);
        if (!surface.exists || !wanted(surface)) continue;
        const std::uint32_t pixel = y * traced.width + x;
        const vec3 radiance(tracer.trace(surface, pixel));
        float* const texel = &traced.radiance[4 * std::size_t{pixel}];
        for (int c = 0; c < 3; ++c) texel[c] = radiance[c];
        texel[3] = 1.0f;
      }
      if (!input.progress) continue;
      const std::lock_guard lock(mutex);
      input.progress(++done, traced.height);
    }
  });
  Hasher hasher;
  hasher.value(traced.width).value(traced.height).value(traced.samples);
  traced.version = hasher.bytes(std::as_bytes(std::span(traced.radiance))).digest();
}

}  // namespace gloam
