// The kinds of queries that cost is measured of. measure.sh reads their names here.
#pragma once

#include <string_view>

namespace espalier::firmware {

// clang-format off
inline constexpr const char* kind_names[] = {
    "open", "open_unchecked", "raycast", "occluded", "overlaps_sphere", "closest_point", "overlaps_box",
    "overlaps_box_in_steps", "first_hit_in_steps", "any_hit_in_steps", "collides", "minimum_distance",
    "within_distance", "for_each_contact", "collect_touches", "for_each_hit", "for_each_crossing", "closest_hits",
    "raycast_batch", "for_each_overlap_sphere", "for_each_overlap_box", "overlaps_capsule", "overlaps_oriented_box",
    "overlaps_triangle", "overlaps_planes", "overlaps_cone", "closest_triangles", "contains", "signed_distance",
    "winding_number", "closest_to_segment", "closest_to_box", "contacts_sphere", "contacts_capsule",
    "contacts_oriented_box", "contacts_convex_hull", "sweep_sphere", "sweep_capsule", "sweep_box",
    "sweep_oriented_box", "sweep_convex_hull", "may_overlap_sphere", "may_overlap_box", "may_be_occluded",
    "distance_bounds", "open_scene", "scene_raycast", "scene_occluded", "scene_overlaps_sphere",
    "scene_closest_point", "moving_step", "moving_step_repack", "refit",
};
// clang-format on

/// A kind by its name, which does not compile if there is none.
struct Kind {
    unsigned number = 0;
    consteval Kind(const char* name) {
        while (std::string_view(kind_names[number]) != name) ++number;
    }
};

}  // namespace espalier::firmware
