// The options of a bake from C that tests may fill with any bytes.
#pragma once

#include <espalier/c/bake.h>

namespace espalier::tests {

/// Calls visit(field) for each option that is a choice or a flag, and for the box of a deformable blob.
template <class Visit>
void for_each_choice(espalier_bake_options& options, const Visit& visit) {
    visit(options.resolution_kind);
    visit(options.profile);
    visit(options.effort);
    visit(options.builder);
    visit(options.original_ids);
    visit(options.drop_bad_triangles);
    visit(options.allow_empty);
    visit(options.strict);
    visit(options.with_remap);
    visit(options.oriented_box);
    visit(options.sphere);
    visit(options.k_dop);
    visit(options.deformable);
    visit(options.has_range);
    visit(options.chooses_origin);
    visit(options.range);
    visit(options.max_leaf_triangles);
}

/// Calls visit(field) for each option that is a real number.
template <class Visit>
void for_each_number(espalier_bake_options& options, const Visit& visit) {
    visit(options.resolution);
    visit(options.flat_angle);
    visit(options.origin.x);
    visit(options.origin.y);
    visit(options.origin.z);
    visit(options.max_dropped);
    visit(options.duplicate_budget);
    visit(options.byte_price);
}

}  // namespace espalier::tests
