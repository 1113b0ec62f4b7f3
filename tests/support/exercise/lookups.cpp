#include "run.hpp"

#include <cstdint>

#include <espalier/espalier.hpp>

#include "support/base/answer_hash.hpp"
#include "support/base/hostile_values.hpp"
#include "support/base/random.hpp"
#include "support/blobs/measured_blob.hpp"
#include "support/queries/hostile_arguments.hpp"

namespace espalier::tests::exercises {

void exercise_bounds(Exercise& run) {
    AnswerHash& hash = run.hash;
    Sphere sphere;
    if (bounding_sphere(run.blob, sphere)) {
        hash.add(sphere.center);
        hash.add(sphere.radius);
    }
    const Sphere asked = {some_point(run.blob, run.random), some_length(run.blob, run.random)};
    hash.add(std::uint32_t{is_outside_bounds(run.blob, asked)});
    hash.add(std::uint32_t{is_outside_bounds(run.blob, Box{some_point(run.blob, run.random), asked.center})});
    OrientedBox box;
    if (oriented_bounds(run.blob, box)) {
        hash.add(box.center);
        for (const Vec3& axis : box.half_axes) hash.add(axis);
    }
    KDop k_dop;
    if (k_dop_bounds(run.blob, k_dop)) {
        for (unsigned k = 0; k < KDop::count; ++k) {
            hash.add(k_dop.lo[k]);
            hash.add(k_dop.hi[k]);
        }
    }
}

void exercise_nodes(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    std::uint32_t visited = 0;
    const std::uint32_t until = 1 + run.random.below(300);
    const bool saw_all = for_each_node(blob, [&](const TreeNode& node) {
        run.verdict.require(node.depth >= 1 && node.depth <= blob.depth(), "a node is deeper than the tree");
        run.hash.add(node.number);
        for (unsigned i = 0; i < node.child_count; ++i) {
            const TreeChild& child = node.children[i];
            run.verdict.require(!child.is_leaf || child.first.index + child.count <= blob.triangle_count(),
                                "a leaf has triangles that do not exist");
            run.hash.add(child.box.min);
            run.hash.add(child.box.max);
        }
        if (++visited == until) return NodeVisit::end;
        return node.number % 5 == 4 ? NodeVisit::skip : NodeVisit::descend;
    });
    run.verdict.require(saw_all == (visited < until), "for_each_node says wrongly whether it saw all");
}

void exercise_lookups(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    AnswerHash& hash = run.hash;
    Verdict& verdict = run.verdict;
    const std::uint32_t indices[] = {0, random.below(blob.triangle_count() + 1), blob.triangle_count(), 0x80000000u,
                                     0xFFFFFFFFu};
    for (const std::uint32_t index : indices) {
        OriginalTriangle original;
        if (original_triangle(blob, {index}, original)) {
            verdict.require(index < blob.triangle_count(), "a triangle that does not exist has an original");
            hash.add(original.file);
            hash.add(original.mesh);
            hash.add(original.triangle);
            hash.add(original.first_corner);
            verdict.require(original.first_corner < 3, "a triangle begins with a corner that it does not have");
        }
        const RayHit hit = {0.0f, hostile_values[random.below(hostile_values.size())], 0.5f, {}, {index}};
        const OriginalHit turned = original_hit(blob, hit);
        verdict.require(!turned || index < blob.triangle_count(), "a hit of no triangle leads back");
        hash.add(static_cast<std::uint32_t>(turned.status));
        hash.add(std::uint32_t{material(blob, {index})});
        EdgeKinds kinds;
        if (edge_kinds(blob, {index}, kinds))
            for (const EdgeKind kind : {kinds.ab, kinds.bc, kinds.ca}) hash.add(static_cast<std::uint32_t>(kind));
        Corners corners;
        const bool exists = triangle_corners(blob, {index}, corners);
        verdict.require(exists == (index < blob.triangle_count()), "corners of a triangle that does not exist");
        hash.add(corners.c);
        Vec3 normal;
        const Contact contact = {{index}, static_cast<Feature>(random.below(8)), some_point(blob, random)};
        if (is_on_inner_edge(blob, contact, normal)) {
            verdict.require(exists, "a triangle that does not exist has an inner edge");
            hash.add(normal);
        }
    }
    hash.add(blob.step());
    hash.add(blob.bounds_min());
    hash.add(blob.bounds_max());
    std::uint32_t visited = 0;
    std::uint32_t next = 0;
    for_each_triangle(blob, [&](Triangle triangle, const Corners& corners) {
        const bool follows = blob.copy_count() == 0 ? triangle.index == next : triangle.index >= next;
        verdict.require(follows, "triangles are not walked in storage order");
        next = triangle.index + 1;
        ++visited;
        hash.add(corners.a);
        hash.add(corners.b);
        hash.add(corners.c);
        return visited == 4096 ? stop : keep_going;
    });
}

}  // namespace espalier::tests::exercises
