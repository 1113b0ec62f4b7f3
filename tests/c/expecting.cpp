#include "expecting.hpp"

#include <array>

namespace espalier::tests {

void Expecting::tell(const RayHit& hit) {
    tell(hit.t);
    tell(hit.u);
    tell(hit.v);
    tell(hit.normal);
    tell(hit.triangle);
}

void Expecting::tell(const Nearest& nearest) {
    tell(nearest.point);
    tell(nearest.distance);
    tell(nearest.u);
    tell(nearest.v);
    tell(nearest.triangle);
    tell(nearest.feature);
}

void Expecting::tell(const NearestPair& pair) {
    tell(pair.on_shape);
    tell(pair.on_surface);
    tell(pair.distance);
    tell(pair.u);
    tell(pair.v);
    tell(pair.triangle);
}

void Expecting::tell(const SweepHit& hit) {
    tell(hit.t);
    tell(hit.point);
    tell(hit.normal);
    tell(hit.triangle);
    tell(hit.starts_overlapping);
}

void Expecting::tell(const QueryCounters& counters) {
    tell(counters.nodes);
    tell(counters.leaves);
    tell(counters.groups);
    tell(counters.triangles);
    tell(counters.candidates);
}

void Expecting::about(Triangle triangle) {
    OriginalTriangle original = {7, 7, 7, 7};
    auto kinds = EdgeKinds{EdgeKind{9}, EdgeKind{9}, EdgeKind{9}};
    Vec3 normal = {5.0f, 5.0f, 5.0f};
    Corners corners;
    tell(original_triangle(blob_, triangle, original));
    tell(original.file);
    tell(original.mesh);
    tell(original.triangle);
    tell(original.first_corner);
    tell(std::uint32_t{material(blob_, triangle)});
    tell(edge_kinds(blob_, triangle, kinds));
    tell(kinds.ab);
    tell(kinds.bc);
    tell(kinds.ca);
    tell(is_on_inner_edge(blob_, {triangle, static_cast<Feature>(asked_.bits % 8), direction(0)}, normal));
    tell(normal);
    tell(triangle_corners(blob_, triangle, corners));
    tell(corners.a);
    tell(corners.b);
    tell(corners.c);
}

void Expecting::lookups() {
    tell(blob_.triangle_count());
    tell(blob_.copy_count());
    tell(blob_.vertex_count());
    tell(blob_.size_bytes());
    tell(blob_.checksum());
    tell(std::uint32_t{blob_.depth()});
    tell(std::uint32_t{blob_.bits()});
    tell(blob_.profile());
    tell(blob_.step());
    tell(blob_.max_error());
    tell(blob_.bounds_min());
    tell(blob_.bounds_max());
    tell(blob_.closed());
    tell(blob_.has_original_ids());
    tell(blob_.has_materials());
    tell(blob_.has_edge_flags());

    Sphere sphere = {{}, -1.0f};
    tell(bounding_sphere(blob_, sphere));
    tell(sphere.center);
    tell(sphere.radius);
    OrientedBox oriented;
    tell(oriented_bounds(blob_, oriented));
    tell(oriented.center);
    for (const Vec3& axis : oriented.half_axes) tell(axis);
    KDop k_dop;
    tell(k_dop_bounds(blob_, k_dop));
    for (unsigned i = 0; i < KDop::count; ++i) {
        tell(KDop::directions[i]);
        tell(k_dop.lo[i]);
        tell(k_dop.hi[i]);
    }
    tell(is_outside_bounds(blob_, Sphere{point(0), length(0)}));
    tell(is_outside_bounds(blob_, Box{point(0), point(1)}));

    about({asked_.bits % (blob_.triangle_count() + 1)});
    about({asked_.bits});
    about(no_triangle);
}

void Expecting::one_ray(const Ray& ray) {
    const auto filter = [&](Triangle triangle) { return counts(triangle); };
    RayHit hit;
    tell(raycast(blob_, ray, hit));
    tell(hit);
    tell(raycast(blob_, ray, hit, filter));
    tell(hit);
    tell(occluded(blob_, ray));
    tell(occluded(blob_, ray, filter));
    std::array<RayHit, 5> hits;
    HitCount count = closest_hits(blob_, ray, hits);
    tell(std::uint64_t{count.count});
    tell(count.status);
    for (std::size_t i = 0; i < count.count; ++i) tell(hits[i]);
    count = closest_hits(blob_, ray, std::span(hits).first(2), filter);
    tell(std::uint64_t{count.count});
    tell(count.status);
    for (std::size_t i = 0; i < count.count; ++i) tell(hits[i]);
    visits_ = asked_.bits % 9;
    tell(for_each_hit(blob_, ray, [&](const RayHit& each) {
        tell(each);
        return visit_one();
    }));
    QueryCounters counters = {1, 2, 3, 4, 5};
    tell(raycast_counted(blob_, ray, hit, counters));
    tell(hit);
    tell(counters);
}

void Expecting::tell(const OriginalHit& original) {
    tell(original.file);
    tell(original.mesh);
    tell(original.triangle);
    tell(original.u);
    tell(original.v);
    tell(original.status);
}

void Expecting::originals(const std::array<RayHit, 18>& hits) {
    for (const RayHit& hit : hits) tell(original_hit(blob_, hit));
    std::array<OriginalHit, 18> originals;
    tell(original_hit(blob_, hits, originals));
    for (const OriginalHit& original : originals) tell(original);
    const std::uint32_t bits = asked_.bits;
    const OriginalTriangle remap[2] = {{bits, 1, 2, bits % 3}, {3, 4, bits, bits % 5}};
    RayHit turned = hits[0];
    for (const std::uint32_t triangle : {0u, 1u, 2u, no_triangle.index}) {
        turned.triangle = {triangle};
        tell(original_hit(remap, turned));
    }
    std::array<OriginalTriangle, 18> triangles;
    std::array<Triangle, 18> named;
    for (std::size_t i = 0; i < hits.size(); ++i) named[i] = hits[i].triangle;
    for (const std::size_t count : {1u, 18u}) {
        tell(original_triangle(blob_, std::span(named).first(count), std::span(triangles).first(count)));
        for (const OriginalTriangle& original : std::span(triangles).first(count)) {
            tell(original.file);
            tell(original.mesh);
            tell(original.triangle);
            tell(original.first_corner);
        }
    }
}

void Expecting::rounded_ray(const Lattice& region, const Ray& ray) {
    const RoundedRay rounded = round_ray(region, ray);
    RayHit hit;
    bool any = true;
    tell(rounded.status());
    tell(raycast(blob_, rounded, hit));
    tell(hit);
    tell(occluded(blob_, rounded, any));
    tell(any);
}

void Expecting::rays() {
    std::array<Ray, 18> rays;
    rays[0] = {point(0), direction(0)};
    rays[1] = {point(0), direction(0), length(0), length(1), static_cast<Faces>(asked_.bits % 4)};
    rays[2] = along({point(0), point(1)});
    for (std::size_t i = 0; i < 3; ++i) one_ray(rays[i]);
    for (std::size_t i = 3; i < rays.size(); ++i) {
        rays[i] = rays[i % 3];
        rays[i].origin = point(static_cast<int>(i % 4));
    }
    std::array<RayHit, 18> hits;
    tell(std::uint64_t{raycast(blob_, rays, hits)});
    for (const RayHit& hit : hits) tell(hit);
    originals(hits);
    std::array<std::uint8_t, 18> answers;
    tell(std::uint64_t{occluded(blob_, rays, answers)});
    for (const std::uint8_t answer : answers) tell(std::uint32_t{answer});
    Lattice region = lattice_of(blob_);
    for (std::size_t i = 0; i < 3; ++i) rounded_ray(region, rays[i]);
    const std::array<Blob, 2> blobs = {blob_, other_};
    tell(lattice_of(blobs, region));
    rounded_ray(region, rays[0]);
}

void Expecting::walks() {
    visits_ = asked_.bits % 200;
    tell(for_each_triangle(blob_, [&](Triangle triangle, const Corners& corners) {
        tell(corners.a);
        tell(corners.b);
        tell(corners.c);
        tell(triangle);
        return visit_one();
    }));
    visits_ = asked_.bits % 30;
    tell(for_each_node(blob_, [&](const TreeNode& node) {
        tell(node.number);
        tell(std::uint32_t{node.depth});
        tell(std::uint32_t{node.child_count});
        for (unsigned i = 0; i < node.child_count; ++i) {
            const TreeChild& child = node.children[i];
            tell(child.box.min);
            tell(child.box.max);
            tell(child.is_leaf);
            tell(child.node);
            tell(child.first);
            tell(child.count);
        }
        if (visit_one() == stop) return NodeVisit::end;
        return node.number % 3 == 2 ? NodeVisit::skip : NodeVisit::descend;
    }));
}

void Expecting::tell(const Steps& steps) {
    for (const std::int32_t coordinate : {steps.x, steps.y, steps.z}) tell(static_cast<std::uint32_t>(coordinate));
}

void Expecting::tell(const HitInSteps& hit) {
    tell(hit.t);
    tell(hit.side);
    tell(hit.triangle);
}

void Expecting::steps() {
    const Lattice lattice = lattice_of(blob_);
    tell(lattice.origin);
    tell(static_cast<std::uint32_t>(lattice.step_exponent));
    for (const std::int32_t extent : lattice.extent) tell(static_cast<std::uint32_t>(extent));
    BoxInSteps box = {{1, 2, 3}, {4, 5, 6}};
    tell(steps_around(lattice, {point(0), point(1)}, box));
    tell(box.min);
    tell(box.max);
    SegmentInSteps segment = {{7, 8, 9}, {-1, -2, -3}};
    tell(to_steps(lattice, point(2), segment.from));
    tell(to_steps(lattice, point(3), segment.to));
    tell(segment.from);
    tell(segment.to);
    tell(to_world(lattice, segment.to));
    const auto ask = [&] {
        HitInSteps hit = {11, Faces{12}, {13}};
        bool any = false;
        tell(first_hit(blob_, segment, hit));
        tell(hit);
        tell(any_hit(blob_, segment, any));
        tell(any);
    };
    ask();
    segment = {bits_of(asked_.directions[0]), bits_of(asked_.directions[1])};
    ask();
}

void Expecting::nothing() {
    const Ray ray = {point(0), direction(0)};
    RayHit hit;
    const bool found = raycast(blob_, ray, hit);
    tell(found);
    tell(hit.t);
    tell(found);
    const HitCount one = closest_hits(blob_, ray, std::span(&hit, 1));
    tell(std::uint64_t{one.count});
    tell(one.status);
    SweepHit swept;
    tell(sweep(blob_, Sphere{point(0), length(0)}, direction(0), swept));
    tell(swept.t);
    tell(sweep(blob_, Capsule{point(0), point(1), length(0)}, direction(0), swept));
    tell(swept.t);
    tell(sweep(blob_, Box{point(0), point(1)}, direction(0), swept));
    tell(swept.t);

    for (int refused = 0; refused < 10; ++refused) tell(false);
    tell(QueryStatus::invalid_argument);

    tell(std::uint32_t{0});
    tell(std::uint32_t{0});
    tell(QueryStatus::ok);
    tell(original_triangle(blob_, {}, {}));
    tell(QueryStatus::invalid_argument);
    tell(Status::not_a_remap);
    tell(std::uint32_t{0});
    tell(found ? QueryStatus::output_full : QueryStatus::ok);
    tell(std::uint32_t{0});
    tell(blob_.triangle_count() > 0);  // no planes are all of space
    for (const OverlapPage& page : {collect_overlaps(blob_, Sphere{point(0), length(0)}, {}),
                                    collect_overlaps(blob_, std::span<const Plane>{}, {})}) {
        tell(page.status);
        tell(page.next);
    }
    std::size_t count = 1;
    tell(all_contacts(blob_, other_, {}, {}, count, {100}));
    tell(std::uint64_t{count});
}

}  // namespace espalier::tests
