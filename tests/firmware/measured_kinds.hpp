// The kinds of queries that cost is measured of. measure.sh reads their names here.
#pragma once

namespace espalier::firmware {

enum Kind : unsigned {
    opening,
    unchecked_opening,
    closest_ray,
    any_ray,
    sphere_overlap,
    nearest_point,
    box_overlap,
    box_in_steps,
    first_in_steps,
    any_in_steps,
    two_touch,
    two_distance,
    two_within,
    two_contacts,
    two_touches,
    all_hits,
    all_crossings,
    few_hits,
    ray_batch,
    sphere_list,
    box_list,
    capsule_overlap,
    oriented_box_overlap,
    triangle_overlap,
    planes_overlap,
    cone_overlap,
    few_points,
    inside,
    signed_point,
    winding,
    nearest_to_segment,
    nearest_to_box,
    contacts_sphere,
    contacts_capsule,
    contacts_box,
    contacts_hull,
    moving_sphere,
    moving_capsule,
    moving_box,
    moving_oriented_box,
    moving_hull,
    coarse_sphere,
    coarse_box,
    coarse_ray,
    coarse_distance,
    scene_opening,
    scene_ray,
    scene_any_ray,
    scene_sphere,
    scene_point,
    moving_step,
    moving_step_repack,
    refit_pose,
    kind_count
};

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
static_assert(sizeof kind_names / sizeof *kind_names == kind_count);

}  // namespace espalier::firmware
