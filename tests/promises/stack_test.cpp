// How much stack each query needs on each instruction set, measured over queries that fill the traversal's stack. The
// budgets are in tests/support/machine/stack_budgets.hpp.
#include "support/testing.hpp"

#include <functional>

#include "support/base/sanitized.hpp"
#include "support/blobs/deformed_mesh.hpp"
#include "support/machine/chosen_instruction_set.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/machine/stack_budgets.hpp"
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

/// Measures each query of a blob some times over, on the chosen instruction set.
class Measurement {
public:
    Measurement(StackMeter& meter, const TestBlob& test)
        : meter_(meter),
          test_(test),
          blob_(test.opened.blob),
          data_(detail::data_of(blob_)),
          suffix_(blob_.profile() == Profile::tiny ? ", predicted" : "") {}

    void run() {
        measure("open", [&] { (void)open(test_.opened.bytes); });
        QueryMaker queries(test_.decoded, 5);
        ShapeMaker shapes(test_.decoded, 6);
        SweepMaker sweeps(test_.decoded, 7);
        PlacementMaker placements(test_.decoded, test_.decoded, 8);
        for (int i = 0; i < 60; ++i) {
            const Ray ray = queries.any_ray();
            measure_rays(ray);
            measure_batches(queries);
            const Sphere sphere = queries.sphere();
            measure_distances(sphere);
            measure_approximate(sphere, ray);
            shapes.make_volumes(true, [&](const auto& shape) {
                measure_volume(shape);
                if constexpr (std::is_same_v<decltype(shape), const Capsule&>) measure_contacts(shape);
            });
            const SweepOptions options = {.culling = FaceCulling::back, .ignore_leaving = i % 2 == 0, .skin = 0.125f};
            sweeps.make_shapes(true, [&](const auto& moving, int) { measure_sweep(moving, options); });
            if (i % 10 == 0) measure_pairs(i % 20 == 0 ? placements.random() : placements.adversarial());
        }
        measure_lookups();
    }

private:
    void measure(const std::string& query, FunctionRef<void()> call) { meter_.measure(query + suffix_, call); }

    void measure_rays(const Ray& ray) {
        measure("raycast", [&] { (void)raycast(blob_, ray); });
        measure("raycast, the inner query", [&] {
            for (const InstructionPath& path : paths_) (void)path.closest_hit(data_, ray, {});
        });
        measure("raycast, a rounded ray", [&] { (void)raycast(blob_, round_ray(blob_.lattice(), ray)); });
        measure("occluded", [&] { (void)occluded(blob_, ray); });
        measure("for_each_hit", [&] { (void)for_each_hit(blob_, ray, [](const RayHit&) { return Visit::next; }); });
        measure("for_each_crossing",
                [&] { (void)for_each_crossing(blob_, ray, [](const RayHit&) { return Visit::next; }); });
        measure("closest_hits", [&] { (void)closest_hits(blob_, ray, hits_); });
    }
    void measure_batches(QueryMaker& queries) {
        std::array<Ray, 64> rays;  // a group, and then strangers
        rays.fill(queries.any_ray());
        for (std::size_t k = 32; k < rays.size(); ++k) rays[k] = queries.any_ray();
        std::array<YesNo, 64> answers;
        measure("raycast, a batch", [&] { (void)raycast(blob_, rays, hits_); });
        measure("occluded, a batch", [&] { (void)occluded(blob_, rays, answers); });
        measure("raycast, arrays", [&] {
            const RayArrays arrays = {{&rays[0].origin, sizeof(Ray)}, {&rays[0].direction, sizeof(Ray)}};
            (void)raycast(blob_, arrays, hits_);
        });
    }
    void measure_distances(const Sphere& sphere) {
        const Vec3& center = sphere.center;
        const float radius = sphere.radius;
        detail::RoundedPoint point;
        detail::FoundNearest found;
        if (detail::round_point(data_, center, radius, point) == QueryStatus::ok)
            measure("closest_point, the inner query", [&] {
                for (const InstructionPath& path : paths_) path.closest_triangle(data_, point, found);
            });
        measure("closest_point", [&] { nearest_ = closest_point(blob_, center, radius); });
        std::array<ClosestPoint, 16> few;
        measure("closest_triangles", [&] { (void)closest_triangles(blob_, center, few, radius).status; });
        measure("contains", [&] { (void)contains(blob_, center); });
        measure("winding_number", [&] { (void)winding_number(blob_, center, 8).status; });
        measure("signed_distance", [&] { nearest_ = signed_distance(blob_, center, radius); });
        measure("fix_internal_edge_normal",
                [&] { (void)fix_internal_edge_normal(blob_, middle_triangle(), Feature::edge_ca, center); });
    }
    void measure_approximate(const Sphere& sphere, const Ray& ray) {
        measure("overlaps", [&] { (void)overlaps(blob_, sphere); });
        measure("for_each_overlap", [&] { (void)for_each_overlap(blob_, sphere, [](TriangleId) {}); });
        measure("may_overlap and distance_bounds", [&] {
            (void)overlaps(blob_, sphere, Accuracy{sphere.radius});
            (void)distance_bounds(blob_, sphere.center, sphere.radius, Accuracy{sphere.radius}).status;
        });
        measure("occluded with an accuracy",
                [&] { (void)occluded(blob_, ray, Accuracy{0.01f * (blob_.bounds().max.x - blob_.bounds().min.x)}); });
    }
    void measure_contacts(const Capsule& capsule) {
        const Vec3 &from = capsule.from, &to = capsule.to;
        const float radius = capsule.radius;
        measure("find_contacts, a capsule", [&] {
            std::array<Contact, 8> contacts;
            (void)find_contacts(blob_, capsule, radius, contacts);
        });
        measure("find_contacts, a box", [&] {
            std::array<Contact, 8> contacts;
            const OrientedBox box = {from, {{radius, radius, 0}, {-radius, radius, 0}, {0, 0, radius}}};
            (void)find_contacts(blob_, box, radius, contacts);
        });
        measure("find_contacts, a hull", [&] {
            std::array<Contact, 8> contacts;
            std::array<Vec3, max_hull_vertices> vertices;
            Random random(3);
            for (Vec3& vertex : vertices) vertex = sum(from, random.in_cube(radius));
            (void)find_contacts(blob_, ConvexHull{vertices}, radius, contacts);
        });
        measure("collect_planes", [&] {
            std::array<ContactPlane, 8> planes;
            (void)collect_planes(blob_, capsule, radius, planes);
        });
        const Segment segment = {from, to};
        measure("closest_point, a segment", [&] { nearest_ = closest_point(blob_, segment, radius); });
        const Box around = {{std::min(from.x, to.x), std::min(from.y, to.y), std::min(from.z, to.z)},
                            {std::max(from.x, to.x), std::max(from.y, to.y), std::max(from.z, to.z)}};
        measure("closest_point, a box", [&] { nearest_ = closest_point(blob_, around, radius); });
        measure_volume(Cone{from, difference(to, from), radius});
    }
    template <class Shape>
    void measure_volume(const Shape& shape) {
        const std::string query = std::string("overlaps and pages, ") + name_of(shape);
        std::array<TriangleId, 8> page;
        measure(query, [&] { (void)overlaps(blob_, shape); });
        measure(query, [&] { (void)collect_overlaps(blob_, shape, page); });
    }
    template <class Shape>
    void measure_sweep(const Moving<Shape>& moving, const SweepOptions& options) {
        SweepHit hit;
        measure(std::string("sweep, ") + name_of(moving.shape),
                [&] { hit = sweep(blob_, query_shape(moving.shape), moving.displacement, options); });
    }
    void measure_pairs(const Transform& placement) {
        TestPairFrame frame;
        if (detail::place_pair(data_, data_, placement, frame) != QueryStatus::ok) return;
        const PlacedBlob a = blob_, b(blob_, placement);
        const WorkLimit limit(20'000);
        measure("overlaps, two blobs", [&] { (void)overlaps(a, b, WorkLimit::unlimited()); });
        measure("collect_contacts, resumed", [&] {
            PairContact contacts[1];
            const Filled page = collect_contacts(a, b, contacts, limit);
            (void)collect_contacts(a, b, contacts, limit, page.next);
        });
        measure("collect_touches", [&] {
            PairTouch touches[2];
            (void)collect_touches(a, b, touches, limit);
        });
        measure("pair_touch", [&] { (void)pair_touch(a, b, {{0}, {0}, QueryStatus::ok}); });
        measure("distance, two blobs", [&] { (void)distance(a, b, limit, 1e30f); });
        measure("pairs of triangles, the inner query", [&] {
            for (const InstructionPath& path : paths_) {
                std::uint64_t work = 20'000;
                const auto go_on = [](const detail::TrianglePair&) { return Visit::next; };
                (void)path.touching_pairs(frame, go_on, work);
                detail::FoundTriangles closest;
                bool is_found = false;
                (void)path.nearest_pair(frame, infinity, false, closest, is_found, work);
            }
        });
    }
    void measure_lookups() {
        measure("for_each_node",
                [&] { (void)for_each_node(blob_, [](const TreeNode&) { return NodeVisit::descend; }); });
        measure("triangle_at", [&] { (void)triangle_at(blob_, middle_triangle()); });
        measure("oriented_bounds", [&] { (void)oriented_bounds(blob_); });
    }
    [[nodiscard]] TriangleId middle_triangle() const { return {blob_.triangle_count() / 2}; }

    StackMeter& meter_;
    const TestBlob& test_;
    const Blob& blob_;
    const detail::BlobData& data_;
    std::string suffix_;
    std::vector<InstructionPath> paths_ = chosen_paths();
    std::array<RayHit, 64> hits_;
    ClosestPoint nearest_;
};

TEST_CASE("promise: every query stays within its stack budget") {
    if (sanitized) {
        MESSAGE("SKIPPED: the sanitizers give frames other sizes");
        return;
    }
    for (const bool are_predicted : {false, true}) REQUIRE(!test_blobs(are_predicted).empty());
    on_each_instruction_set([] {
        StackMeter meter;
        for (const bool are_predicted : {false, true})
            for (const TestBlob& test : test_blobs(are_predicted)) Measurement(meter, test).run();
        meter.check();
    });
}

TEST_CASE("promise: refits and what belongs to them stay within their stack budgets") {
    if (sanitized) {
        MESSAGE("SKIPPED: the sanitizers give frames other sizes");
        return;
    }
    Mesh sparse = make_torus(12, 8, 3.0, 1.0);
    sparse.positions.resize(70'000, sparse.positions[0]);  // numbers of four bytes
    Mesh far = make_far_sphere();
    StackMeter meter;
    for (const Mesh& mesh : {make_torus(12, 8, 3.0, 1.0), sparse, far}) {
        for (const unsigned bits : {16u, 24u}) {
            DeformedMesh deformed(mesh, bits);
            std::vector<std::byte> whole(deformed.baked.size());
            for (const std::vector<Vec3>& pose : every_pose(mesh)) {
                bool is_ok = false;
                meter.measure("refit", [&] { is_ok = static_cast<bool>(refit(deformed.deformable, pose)); });
                CHECK(is_ok);
            }
            const std::string others = "seal and create_deformable";
            meter.measure(others, [&] { (void)seal(deformed.deformable, whole); });
            meter.measure(others, [&] { (void)create_deformable(deformed.still, deformed.memory); });
        }
    }
    meter.check();
}

}  // namespace
}  // namespace espalier::tests::stack_test
