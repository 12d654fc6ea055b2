// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/srgb.h"
#include "modules/lights/debug/visualizers.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <set>

#include "engine/ecs/view.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/outputs.h"
#include "modules/lights/selection/light_list.h"
#include "tests/modules/lighting/lit_scene.h"

namespace gloam {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

struct Rgb {
  int r = 0, g = 0, b = 0;
};

int encoded(double linear) { return static_cast<int>(std::lround(255.0 * linear_to_srgb(linear))); }
Rgb encoded(const dvec3& linear) { return {encoded(linear.x), encoded(linear.y), encoded(linear.z)}; }
bool is_near(const Rgb& a, const Rgb& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) <= 2;
}

/// Same as shaders/common/heat.glsl, for a number of lights.
dvec3 heat(int count) {
  const dvec3 stops[] = {dvec3(0.0),        {0.02, 0.05, 0.6}, {0.0, 0.45, 0.6},
                         {0.05, 0.5, 0.05}, {0.8, 0.6, 0.0},   {0.8, 0.02, 0.02}};
  if (count > 31) return dvec3(1.0);
  const double at = count / 31.0 * 5.0;
  const int low = std::min(static_cast<int>(at), 4);
  return glm::mix(stops[low], stops[low + 1], at - low);
}

/// Meaning of a pixel of light_culling or light_list. The picture below is black, and a quarter of it shows through.
enum class Shown { nothing, mask, z_bins, group, list, reached, held, loud, unknown };
struct Shade {
  Shown shown;
  dvec3 color;
  double opacity;
};
const Shade kShades[] = {{Shown::nothing, dvec3(0.0), 0.75},
                         {Shown::mask, dvec3(0.12), 0.75},
                         {Shown::z_bins, dvec3(0.02, 0.08, 0.6), 0.75},
                         {Shown::group, dvec3(0.7, 0.35, 0.0), 0.75},
                         {Shown::list, dvec3(0.05, 0.6, 0.05), 0.75},
                         {Shown::reached, dvec3(0.75, 0.9, 0.2), 0.75},
                         {Shown::held, dvec3(0.02, 0.1, 0.6), 0.75},
                         {Shown::loud, dvec3(1.0, 0.0, 0.25), 0.95}};

/// Empties every tile's list after the lights module has written it.
class ForgetfulModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "forgetful"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::lists || !forgets) return;
    ImageRef& lists = frame.get<LightsOutputs>().tile_lists;
    PassBuilder pass = frame.graph().add_pass("forget", "forgetful");
    lists = pass.write(lists, gpu::Access::transfer_write);
    pass.execute([lists](PassContext& context) {
      context.commands().clear_color_image(context.image(lists), {0, 0, 0, 0});
    });
  }
  bool forgets = false;
};

/// A black wall 5 m away fills the left half of the picture, with sky beside it. Lights are in front of the wall; there
/// is a sun, and a lamp behind the camera. The camera is at the origin and looks along −Z.
class LightViewsTest : public test::LitSceneTest {
 protected:
  [[nodiscard]] ModuleList make_modules() override {
    ModuleList modules = make_all_modules();
    auto forgetful = std::make_unique<ForgetfulModule>();
    forgetful_ = forgetful.get();
    const auto lights =
        std::find_if(modules.begin(), modules.end(), [](const auto& m) { return m->name() == "lights"; });
    modules.insert(std::next(lights), std::move(forgetful));
    return modules;
  }
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(LitSceneTest::SetUp());
    if (IsSkipped()) return;
    environment().has_exposure = true;
    scene.draw(scene.mesh(test::quad(3.0f, scene.material(exact_material(0, 0, 0, 255, 255)))),
               glm::translate(dmat4(1.0), dvec3(-3.0, 0.0, -5.0)));
    named_light("lamp", LightKind::point, dvec3(-2.5, 0.5, -4.5), 1.5f);
    named_light("other", LightKind::point, dvec3(-4.0, -1.4, -4.6), 1.0f);
    named_light("spot", LightKind::spot, dvec3(-1.2, 1.4, -3.2), 3.0f);
    named_light("behind", LightKind::point, dvec3(0.0, 0.0, 20.0), 2.0f);
    named_light("sun", LightKind::directional, dvec3(0.0), 0.0f);
    set_size(130, 70);
  }

  void named_light(const std::string& name, LightKind kind, const dvec3& position, float range_m) {
    Light made;
    made.kind = kind;
    made.intensity = 1e-9f;
    made.range_m = range_m;
    made.outer_angle = 0.35f;
    world.resource<SceneNames>().add("light", name, light(made, position));
  }
  void set_size(std::uint32_t width, std::uint32_t height) {
    settings = test::look_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0), width, height);
  }

  [[nodiscard]] Picture drawn(const std::string& view) {
    settings.visualizer = view;
    draw();
    return picture();
  }
  [[nodiscard]] static Rgb at(const Picture& p, std::uint32_t x, std::uint32_t y) {
    const std::uint8_t* t = &p.rgba[4 * (std::size_t{y} * p.width + x)];
    return {t[0], t[1], t[2]};
  }
  [[nodiscard]] static Shown shown_at(const Picture& p, std::uint32_t x, std::uint32_t y) {
    const bool grid = x % 8 == 0 || y % 8 == 0;
    for (const Shade& shade : kShades)
      if (is_near(at(p, x, y), encoded(shade.color * shade.opacity * (grid && shade.shown != Shown::loud ? 0.6 : 1.0))))
        return shade.shown;
    return Shown::unknown;
  }
  /// The count whose colour a visualizer of counts shows for a tile; -1 if the colour is that of no count.
  [[nodiscard]] static int count_at(const Picture& p, uvec2 tile, std::uint32_t side) {
    const Rgb color = at(p, std::min(tile.x * side + 2, p.width - 1), std::min(tile.y * side + 2, p.height - 1));
    for (int count = 0; count <= 32; ++count)
      if (is_near(color, encoded(heat(count)))) return count;
    return -1;
  }

  enum class Reach { no, yes, close };  // close: too close to the border for floats
  /// Whether light `index` (in the order of adding) reaches the surface at a pixel.
  [[nodiscard]] Reach reach(std::size_t index, std::uint32_t x, std::uint32_t y) const {
    const Ray r = ray(x, y);
    const dvec3 point = r.direction * (-5.0 / r.direction.z);
    if (point.x > -1e-3) return point.x < 1e-3 ? Reach::close : Reach::no;
    const test::OracleLight& l = oracle_lights[index];
    const dvec3 offset = point - l.position;
    double inside = static_cast<double>(l.light.range_m) - glm::length(offset);
    if (l.light.kind == LightKind::spot)
      inside = std::min(
          inside, glm::dot(glm::normalize(offset), l.direction) - std::cos(static_cast<double>(l.light.outer_angle)));
    return std::abs(inside) < 1e-4 ? Reach::close : inside > 0.0 ? Reach::yes : Reach::no;
  }
  [[nodiscard]] Reach tile_reach(std::size_t index, uvec2 tile) const {
    Reach found = Reach::no;
    for (std::uint32_t y = tile.y * 8; y < std::min(tile.y * 8 + 8, settings.height); ++y)
      for (std::uint32_t x = tile.x * 8; x < std::min(tile.x * 8 + 8, settings.width); ++x)
        if (const Reach r = reach(index, x, y); r == Reach::yes || (r == Reach::close && found == Reach::no)) found = r;
    return found;
  }
  [[nodiscard]] uvec2 tiles() const { return {(settings.width + 7) / 8, (settings.height + 7) / 8}; }
  template <class F>
  void for_tiles(F&& function) const {
    for (std::uint32_t y = 0; y < tiles().y; ++y)
      for (std::uint32_t x = 0; x < tiles().x; ++x) function(uvec2(x, y));
  }

  ForgetfulModule* forgetful_ = nullptr;
};

constexpr std::size_t kLamp = 0, kOther = 1, kSpot = 2;

TEST_F(LightViewsTest, the_accurate_counts_are_those_of_a_ray_a_pixel) {
  for (const uvec2 size : {uvec2(130, 70), uvec2(7, 5), uvec2(1, 1), uvec2(64, 64)}) {
    set_size(size.x, size.y);
    const Picture p = drawn("lights_accurate");
    int lit = 0;
    for_tiles([&](uvec2 tile) {
      int least = 0, most = 0;
      for (const std::size_t l : {kLamp, kOther, kSpot}) {
        const Reach r = tile_reach(l, tile);
        least += r == Reach::yes ? 1 : 0;
        most += r != Reach::no ? 1 : 0;
      }
      const int shown = count_at(p, tile, 8);
      EXPECT_GE(shown, least) << tile.x << "," << tile.y << " of " << size.x << "x" << size.y;
      EXPECT_LE(shown, most) << tile.x << "," << tile.y << " of " << size.x << "x" << size.y;
      lit += shown > 0 ? 1 : 0;
    });
    EXPECT_GE(lit, size.x >= 64 ? 10 : 0);
  }
}

TEST_F(LightViewsTest, the_difference_is_what_the_accurate_search_drops) {
  for (const uvec2 size : {uvec2(130, 70), uvec2(7, 5)}) {
    set_size(size.x, size.y);
    const Picture approx = drawn("lights_approx"), accurate = drawn("lights_accurate"),
                  difference = drawn("lights_difference");
    int found = 0;
    for_tiles([&](uvec2 tile) {
      const int all = count_at(approx, tile, 8), kept = count_at(accurate, tile, 8);
      EXPECT_GE(all, kept);
      EXPECT_EQ(count_at(difference, tile, 8), all - kept) << tile.x << "," << tile.y;
      found += all;
    });
    EXPECT_GE(found, size.x > 7 ? 10 : 0);
  }
}

TEST_F(LightViewsTest, tile_masks_shows_the_masks_of_the_cpu) {
  for (const uvec2 size : {uvec2(130, 70), uvec2(7, 5)}) {
    set_size(size.x, size.y);
    const Picture p = drawn("tile_masks");
    const auto& masks = world.view_resource<TileLightMasks>(ViewId{0});
    ASSERT_EQ(masks.tiles, mask_tiles_of(size.x, size.y));
    std::size_t found = 0;
    for (std::uint32_t i = 0; i < masks.tiles.x * masks.tiles.y; ++i) {
      const uvec2 tile(i % masks.tiles.x, i / masks.tiles.x);
      const auto lights =
          decode_light_mask(std::span(masks.words).subspan(std::size_t{i} * GLOAM_MASK_WORDS, GLOAM_MASK_WORDS));
      EXPECT_EQ(count_at(p, tile, GLOAM_LIGHT_TILE), static_cast<int>(lights.size())) << tile.x << "," << tile.y;
      found += lights.size();
    }
    EXPECT_GT(found, 0u);
  }
}

TEST_F(LightViewsTest, counts_of_32_lights_and_more_are_white) {
  for (int i = 0; i < 40; ++i) named_light("more" + std::to_string(i), LightKind::point, dvec3(-2.5, 0.5, -4.5), 1.0f);
  const Picture p = drawn("lights_accurate");
  int white = 0;
  for_tiles([&](uvec2 tile) { white += count_at(p, tile, 8) == 32 ? 1 : 0; });
  EXPECT_GT(white, 2);
}

TEST_F(LightViewsTest, the_culling_view_shows_how_far_a_light_got_in_each_tile) {
  for (const auto& [name, index] : {std::pair{"lamp", kLamp}, {"other", kOther}, {"spot", kSpot}}) {
    const Picture p = drawn(std::string("light_culling:") + name);
    std::set<Shown> seen;
    for_tiles([&](uvec2 tile) {
      const Shown shown = shown_at(p, std::min(tile.x * 8 + 2, p.width - 1), std::min(tile.y * 8 + 2, p.height - 1));
      seen.insert(shown);
      EXPECT_NE(shown, Shown::unknown);
      EXPECT_NE(shown, Shown::loud);
      const Reach r = tile_reach(index, tile);
      if (r != Reach::close) {
        EXPECT_EQ(shown == Shown::list, r == Reach::yes) << name << " " << tile.x << "," << tile.y;
      }
    });
    EXPECT_THAT(seen, Contains(Shown::list)) << name;
    EXPECT_THAT(seen, Contains(Shown::nothing)) << name;
  }
}

TEST_F(LightViewsTest, the_list_view_shows_which_pixels_look_at_a_light_and_which_it_reaches) {
  for (const uvec2 size : {uvec2(130, 70), uvec2(7, 5)}) {
    set_size(size.x, size.y);
    const Picture p = drawn("light_list:lamp");
    for (std::uint32_t y = 0; y < size.y; ++y)
      for (std::uint32_t x = 0; x < size.x; ++x) {
        const Reach pixel = reach(kLamp, x, y), tile = tile_reach(kLamp, uvec2(x / 8, y / 8));
        if (pixel == Reach::close || tile == Reach::close) continue;
        const Shown expected = pixel == Reach::yes ? Shown::reached : tile == Reach::yes ? Shown::held : Shown::nothing;
        ASSERT_EQ(shown_at(p, x, y), expected) << x << "," << y;
      }
  }
}

TEST_F(LightViewsTest, a_list_without_its_light_is_loud) {
  forgetful_->forgets = true;
  const Picture culling = drawn("light_culling:lamp"), list = drawn("light_list:lamp");
  for_tiles([&](uvec2 tile) {
    const std::uint32_t x = std::min(tile.x * 8 + 2, culling.width - 1),
                        y = std::min(tile.y * 8 + 2, culling.height - 1);
    const Reach r = tile_reach(kLamp, tile);
    if (r != Reach::close) {
      EXPECT_EQ(shown_at(culling, x, y) == Shown::loud, r == Reach::yes) << tile.x << "," << tile.y;
    }
    const Reach pixel = reach(kLamp, x, y);
    if (pixel != Reach::close) {
      EXPECT_EQ(shown_at(list, x, y), pixel == Reach::yes ? Shown::loud : Shown::nothing);
    }
  });
}

TEST_F(LightViewsTest, an_overflown_list_is_read_from_the_mask_of_the_group) {
  ASSERT_TRUE(renderer->knobs().set("lights.fixed_slots", "1").ok());
  for (int i = 0; i < 8; ++i) named_light("more" + std::to_string(i), LightKind::point, dvec3(-2.5, 0.5, -4.5), 1.5f);
  const Picture p = drawn("light_culling:lamp");
  std::set<Shown> seen;
  for_tiles([&](uvec2 tile) {
    seen.insert(shown_at(p, std::min(tile.x * 8 + 2, p.width - 1), std::min(tile.y * 8 + 2, p.height - 1)));
  });
  EXPECT_FALSE(seen.contains(Shown::loud));
  EXPECT_TRUE(seen.contains(Shown::list));
}

TEST_F(LightViewsTest, a_light_in_no_list_gives_a_dark_picture_and_one_sentence) {
  for (const char* name : {"sun", "behind"}) {
    for (const char* view : {"light_culling:", "light_list:"}) {
      warnings.clear();
      for (int frame = 0; frame < 2; ++frame) {
        const Picture p = drawn(std::string(view) + name);
        EXPECT_TRUE(std::all_of(p.rgba.begin(), p.rgba.end(), [](std::uint8_t b) { return b == 0 || b == 255; }));
      }
      EXPECT_THAT(warnings, SizeIs(1)) << view << name;
      EXPECT_THAT(warnings, Contains(HasSubstr(std::string(view) + name + " shows no tile"))) << name;
    }
  }
}

TEST_F(LightViewsTest, every_view_writes_an_image_of_its_name) {
  for (const VisualizerInfo& view : light_visualizers()) {
    static_cast<void>(drawn(view.name + (view.argument.empty() ? "" : ":lamp")));
    EXPECT_THAT(renderer->describe(), HasSubstr(view.name + "_view")) << view.name;
    EXPECT_TRUE(renderer->check_visualizer(world, settings.visualizer).ok());
    EXPECT_FALSE(view.legend.empty());
    EXPECT_TRUE(std::all_of(view.legend.begin(), view.legend.end(), [](char c) { return c >= ' ' && c <= '~'; }))
        << "the font is ASCII";
  }
  EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(LightViewsTest, need_lists_and_a_light_that_is_there) {
  EXPECT_EQ(renderer->check_visualizer(world, "light_list:nobody").error().kind, ErrorKind::usage);
  ASSERT_TRUE(renderer->knobs().set("lights.culling", "brute").ok());
  for (const char* view : {"tile_masks", "lights_approx", "light_list:lamp"}) {
    settings.visualizer = view;
    const ViewRequest request{settings, {}};
    const Status refused = renderer->render(world, std::span(&request, 1));
    ASSERT_FALSE(refused.ok()) << view;
    EXPECT_EQ(refused.error().kind, ErrorKind::usage);
    EXPECT_THAT(refused.error().message, HasSubstr("needs lights.culling=tiled"));
    EXPECT_EQ(renderer->check_visualizer(world, view).error().message, refused.error().message)
        << "known before drawing";
  }
}

TEST_F(LightViewsTest, without_local_lights_show_none) {
  const std::set<LightKind> local = {LightKind::point, LightKind::spot};
  std::vector<Entity> gone;
  world.view<const Light>().each([&](Entity e, const Light& l) {
    if (local.contains(l.kind)) gone.push_back(e);
  });
  for (const Entity e : gone) world.destroy(e);
  for (const char* view : {"tile_masks", "lights_accurate", "light_culling:lamp"}) {
    const Picture p = drawn(view);
    EXPECT_TRUE(std::all_of(p.rgba.begin(), p.rgba.end(), [](std::uint8_t b) { return b == 0 || b == 255; })) << view;
  }
}

TEST_F(LightViewsTest, of_a_scene_without_lights_say_that_the_picture_is_shown_as_it_is) {
  std::vector<Entity> lights;
  world.view<const Light>().each([&](Entity e, const Light&) { lights.push_back(e); });
  for (const Entity e : lights) world.destroy(e);
  for (int frame = 0; frame < 2; ++frame) static_cast<void>(drawn("lights_accurate"));
  EXPECT_THAT(warnings, ElementsAre("view lights_accurate shows the picture as it is: no light"));
}

}  // namespace
}  // namespace gloam
