// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <tuple>
#include <type_traits>

#include "engine/ecs/component.h"
#include "engine/ecs/type_key.h"
#include "engine/ecs/world.h"

#ifdef _MSC_VER
#define GLOAM_RESTRICT __restrict
#else
#define GLOAM_RESTRICT __restrict__
#endif

namespace gloam {

/// Terms of a view besides plain components. With<T> and Without<T> only filter. Maybe<const T> and Maybe<T> pass a
/// pointer (null where T is absent) to row functions and a span (empty where T is absent) to chunk functions.
template <class T>
struct With {};
template <class T>
struct Without {};
template <class T>
struct Maybe {};

namespace detail {

/// Traits of one template argument of a view. `Cursor` indexes the column: cursor[i] is the argument of a row function.
template <class Arg>
struct ViewTerm {
  using Component = std::remove_const_t<Arg>;
  using Value = Arg;
  /// restrict: nothing writes a const column while a view iterates, so writes to other columns cannot change it.
  using Cursor = std::conditional_t<std::is_const_v<Arg>, Arg * GLOAM_RESTRICT, Arg*>;
  static constexpr bool kColumn = true;
  static constexpr bool kWrites = !std::is_const_v<Arg>;
  static_assert(!std::is_empty_v<Component>, "a tag has no values: ask for With<Tag>, or has<Tag>");
  static Cursor cursor(std::byte* column) { return reinterpret_cast<Arg*>(column); }
  static void describe(const World& world, QueryTerms& terms) {
    terms.columns.push_back(world.component_id<Component>());
    terms.required.push_back(terms.columns.back());
  }
};

template <class Arg>
struct MaybeCursor {
  Arg* column = nullptr;
  Arg* operator[](std::size_t row) const { return column == nullptr ? nullptr : column + row; }
};

template <class Arg>
struct ViewTerm<Maybe<Arg>> {
  using Component = std::remove_const_t<Arg>;
  using Value = Arg;
  using Cursor = MaybeCursor<Arg>;
  static constexpr bool kColumn = true;
  static constexpr bool kWrites = !std::is_const_v<Arg>;
  static_assert(!std::is_empty_v<Component>, "a tag has no values: ask has<Tag>");
  static Cursor cursor(std::byte* column) { return {reinterpret_cast<Arg*>(column)}; }
  static void describe(const World& world, QueryTerms& terms) {
    terms.columns.push_back(world.component_id<Component>());
  }
};

template <class T>
struct ViewTerm<With<T>> {
  static constexpr bool kColumn = false;
  static constexpr bool kWrites = false;
  static void describe(const World& world, QueryTerms& terms) { terms.required.push_back(world.component_id<T>()); }
};

template <class T>
struct ViewTerm<Without<T>> {
  static constexpr bool kColumn = false;
  static constexpr bool kWrites = false;
  static void describe(const World& world, QueryTerms& terms) { terms.excluded.push_back(world.component_id<T>()); }
};

template <class Arg>
std::span<Arg> chunk_span(Arg* column, std::size_t first, std::size_t count) {
  return {column + first, count};
}
template <class Arg>
std::span<Arg> chunk_span(MaybeCursor<Arg> cursor, std::size_t first, std::size_t count) {
  return cursor.column == nullptr ? std::span<Arg>() : std::span<Arg>(cursor.column + first, count);
}

/// The inner loop of all row functions: plain pointers and one counter. Args: the view's column arguments.
template <class... Args, class F>
void call_rows(F& f, const Entity* entities, std::size_t first, std::size_t last,
               typename ViewTerm<Args>::Cursor... cursors) {
  if constexpr (std::is_invocable_v<F&, Entity, decltype(cursors[0])...>) {
    for (std::size_t row = first; row < last; ++row) f(entities[row], cursors[row]...);
  } else {
    static_assert(std::is_invocable_v<F&, decltype(cursors[0])...>,
                  "the function takes [Entity,] and then one argument a column: const T&, T&, or T* for Maybe");
    for (std::size_t row = first; row < last; ++row) f(cursors[row]...);
  }
}

template <class F, class... Spans>
void call_chunk(F& f, std::span<const Entity> entities, Spans... spans) {
  if constexpr (std::is_invocable_v<F&, std::span<const Entity>, Spans...>) {
    f(entities, spans...);
  } else {
    f(spans...);
  }
}

template <class F, class... Spans>
void call_numbered_chunk(F& f, std::size_t ordinal, std::span<const Entity> entities, Spans... spans) {
  if constexpr (std::is_invocable_v<F&, std::size_t, std::span<const Entity>, Spans...>) {
    f(ordinal, entities, spans...);
  } else {
    f(ordinal, spans...);
  }
}

/// Concatenates type lists. ColumnArguments uses it to select the arguments of a view that are columns, in order.
template <class... Lists>
struct Concatenate {
  using type = TypeList<>;
};
template <class... As, class... Bs, class... Rest>
struct Concatenate<TypeList<As...>, TypeList<Bs...>, Rest...> : Concatenate<TypeList<As..., Bs...>, Rest...> {};
template <class... As>
struct Concatenate<TypeList<As...>> {
  using type = TypeList<As...>;
};
template <class... Args>
using ColumnArguments =
    typename Concatenate<std::conditional_t<ViewTerm<Args>::kColumn, TypeList<Args>, TypeList<>>...>::type;

/// Position of component T among the column arguments, and the argument's value type (const T or T).
template <class T, class List>
struct FindColumn;
template <class T, class First, class... Rest>
struct FindColumn<T, TypeList<First, Rest...>> {
  static constexpr bool kHere = std::is_same_v<T, typename ViewTerm<First>::Component>;
  static constexpr std::size_t index() {
    if constexpr (kHere) {
      return 0;
    } else {
      return 1 + FindColumn<T, TypeList<Rest...>>::index();
    }
  }
  static constexpr auto value_pointer() {
    if constexpr (kHere) {
      return static_cast<typename ViewTerm<First>::Value*>(nullptr);
    } else {
      return FindColumn<T, TypeList<Rest...>>::value_pointer();
    }
  }
};
template <class T>
struct FindColumn<T, TypeList<>> {
  static_assert(!std::is_same_v<T, T>, "the view has no such column");
};

}  // namespace detail
}  // namespace gloam
