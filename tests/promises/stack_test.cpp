// How much stack each query needs on each instruction set, measured over queries that fill the traversal's stack. The
// budgets are in tests/support/machine/stack_budgets.hpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <espalier/espalier.hpp>

#include "support/base/random.hpp"
#include "support/base/sanitized.hpp"
#include "support/base/test_scale.hpp"
#include "support/blobs/deformed_mesh.hpp"
#include "support/blobs/test_blobs.hpp"
#include "support/machine/chosen_instruction_set.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/machine/stack_budgets.hpp"
#include "support/machine/stack_use.hpp"
#include "support/meshes/makers.hpp"
#include "support/meshes/motions.hpp"
#include "support/queries/placement_maker.hpp"
#include "support/queries/ray_maker.hpp"
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

/// The most that `call` took for any blob and query.
template <class Call>
std::size_t most_stack(const std::vector<std::reference_wrapper<const TestBlob>>& measured, Call call) {
    std::size_t most = 0;
    for (const TestBlob& blob : measured) {
        QueryMaker maker(blob.decoded, 5);
        const std::uint64_t queries = std::max<std::uint64_t>(4, scaled(40));
        for (std::uint64_t i = 0; i < queries; ++i) most = std::max(most, call(blob, maker));
    }
    return most;
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
    for (const Condition& condition : conditions()) {
        const ChosenInstructionSet chosen(condition.set);
        const bool are_predicted = condition.are_predicted;
        const auto measured = test_blobs(are_predicted);
        REQUIRE(!measured.empty());
        struct Row {
            const char* query;
            std::size_t most;
        };
        ClosestPoint nearest;
        std::array<ClosestPoint, 16> few;
        bool inside = false;
        const auto ray_row = [&](auto query) {
            return most_stack(measured, [&](const TestBlob& blob, QueryMaker& maker) {
                const Ray ray = maker.any_ray();
                return stack_use([&] { query(blob.opened.blob, ray); });
            });
        };
        using Rays = std::array<Ray, 64>;
        std::array<RayHit, 64> hits;
        std::array<YesNo, 64> answers;
        const auto batch_row = [&](auto query) {
            return most_stack(measured, [&](const TestBlob& blob, QueryMaker& maker) {
                Rays rays;
                rays.fill(maker.any_ray());  // a group, and then strangers
                for (std::size_t i = 32; i < rays.size(); ++i) rays[i] = maker.any_ray();
                return stack_use([&] { query(blob.opened.blob, rays); });
            });
        };
        const auto ray_path_row = [&](auto query) {
            std::size_t most = 0;
            for (const InstructionPath& path : chosen_paths())
                most = std::max(most, most_stack(measured, [&](const TestBlob& blob, QueryMaker& maker) {
                                    const Ray ray = maker.any_ray();
                                    return stack_use([&] { query(path, blob.opened.blob, ray); });
                                }));
            return most;
        };
        const auto sphere_row = [&](auto query) {
            return most_stack(measured, [&](const TestBlob& blob, QueryMaker& maker) {
                const Sphere sphere = maker.sphere();
                return stack_use([&] { query(blob.opened.blob, sphere); });
            });
        };
        const auto volume_row = [&](auto make) {
            std::size_t most = 0;
            for (const TestBlob& blob : measured) {
                ShapeMaker maker(blob.decoded, 6);
                for (int i = 0; i < 30; ++i) {
                    const auto shape = make(maker);
                    std::array<TriangleId, 8> page;
                    most = std::max(most, stack_use([&] { (void)overlaps(blob.opened.blob, shape); }));
                    most = std::max(most, stack_use([&] { (void)collect_overlaps(blob.opened.blob, shape, page); }));
                }
            }
            return most;
        };
        const auto point_path_row = [&](auto query) {
            std::size_t most = 0;
            for (const InstructionPath& path : chosen_paths())
                most =
                    std::max(most, most_stack(measured, [&](const TestBlob& blob, QueryMaker& maker) {
                                 const Sphere sphere = maker.sphere();
                                 const detail::BlobData& data = detail::data_of(blob.opened.blob);
                                 detail::RoundedPoint point;
                                 if (detail::round_point(data, sphere.center, sphere.radius, point) != QueryStatus::ok)
                                     return std::size_t{0};
                                 return stack_use([&] { query(path, data, point); });
                             }));
            return most;
        };
        detail::FoundNearest found;
        const auto sweep_row = [&](auto make) {
            std::size_t most = 0;
            for (const TestBlob& blob : measured) {
                SweepMaker maker(blob.decoded, 7);
                for (int i = 0; i < 60; ++i) {
                    const auto moving = make(maker);
                    SweepHit sweep_hit;
                    most = std::max(most, stack_use([&] {
                                        sweep_hit = sweep(blob.opened.blob, moving.shape, moving.displacement,
                                                          SweepOptions{.culling = FaceCulling::back,
                                                                       .ignore_leaving = i % 2 == 0,
                                                                       .skin = 0.125f});
                                    }));
                }
            }
            return most;
        };
        const auto placed_row = [&](auto query) {
            std::size_t most = 0;
            for (const TestBlob& blob : measured) {
                PlacementMaker maker(blob.decoded, blob.decoded, 8);
                for (int i = 0; i < 6; ++i) {
                    const Transform placement = i % 2 == 0 ? maker.random() : maker.adversarial();
                    TestPairFrame frame;
                    const auto& data = detail::data_of(blob.opened.blob);
                    if (detail::place_pair(data, data, placement, frame) != QueryStatus::ok) continue;
                    const PlacedBlob a(blob.opened.blob), b(blob.opened.blob, placement);
                    for (const InstructionPath& path : chosen_paths())
                        most = std::max(most, stack_use([&] { query(path, a, b, frame); }));
                }
            }
            return most;
        };
        const auto pair_row = [&](auto ask) {
            std::size_t most = 0;
            for (const TestBlob& blob : measured) {
                ShapeMaker maker(blob.decoded, 7);
                for (int i = 0; i < 30; ++i) {
                    const Capsule capsule = maker.capsule(true);
                    ClosestPoint pair;
                    most = std::max(most, stack_use([&] { pair = ask(blob.opened.blob, capsule); }));
                }
            }
            return most;
        };
        const Row rows[] = {
            {"open",
             most_stack(measured, [](const TestBlob& blob,
                                     QueryMaker&) { return stack_use([&] { (void)open(blob.opened.bytes); }); })},
            {"raycast", ray_row([](const Blob& blob, const Ray& ray) { (void)raycast(blob, ray); })},
            {"raycast, the inner query",
             ray_path_row([&](const InstructionPath& path, const Blob& blob, const Ray& ray) {
                 (void)path.closest_hit(detail::data_of(blob), ray, nullptr);
             })},
            {"closest_point, the inner query",
             point_path_row([&](const InstructionPath& path, const detail::BlobData& blob,
                                const detail::RoundedPoint& point) { path.closest_triangle(blob, point, found); })},
            {"raycast, a rounded ray",
             ray_row([&](const Blob& blob, const Ray& ray) { (void)raycast(blob, round_ray(blob.lattice(), ray)); })},
            {"occluded", ray_row([](const Blob& blob, const Ray& ray) { (void)occluded(blob, ray); })},
            {"raycast, a batch",
             batch_row([&](const Blob& blob, const Rays& rays) { (void)raycast(blob, rays, hits); })},
            {"occluded, a batch",
             batch_row([&](const Blob& blob, const Rays& rays) { (void)occluded(blob, rays, answers); })},
            {"raycast, arrays", batch_row([&](const Blob& blob, const Rays& rays) {
                 const RayArrays arrays = {{&rays[0].origin, sizeof(Ray)}, {&rays[0].direction, sizeof(Ray)}};
                 (void)raycast(blob, arrays, hits);
             })},
            {"for_each_hit", ray_row([](const Blob& blob, const Ray& ray) {
                 (void)for_each_hit(blob, ray, [](const RayHit&) { return Visit::next; });
             })},
            {"for_each_crossing", ray_row([](const Blob& blob, const Ray& ray) {
                 (void)for_each_crossing(blob, ray, [](const RayHit&) { return Visit::next; });
             })},
            {"closest_hits", ray_row([&](const Blob& blob, const Ray& ray) { (void)closest_hits(blob, ray, hits); })},
            {"find_contacts, a capsule", pair_row([](const Blob& blob, const Capsule& capsule) {
                 std::array<Contact, 8> contacts;
                 (void)find_contacts(blob, capsule, capsule.radius, contacts);
                 return ClosestPoint();
             })},
            {"find_contacts, a box", pair_row([](const Blob& blob, const Capsule& capsule) {
                 std::array<Contact, 8> contacts;
                 const float half = capsule.radius;
                 (void)find_contacts(blob, OrientedBox{capsule.from, {{half, half, 0}, {-half, half, 0}, {0, 0, half}}},
                                     half, contacts);
                 return ClosestPoint();
             })},
            {"find_contacts, a hull", pair_row([](const Blob& blob, const Capsule& capsule) {
                 std::array<Contact, 8> contacts;
                 std::array<Vec3, max_hull_vertices> vertices;
                 Random random(3);
                 for (Vec3& vertex : vertices) {
                     const Vec3 off = random.in_cube(capsule.radius);
                     vertex = {capsule.from.x + off.x, capsule.from.y + off.y, capsule.from.z + off.z};
                 }
                 (void)find_contacts(blob, ConvexHull{vertices}, capsule.radius, contacts);
                 return ClosestPoint();
             })},
            {"overlaps, two blobs",
             placed_row([](const InstructionPath&, const PlacedBlob& a, const PlacedBlob& b, const detail::PairFrame&) {
                 (void)overlaps(a, b, WorkLimit::unlimited());
             })},
            {"collect_contacts, resumed",
             placed_row([](const InstructionPath&, const PlacedBlob& a, const PlacedBlob& b, const detail::PairFrame&) {
                 PairContact contacts[1];
                 const Filled page = collect_contacts(a, b, contacts, WorkLimit(20'000));
                 (void)collect_contacts(a, b, contacts, WorkLimit(20'000), page.next);
             })},
            {"collect_touches",
             placed_row([](const InstructionPath&, const PlacedBlob& a, const PlacedBlob& b, const detail::PairFrame&) {
                 PairTouch touches[2];
                 (void)collect_touches(a, b, touches, WorkLimit(20'000));
             })},
            {"pair_touch",
             placed_row([](const InstructionPath&, const PlacedBlob& a, const PlacedBlob& b, const detail::PairFrame&) {
                 (void)pair_touch(a, b, {{0}, {0}, QueryStatus::ok});
             })},
            {"distance, two blobs",
             placed_row([](const InstructionPath&, const PlacedBlob& a, const PlacedBlob& b, const detail::PairFrame&) {
                 (void)distance(a, b, WorkLimit(20'000), 1e30f);
             })},
            {"pairs of triangles, the inner query", placed_row([](const InstructionPath& path, const PlacedBlob&,
                                                                  const PlacedBlob&, const detail::PairFrame& frame) {
                 std::uint64_t work = 20'000;
                 const auto go_on = [](const detail::TrianglePair&) { return Visit::next; };
                 (void)path.touching_pairs(frame, go_on, work);
                 detail::FoundTriangles closest;
                 bool is_found = false;
                 (void)path.nearest_pair(frame, std::numeric_limits<float>::infinity(), false, closest, is_found, work);
             })},
            {"sweep, a sphere", sweep_row([](SweepMaker& maker) { return maker.awkward_sphere(); })},
            {"sweep, a capsule", sweep_row([](SweepMaker& maker) { return maker.awkward_capsule(); })},
            {"sweep, a box", sweep_row([](SweepMaker& maker) { return maker.awkward_box(); })},
            {"sweep, an oriented box", sweep_row([](SweepMaker& maker) { return maker.awkward_oriented_box(); })},
            {"sweep, a hull", sweep_row([](SweepMaker& maker) { return maker.awkward_hull(); })},
            {"overlaps", sphere_row([](const Blob& blob, const Sphere& sphere) { (void)overlaps(blob, sphere); })},
            {"for_each_overlap", sphere_row([](const Blob& blob, const Sphere& sphere) {
                 (void)for_each_overlap(blob, sphere, [](TriangleId) {});
             })},
            {"may_overlap and distance_bounds", sphere_row([](const Blob& blob, const Sphere& sphere) {
                 (void)overlaps(blob, sphere, Accuracy{sphere.radius});
                 (void)distance_bounds(blob, sphere.center, sphere.radius, Accuracy{sphere.radius}).status;
             })},
            {"occluded with an accuracy", ray_row([](const Blob& blob, const Ray& ray) {
                 (void)occluded(blob, ray, Accuracy{0.01f * (blob.bounds().max.x - blob.bounds().min.x)});
             })},
            {"overlaps and pages, a capsule", volume_row([](ShapeMaker& maker) { return maker.capsule(true); })},
            {"overlaps and pages, a box", volume_row([](ShapeMaker& maker) { return maker.box(true); })},
            {"overlaps and pages, an oriented box",
             volume_row([](ShapeMaker& maker) { return maker.oriented_box(true); })},
            {"overlaps and pages, a cone", volume_row([](ShapeMaker& maker) {
                 const Capsule c = maker.capsule(true);
                 const Vec3 axis = {c.to.x - c.from.x, c.to.y - c.from.y, c.to.z - c.from.z};
                 return Cone{c.from, axis, c.radius};
             })},
            {"overlaps and pages, a triangle", volume_row([](ShapeMaker& maker) { return maker.corners(true); })},
            {"overlaps and pages, planes", volume_row([](ShapeMaker& maker) { return maker.planes(true); })},
            {"closest_point", sphere_row([&](const Blob& blob, const Sphere& sphere) {
                 nearest = closest_point(blob, sphere.center, sphere.radius);
             })},
            {"closest_triangles", sphere_row([&](const Blob& blob, const Sphere& sphere) {
                 (void)closest_triangles(blob, sphere.center, few, sphere.radius).status;
             })},
            {"closest_point, a segment", pair_row([](const Blob& blob, const Capsule& capsule) {
                 return closest_point(blob, Segment{capsule.from, capsule.to}, capsule.radius);
             })},
            {"closest_point, a box", pair_row([](const Blob& blob, const Capsule& capsule) {
                 const Vec3& a = capsule.from;
                 const Vec3& b = capsule.to;
                 const Vec3 min = {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
                 const Vec3 max = {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
                 return closest_point(blob, Box{min, max}, capsule.radius);
             })},
            {"contains",
             sphere_row([&](const Blob& blob, const Sphere& sphere) { inside = contains(blob, sphere.center).yes(); })},
            {"winding_number", sphere_row([](const Blob& blob, const Sphere& sphere) {
                 (void)winding_number(blob, sphere.center, 8).status;
             })},
            {"signed_distance", sphere_row([&](const Blob& blob, const Sphere& sphere) {
                 nearest = signed_distance(blob, sphere.center, sphere.radius);
             })},
            {"for_each_node", sphere_row([](const Blob& blob, const Sphere&) {
                 (void)for_each_node(blob, [](const TreeNode&) { return NodeVisit::descend; });
             })},
            {"fix_internal_edge_normal", sphere_row([](const Blob& blob, const Sphere& sphere) {
                 (void)fix_internal_edge_normal(blob, {blob.triangle_count() / 2}, Feature::edge_ca, sphere.center);
             })},
            {"triangle_at",
             sphere_row([](const Blob& blob, const Sphere&) { (void)triangle_at(blob, {blob.triangle_count() / 2}); })},
            {"oriented_bounds", sphere_row([](const Blob& blob, const Sphere&) { (void)oriented_bounds(blob); })},
        };
        for (const Row& row : rows) check_stack(row.query + std::string(are_predicted ? ", predicted" : ""), row.most);
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
