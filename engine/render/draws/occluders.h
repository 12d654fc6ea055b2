// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/draws/draw_lists.h"
#include "engine/render/view.h"

namespace gloam {

/// Triangles of a view's solid draws.
[[nodiscard]] std::uint32_t solid_triangles(const ViewDraws& draws);

/// Chooses clusters that probably hide others: those that cover most of the picture for their number of triangles.
/// Surfaces with holes are left out. The draws have at most most_triangles triangles. Any choice gives the same
/// picture: it only decides how much is hidden.
[[nodiscard]] std::vector<Draw> choose_occluders(const RenderView& view, const ViewDraws& draws,
                                                 std::uint32_t most_triangles);

}  // namespace gloam
