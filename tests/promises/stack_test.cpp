// How much stack each query needs on each instruction set, measured over queries that fill the traversal's stack. The
// budgets are in tests/support/machine/stack_budgets.hpp.
#include "support/testing.hpp"

#include <functional>

#include "support/base/sanitized.hpp"
#include "support/blobs/deformed_mesh.hpp"
#include "support/machine/chosen_instruction_set.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/machine/stack_budgets.hpp"
#include "support/machine/stack_use.hpp"
#include "support/meshes/motions.hpp"
#include "support/queries/placement_maker.hpp"
#include "support/queries/shape_maker.hpp"
#include "support/queries/sweep_maker.hpp"
#include "support/queries/test_pair_frame.hpp"

namespace espalier::tests::stack_test {
namespace {

/// Blobs whose vertices are predicted, or the others.
std::vector<std::reference_wrapper<const TestBlob>> test_blobs(bool are_predicted) {
    std::vector<std::reference_wrapper<const TestBlob>> blobs;
    // A frame is as deep for one blob as for another of its profile: at a small scale a few blobs stand for all.
    const std::size_t step = scaled(8) < 8 ? 8 : 1;
    std::size_t number = 0;
    for (const TestBlob& blob : medium_test_blobs())
        if ((blob.opened.blob.profile() == Profile::tiny) == are_predicted && number++ % step == 0)
            blobs.push_back(blob);
    return blobs;
}

/// Arguments of every query of a blob.
struct Asked {
    const TestBlob& test;
    const Blob& blob = test.opened.blob;
    Ray ray = {};
    std::array<Ray, 64> rays = {};  ///< a group, and then strangers
    Sphere sphere = {};
    std::optional<detail::RoundedPoint> point = std::nullopt;
    Capsule capsule = {};
    Box box = {};
    OrientedBox oriented_box = {};
    Triangle triangle = {};
    std::vector<Plane> planes = {};
    SweepOptions options = {};
    Moving<Sphere> moving_sphere = {};
    Moving<Capsule> moving_capsule = {};
    Moving<Box> moving_box = {};
    Moving<OrientedBox> moving_oriented_box = {};
    Moving<OwnedHull> moving_hull = {};
    std::optional<TestPairFrame> frame = std::nullopt;  ///< of a and b, in some of them
    PlacedBlob a = PlacedBlob(blob), b = a;
};

/// Some for each blob.
std::vector<Asked> arguments_for(const std::vector<std::reference_wrapper<const TestBlob>>& blobs) {
    std::vector<Asked> all;
    for (const TestBlob& blob : blobs) {
        QueryMaker queries(blob.decoded, 5);
        ShapeMaker shapes(blob.decoded, 6);
        SweepMaker sweeps(blob.decoded, 7);
        PlacementMaker placements(blob.decoded, blob.decoded, 8);
        const detail::BlobData& data = detail::data_of(blob.opened.blob);
        for (int i = 0; i < 60; ++i) {
            Asked& asked = all.emplace_back(Asked{blob});
            asked.ray = queries.any_ray();
            asked.rays.fill(queries.any_ray());
            for (std::size_t k = 32; k < asked.rays.size(); ++k) asked.rays[k] = queries.any_ray();
            asked.sphere = queries.sphere();
            detail::RoundedPoint point;
            if (detail::round_point(data, asked.sphere.center, asked.sphere.radius, point) == QueryStatus::ok)
                asked.point = point;
            asked.capsule = shapes.capsule(true);
            asked.box = shapes.box(true);
            asked.oriented_box = shapes.oriented_box(true);
            asked.triangle = shapes.corners(true);
            const ConvexVolume planes = shapes.planes(true);
            asked.planes.assign(planes.planes.begin(), planes.planes.end());
            asked.options = {.culling = FaceCulling::back, .ignore_leaving = i % 2 == 0, .skin = 0.125f};
            asked.moving_sphere = sweeps.sphere(true);
            asked.moving_capsule = sweeps.capsule(true);
            asked.moving_box = sweeps.box(true);
            asked.moving_oriented_box = sweeps.oriented_box(true);
            asked.moving_hull = sweeps.hull(true);
            if (i % 10 != 0) continue;
            const Transform placement = i % 20 == 0 ? placements.random() : placements.adversarial();
            TestPairFrame frame;
            if (detail::place_pair(data, data, placement, frame) != QueryStatus::ok) continue;
            asked.frame = frame;
            asked.b = PlacedBlob(asked.blob, placement);
        }
    }
    return all;
}

/// What each query is measured on.
struct Condition {
    detail::InstructionSet set;
    bool are_predicted;
};
std::vector<Condition> conditions() {
    std::vector<Condition> all;
    for (const detail::InstructionSet set : instruction_sets())
        for (const bool are_predicted : {false, true}) all.push_back({set, are_predicted});
    return all;
}

/// The inner queries of the chosen instruction set. Those of one lane are two, for fast code and for small code.
std::vector<InstructionPath> chosen_paths() {
    const std::string name = name_of(detail::instruction_set());
    std::vector<InstructionPath> chosen;
    for (const InstructionPath& path : instruction_paths())
        if (path.name == name || (name == "scalar" && path.name == std::string("small"))) chosen.push_back(path);
    return chosen;
}

TEST_CASE("promise: the measure of stack reports a frame of known size") {
    if (sanitized) return;
    const std::size_t empty = stack_use([] {});
    const std::size_t filled = stack_use([] {
        volatile char frame[4096];
        for (volatile char& c : frame) c = 1;
    });
    CHECK(filled >= empty + 4096);
    CHECK(filled < empty + 4096 + 256);
}

TEST_CASE("promise: every query stays within its stack budget") {
    if (sanitized) {
        MESSAGE("SKIPPED: the sanitizers give frames other sizes");
        return;
    }
    std::vector<Asked> of_others = arguments_for(test_blobs(false)), of_predicted = arguments_for(test_blobs(true));
    for (const Condition& condition : conditions()) {
        const ChosenInstructionSet chosen(condition.set);
        const std::vector<InstructionPath> paths = chosen_paths();
        const std::vector<Asked>& all = condition.are_predicted ? of_predicted : of_others;
        REQUIRE(!all.empty());
        const auto check = [&](const char* query, auto ask) {
            std::size_t most = 0;
            for (const Asked& asked : all) most = std::max(most, stack_use([&] { ask(asked); }));
            check_stack(query + std::string(condition.are_predicted ? ", predicted" : ""), most);
        };
        const auto check_volume = [&](const char* query, auto shape_of) {
            std::array<TriangleId, 8> page;
            check(query, [&](const Asked& q) { (void)overlaps(q.blob, shape_of(q)); });
            check(query, [&](const Asked& q) { (void)collect_overlaps(q.blob, shape_of(q), page); });
        };
        SweepHit sweep_hit;
        const auto check_sweep = [&](const char* query, auto moving) {
            check(query, [&](const Asked& q) {
                sweep_hit = sweep(q.blob, (q.*moving).shape, (q.*moving).displacement, q.options);
            });
        };
        const auto check_pair = [&](const char* query, auto ask) {
            check(query, [&](const Asked& q) {
                if (q.frame) ask(q.a, q.b);
            });
        };
        std::array<RayHit, 64> hits;
        std::array<YesNo, 64> answers;
        ClosestPoint nearest;
        std::array<ClosestPoint, 16> few;
        bool inside = false;
        detail::FoundNearest found;
        check("open", [](const Asked& q) { (void)open(q.test.opened.bytes); });
        check("raycast", [](const Asked& q) { (void)raycast(q.blob, q.ray); });
        check("raycast, the inner query", [&](const Asked& q) {
            for (const InstructionPath& path : paths) (void)path.closest_hit(detail::data_of(q.blob), q.ray, nullptr);
        });
        check("closest_point, the inner query", [&](const Asked& q) {
            for (const InstructionPath& path : paths)
                if (q.point) path.closest_triangle(detail::data_of(q.blob), *q.point, found);
        });
        check("raycast, a rounded ray",
              [](const Asked& q) { (void)raycast(q.blob, round_ray(q.blob.lattice(), q.ray)); });
        check("occluded", [](const Asked& q) { (void)occluded(q.blob, q.ray); });
        check("raycast, a batch", [&](const Asked& q) { (void)raycast(q.blob, q.rays, hits); });
        check("occluded, a batch", [&](const Asked& q) { (void)occluded(q.blob, q.rays, answers); });
        check("raycast, arrays", [&](const Asked& q) {
            const RayArrays arrays = {{&q.rays[0].origin, sizeof(Ray)}, {&q.rays[0].direction, sizeof(Ray)}};
            (void)raycast(q.blob, arrays, hits);
        });
        check("for_each_hit",
              [](const Asked& q) { (void)for_each_hit(q.blob, q.ray, [](const RayHit&) { return Visit::next; }); });
        check("for_each_crossing", [](const Asked& q) {
            (void)for_each_crossing(q.blob, q.ray, [](const RayHit&) { return Visit::next; });
        });
        check("closest_hits", [&](const Asked& q) { (void)closest_hits(q.blob, q.ray, hits); });
        check("find_contacts, a capsule", [](const Asked& q) {
            std::array<Contact, 8> contacts;
            (void)find_contacts(q.blob, q.capsule, q.capsule.radius, contacts);
        });
        check("find_contacts, a box", [](const Asked& q) {
            std::array<Contact, 8> contacts;
            const float half = q.capsule.radius;
            const OrientedBox box = {q.capsule.from, {{half, half, 0}, {-half, half, 0}, {0, 0, half}}};
            (void)find_contacts(q.blob, box, half, contacts);
        });
        check("find_contacts, a hull", [](const Asked& q) {
            std::array<Contact, 8> contacts;
            std::array<Vec3, max_hull_vertices> vertices;
            Random random(3);
            for (Vec3& vertex : vertices) vertex = sum(q.capsule.from, random.in_cube(q.capsule.radius));
            (void)find_contacts(q.blob, ConvexHull{vertices}, q.capsule.radius, contacts);
        });
        check_pair("overlaps, two blobs",
                   [](const PlacedBlob& a, const PlacedBlob& b) { (void)overlaps(a, b, WorkLimit::unlimited()); });
        check_pair("collect_contacts, resumed", [](const PlacedBlob& a, const PlacedBlob& b) {
            PairContact contacts[1];
            const Filled page = collect_contacts(a, b, contacts, WorkLimit(20'000));
            (void)collect_contacts(a, b, contacts, WorkLimit(20'000), page.next);
        });
        check_pair("collect_touches", [](const PlacedBlob& a, const PlacedBlob& b) {
            PairTouch touches[2];
            (void)collect_touches(a, b, touches, WorkLimit(20'000));
        });
        check_pair("pair_touch", [](const PlacedBlob& a, const PlacedBlob& b) {
            (void)pair_touch(a, b, {{0}, {0}, QueryStatus::ok});
        });
        check_pair("distance, two blobs",
                   [](const PlacedBlob& a, const PlacedBlob& b) { (void)distance(a, b, WorkLimit(20'000), 1e30f); });
        check("pairs of triangles, the inner query", [&](const Asked& q) {
            if (!q.frame) return;
            for (const InstructionPath& path : paths) {
                std::uint64_t work = 20'000;
                const auto go_on = [](const detail::TrianglePair&) { return Visit::next; };
                (void)path.touching_pairs(*q.frame, go_on, work);
                detail::FoundTriangles closest;
                bool is_found = false;
                (void)path.nearest_pair(*q.frame, infinity, false, closest, is_found, work);
            }
        });
        check_sweep("sweep, a sphere", &Asked::moving_sphere);
        check_sweep("sweep, a capsule", &Asked::moving_capsule);
        check_sweep("sweep, a box", &Asked::moving_box);
        check_sweep("sweep, an oriented box", &Asked::moving_oriented_box);
        check_sweep("sweep, a hull", &Asked::moving_hull);
        check("overlaps", [](const Asked& q) { (void)overlaps(q.blob, q.sphere); });
        check("for_each_overlap", [](const Asked& q) { (void)for_each_overlap(q.blob, q.sphere, [](TriangleId) {}); });
        check("may_overlap and distance_bounds", [](const Asked& q) {
            (void)overlaps(q.blob, q.sphere, Accuracy{q.sphere.radius});
            (void)distance_bounds(q.blob, q.sphere.center, q.sphere.radius, Accuracy{q.sphere.radius}).status;
        });
        check("occluded with an accuracy", [](const Asked& q) {
            (void)occluded(q.blob, q.ray, Accuracy{0.01f * (q.blob.bounds().max.x - q.blob.bounds().min.x)});
        });
        check_volume("overlaps and pages, a capsule", [](const Asked& q) { return q.capsule; });
        check_volume("overlaps and pages, a box", [](const Asked& q) { return q.box; });
        check_volume("overlaps and pages, an oriented box", [](const Asked& q) { return q.oriented_box; });
        check_volume("overlaps and pages, a cone", [](const Asked& q) {
            return Cone{q.capsule.from, difference(q.capsule.to, q.capsule.from), q.capsule.radius};
        });
        check_volume("overlaps and pages, a triangle", [](const Asked& q) { return q.triangle; });
        check_volume("overlaps and pages, planes", [](const Asked& q) { return ConvexVolume{q.planes}; });
        check("closest_point",
              [&](const Asked& q) { nearest = closest_point(q.blob, q.sphere.center, q.sphere.radius); });
        check("closest_triangles",
              [&](const Asked& q) { (void)closest_triangles(q.blob, q.sphere.center, few, q.sphere.radius).status; });
        check("closest_point, a segment", [&](const Asked& q) {
            nearest = closest_point(q.blob, Segment{q.capsule.from, q.capsule.to}, q.capsule.radius);
        });
        check("closest_point, a box", [&](const Asked& q) {
            const Vec3 &a = q.capsule.from, &b = q.capsule.to;
            const Vec3 min = {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
            const Vec3 max = {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
            nearest = closest_point(q.blob, Box{min, max}, q.capsule.radius);
        });
        check("contains", [&](const Asked& q) { inside = contains(q.blob, q.sphere.center).yes(); });
        check("winding_number", [](const Asked& q) { (void)winding_number(q.blob, q.sphere.center, 8).status; });
        check("signed_distance",
              [&](const Asked& q) { nearest = signed_distance(q.blob, q.sphere.center, q.sphere.radius); });
        check("for_each_node",
              [](const Asked& q) { (void)for_each_node(q.blob, [](const TreeNode&) { return NodeVisit::descend; }); });
        check("fix_internal_edge_normal", [](const Asked& q) {
            (void)fix_internal_edge_normal(q.blob, {q.blob.triangle_count() / 2}, Feature::edge_ca, q.sphere.center);
        });
        check("triangle_at", [](const Asked& q) { (void)triangle_at(q.blob, {q.blob.triangle_count() / 2}); });
        check("oriented_bounds", [](const Asked& q) { (void)oriented_bounds(q.blob); });
    }
}

TEST_CASE("promise: refits and what belongs to them stay within their stack budgets") {
    if (sanitized) {
        MESSAGE("SKIPPED: the sanitizers give frames other sizes");
        return;
    }
    Mesh sparse = make_torus(12, 8, 3.0, 1.0);
    sparse.positions.resize(70'000, sparse.positions[0]);  // numbers of four bytes
    Mesh far = make_far_sphere();
    std::size_t most_of_refit = 0, most_of_others = 0;
    for (const Mesh& mesh : {make_torus(12, 8, 3.0, 1.0), sparse, far}) {
        for (const unsigned bits : {16u, 24u}) {
            DeformedMesh deformed(mesh, bits);
            std::vector<std::byte> whole(deformed.baked.size());
            for (const std::vector<Vec3>& pose : every_pose(mesh)) {
                bool is_ok = false;
                most_of_refit = std::max(
                    most_of_refit, stack_use([&] { is_ok = static_cast<bool>(refit(deformed.deformable, pose)); }));
                CHECK(is_ok);
            }
            const auto measure = [&](auto call) { most_of_others = std::max(most_of_others, stack_use(call)); };
            measure([&] { (void)seal(deformed.deformable, whole); });
            measure([&] { (void)create_deformable(deformed.still, deformed.memory); });
        }
    }
    check_stack("refit", most_of_refit);
    check_stack("seal and create_deformable", most_of_others);
}

}  // namespace
}  // namespace espalier::tests::stack_test
