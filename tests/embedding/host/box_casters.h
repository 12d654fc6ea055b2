// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/render/module.h"

namespace host {

/// A module that draws the boxes of the little world into shadow maps with a shader of the host, and nothing else.
/// gloam has no mesh of them.
[[nodiscard]] std::unique_ptr<gloam::Module> make_box_casters();

}  // namespace host
