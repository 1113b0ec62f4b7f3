// Claims about input that nobody would make on purpose.
#include "support/testing.hpp"

#include "baking_support.hpp"

namespace espalier::tests::baker_hostile_test {
namespace {

float some_coordinate(Random& random, unsigned kind) {
    if (kind == 0) return hostile_values[random.below(hostile_values.size())];
    if (kind == 1) return static_cast<float>(random.between(-4, 4));
    if (kind == 2) return std::ldexp(random.signed_unit(), random.between(-149, 127));
    if (kind == 3) return std::ldexp(random.signed_unit(), -140);
    if (kind == 4) return std::numeric_limits<float>::max() * (random.coin() ? 1.0f : 0.9999999f);
    if (kind == 5) return 1e6f + static_cast<float>(random.below(8)) * 0.0625f;
    return random.unit();
}

Mesh hostile_mesh(Random& random) {
    Mesh mesh = {.name = "hostile"};
    const unsigned kind = random.below(8);
    const std::uint32_t vertices = 1 + random.below(random.coin() ? 6 : 60);
    for (std::uint32_t i = 0; i < vertices; ++i) {
        const auto coordinate = [&] { return some_coordinate(random, kind == 7 ? random.below(7) : kind); };
        mesh.positions.push_back({coordinate(), coordinate(), coordinate()});
    }
    for (std::uint32_t i = random.below(100); i > 0; --i) {
        mesh.triangles.push_back({random.below(vertices), random.below(vertices), random.below(vertices)});
        if (random.below(100) == 0) mesh.triangles.back()[random.below(3)] = static_cast<std::uint32_t>(random.next());
    }
    const std::uint32_t materials = std::array{0u, 1u, 256u, 65536u}[random.below(4)];  // 0: none
    if (materials != 0)
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) mesh.materials.push_back(random.below(materials));
    return mesh;
}

TEST_CASE("baker: any input gives a sound blob or a reason and never an internal error") {
    Random random(2024);
    unsigned baked = 0, refused = 0;
    const std::uint64_t count = std::max<std::uint64_t>(scaled(20'000), 200);
    for (std::uint64_t i = 0; i < count; ++i) {
        CAPTURE(i);
        const Mesh first = hostile_mesh(random);
        const Mesh second = hostile_mesh(random);
        BakeOptions options = with_bits(1 + random.below(24));
        if (random.below(3) == 0)
            options.resolution = Resolution::tolerance(std::ldexp(1.0, random.between(-160, 140)));
        options.drop_bad_triangles = random.below(8) != 0;
        options.original_ids = random.coin();
        options.effort = static_cast<Effort>(random.below(3));
        options.build.builder = static_cast<Builder>(random.below(6));
        options.profile = every_profile[random.below(every_profile.size())];
        if (options.build.builder == Builder::spatial_splits) options.profile = Profile::fast;
        const auto result = random.coin() ? bake_mesh(first, options) : bake_meshes({&first, &second}, options);
        if (!result) {
            ++refused;
            REQUIRE(result.status != BakeStatus::internal);
            REQUIRE(result.status != BakeStatus::invalid_options);
            REQUIRE(result.message.size() > 20);
            continue;
        }
        ++baked;
        require_sound(result.bytes);
        REQUIRE(result.report.lattice.max_error >= 0.0);
        if (options.resolution.kind() == Resolution::Kind::tolerance && result.report.tree.triangles != 0)
            REQUIRE(result.report.lattice.max_error <= options.resolution.value());
    }
    CHECK(baked > count / 20);
    CHECK(refused > count / 20);
}

}  // namespace
}  // namespace espalier::tests::baker_hostile_test
