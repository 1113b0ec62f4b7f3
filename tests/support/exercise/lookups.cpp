#include "run.hpp"

namespace espalier::tests::exercises {

void exercise_bounds(Exercise& run) {
    AnswerHash& hash = run.hash;
    if (const Result<Sphere> sphere = bounding_sphere(run.blob)) {
        hash.add(sphere->center, sphere->radius);
    }
    if (const Result<OrientedBox> box = oriented_bounds(run.blob)) {
        hash.add(box->center);
        for (const Vec3& axis : box->half_axes) hash.add(axis);
    }
    if (const Result<KDop> k_dop = k_dop_bounds(run.blob)) {
        for (unsigned k = 0; k < KDop::count; ++k) {
            hash.add(k_dop->lo[k], k_dop->hi[k]);
        }
    }
}

void exercise_nodes(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    std::uint32_t visited = 0;
    const std::uint32_t until = 1 + run.random.below(300);
    const QueryStatus status = for_each_node(blob, [&](const TreeNode& node) {
        run.verdict.require(node.depth >= 1 && node.depth <= blob.depth(), "a node is deeper than the tree");
        run.hash.add(node.number);
        for (unsigned i = 0; i < node.child_count; ++i) {
            const TreeChild& child = node.children[i];
            run.verdict.require(!child.is_leaf || child.first.index + child.count <= blob.triangle_count(),
                                "a leaf has triangles that do not exist");
            run.hash.add(child.box.min, child.box.max);
        }
        if (++visited == until) return NodeVisit::stop;
        return node.number % 5 == 4 ? NodeVisit::skip : NodeVisit::descend;
    });
    run.verdict.require(status == (visited < until ? QueryStatus::ok : QueryStatus::stopped),
                        "the status of for_each_node is wrong");
}

void exercise_lookups(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    AnswerHash& hash = run.hash;
    Verdict& verdict = run.verdict;
    const std::uint32_t indices[] = {0, random.below(blob.triangle_count() + 1), blob.triangle_count(), 0x80000000u,
                                     0xFFFFFFFFu};
    for (const std::uint32_t index : indices) {
        if (const Result<OriginalTriangle> original = original_triangle(blob, {index})) {
            verdict.require(index < blob.triangle_count(), "a triangle that does not exist has an original");
            hash.add(original->file, original->mesh, original->triangle, original->first_corner);
            verdict.require(original->first_corner < 3, "a triangle begins with a corner that it does not have");
        }
        const RayHit hit = {0.0f, hostile_values[random.below(hostile_values.size())], 0.5f, {}, {index}};
        const OriginalHit turned = original_hit(blob, hit);
        verdict.require(!turned || index < blob.triangle_count(), "a hit of no triangle leads back");
        hash.add(static_cast<std::uint32_t>(turned.status), std::uint32_t{material(blob, {index})});
        if (const Result<EdgeKinds> kinds = edge_kinds(blob, {index}))
            for (const EdgeKind kind : {kinds->ab, kinds->bc, kinds->ca}) hash.add(static_cast<std::uint32_t>(kind));
        const auto [corners, status] = triangle_at(blob, {index});
        const bool exists = status == QueryStatus::ok;
        verdict.require(exists == (index < blob.triangle_count()), "corners of a triangle that does not exist");
        hash.add(corners.c);
        const TriangleId id = {index};
        Result<TriangleData> data;
        (void)triangle_data(blob, {&id}, {&data, 1});
        verdict.require(data.status == status && data->corners.c == corners.c, "the data of a triangle are others");
        const auto feature = static_cast<Feature>(random.below(8));
        const Vec3 given = some_point(blob, random);
        const Vec3 normal = fix_internal_edge_normal(blob, {index}, feature, given);
        if (std::memcmp(&normal, &given, sizeof normal) != 0)
            verdict.require(exists, "a triangle that does not exist has an internal edge");
        hash.add(normal);
    }
    hash.add(std::ldexp(1.0f, blob.lattice().step_exponent), blob.bounds().min, blob.bounds().max);
    std::uint32_t visited = 0, next = 0;
    (void)for_each_triangle(blob, [&](TriangleId triangle, const Triangle& corners) {
        const bool follows = blob.duplicate_reference_count() == 0 ? triangle.index == next : triangle.index >= next;
        verdict.require(follows, "triangles are not walked in storage order");
        next = triangle.index + 1;
        ++visited;
        hash.add(corners.a, corners.b, corners.c);
        return visited == 4096 ? Visit::stop : Visit::next;
    });
}

}  // namespace espalier::tests::exercises
