// Rays against one blob.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "flags.hpp"
#include "held_blob.hpp"
#include "lists.hpp"
#include "parts.hpp"
#include "rays.hpp"

#include <algorithm>
#include <limits>

#include <espalier/batches/rays.hpp>
#include <espalier/original.hpp>
#include <espalier/ray.hpp>

namespace espalier::python {

namespace {

/// Writes the closest hits of rays: of all at once, or with a filter of one after the other.
void write_hits(const Blob& blob, const RayArrays& rays, const TriangleFilter& filter, std::span<RayHit> hits) {
    if (!filter) {
        static_cast<void>(raycast(blob, rays, hits));
        return;
    }
    for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = raycast(blob, rays.at(i), filter);
}

/// Writes whether rays hit anything, in the same way.
void write_occlusions(const Blob& blob, const RayArrays& rays, const TriangleFilter& filter, std::span<YesNo> answers) {
    if (!filter) {
        static_cast<void>(occluded(blob, rays, answers));
        return;
    }
    for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = occluded(blob, rays.at(i), filter);
}

py::array raycasts(const HeldBlob& self, const py::handle& origins, const py::handle& directions,
                   const py::handle& t_min, const py::handle& t_max, int culling, const py::object& only,
                   unsigned threads) {
    const Rays rays(origins, directions, t_min, t_max, culling, origin_of(self.blob));
    const Flags flags(only);
    py::array results = rays.batch.results(dtype_of("ray_hit"));
    auto* hits = static_cast<RayHit*>(results.mutable_data());
    run_ranges(rays.batch.count(), threads, [&](std::size_t begin, std::size_t end) {
        write_hits(self.blob, rays.arrays.from(begin), flags.of_triangles(), std::span(hits + begin, end - begin));
    });
    return results;
}

/// Writes origin + t * direction in double: the product is exact, the sum is rounded once. NaN for a miss.
void write_place(const Ray& ray, const RayHit& hit, double* place) {
    const double t = hit ? static_cast<double>(hit.t) : std::numeric_limits<double>::quiet_NaN();
    place[0] = static_cast<double>(ray.origin.x) + t * static_cast<double>(ray.direction.x);
    place[1] = static_cast<double>(ray.origin.y) + t * static_cast<double>(ray.direction.y);
    place[2] = static_cast<double>(ray.origin.z) + t * static_cast<double>(ray.direction.z);
}

/// Returns (hits, places, sources).
py::tuple raycast_sources(const HeldBlob& self, const py::handle& origins, const py::handle& directions,
                          const py::handle& t_min, const py::handle& t_max, int culling, const py::object& only,
                          unsigned threads) {
    const Rays rays(origins, directions, t_min, t_max, culling, origin_of(self.blob));
    const Flags flags(only);
    py::array hit_array = rays.batch.results(dtype_of("ray_hit"));
    std::vector<py::ssize_t> place_shape = rays.batch.shape();
    place_shape.push_back(3);
    py::array_t<double> place_array(place_shape);
    py::array source_array = rays.batch.results(dtype_of("original_hit"));
    auto* hits = static_cast<RayHit*>(hit_array.mutable_data());
    auto* places = place_array.mutable_data();
    auto* sources = static_cast<OriginalHit*>(source_array.mutable_data());
    run_ranges(rays.batch.count(), threads, [&](std::size_t begin, std::size_t end) {
        const std::span<RayHit> some(hits + begin, end - begin);
        write_hits(self.blob, rays.arrays.from(begin), flags.of_triangles(), some);
        for (std::size_t i = begin; i < end; ++i) write_place(rays.arrays.at(i), hits[i], places + 3 * i);
        static_cast<void>(original_hit(self.blob, some, std::span(sources + begin, end - begin)));
    });
    return py::make_tuple(hit_array, place_array, source_array);
}

py::array occlusions(const HeldBlob& self, const py::handle& origins, const py::handle& directions,
                     const py::handle& t_min, const py::handle& t_max, int culling, const py::object& only,
                     unsigned threads) {
    const Rays rays(origins, directions, t_min, t_max, culling, origin_of(self.blob));
    const Flags flags(only);
    py::array results = rays.batch.results(py::dtype::of<std::uint8_t>());
    static_assert(sizeof(YesNo) == 1);
    auto* answers = static_cast<YesNo*>(results.mutable_data());
    run_ranges(rays.batch.count(), threads, [&](std::size_t begin, std::size_t end) {
        write_occlusions(self.blob, rays.arrays.from(begin), flags.of_triangles(),
                         std::span(answers + begin, end - begin));
    });
    return results;
}

/// Returns (offsets, hits, statuses) of all hits, of all crossings, or of the first hits up to a number, which alone
/// take a filter.
py::tuple hit_lists(const HeldBlob& self, const py::handle& origins, const py::handle& directions,
                    const py::handle& t_min, const py::handle& t_max, int culling, const py::object& only,
                    unsigned threads, int kind, std::size_t most) {
    const Rays rays(origins, directions, t_min, t_max, culling, origin_of(self.blob));
    const Flags flags(only);
    most = std::min<std::size_t>(most, self.blob.triangle_count());
    return make_lists<RayHit>(rays.batch, dtype_of("ray_hit"), threads, [&](std::size_t query, Growing<RayHit>& hits) {
        if (kind == 2) {
            const std::span<RayHit> places = hits.places(most).first(most);
            const Ray ray = rays.arrays.at(query);
            const TriangleFilter filter = flags.of_triangles();
            const Filled filled =
                filter ? closest_hits(self.blob, ray, places, filter) : closest_hits(self.blob, ray, places);
            hits.add(filled.count);
            return filled.status;
        }
        QueryStatus status = QueryStatus::ok;
        std::size_t offsets[2];
        for (std::size_t wanted = 16;;) {
            const std::span<RayHit> places = hits.places(wanted);
            const RayArrays one = rays.arrays.from(query);
            const FilledLists filled = kind == 0
                                           ? collect_hits(self.blob, one, std::span(&status, 1), offsets, places)
                                           : collect_crossings(self.blob, one, std::span(&status, 1), offsets, places);
            if (filled.status != QueryStatus::output_full) {
                hits.add(filled.count);
                return filled.status == QueryStatus::ok ? status : filled.status;
            }
            wanted = filled.needed;
        }
    });
}

}  // namespace

void bind_rays(py::module_& module) {
    module.def("raycasts", raycasts);
    module.def("raycast_sources", raycast_sources);
    module.def("occlusions", occlusions);
    module.def("hit_lists", hit_lists);
}

}  // namespace espalier::python
