// Claims about queries that stop at small boxes, against the loop over all triangles: nothing is missed, and how wrong
// a yes can be.
#include "support/testing.hpp"

#include <runtime/blob/node.hpp>
#include <runtime/lattice/round_ray.hpp>

#include "approximate_checks.hpp"
#include "support/blobs/node_kinds.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/meshes/real_meshes.hpp"
#include "support/queries/shape_maker.hpp"

namespace espalier::tests::approximate_test {
namespace {

struct StepBox {
    std::int32_t low[3], high[3];
    [[nodiscard]] std::int32_t longest_side() const {
        return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    }
};

template <class Node>
StepBox box_of(const detail::BlobData& blob, const Node& node, unsigned child) {
    StepBox box;
    for (int k = 0; k < 3; ++k) {
        box.low[k] = node.low(k, child, blob.bits);
        box.high[k] = node.high(k, child, blob.bits);
    }
    return box;
}

/// A box of the tree, and another one on the way to it: that of its node, or the asset's.
template <class Node>
void pick_boxes(const detail::BlobData& blob, Random& random, StepBox& upper, StepBox& lower) {
    const Node node = detail::node_at<Node>(blob, random.below(blob.node_count));
    if (node.node_children() == 0 || random.coin()) {
        upper = {{0, 0, 0}, {blob.extent[0], blob.extent[1], blob.extent[2]}};
        lower = box_of(blob, node, random.below(node.node_children() + node.leaf_children()));
        return;
    }
    const unsigned child = random.below(node.node_children());
    const Node below = detail::node_at<Node>(blob, node.first_child() + child);
    upper = box_of(blob, node, child);
    lower = box_of(blob, below, random.below(below.node_children() + below.leaf_children()));
}

/// Through a box of the tree, where there is such a place beyond the box above it or the asset; `steps` is small enough
/// for nothing but that box to do.
Ray ray_beside_a_box(const detail::BlobData& blob, Random& random, std::int32_t& steps) {
    StepBox upper, lower;
    std::uint32_t side = 0;
    bool is_high = false;
    for (int tries = 0; tries < 50; ++tries) {
        with_node_kind(blob.profile, [&]<class Node>() { pick_boxes<Node>(blob, random, upper, lower); });
        side = random.below(3);
        is_high = random.coin();
        if (is_high ? lower.high[side] > upper.high[side] : lower.low[side] < upper.low[side]) break;
    }
    steps = lower.longest_side();
    float from[3], to[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
        const auto place = [&] {
            return static_cast<float>(lower.low[k]) + static_cast<float>(lower.high[k] - lower.low[k]) * random.unit();
        };
        from[k] = place(), to[k] = place();
    }
    const float beyond = static_cast<float>(random.between(-2, 24)) * 0.125f;
    from[side] = to[side] =
        is_high ? static_cast<float>(upper.high[side]) + beyond : static_cast<float>(upper.low[side]) - beyond;
    const float step = std::ldexp(1.0f, blob.step_exponent);
    Ray ray = {
        .origin = {blob.origin[0] + from[0] * step, blob.origin[1] + from[1] * step, blob.origin[2] + from[2] * step},
        .direction = {(to[0] - from[0]) * step, (to[1] - from[1]) * step, (to[2] - from[2]) * step}};
    const float back = random.coin() ? 0.0f : 4.0f * random.unit();
    ray.origin.x -= back * ray.direction.x;
    ray.origin.y -= back * ray.direction.y;
    ray.origin.z -= back * ray.direction.z;
    return ray;
}

/// Boxes may stick out of those above them, and of the asset's.
void check_rays_beside_boxes(Asked& asked, bool, Tally& tally) {
    const detail::BlobData& blob = detail::data_of(asked.blob);
    std::int32_t steps = 0;
    const Ray ray = ray_beside_a_box(blob, asked.maker.random(), steps);
    CAPTURE(describe(ray));
    CAPTURE(steps);
    QueryCounters counters;
    const InstructionPath& scalar = instruction_paths().front();
    const bool maybe = scalar.may_hit(blob, ray, {steps, &counters}).yes();
    for (const InstructionPath& path : instruction_paths()) {
        CAPTURE(path.name);
        REQUIRE(path.may_hit(blob, ray, {steps, &counters}).yes() == maybe);
    }
    tally.add(maybe, scalar.any_hit(blob, ray, {}).yes());
}

struct Kind {
    const char* name;
    Check check;
};
constexpr Kind spheres = {"spheres", check_sphere};
constexpr Kind boxes = {"boxes", check_box};
constexpr Kind rays = {"rays", check_ray};
constexpr Kind distance_limits = {"distance bounds", check_bounds};

void tell_calls(const Kind& kind, const std::string& mesh, std::uint64_t random, std::uint64_t awkward) {
    MESSAGE(calls_made(std::string("approximate: ") + kind.name, mesh, random, awkward));
}

Tally check_test_blobs(Check check, std::uint64_t seed, std::uint64_t count, std::uint64_t& awkward_calls) {
    Tally tally;
    for (const std::vector<TestBlob>* blobs : {&small_test_blobs(), &medium_test_blobs()}) {
        for (const TestBlob& blob : *blobs) {
            CAPTURE(blob.name);
            Asked asked(blob.opened.blob, blob.decoded, seed);
            for (std::uint64_t i = 0; i < count; ++i) {
                const bool awkward = asked.maker.random().coin();
                check(asked, awkward, tally);
                awkward_calls += awkward ? 1u : 0u;
            }
        }
    }
    return tally;
}

Tally check_test_blobs(const Kind& kind, std::uint64_t seed) {
    const std::uint64_t count = scaled_share(300);
    std::uint64_t awkward = 0;
    const Tally tally = check_test_blobs(kind.check, seed, count, awkward);
    const std::uint64_t asked = count * (small_test_blobs().size() + medium_test_blobs().size());
    tell_calls(kind, generated_meshes, asked - awkward, awkward);
    return tally;
}

/// Times a scale of 1,000 these are at least the counts that a release must show, all profiles together.
void check_real_mesh(const Mesh& mesh, Profile profile) {
    const OpenedBlob opened(mesh, with_profile(profile));
    Asked asked(opened.blob, decode(opened.bytes), 86 + static_cast<std::uint64_t>(profile));
    const std::uint64_t count = scaled_share(112);
    Tally tally;
    for (const Kind& kind : {spheres, boxes, rays, distance_limits}) {
        for (std::uint64_t i = 0; i < count; ++i) kind.check(asked, i % 10 == 9, tally);
        tell_calls(kind, mesh.name, count - count / 10, count / 10);
    }
    for (std::uint64_t i = 0; i < count; ++i) check_instruction_sets(asked, i % 10 == 9, tally);
}

TEST_CASE("approximate: spheres miss no overlap and err by at most the root of 3 times accuracy") {
    check_test_blobs(spheres, 81).check();
}

TEST_CASE("approximate: boxes miss no overlap and err by at most the accuracy along every axis") {
    check_test_blobs(boxes, 82).check();
}

TEST_CASE("approximate: rays miss no hit and err by at most the root of 3 times accuracy") {
    check_test_blobs(rays, 83).check();
}

TEST_CASE("approximate: distance bounds hold the distance within the root of 3 times accuracy") {
    CHECK(check_test_blobs(distance_limits, 84).wrong_yes > 0);  // some are apart
}

TEST_CASE("approximate: every instruction set gives the same answers with the same work") {
    std::uint64_t awkward = 0;
    check_test_blobs(check_instruction_sets, 85, scaled_share(60), awkward);
}

TEST_CASE("approximate: a ray just beyond a box or the asset gives the same answer on every path") {
    std::uint64_t awkward = 0;
    check_test_blobs(check_rays_beside_boxes, 87, scaled_share(2'000), awkward).check();
}

TEST_CASE("approximate: a sphere is near where it touches a triangle or a small box and nowhere else") {
    for_each_node_kind([]<class Node>(Profile profile) {
        const OpenedBlob opened(make_terrain(40, 5), {.resolution = Resolution::bits(10), .profile = profile});
        const detail::BlobData& data = detail::data_of(opened.blob);
        const float step = std::ldexp(1.0f, data.step_exponent);
        Random random(9);
        std::uint32_t by_box = 0, by_triangle = 0, far = 0;
        for (int i = 0; i < 20'000; ++i) {
            // In lattice steps, and near the asset; a place that the border of a box is near to is left out.
            std::array<float, 3> center{};
            for (unsigned k = 0; k < 3; ++k)
                center[k] = static_cast<float>(random.between(-20, data.extent[k] + 20)) + 0.5f;
            const float radius = static_cast<float>(random.below(64)) + 0.25f;
            const auto accuracy = static_cast<std::int32_t>(random.below(96));
            bool is_small = false, is_on_border = false;
            std::vector<std::uint32_t> nodes = {0};
            while (!nodes.empty()) {
                const Node node = detail::node_at<Node>(data, nodes.back());
                nodes.pop_back();
                for (unsigned child = 0; child < node.node_children() + node.leaf_children(); ++child) {
                    std::int32_t longest = 0;
                    double squared = 0.0;
                    for (unsigned k = 0; k < 3; ++k) {
                        const std::int32_t low = node.low(static_cast<int>(k), child, data.bits);
                        const std::int32_t high = node.high(static_cast<int>(k), child, data.bits);
                        longest = std::max(longest, high - low);
                        const double off = std::max({low - double(center[k]), double(center[k]) - high, 0.0});
                        squared += off * off;
                    }
                    is_on_border = is_on_border || std::abs(std::sqrt(squared) - double(radius)) < 0.01;
                    if (squared > double(radius) * double(radius)) continue;
                    if (accuracy > 0 && longest <= accuracy) is_small = true;
                    else if (child < node.node_children()) nodes.push_back(node.first_child() + child);
                }
            }
            if (is_on_border) continue;
            const Sphere sphere = {{data.origin[0] + center[0] * step, data.origin[1] + center[1] * step,
                                    data.origin[2] + center[2] * step},
                                   radius * step};
            const bool touches = overlaps(opened.blob, sphere).yes();
            (touches ? by_triangle : is_small ? by_box : far) += 1;
            CHECK(overlaps(opened.blob, sphere, Accuracy{static_cast<float>(accuracy) * step}).yes() ==
                  (touches || is_small));
        }
        CHECK(by_box > 100);
        CHECK(by_triangle > 1'000);
        CHECK(far > 1'000);
    });
}

TEST_CASE("approximate: every query keeps its bound on real meshes") {
    for_each_real_mesh(check_real_mesh, quickly_baked);
}

TEST_CASE("approximate: coarse answers take less work and a NaN or negative accuracy is exact") {
    const OpenedBlob sphere(make_icosphere(5, 1.0, {0.0f, 0.0f, 0.0f}));
    std::uint64_t before = ~std::uint64_t{0};
    for (const float accuracy : {0.0f, 0.5f, 1.0f, 4.0f}) {
        QueryCounters counters;
        for (int i = 0; i < 100; ++i) {
            const auto angle = static_cast<float>(i);
            REQUIRE(distance_bounds(sphere.blob, {1.5f * std::sin(angle), 1.5f * std::cos(angle), 0.1f}, infinity,
                                    Accuracy{accuracy}, &counters));
        }
        CHECK(counters.nodes < before);
        if (accuracy == 0.0f) {  // every point comes to some leaf, which has a triangle at least
            CHECK(counters.leaves >= 100);
            CHECK(counters.triangles >= counters.leaves);
        }
        before = counters.nodes;
    }
    CHECK(before == 100);  // the root, once each
    const Sphere inside{{0.0f, 0.0f, 0.0f}, 0.5f};
    CHECK(overlaps(sphere.blob, inside).no());
    CHECK(overlaps(sphere.blob, inside, Accuracy{not_a_number}).no());
    CHECK(overlaps(sphere.blob, inside, Accuracy{-1.0f}).no());
    CHECK(overlaps(sphere.blob, inside, Accuracy{infinity}).yes());
    CHECK(overlaps(sphere.blob, Sphere{{not_a_number, 0.0f, 0.0f}, 1.0f}, Accuracy{1.0f}).status() ==
          QueryStatus::invalid_argument);
    CHECK(overlaps(sphere.blob, Sphere{{9.0f, 0.0f, 0.0f}, 1.0f}, Accuracy{infinity}).no());
    CHECK(overlaps(Blob(), inside, Accuracy{infinity}).status() == QueryStatus::not_open);
}

}  // namespace
}  // namespace espalier::tests::approximate_test
