// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/soak/plan.h"

#include <algorithm>
#include <iterator>
#include <random>
#include <tuple>
#include <utility>

namespace gloam::soak {
namespace {

using Knobs = std::map<std::string, std::string>;

const std::vector<std::string> kScenes = {"plain",      "lens",       "smoke",    "lanterns", "many_lights",
                                          "penumbra",   "shadows",    "closeups", "meadow",   "shadow_grid",
                                          "wet_street", "meadow_day", "backlight"};
const std::vector<std::string> kBriefScenes = {"smoke"};

const std::vector<Knobs> kSettings = {
    {{"shadows.mode", "off"}},
    {{"shadows.mode", "monolithic"}, {"shadows.depth", "d16"}},
    {{"lighting.antialiasing", "taa"}},
    {{"lighting.antialiasing", "smaa"}, {"glare.lines", "off"}},
    {{"reflections.mode", "planar"}, {"fog.resolution", "half"}},
    {{"reflections.mode", "off"}, {"lighting.occlusion", "on"}},
    {{"shadows.kept_atlases", "0"}, {"shadows.reuse", "off"}},
    {{"scene.reuse", "off"}, {"lighting.reuse", "off"}, {"particles.lighting", "sprite"}},
};
/// Without knobs whose values are other shaders: each would be compiled.
const std::vector<Knobs> kBriefSettings = {
    {{"shadows.kept_atlases", "0"}, {"shadows.reuse", "off"}},
    {{"scene.reuse", "off"}, {"lighting.reuse", "off"}},
};
const std::vector<std::vector<std::string>> kWithout = {
    {"fog"}, {"grass"}, {"particles", "glare"}, {"shadows"}, {"reflections"}};
const std::vector<std::vector<std::string>> kBriefWithout = {{"fog"}};
constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, 5> kSizes = {
    {{64, 36}, {96, 54}, {33, 61}, {80, 45}, {112, 63}}};

enum class Kind {
  scene,
  base_scene,
  knobs,
  modules,
  size,
  mesh_comes,
  mesh_goes,
  lamp_comes,
  lamp_goes,
  camera,
  second_view,
  budget
};

/// How often each change happens in a cycle.
struct Share {
  Kind kind;
  std::uint32_t long_count, brief_count;
};
constexpr Share kShares[] = {{Kind::base_scene, 4, 1}, {Kind::size, 6, 2},        {Kind::mesh_comes, 8, 2},
                             {Kind::mesh_goes, 6, 1},  {Kind::lamp_comes, 8, 2},  {Kind::lamp_goes, 6, 1},
                             {Kind::camera, 6, 1},     {Kind::second_view, 5, 1}, {Kind::budget, 3, 1}};

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(engine_()) % bound; }
  template <class T>
  const T& one_of(const std::vector<T>& list) {
    return list[below(static_cast<std::uint32_t>(list.size()))];
  }
  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(static_cast<std::uint32_t>(i))]);
  }

 private:
  std::mt19937 engine_;
};

struct Change {
  Kind kind;
  std::uint32_t which = 0;  ///< index into the list of scenes, settings or modules
};

std::vector<Change> shuffled_changes(Dice& dice, bool brief) {
  std::vector<Change> changes;
  const auto each = [&](Kind kind, std::size_t count) {
    for (std::uint32_t i = 0; i < count; ++i) changes.push_back({kind, i});
  };
  each(Kind::scene, (brief ? kBriefScenes : kScenes).size());
  each(Kind::knobs, (brief ? kBriefSettings : kSettings).size());
  each(Kind::modules, (brief ? kBriefWithout : kWithout).size());
  for (const Share& share : kShares) each(share.kind, brief ? share.brief_count : share.long_count);
  dice.shuffle(changes);
  return changes;
}

void come(std::vector<std::uint32_t>& list, Dice& dice) {
  const std::uint32_t number = dice.below(1000);
  const auto place = std::ranges::lower_bound(list, number);
  if (place == list.end() || *place != number) list.insert(place, number);
}
void go(std::vector<std::uint32_t>& list, Dice& dice) {
  if (!list.empty()) list.erase(list.begin() + dice.below(static_cast<std::uint32_t>(list.size())));
}

void apply(const Change& change, Step& step, Dice& dice, bool brief) {
  State& state = step.state;
  ShownView& view = state.views[state.views[1].drawn ? dice.below(2) : 0];
  switch (change.kind) {
    case Kind::scene:
      state.scene = (brief ? kBriefScenes : kScenes)[change.which];
      break;
    case Kind::base_scene:
      state.scene = State().scene;
      break;
    case Kind::knobs:
      state.knobs = (brief ? kBriefSettings : kSettings)[change.which];
      break;
    case Kind::modules:
      view.without = (brief ? kBriefWithout : kWithout)[change.which];
      break;
    case Kind::size:
      std::tie(view.width, view.height) = kSizes[dice.below(kSizes.size())];
      break;
    case Kind::mesh_comes:
      return come(state.meshes, dice);
    case Kind::mesh_goes:
      return go(state.meshes, dice);
    case Kind::lamp_comes:
      return come(state.lamps, dice);
    case Kind::lamp_goes:
      return go(state.lamps, dice);
    case Kind::camera:
      view.camera = dice.below(8);
      view.turn = 0.1 * dice.below(10) - 0.5;
      step.cuts = true;
      break;
    case Kind::second_view:
      state.views[1].drawn = !state.views[1].drawn;
      break;
    case Kind::budget:
      step.has_budget = true;
      break;
  }
}

std::string name_of(Kind kind) {
  constexpr const char* kNames[] = {"scene",     "base scene", "knobs",     "modules", "size",        "mesh comes",
                                    "mesh goes", "lamp comes", "lamp goes", "camera",  "second view", "budget"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace

std::vector<Step> Plan::tour() const {
  std::vector<std::string> scenes = brief_ ? kBriefScenes : kScenes;
  scenes.push_back(State().scene);
  std::vector<Knobs> settings = brief_ ? kBriefSettings : kSettings;
  settings.emplace_back();
  std::vector<Step> steps;
  std::uint32_t number = 0;
  for (const std::string& scene : scenes) {
    for (const Knobs& knobs : settings) {
      Step step{.change = "tour", .frames = 2};
      step.state.scene = scene;
      step.state.knobs = knobs;
      for (ShownView& view : step.state.views) {
        view.drawn = true;
        view.camera = number++;
        std::tie(view.width, view.height) = kSizes[number % kSizes.size()];
      }
      for (std::uint32_t i = 0; i < 3; ++i) {
        step.state.meshes.push_back(100 * i + number);
        step.state.lamps.push_back(100 * i + number);
      }
      steps.push_back(std::move(step));
    }
  }
  steps.push_back({.change = "base", .state = {}, .frames = 2, .is_base = true});
  return steps;
}

std::vector<Step> Plan::cycle(std::uint32_t number) const {
  Dice dice(seed_ * 1000003u + number);
  std::vector<Step> steps;
  State state;
  std::uint32_t left = frames_of_a_cycle();
  const std::vector<Change> changes = shuffled_changes(dice, brief_);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Step step{.change = name_of(changes[i].kind), .state = state};
    apply(changes[i], step, dice, brief_);
    state = step.state;
    // Leaves a frame for each change that follows, and one for the base state.
    const auto most = left - static_cast<std::uint32_t>(changes.size() - i);
    step.frames = std::min(most, 1 + dice.below(brief_ ? 3 : 12));
    left -= step.frames;
    steps.push_back(std::move(step));
  }
  steps.push_back({.change = "base", .state = {}, .frames = left, .is_base = true});
  return steps;
}

const std::vector<std::string>& planned_knobs() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names = {"grass.density_scale", "shadows.atlas"};  // of budgets (Host::draw)
    for (const auto* list : {&kSettings, &kBriefSettings})
      for (const Knobs& knobs : *list)
        for (const auto& [name, value] : knobs) names.push_back(name);
    std::ranges::sort(names);
    const auto [first, last] = std::ranges::unique(names);
    names.erase(first, last);
    return names;
  }();
  return all;
}

}  // namespace gloam::soak
