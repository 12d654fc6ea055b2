// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace gloam {

class World;

/// The number of a world that a renderer has prepared (Renderer::prepare_world): ≥ 1, and different for all worlds that
/// this renderer has ever prepared. A world that is prepared again gets a new number, and so does a world that another
/// renderer draws after the end of the first. Key of all data that the renderer and its modules keep for a world
/// outside of it. Asserts that the world was prepared.
[[nodiscard]] std::uint64_t world_id(const World& world);

}  // namespace gloam
