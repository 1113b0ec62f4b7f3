// What a bake may lose before its policy refuses it.
#include "support/testing.hpp"

#include "baker/baking_support.hpp"

namespace espalier::tests::policy_test {
namespace {

/// A cube, and so many triangles without area: with two corners in one place, or along a line.
Mesh cube_and_flat(unsigned with_equal_corners, unsigned along_a_line) {
    Mesh mesh = make_cube(0.0f, 1.0f);
    for (unsigned i = 0; i < with_equal_corners; ++i) append_triangle(mesh, {0, 0, 0}, {0, 0, 0}, {1, 0, 0});
    for (unsigned i = 0; i < along_a_line; ++i)
        append_triangle(mesh, {0, 0, 0}, {0.25f, 0, 0}, {1.0f + static_cast<float>(i), 0, 0});
    return mesh;
}

BakeOptions with_policy(const BakePolicy& policy) {
    BakeOptions options;
    options.policy = policy;
    return options;
}

TEST_CASE("policy: lost triangles are counted in percent without those that had no surface to lose") {
    CHECK(bake_mesh(cube_and_flat(50, 1), with_policy({})));  // 1 of 13
    const BakeResult refused = bake_mesh(cube_and_flat(50, 2), with_policy({}));
    REQUIRE(refused.status == BakeStatus::invalid_mesh);
    CHECK(refused.bytes.empty());
    for (const char* part : {"dropped 2 of 14 triangles", "2 without area (first: cube, triangle 12)",
                             "At most 10 % may be (max_dropped)", "raise max_dropped"})
        CHECK_MESSAGE(refused.message.find(part) != std::string::npos, refused.message);
    CHECK(refused.place.has_value());
    BakePolicy policy;
    policy.max_dropped = 15.0;
    const BakeResult accepted = bake_mesh(cube_and_flat(50, 2), with_policy(policy));
    REQUIRE(accepted);
    CHECK(accepted.report.findings.zero_area.count == 52);
    CHECK(accepted.report.findings.equal_corners == 50);
    CHECK(bake_mesh(cube_and_flat(50, 2)));
    policy.max_dropped = 0.0;
    CHECK(bake_mesh(cube_and_flat(9, 0), with_policy(policy)));
    CHECK(bake_mesh(cube_and_flat(0, 1), with_policy(policy)).status == BakeStatus::invalid_mesh);
}

TEST_CASE("policy: what the lattice flattens is lost and the advice is a finer one") {
    Mesh mesh = make_cube(0.0f, 1.0f);
    for (int i = 0; i < 5; ++i) append_triangle(mesh, {0.5f, 0.5f, 0.5f}, {0.5001f, 0.5f, 0.5f}, {0.5f, 0.5001f, 0.5f});
    BakeOptions options = with_policy({});
    options.resolution = Resolution::bits(4);
    const BakeResult refused = bake_mesh(mesh, options);
    REQUIRE(refused.status == BakeStatus::invalid_mesh);
    CHECK(refused.message.find("5 without area on the lattice") != std::string::npos);
    CHECK(refused.message.find("choose a finer lattice") != std::string::npos);
    options.resolution = Resolution::bits(20);
    CHECK(bake_mesh(mesh, options));  // duplicates are there once
}

TEST_CASE("policy: nothing left and warnings are refused where the policy does") {
    const BakeResult empty = bake({}, with_policy({}));
    REQUIRE(empty.status == BakeStatus::invalid_mesh);
    CHECK(empty.message.find("no triangle is left") != std::string::npos);
    BakePolicy policy;
    policy.allow_empty = true;
    CHECK(bake({}, with_policy(policy)));
    BakeOptions fine = with_policy({});
    fine.resolution = Resolution::bits(24);
    CHECK(bake_mesh(make_cube(0.0f, 1.0f), fine));
    fine.policy->strict = true;
    const BakeResult strict = bake_mesh(make_cube(0.0f, 1.0f), fine);
    REQUIRE(strict.status == BakeStatus::invalid_mesh);
    CHECK(strict.message.find("strict refuses a warning: at 24 bits") != std::string::npos);
    fine.policy->max_dropped = 101.0;
    CHECK(bake_mesh(make_cube(0.0f, 1.0f), fine).status == BakeStatus::invalid_options);
}

}  // namespace
}  // namespace espalier::tests::policy_test
