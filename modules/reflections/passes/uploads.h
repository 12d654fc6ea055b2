// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/frame/transfers/staging.h"
#include "engine/render/frame_builder.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/override.h"

namespace gloam {

/// An image array of the world with these layers; null if there are none. Copied to the GPU when the captures have
/// changed. version: ReflectionCaptures::version. uploaded: set if this
/// frame copies.
[[nodiscard]] ImageRef upload_captures(FrameBuilder& frame, Staging& staging, const char* name,
                                       const CapturedLayers& layers, std::uint64_t version, bool* uploaded = nullptr);

/// The traced radiance as an rgba32f image of the view's size.
[[nodiscard]] ImageRef upload_traced(FrameBuilder& frame, Staging& staging, const char* name,
                                     const TracedPixels& traced);

}  // namespace gloam
