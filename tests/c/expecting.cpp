#include "expecting.hpp"

#include <array>
#include <cstring>

namespace espalier::tests {

void Expecting::tell(const RayHit& hit) {
    tell(hit.t);
    tell(hit.u);
    tell(hit.v);
    tell(hit.normal);
    tell(hit.triangle);
    tell(hit.status);
    tell(hit.side);
}

void Expecting::tell(const ClosestPoint& nearest) {
    tell(nearest.point);
    tell(nearest.on_shape);
    tell(nearest.face_normal);
    tell(nearest.distance);
    tell(nearest.u);
    tell(nearest.v);
    tell(nearest.triangle);
    tell(nearest.status);
    tell(nearest.feature);
    tell(nearest.side);
    tell(std::uint32_t{nearest.reserved});
}

void Expecting::tell(const SweepHit& hit) {
    tell(hit.t);
    tell(hit.point);
    tell(hit.normal);
    tell(hit.face_normal);
    tell(hit.triangle);
    tell(hit.status);
    tell(hit.feature);
    tell(hit.starts_overlapping);
}

void Expecting::tell(const QueryCounters& counters) {
    tell(counters.nodes);
    tell(counters.leaves);
    tell(counters.groups);
    tell(counters.triangles);
    tell(counters.candidates);
}

void Expecting::tell(const Lattice& lattice) {
    tell(lattice.origin);
    tell(static_cast<std::uint32_t>(lattice.step_exponent));
    for (const std::int32_t extent : lattice.extent) tell(static_cast<std::uint32_t>(extent));
}

void Expecting::tell(const Filled& filled) {
    tell(static_cast<std::uint32_t>(filled.count));
    for (const std::uint32_t place : filled.next.place) tell(place);
    tell(filled.status);
}

void Expecting::tell(const Result<OriginalTriangle>& original) {
    tell(original.status);
    tell(original->file);
    tell(original->mesh);
    tell(original->triangle);
    tell(original->first_corner);
}

void Expecting::about(TriangleId triangle) {
    tell(original_triangle(blob_, triangle));
    tell(std::uint32_t{material(blob_, triangle)});
    const Result<EdgeKinds> kinds = edge_kinds(blob_, triangle);
    tell(kinds.status);
    tell(kinds->ab);
    tell(kinds->bc);
    tell(kinds->ca);
    tell(fix_internal_edge_normal(blob_, triangle, static_cast<Feature>(asked_.bits % 8), direction(0)));
    const Result<Triangle> corners = triangle_at(blob_, triangle);
    tell(corners.status);
    tell(corners->a);
    tell(corners->b);
    tell(corners->c);
}

void Expecting::lookups() {
    tell(true);  // the sizes that the library states
    tell(blob_.status());
    tell(blob_.triangle_count());
    tell(blob_.duplicate_reference_count());
    tell(blob_.vertex_count());
    tell(blob_.size());
    tell(blob_.checksum());
    tell(std::uint32_t{blob_.depth()});
    tell(blob_.profile());
    tell(blob_.lattice());
    tell(blob_.max_error());
    tell(blob_.bounds().min);
    tell(blob_.bounds().max);
    tell(blob_.is_closed());
    tell(blob_.is_deformable());
    tell(static_cast<std::uint32_t>(deformable_bytes(blob_)));
    tell(blob_.has_original_ids());
    tell(blob_.has_materials());
    tell(blob_.has_edge_flags());

    const Result<Sphere> sphere = bounding_sphere(blob_);
    tell(sphere.status);
    tell(sphere->center);
    tell(sphere->radius);
    const Result<OrientedBox> oriented = oriented_bounds(blob_);
    tell(oriented.status);
    tell(oriented->center);
    for (const Vec3& axis : oriented->half_axes) tell(axis);
    const Result<KDop> k_dop = k_dop_bounds(blob_);
    tell(k_dop.status);
    for (unsigned i = 0; i < KDop::count; ++i) {
        tell(KDop::directions[i]);
        tell(k_dop->lo[i]);
        tell(k_dop->hi[i]);
    }

    about({asked_.bits % (blob_.triangle_count() + 1)});
    about({asked_.bits});
    about(no_triangle);
}

void Expecting::one_ray(const Ray& ray) {
    const auto filter = [&](TriangleId triangle) { return counts(triangle); };
    tell(raycast(blob_, ray));
    tell(raycast(blob_, ray, filter));
    tell(occluded(blob_, ray));
    tell(occluded(blob_, ray, filter));
    std::array<RayHit, 5> hits;
    Filled count = closest_hits(blob_, ray, hits);
    tell(count);
    for (std::size_t i = 0; i < count.count; ++i) tell(hits[i]);
    count = closest_hits(blob_, ray, std::span(hits).first(2), filter);
    tell(count);
    for (std::size_t i = 0; i < count.count; ++i) tell(hits[i]);
    visits_ = asked_.bits % 9;
    const auto visit = [&](const RayHit& each) {
        tell(each);
        return visit_one();
    };
    tell(for_each_hit(blob_, ray, visit));
    visits_ = asked_.bits % 7;
    tell(for_each_crossing(blob_, ray, visit));
    QueryCounters counters = {1, 2, 3, 4, 5};
    tell(raycast(blob_, ray, counters));
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
    std::array<Result<OriginalTriangle>, 18> triangles;
    std::array<TriangleId, 18> named;
    for (std::size_t i = 0; i < hits.size(); ++i) named[i] = hits[i].triangle;
    for (const std::size_t count : {1u, 18u}) {
        tell(original_triangle(blob_, std::span(named).first(count), std::span(triangles).first(count)));
        for (const Result<OriginalTriangle>& original : std::span(triangles).first(count)) tell(original);
    }
}

void Expecting::rounded_ray(const Lattice& region, const Ray& ray) {
    const RoundedRay rounded = round_ray(region, ray);
    tell(rounded.status());
    tell(raycast(blob_, rounded));
    tell(occluded(blob_, rounded));
    const auto counts = [&](TriangleId triangle) { return this->counts(triangle); };
    tell(raycast(blob_, rounded, counts));
    tell(occluded(blob_, rounded, counts));
    visits_ = asked_.bits % 9;
    const auto visit = [&](const RayHit& hit) {
        tell(hit);
        return visit_one();
    };
    tell(for_each_hit(blob_, rounded, visit));
    visits_ = asked_.bits % 7;
    tell(for_each_crossing(blob_, rounded, visit));
    for (const bool whole : {false, true}) {
        const Transform transform = {{}, {whole ? 64.0f : length(0), 0.0f, whole ? -128.0f : 0.0f}, 1.0f};
        const RoundedRay local = to_local(transform, rounded);
        tell(local.status());
        tell(raycast(blob_, local));
    }
}

void Expecting::rays() {
    const std::array<Ray, 18> rays = made_rays<18>();
    for (std::size_t i = 0; i < 3; ++i) one_ray(rays[i]);
    std::array<RayHit, 18> hits;
    std::memset(static_cast<void*>(&hits), 0, sizeof hits);
    tell(raycast(blob_, rays, hits));
    for (const RayHit& hit : hits) tell(hit);
    originals(hits);
    std::array<YesNo, 18> answers;
    answers.fill(YesNo(QueryStatus::ok));
    tell(occluded(blob_, rays, answers));
    for (const YesNo answer : answers) tell(answer);
    const Lattice region = blob_.lattice();
    for (std::size_t i = 0; i < 3; ++i) rounded_ray(region, rays[i]);
    const std::array<Blob, 2> blobs = {blob_, other_};
    const Result<Lattice> both = lattice_of(blobs);
    tell(both.status);
    rounded_ray(*both, rays[0]);
}

void Expecting::walks() {
    visits_ = asked_.bits % 200;
    tell(for_each_triangle(
        blob_, [&](TriangleId triangle, const Triangle& corners) { return visit_triangle(triangle, corners); }));
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
        if (visit_one() == Visit::stop) return NodeVisit::stop;
        return node.number % 3 == 2 ? NodeVisit::skip : NodeVisit::descend;
    }));
}

void Expecting::tell(const LatticePoint& steps) {
    for (const std::int32_t coordinate : {steps.x, steps.y, steps.z}) tell(static_cast<std::uint32_t>(coordinate));
}

void Expecting::tell(const LatticeHit& hit) {
    tell(hit.t);
    tell(hit.triangle);
    tell(hit.status);
    tell(hit.side);
}

void Expecting::steps() {
    const Lattice lattice = blob_.lattice();
    tell(lattice);
    const Result<LatticeBox> box = to_lattice(lattice, Box{point(0), point(1)});
    tell(box.status);
    tell(box->min);
    tell(box->max);
    const Result<LatticePoint> from = to_lattice(lattice, point(2)), to = to_lattice(lattice, point(3));
    tell(from.status);
    tell(to.status);
    LatticeSegment segment = {*from, *to};
    tell(segment.from);
    tell(segment.to);
    tell(to_local(lattice, segment.to));
    const auto ask = [&] {
        tell(raycast(blob_, segment));
        tell(occluded(blob_, segment));
    };
    ask();
    segment = {bits_of(asked_.directions[0]), bits_of(asked_.directions[1])};
    ask();
}

void Expecting::nothing() {
    const Ray ray = {point(0), direction(0)};
    RayHit hit = raycast(blob_, ray);
    tell(hit.status);
    tell(hit.t);
    tell(hit.status);
    tell(closest_hits(blob_, ray, std::span(&hit, 1)));
    tell(sweep(blob_, sphere(), direction(0)).t);
    tell(sweep(blob_, capsule(), direction(0)).t);
    tell(sweep(blob_, box(), direction(0)).t);
    tell(sweep(blob_, oriented_box(), direction(0)).t);
    const std::array<Vec3, 4> vertices = all_points();
    tell(sweep(blob_, convex_hull(vertices), direction(0)).t);
    tell(sweep(blob_, ConvexHull{}, direction(0)).status);

    for (int refused = 0; refused < 13; ++refused) tell(QueryStatus::invalid_argument);
    tell(QueryStatus::invalid_argument);

    tell(raycast(blob_, std::span<const Ray>{}, {}));
    tell(occluded(blob_, std::span<const Ray>{}, {}));
    tell(original_hit(blob_, {}, {}));
    tell(original_triangle(blob_, std::span<const TriangleId>{}, {}));
    tell(original_hit(std::span<const OriginalTriangle>{}, hit).status);
    tell(OpenStatus::not_a_remap);
    tell(closest_hits(blob_, ray, {}));
    tell(closest_triangles(blob_, point(0), {}).status);
    tell(overlaps(blob_, ConvexVolume{}).status());
    for (const Filled& page : {collect_overlaps(blob_, sphere(), {}), collect_overlaps(blob_, ConvexVolume{}, {})}) {
        tell(page.status);
        tell(page.next.place[0]);
    }
    const Filled filled = collect_contacts(blob_, other_, {}, WorkLimit(100));
    tell(std::uint64_t{filled.count});
    tell(filled.status);
}

}  // namespace espalier::tests
