// The inner queries of every instruction set that this machine has, by name: the scalar ones first.
#pragma once

#include <vector>

#include <runtime/pair_queries.hpp>
#include <runtime/point_queries.hpp>
#include <runtime/ray_batch.hpp>
#include <runtime/ray_queries.hpp>

namespace espalier::tests {

struct InstructionPath {
    const char* name;
    decltype(&detail::scalar::closest_hit) closest_hit;
    decltype(&detail::scalar::first_hits) first_hits;
    decltype(&detail::scalar::any_hit) any_hit;
    decltype(&detail::scalar::every_hit) every_hit;
    decltype(&detail::scalar::closest_hits) closest_hits;
    decltype(&detail::scalar::any_hits) any_hits;
    decltype(&detail::scalar::any_overlap) any_overlap;
    decltype(&detail::scalar::every_overlap) every_overlap;
    decltype(&detail::scalar::closest_triangle) closest_triangle;
    decltype(&detail::scalar::closest_triangles) closest_triangles;
    decltype(&detail::scalar::may_overlap) may_overlap;
    decltype(&detail::scalar::closest_bounds) closest_bounds;
    decltype(&detail::scalar::may_hit) may_hit;
    decltype(&detail::scalar::closest_hit_on_lattice) closest_hit_on_lattice;
    decltype(&detail::scalar::any_hit_on_lattice) any_hit_on_lattice;
    decltype(&detail::scalar::touching_pairs) touching_pairs;
    decltype(&detail::scalar::nearest_pair) nearest_pair;
};

const std::vector<InstructionPath>& instruction_paths();

}  // namespace espalier::tests
