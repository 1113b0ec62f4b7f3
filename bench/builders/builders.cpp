#include "builders.hpp"

#include <baker/build/build.hpp>

namespace espalier::bench {
namespace {

using baker::BuildSettings;
using baker::LatticeMesh;

/// Returns a builder of the library. `adjust` sets what the name states.
template <class Adjust>
NamedBuilder of_library(const char* family, const char* name, Builder builder, Adjust adjust) {
    return {family, name, [builder, adjust](const LatticeMesh& mesh, BuildSettings settings) {
                adjust(settings);
                return baker::build(mesh, builder, settings);
            }};
}
NamedBuilder of_library(const char* family, const char* name, Builder builder) {
    return of_library(family, name, builder, [](BuildSettings&) {});
}

NamedBuilder at_points(const char* name, SplitAxis axis, SplitPoint point) {
    return {"split point", name, [axis, point](const LatticeMesh& mesh, const BuildSettings& settings) {
                return build_at_points(mesh, axis, point, settings);
            }};
}

NamedBuilder by_objective(const char* name, Objective objective) {
    return {"objective", name, [objective](const LatticeMesh& mesh, const BuildSettings& settings) {
                return build_by_objective(mesh, objective, settings);
            }};
}

}  // namespace

std::vector<NamedBuilder> all_builders() {
    return {
        of_library("SAH", "binned SAH, 32 bins", Builder::binned_sah, [](BuildSettings& s) { s.bins = 32; }),
        of_library("SAH", "binned SAH, 16 bins", Builder::binned_sah, [](BuildSettings& s) { s.bins = 16; }),
        of_library("SAH", "sweep SAH", Builder::sweep_sah),
        of_library("SAH", "spatial splits", Builder::spatial_splits),
        at_points("object median (equal numbers)", SplitAxis::longest_side, SplitPoint::object_median),
        at_points("object mean", SplitAxis::longest_side, SplitPoint::object_mean),
        at_points("object mean, greatest variance", SplitAxis::greatest_variance, SplitPoint::object_mean),
        at_points("object mean, least sum", SplitAxis::least_sum, SplitPoint::object_mean),
        at_points("object mean, least maximum", SplitAxis::least_maximum, SplitPoint::object_mean),
        at_points("spatial median", SplitAxis::longest_side, SplitPoint::spatial_median),
        by_objective("least sum of volumes", Objective::sum_of_volumes),
        by_objective("least sum of areas", Objective::sum_of_areas),
        by_objective("least maximum", Objective::maximum_area),
        by_objective("least intersection", Objective::intersection_area),
        by_objective("greatest separation", Objective::separation),
        by_objective("least sum of areas, a third on each side", Objective::bounded_sum_of_areas),
        of_library("bottom-up", "agglomerative, from 4", Builder::agglomerative,
                   [](BuildSettings& s) { s.clusters_from = 4; }),
        of_library("bottom-up", "agglomerative, from 20", Builder::agglomerative,
                   [](BuildSettings& s) { s.clusters_from = 20; }),
        of_library("curve", "linear", Builder::linear),
        of_library("insertion", "insertion", Builder::insertion),
    };
}

}  // namespace espalier::bench
