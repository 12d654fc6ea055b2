// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/governor/budget_control.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gloam {
namespace {

/// The points that no other one beats, the fastest first.
std::vector<FrontPoint> unbeaten(std::vector<FrontPoint> points) {
  std::erase_if(points,
                [](const FrontPoint& point) { return !(point.ms > 0.0) || !std::isfinite(point.ms + point.error); });
  std::ranges::stable_sort(
      points, [](const FrontPoint& a, const FrontPoint& b) { return a.ms != b.ms ? a.ms < b.ms : a.error < b.error; });
  std::vector<FrontPoint> front;
  for (FrontPoint& point : points)
    if (front.empty() || point.error < front.back().error) front.push_back(std::move(point));
  return front;
}

Status check(double ms, const std::vector<std::string>& locked, const KnobRegistry& knobs) {
  if (!(ms > 0.0)) return Error{ErrorKind::usage, "a budget is a time above 0 ms"};
  for (const std::string& name : locked)
    if (knobs.find(name) == nullptr) return Error{ErrorKind::usage, "unknown knob " + name + " is locked"};
  return {};
}

bool names(const FrontPoint& point, const std::string& knob) {
  return std::ranges::find(point.settings, knob, &KnobOverride::name) != point.settings.end();
}

}  // namespace

Result<BudgetControl> BudgetControl::create(FrameBudget budget, const KnobRegistry& knobs) {
  GLOAM_TRY(check(budget.ms, budget.locked, knobs));
  std::vector<FrontPoint> front = unbeaten(std::move(budget.front));
  if (front.empty()) return Error{ErrorKind::usage, "a budget needs a measured setting to choose"};
  std::vector<GovernorPoint> points;
  for (const FrontPoint& point : front) points.push_back({point.ms, point.error});
  BudgetControl control(std::move(front), Governor(points, budget.ms));
  GLOAM_TRY(control.resolve(std::move(budget.locked), knobs));
  control.effect_ = std::move(budget.effect);
  return control;
}

Status BudgetControl::change(double ms, std::vector<std::string> locked, const KnobRegistry& knobs) {
  GLOAM_TRY(check(ms, locked, knobs));
  governor_.set_budget(ms);
  if (locked == locked_) return {};
  frames_here_ = 0;
  return resolve(std::move(locked), knobs);
}

Status BudgetControl::resolve(std::vector<std::string> locked, const KnobRegistry& knobs) {
  locked_ = std::move(locked);
  governed_.clear();
  governed_names_.clear();
  named_.clear();
  numbers_.clear();
  exact_.clear();
  for (std::size_t i = 0; i < knobs.knobs().size(); ++i) {
    const std::string& name = knobs.knobs()[i].name;
    const bool named = std::ranges::any_of(front_, [&](const FrontPoint& point) { return names(point, name); });
    if (named) named_.push_back(name);
    if (!named || std::ranges::find(locked_, name) != locked_.end()) continue;
    governed_.push_back(i);
    governed_names_.push_back(name);
  }
  for (const FrontPoint& point : front_) {
    KnobRegistry values = knobs;
    for (const Knob& knob : values.knobs()) values.set_number(knob, knob.default_number);
    for (const KnobOverride& setting : point.settings) GLOAM_TRY(values.set(setting.name, setting.value));
    for (const std::size_t index : governed_) numbers_.push_back(values.number(values.knobs()[index]));
    if (&point != &front_.back()) continue;
    for (const std::size_t index : governed_) {
      const Knob& knob = values.knobs()[index];
      exact_.push_back({knob.name, values.text(knob)});
    }
  }
  return {};
}

void BudgetControl::apply(KnobRegistry& knobs) const { set_point(governor_.point(), knobs); }

bool BudgetControl::set_neighbour(int step, KnobRegistry& knobs) const {
  const std::size_t at = governor_.point();
  if (step < 0 ? at == 0 : at + 1 == front_.size()) return false;
  set_point(step < 0 ? at - 1 : at + 1, knobs);
  return true;
}

void BudgetControl::set_point(std::size_t point, KnobRegistry& knobs) const {
  const std::size_t first = point * governed_.size();
  for (std::size_t i = 0; i < governed_.size(); ++i) {
    const Knob& knob = knobs.knobs()[governed_[i]];
    // A set counts as a change, even with the same value.
    if (knobs.number(knob) != numbers_[first + i]) knobs.set_number(knob, numbers_[first + i]);
  }
}

GovernorDecision BudgetControl::add(const FrameTime& time, std::uint64_t drawn_version, KnobRegistry& knobs) {
  const bool drawn_here = drawn_version == knobs.version();
  const bool settled = drawn_here && frames_here_ >= kUnjudged;
  if (drawn_here && frames_here_ < kUnjudged) just_settled_ = ++frames_here_ == kUnjudged;
  const GovernorDecision decision = governor_.add({.ms = time.ms, .judged = time.judged && settled, .view = time.view});
  if (!decision.changed()) return decision;
  frames_here_ = 0;
  just_settled_ = false;
  ++changes_;
  last_change_ = decision;
  apply(knobs);
  return decision;
}

const std::string* BudgetControl::shared_knob(const BudgetControl& other) const {
  const auto found = std::ranges::find_first_of(governed_names_, other.governed_names_);
  return found == governed_names_.end() ? nullptr : &*found;
}

BudgetStep BudgetControl::step_to(std::size_t point) const {
  return {.ms = governor_.expected_ms(point), .error = front_[point].error, .settings = front_[point].settings};
}

BudgetState BudgetControl::state() const {
  const std::size_t at = governor_.point();
  const FrontPoint& point = front_[at];
  return {.effect = effect_,
          .ms = governor_.budget_ms(),
          .points = front_.size(),
          .point = at,
          .changes = changes_,
          .error = point.error,
          .settings = point.settings,
          .last_change = last_change_,
          .measured_ms = governor_.measured_ms(),
          .cheaper = at > 0 ? std::optional(step_to(at - 1)) : std::nullopt,
          .better = at + 1 < front_.size() ? std::optional(step_to(at + 1)) : std::nullopt,
          .governed = governed_names_,
          .named = named_,
          .locked = locked_,
          .exact = exact_};
}

}  // namespace gloam
