// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gpu/device.h"
#include "engine/render/readback/picture.h"
#include "engine/render/views/view_store.h"

namespace gloam {

/// Renderer::read_picture and read_linear. Both wait for the GPU.
[[nodiscard]] Result<Picture> read_picture(const ViewStore& views, ViewId view, gpu::Device& device);
[[nodiscard]] Result<LinearPicture> read_linear(const ViewStore& views, ViewId view, gpu::Device& device);

}  // namespace gloam
