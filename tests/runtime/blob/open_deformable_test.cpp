// The verifier's rules for deformable blobs: each, broken alone, is the reason of the refusal.
#include "support/testing.hpp"

#include "open_blobs.hpp"
#include "support/blobs/deformed_mesh.hpp"

namespace espalier::tests::open_deformable_test {
namespace {

using namespace espalier::tests::opening;

/// A deformable blob, and where its parts begin.
struct Parts {
    explicit Parts(unsigned bits = 16) : Parts(DeformedMesh(make_plane_grid(9), bits).baked) {}
    explicit Parts(Bytes baked)
        : bytes(std::move(baked)),
          triangles(get(bytes, at::triangle_count_at, 4)),
          corners(sections_of(bytes)),
          guard(corners + format::corners::padded_bytes(static_cast<std::uint32_t>(triangles))),
          sources(guard + format::corners::guard_bytes) {}

    [[nodiscard]] OpenStatus with(std::size_t place, std::uint64_t value, unsigned size = 4) const {
        return status_with(bytes, place, value, size);
    }
    [[nodiscard]] std::uint64_t field(std::size_t place, unsigned size = 4) const { return get(bytes, place, size); }

    Bytes bytes;
    std::uint64_t triangles;
    std::size_t corners, guard, sources;
};

std::uint64_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }

TEST_CASE("open: each rule of the header of a deformable blob is enforced") {
    const Parts blob;
    REQUIRE(status_of(blob.bytes) == OpenStatus::ok);
    REQUIRE(blob.field(at::version_minor_at, 2) == 1);
    CHECK(blob.with(at::version_minor_at, 0, 2) == OpenStatus::bad_header);
    for (const float cost : {0.0f, -0.0f, -1.0f, std::numeric_limits<float>::denorm_min(),
                             std::numeric_limits<float>::infinity(), not_a_number})
        CHECK(blob.with(at::rest_cost_at, bits_of(cost)) == OpenStatus::bad_header);
    CHECK(blob.with(at::rest_cost_at, bits_of(std::numeric_limits<float>::max())) == OpenStatus::ok);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t low = at::pose_low_at + 4 * k, high = at::pose_high_at + 4 * k;
        const std::uint64_t extent = blob.field(at::extent_at + 4 * k);
        CHECK(blob.with(low, blob.field(high) + 1) == OpenStatus::bad_header);
        CHECK(blob.with(high, extent) == OpenStatus::ok);
        CHECK(blob.with(high, extent + 1) == OpenStatus::bad_header);
        CHECK(blob.with(high, 0xFFFFFFFFu) == OpenStatus::bad_header);
        // Vertices outside of the pose's box.
        if (blob.field(low) != 0) CHECK(blob.with(low, 0) == OpenStatus::ok);
        CHECK(blob.with(low, blob.field(high)) ==
              (blob.field(low) == blob.field(high) ? OpenStatus::ok : OpenStatus::bad_leaf));
        if (blob.field(low) != blob.field(high)) CHECK(blob.with(high, blob.field(low)) == OpenStatus::bad_leaf);
    }
    CHECK(blob.with(at::reserved_at, 1) == OpenStatus::bad_header);
    CHECK(blob.with(at::bytes - 1, 1, 1) == OpenStatus::bad_header);
    for (unsigned profile = 1; profile < 4; ++profile)
        CHECK(blob.with(at::profile_at, profile, 1) == OpenStatus::bad_header);
    const std::uint64_t features = blob.field(at::features_at);
    for (const std::uint32_t other : {feature::split_references, feature::edge_flags, feature::oriented_box,
                                      feature::bounding_sphere, feature::k_dop})
        CHECK(blob.with(at::features_at, features | other) == OpenStatus::bad_header);
    CHECK(blob.with(at::features_at, features & ~std::uint64_t{feature::deformable}) == OpenStatus::bad_header);
}

TEST_CASE("open: a deformable blob has triangles") {
    Bytes empty = bake_or_throw(Mesh{}, with_profile(Profile::fast));
    put(empty, at::version_minor_at, 1, 2);
    put(empty, at::features_at, feature::deformable, 4);
    CHECK(status_with(empty, at::rest_cost_at, bits_of(1.0f), 4) == OpenStatus::bad_header);
}

TEST_CASE("open: fields of deformable blobs are zero in others") {
    const Bytes bytes = plain_blob(Profile::fast);
    REQUIRE(get(bytes, at::version_minor_at, 2) == 0);
    for (std::size_t place = at::position_count_at; place < at::bytes; place += 4)
        CHECK(status_with(bytes, place, 1, 4) == OpenStatus::bad_header);
    CHECK(status_with(bytes, at::version_minor_at, 1, 2) == OpenStatus::ok);
    CHECK(status_with(bytes, at::version_minor_at, format::version_minor + 1, 2) == OpenStatus::unsupported_version);
}

TEST_CASE("open: each rule of corners and vertex sources is enforced") {
    for (const unsigned bits : {12u, 20u}) {
        const Parts blob(bits);
        const std::uint64_t positions = blob.field(at::position_count_at);
        const std::uint64_t slots = blob.field(at::vertex_slots_at);
        REQUIRE(blob.bytes.size() == blob.sources + (2 * slots + 3) / 4 * 4);
        // Every corner is a vertex of its leaf.
        for (std::size_t i = 0; i < 3 * blob.triangles; i += 7)
            CHECK(blob.with(blob.corners + i, 32, 1) == OpenStatus::bad_leaf);
        // The guard and what fills up sections are zero.
        for (std::size_t i = blob.corners + 3 * blob.triangles; i < blob.sources; ++i)
            CHECK(blob.with(i, 1, 1) == OpenStatus::bad_section);
        for (std::size_t i = blob.sources + 2 * slots; i < blob.bytes.size(); ++i)
            CHECK(blob.with(i, 1, 1) == OpenStatus::bad_section);
        // Every source is a position.
        for (std::size_t slot = 0; slot < slots; slot += 3) {
            CHECK(blob.with(blob.sources + 2 * slot, positions - 1, 2) == OpenStatus::ok);
            CHECK(blob.with(blob.sources + 2 * slot, positions, 2) == OpenStatus::bad_section);
        }
        CHECK(blob.with(at::position_count_at, 0) == OpenStatus::bad_section);
        CHECK(blob.with(at::position_count_at, positions + 1) == OpenStatus::ok);
        CHECK(blob.with(at::position_count_at, 0x10001) == OpenStatus::bad_section);  // other numbers
        CHECK(blob.with(at::vertex_slots_at, slots + 2) == OpenStatus::bad_section);
        CHECK(blob.with(at::vertex_slots_at, 0xFFFFFFFFu) == OpenStatus::bad_section);
        const std::uint64_t same_size = slots % 2 == 0 ? slots - 1 : slots + 1;
        CHECK(blob.with(at::vertex_slots_at, same_size) != OpenStatus::ok);
    }
}

TEST_CASE("open: the first triangle of each leaf of a deformable blob is the next one") {
    const Parts blob;
    const std::size_t nodes = get(blob.bytes, at::node_count_at, 4);
    for (std::size_t node = 0; node < nodes; ++node) {
        const std::size_t place = node_of(blob.bytes, node);
        for (std::size_t leaf = 0; leaf < counts_of(blob.bytes, place).leaves; ++leaf) {
            const std::size_t data = leaf_data_of(blob.bytes, place, leaf);
            for (const std::uint64_t wrong : {blob.field(data) + 1, std::uint64_t{0x7FFFFFFF}, std::uint64_t{~0u}})
                CHECK(blob.with(data, wrong) == OpenStatus::bad_leaf);
        }
    }
}

TEST_CASE("open: an origin beyond the floats that a refit counts from is refused") {
    BakeOptions options = deformable_options(make_cube(-1.0f, 1.0f));
    options.resolution = Resolution::step(-20);
    const Bytes bytes = DeformedMesh(make_cube(-1.0f, 1.0f), options).baked;
    REQUIRE(status_of(bytes) == OpenStatus::ok);
    // The greatest and the least exponent of the origin at this step.
    CHECK(status_with(bytes, at::origin_at, bits_of(0x1p106f), 4) == OpenStatus::ok);
    CHECK(status_with(bytes, at::origin_at, bits_of(0x1p107f), 4) == OpenStatus::bad_header);
}

TEST_CASE("open: broken deformable blobs are refused or safe in every query and refit") {
    for (const unsigned bits : {14u, 20u}) {
        const Parts blob(bits);
        Random random(700 + bits);
        std::size_t opened = 0;
        for (std::uint64_t i = 0; i < scaled(3000); ++i) {
            Bytes bytes = blob.bytes;
            for (unsigned edits = 1 + random.below(3); edits != 0; --edits) {
                const std::size_t place =
                    random.coin() ? random.below(static_cast<std::uint32_t>(bytes.size())) : 16 + random.below(112);
                bytes[place] = static_cast<std::byte>(random.below(256));
            }
            repair_checksum(bytes);
            const Blob broken = open(bytes);
            if (!broken) continue;
            ++opened;
            exercise(broken, random, 1, false);
            std::vector<std::byte> memory(deformable_bytes(broken));
            Deformable moving = create_deformable(broken, memory);
            if (!moving || moving.position_count() > 100'000) continue;
            std::vector<Vec3> positions(moving.position_count());
            for (Vec3& p : positions) p = random.in_box(moving.range());
            (void)refit(moving, positions);
            exercise(moving.blob(), random, 1, false);
            REQUIRE(seal(moving, bytes) == QueryStatus::ok);
            CHECK(open(bytes));
        }
        CHECK(opened > 0);
    }
}

}  // namespace
}  // namespace espalier::tests::open_deformable_test
