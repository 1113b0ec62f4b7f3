#include "ray_accuracy.hpp"

#include <cmath>
#include <cstdio>

#include "distribution.hpp"
#include "../../tests/oracle/surfaces.hpp"

namespace espalier::bench {

using namespace reference;

namespace {

/// A ray whose t is off by more has met another part of the surface, or grazes it. In steps.
constexpr double another_place = 8.0;

PointRay to_point_ray(const Ray& ray) { return {to_point(ray.origin), to_point(ray.direction)}; }

}  // namespace

std::vector<ReferenceHit> reference_hits(const DoubleTree& source, const std::vector<Ray>& rays) {
    std::vector<ReferenceHit> hits;
    hits.reserve(rays.size());
    for (const Ray& ray : rays) hits.push_back(source.closest_hit(to_point_ray(ray)));
    return hits;
}

void print_ray_accuracy(const Blob& blob, const DoubleTree& source, const std::vector<Ray>& rays,
                        const std::vector<ReferenceHit>& references, std::size_t points) {
    const double step = std::ldexp(1.0, blob.lattice().step_exponent);
    std::size_t hits = 0, missed = 0, extra = 0, elsewhere = 0, doubtful = 0;
    Distribution t_errors, normal_errors, point_errors;
    std::size_t point_count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const ReferenceHit& reference = references[i];
        const RayHit hit = raycast(blob, rays[i]);
        const bool is_hit = bool(hit);
        doubtful += reference.is_doubtful;
        hits += reference.is_hit;
        missed += reference.is_hit && !is_hit;
        extra += !reference.is_hit && is_hit;
        if (!is_hit) continue;
        const PointRay ray = to_point_ray(rays[i]);
        const double t = static_cast<double>(hit.t);
        if (point_count < points) {
            ++point_count;
            const ReferenceNearest nearest =
                source.nearest(ray.origin + t * ray.direction, reference.is_hit ? reference.triangle : 0);
            point_errors.add(std::sqrt(nearest.squared_distance) / step);
        }
        if (!reference.is_hit) continue;
        const double t_error = std::abs(t - reference.t) * length(ray.direction) / step;
        elsewhere += t_error > another_place;
        t_errors.add(t_error);
        normal_errors.add(angle_between(to_point(hit.normal), normal_of(source.triangles()[reference.triangle])));
    }
    std::printf(",\"rays\":%zu,\"hits\":%zu,\"missed\":%zu,\"extra\":%zu,\"elsewhere\":%zu,\"doubtful\":%zu",
                rays.size(), hits, missed, extra, elsewhere, doubtful);
    t_errors.print("t_steps");
    normal_errors.print("normal_degrees");
    std::printf(",\"points\":%zu", point_count);
    point_errors.print("point_steps");
}

}  // namespace espalier::bench
