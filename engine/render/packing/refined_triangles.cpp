// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/refined_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/math/bounds.h"

namespace gloam {
namespace {

constexpr int kMostRounds = 128;

using Triangle = std::array<std::uint32_t, 3>;

dvec3 world_of(const dmat4& world_from_mesh, const dvec3& position) {
  return dvec3(world_from_mesh * dvec4(position, 1.0));
}

double length_of(const dvec3& a, const dvec3& b, const dvec3& c) {
  return std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
}

double nearest_eye(const SeenFrom& seen, const dvec3& a, const dvec3& b, const dvec3& c) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const dvec3& eye : seen.eyes) nearest = std::min(nearest, distance_to_triangle(eye, a, b, c));
  return std::max(nearest, seen.nearest);
}

/// Not more than the distance of an eye from the triangle. Cheap.
double nearest_eye_bound(const SeenFrom& seen, const dvec3& a, double length) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const dvec3& eye : seen.eyes) nearest = std::min(nearest, glm::length(eye - a) - length);
  return std::max(nearest, seen.nearest);
}

struct PositionHash {
  std::size_t operator()(const vec3& p) const {
    // −0 and 0 are one place.
    return static_cast<std::size_t>(Hasher().bytes_of(p + vec3(0.0f)).digest());
  }
};

/// Splits triangles by their longest edges. An edge is named by its corners' places, which vertices with different
/// normals share; so both triangles of an edge split it, at the same point.
class Splitter {
 public:
  Splitter(const Primitive& source, const SeenFrom& seen) : seen_(seen), made_(source) {
    std::unordered_map<vec3, std::uint32_t, PositionHash> known(source.positions.size());
    for (const vec3& position : source.positions) {
      const auto found = known.try_emplace(position, places_.size()).first;
      if (found->second == places_.size()) add_place(dvec3(position));
      place_of_.push_back(found->second);
    }
    own_places_ = places_.size();
    marked_places_.assign(own_places_, 0);
    for (std::size_t i = 0; i + 2 < source.indices.size(); i += 3) {
      const Triangle triangle{source.indices[i], source.indices[i + 1], source.indices[i + 2]};
      (is_long(triangle) ? triangles_ : whole_).push_back(triangle);
    }
  }

  Primitive split(const dvec3& origin) {
    for (int round = 0; round < kMostRounds && triangles_.size() < kMostAddedTriangles; ++round) {
      edges_ = {};
      for (const Triangle& triangle : triangles_)
        if (is_long(triangle)) mark(longest(triangle));
      if (edges_.empty()) break;
      split_edges();
    }
    return take(origin);
  }

 private:
  /// Two places, the lower one first.
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  void add_place(const dvec3& position) {
    places_.push_back(position);
    worlds_.push_back(world_of(seen_.world_from_mesh, position));
  }
  [[nodiscard]] Edge edge(std::uint32_t a, std::uint32_t b) const { return std::minmax(place_of_[a], place_of_[b]); }
  [[nodiscard]] const dvec3& world(std::uint32_t vertex) const { return worlds_[place_of_[vertex]]; }
  [[nodiscard]] bool is_long(const Triangle& t) const {
    const dvec3 &a = world(t[0]), &b = world(t[1]), &c = world(t[2]);
    const double length = length_of(a, b, c);
    const double most = seen_.too_long / kSplitShare;
    if (!(length > most * nearest_eye_bound(seen_, a, length))) return false;
    return length > most * nearest_eye(seen_, a, b, c);
  }
  /// The first corner of the longest edge. Of edges of equal length both triangles choose the same one.
  [[nodiscard]] std::size_t longest_at(const Triangle& t) const {
    std::size_t best = 0;
    std::pair<double, Edge> most{-1.0, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge own = edge(t[i], t[(i + 1) % 3]);
      const std::pair<double, Edge> length{glm::length(worlds_[own.first] - worlds_[own.second]), own};
      if (length > most) best = i, most = length;
    }
    return best;
  }
  [[nodiscard]] Edge longest(const Triangle& t) const {
    const std::size_t i = longest_at(t);
    return edge(t[i], t[(i + 1) % 3]);
  }
  /// Returns whether the edge was not marked before.
  bool mark(const Edge& edge) {
    if (!edges_.insert(edge).second) return false;
    if (edge.second >= own_places_) return true;  // no whole triangle has it
    marked_places_[edge.first] = marked_places_[edge.second] = 1;
    marked_own_ = true;
    return true;
  }
  /// Whether the triangle has a marked edge. Then its longest edge is marked, too; more: if it was not before.
  bool mark_longest(const Triangle& t, bool& more) {
    if (!is_marked(t[0], t[1]) && !is_marked(t[1], t[2]) && !is_marked(t[2], t[0])) return false;
    more = mark(longest(t)) || more;
    return true;
  }
  /// Moves whole triangles with a marked edge to those that are split.
  void take_neighbours(bool& more) {
    if (!std::exchange(marked_own_, false)) return;
    const auto is_taken = [&](const Triangle& t) {
      const int marked =
          marked_places_[place_of_[t[0]]] + marked_places_[place_of_[t[1]]] + marked_places_[place_of_[t[2]]];
      if (marked < 2 || !mark_longest(t, more)) return false;
      triangles_.push_back(t);
      return true;
    };
    std::erase_if(whole_, is_taken);
  }
  [[nodiscard]] bool is_marked(std::uint32_t a, std::uint32_t b) const { return edges_.contains(edge(a, b)); }

  /// Splits all marked edges. A triangle is split at its longest edge first, so it is marked, too.
  void split_edges() {
    for (bool more = true; more;) {
      more = false;
      for (const Triangle& t : triangles_) mark_longest(t, more);
      take_neighbours(more);
    }
    vertices_.clear();
    middles_.clear();
    const std::vector<Triangle> before = std::exchange(triangles_, {});
    for (const Triangle& t : before) split_triangle(t, longest_at(t));
  }
  void split_triangle(const Triangle& t, std::size_t at) {
    const std::uint32_t a = t[at], b = t[(at + 1) % 3], c = t[(at + 2) % 3];
    if (!is_marked(a, b)) {
      triangles_.push_back(t);
      return;
    }
    const std::uint32_t middle = middle_of(a, b);
    split_half({b, c, middle});
    split_half({c, a, middle});
  }
  /// A half of a triangle. Its first edge is one of the whole triangle, and may be marked.
  void split_half(const Triangle& t) {
    if (!is_marked(t[0], t[1])) {
      triangles_.push_back(t);
      return;
    }
    const std::uint32_t middle = middle_of(t[0], t[1]);
    triangles_.push_back({t[0], middle, t[2]});
    triangles_.push_back({middle, t[1], t[2]});
  }

  std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) {
    const auto [vertex, is_new] = vertices_.try_emplace(std::minmax(a, b), place_of_.size());
    if (!is_new) return vertex->second;
    const Edge own = edge(a, b);
    const auto [place, new_place] = middles_.try_emplace(own, places_.size());
    if (new_place) add_place(0.5 * (places_[own.first] + places_[own.second]));
    place_of_.push_back(place->second);
    const auto halve = [&](auto& values) {
      if (!values.empty()) values.push_back((values[a] + values[b]) * 0.5f);
    };
    halve(made_.normals);
    halve(made_.tangents);
    halve(made_.uv0);
    halve(made_.uv1);
    halve(made_.colors);
    return vertex->second;
  }

  Primitive take(const dvec3& origin) {
    made_.positions.clear();
    made_.bounds = {};
    for (const std::uint32_t place : place_of_) {
      made_.positions.push_back(vec3(places_[place] - origin));
      made_.bounds.grow(made_.positions.back());
    }
    for (vec3& normal : made_.normals) {
      const float length = glm::length(normal);
      normal = length > 0.0f ? normal / length : vec3(0.0f, 1.0f, 0.0f);
    }
    for (vec4& tangent : made_.tangents) {
      const vec3 along(tangent);
      const float length = glm::length(along);
      tangent = vec4(length > 0.0f ? along / length : vec3(1.0f, 0.0f, 0.0f), tangent.w < 0.0f ? -1.0f : 1.0f);
    }
    made_.indices.clear();
    made_.indices.reserve(3 * (whole_.size() + triangles_.size()));
    for (const auto* some : {&whole_, &triangles_})
      for (const Triangle& t : *some) made_.indices.insert(made_.indices.end(), t.begin(), t.end());
    return std::move(made_);
  }

  const SeenFrom& seen_;
  Primitive made_;                           ///< attributes of all vertices but positions
  std::vector<dvec3> places_, worlds_;       ///< in the mesh and in the world
  std::vector<std::uint32_t> place_of_;      ///< by vertex
  std::vector<Triangle> whole_;              ///< triangles of vertices that are not split
  std::vector<Triangle> triangles_;          ///< all others
  std::size_t own_places_ = 0;               ///< of the source
  std::vector<std::uint8_t> marked_places_;  ///< 1: of a marked edge, by place of the source
  bool marked_own_ = false;                  ///< an edge between places of the source was marked
  std::set<Edge> edges_;                     ///< to split
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> vertices_;  ///< made of two vertices in this round
  std::map<Edge, std::uint32_t> middles_;                                      ///< places made in this round
};

}  // namespace

double longest_edge(const Primitive& primitive) {
  double longest = 0.0;
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
    longest = std::max(longest, length_of(dvec3(primitive.positions[primitive.indices[i]]),
                                          dvec3(primitive.positions[primitive.indices[i + 1]]),
                                          dvec3(primitive.positions[primitive.indices[i + 2]])));
  return longest;
}

double distance_to_triangle(const dvec3& point, const dvec3& a, const dvec3& b, const dvec3& c) {
  const auto to_segment = [&](const dvec3& from, const dvec3& to) {
    const dvec3 along = to - from;
    const double squared = glm::dot(along, along);
    const double t = squared > 0.0 ? std::clamp(glm::dot(point - from, along) / squared, 0.0, 1.0) : 0.0;
    return glm::length(point - (from + along * t));
  };
  const dvec3 normal = glm::cross(b - a, c - a);
  const double area = glm::length(normal);
  const bool inside = area > 0.0 && glm::dot(glm::cross(b - a, point - a), normal) >= 0.0 &&
                      glm::dot(glm::cross(c - b, point - b), normal) >= 0.0 &&
                      glm::dot(glm::cross(a - c, point - c), normal) >= 0.0;
  if (inside) return std::abs(glm::dot(point - a, normal)) / area;
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

double split_slack(const Primitive& primitive, const SeenFrom& seen) {
  double slack = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    std::array<dvec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = world_of(seen.world_from_mesh, dvec3(primitive.positions[primitive.indices[i + k]]));
    const double length = length_of(corners[0], corners[1], corners[2]);
    if (!(nearest_eye_bound(seen, corners[0], length) - length / seen.too_long < slack)) continue;
    slack = std::min(slack, nearest_eye(seen, corners[0], corners[1], corners[2]) - length / seen.too_long);
  }
  return slack;
}

Primitive refined_triangles(const Primitive& source, const SeenFrom& seen, const dvec3& origin) {
  return Splitter(source, seen).split(origin);
}

}  // namespace gloam
