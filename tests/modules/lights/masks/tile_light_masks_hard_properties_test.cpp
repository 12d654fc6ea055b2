// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "engine/jobs/executor.h"
#include "tests/math/generators.h"
#include "tests/modules/lights/masks/mask_oracle.h"
#include "tests/support/property.h"

namespace gloam {
namespace {

TEST(TileLightMasksHardProperties, miss_no_light_in_random_scenes) {
  const auto executor = make_serial_executor();
  TileLightMasks masks;
  test::check_property(10000, [&] {
    const auto seed = static_cast<std::uint32_t>(test::draw_index(1 << 30));
    RC_LOG() << "seed " << seed << '\n';
    test::SceneRandom random(seed);
    const RenderView view = test::draw_view(random);
    std::vector<MaskLight> lights;
    for (int count = random.index(12); count >= 0; --count) lights.push_back(test::draw_mask_light(random, view));
    std::vector<std::uint32_t> before;
    for (const TileBound bound : {TileBound::rect, TileBound::row_interval, TileBound::cone}) {
      build_tile_light_masks(lights, view, bound, *executor, masks);
      for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const std::string missed = test::missed_tile(masks, lights[i], i, view, random, 16);
        if (!missed.empty()) RC_FAIL("bound " + std::to_string(static_cast<int>(bound)) + ": " + missed);
      }
      const std::vector<std::uint32_t> words = test::meant_words(masks);
      for (std::size_t i = 0; i < words.size() && !before.empty(); ++i)
        if (i % GLOAM_MASK_WORDS != 0) RC_ASSERT((words[i] & ~before[i]) == 0u);
      before = words;
    }
  });
}

}  // namespace
}  // namespace gloam
