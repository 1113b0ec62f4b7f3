// Claims about strangers: broken bytes are refused or safe, and no argument of a query does harm. Worth most under the
// sanitizers, which this program is also built with.
#include "support/testing.hpp"

#include "open_blobs.hpp"

#include "support/answers/differences.hpp"

namespace espalier::tests::blob_hostile_test {
namespace {

using namespace espalier::tests::opening;

Bytes small_blob(Profile profile, bool sections) {
    Mesh mesh = make_icosphere(1, 1.0, {0.25f, 0.0f, -1.0f});
    BakeOptions options = with_profile(profile);
    if (sections) {
        mesh.materials.assign(mesh.triangles.size(), 3);
        options.original_ids = true;
    }
    return bake_or_throw(mesh, options);
}

/// With triangles that have copies in several leaves.
Bytes split_blob() { return bake_or_throw(make_soup(60, 1), with_copies()); }

/// Flips the bits from a byte on one by one and repairs the checksum. Not every flip may be accepted.
void check_flips(const Bytes& bytes, std::size_t begin, unsigned rounds) {
    ExactBuffer buffer(bytes);
    const std::vector<std::size_t> bits = sampled(8 * (bytes.size() - begin), 8, bytes.size());
    std::size_t opened = 0;
    for (const std::size_t bit : bits) {
        const auto mask = static_cast<std::byte>(1u << (bit % 8));
        buffer.bytes()[begin + bit / 8] ^= mask;
        repair_checksum(buffer.bytes());
        if (opens_safely(buffer.bytes(), bit, rounds_per_case(rounds))) ++opened;
        buffer.bytes()[begin + bit / 8] ^= mask;
    }
    repair_checksum(buffer.bytes());
    REQUIRE(opens_safely(buffer.bytes(), 0, 12));
    MESSAGE(opened, " of ", bits.size(), " flips opened");
    CHECK(opened < bits.size());
}

TEST_CASE("open: every flipped bit is refused by the checksum") {
    for_each_profile([](Profile profile) {
        for (const bool sections : {false, true}) {
            ExactBuffer buffer(small_blob(profile, sections));
            for (std::size_t bit = 0; bit < 8 * buffer.bytes().size(); ++bit) {
                const auto mask = static_cast<std::byte>(1u << (bit % 8));
                buffer.bytes()[bit / 8] ^= mask;
                const Blob blob = open(buffer.bytes());
                REQUIRE(blob.status() != OpenStatus::ok);
                buffer.bytes()[bit / 8] ^= mask;
            }
            const Blob blob = open(buffer.bytes());
            REQUIRE(blob);
        }
    });
}

TEST_CASE("open: every flipped bit with the checksum repaired is refused or leaves queries safe") {
    for_each_profile([](Profile profile) {
        for (const bool sections : {false, true}) {
            // Coordinates and planes may change and stay legal; structure may not.
            check_flips(small_blob(profile, sections), 0, 8);
        }
    });
}

TEST_CASE("open: every flipped bit of a map of copies is refused or leaves queries safe") {
    const Bytes bytes = split_blob();
    const Blob blob = open(bytes);
    REQUIRE(blob);
    REQUIRE(blob.duplicate_reference_count() > 0);
    const auto begin = static_cast<std::size_t>(detail::data_of(blob).copies - detail::data_of(blob).bytes);
    // An owner may become another triangle, which is a wrong answer; counts may not change.
    check_flips(bytes, begin, 12);
}

TEST_CASE("open: bursts of changed bytes with the checksum repaired are refused or leave queries safe") {
    std::uint64_t opened = 0;
    const std::uint64_t count = scaled(20'000);
    Random random(5);
    std::vector<Bytes> originals;
    for_each_profile([&](Profile profile) {
        originals.push_back(small_blob(profile, false));
        originals.push_back(small_blob(profile, true));
        originals.push_back(bake_or_throw(make_cube(0.0f, 1.0f), with_profile(profile)));
        originals.push_back(bake_or_throw(make_soup(60, 1), with_profile(profile)));
    });
    originals.push_back(split_blob());
    for (std::uint64_t i = 0; i < count; ++i) {
        ExactBuffer buffer(originals[i % originals.size()]);
        const auto size = static_cast<std::uint32_t>(buffer.bytes().size());
        for (std::uint32_t change = 0; change <= random.below(4); ++change) {
            // The beginning decides the most.
            const std::uint32_t at = random.coin() ? random.below(size) : random.below(std::min(size, 400u));
            buffer.bytes()[at] = random.coin() ? static_cast<std::byte>(random.next())
                                               : std::byte{static_cast<unsigned char>(random.coin() ? 0xFF : 0x00)};
        }
        repair_checksum(buffer.bytes());
        if (opens_safely(buffer.bytes(), i, 4)) ++opened;
    }
    CHECK(opened > 0);
    CHECK(opened < count);
}

TEST_CASE("promise: every hostile value in every argument of every query is safe") {
    for_each_profile([](Profile profile) {
        const BakeOptions options = with_profile(profile);
        const OpenedBlob far(make_far_sphere(), options);
        const OpenedBlob flat(make_plane_grid(6), options);
        const OpenedBlob tiny(scaled_by(make_cube(-1.0f, 1.0f), 0x1p-85f), options);
        const OpenedBlob huge(scaled_by(make_cube(-1.0f, 1.0f), 0x1p100f), options);
        for (const Blob& blob : {Blob(), far.blob, flat.blob, tiny.blob, huge.blob}) {
            const Vec3 low = blob.bounds().min;
            const Vec3 high = blob.bounds().max;
            const Vec3 middle{low.x + (high.x - low.x) * 0.4f, low.y + (high.y - low.y) * 0.5f,
                              low.z + (high.z - low.z) * 0.6f};
            for (unsigned slot = 0; slot < 8; ++slot) {
                for (const float value : hostile_values) {
                    for (const float other : {0.0f, value, 1.0f}) {
                        Ray ray{middle, {other, 0.25f, 0.5f}};
                        const auto slots = numbers_of(ray);
                        *slots[slot] = value;
                        const RayHit hit = raycast(blob, ray);
                        const bool found = bool(hit);
                        CHECK(occluded(blob, ray).status() == hit.status);
                        for (unsigned i = 0; i < 8; ++i) {
                            const bool infinite_end = i >= 6;
                            if (std::isnan(*slots[i])) CHECK_FALSE(found);
                            if (!infinite_end && !std::isfinite(*slots[i])) CHECK_FALSE(found);
                        }
                        if (ray.t_max < 0.0f || ray.t_min > ray.t_max) CHECK_FALSE(found);
                        if (found) {
                            CHECK(hit.t >= ray.t_min);
                            CHECK(hit.t <= ray.t_max);
                        }
                    }
                }
            }
            for (int slot = 0; slot < 4; ++slot) {
                for (const float value : hostile_values) {
                    Sphere sphere{middle, high.x - low.x};
                    float* const slots[4] = {&sphere.center.x, &sphere.center.y, &sphere.center.z, &sphere.radius};
                    *slots[slot] = value;
                    const ClosestPoint nearest = closest_point(blob, sphere.center, sphere.radius);
                    const bool found{nearest};
                    CHECK(overlaps(blob, sphere).yes() == found);
                    if (value != value || value == -infinity || (slot < 3 && value == infinity))
                        CHECK(is_refused(nearest.status));
                    if (slot == 3 && value < 0.0f) CHECK(is_refused(nearest.status));
                    if (slot == 3 && value == infinity) CHECK(found == (blob.triangle_count() != 0));
                    if (found) CHECK(nearest.distance <= sphere.radius);
                }
            }
        }
    });
}

TEST_CASE("promise: random bits as arguments give the same answers on every instruction set") {
    for_each_profile([](Profile profile) {
        const BakeOptions options = with_profile(profile);
        const OpenedBlob tiny(scaled_by(make_cube(-1.0f, 1.0f), 0x1p-85f), options);
        const OpenedBlob huge(scaled_by(make_cube(-1.0f, 1.0f), 0x1p100f), options);
        const OpenedBlob unit(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}), options);
        const OpenedBlob far(make_far_sphere(), options);
        Random random(7);
        for (const Blob& blob : {tiny.blob, huge.blob, unit.blob, far.blob}) {
            const Vec3 low = blob.bounds().min;
            const Vec3 high = blob.bounds().max;
            const auto any = [&](float from, float to) {
                const auto kind = random.below(4);
                if (kind == 0) return hostile_values[random.below(hostile_values.size())];
                if (kind == 1) return std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
                return from + (to - from) * (random.unit() * 3.0f - 1.0f);
            };
            for (std::uint64_t i = 0; i < scaled_share(30'000); ++i) {
                const Vec3 origin{any(low.x, high.x), any(low.y, high.y), any(low.z, high.z)};
                const Vec3 target{any(low.x, high.x), any(low.y, high.y), any(low.z, high.z)};
                Ray ray{origin, difference(target, origin)};
                if (random.below(4) == 0) ray.direction = target;
                if (random.below(4) == 0) ray.t_min = any(0.0f, 1.0f);
                if (random.below(4) == 0) ray.t_max = any(0.0f, 1.0f);
                ray.culling = static_cast<FaceCulling>(random.below(3));
                require_none(path_difference(blob, ray));
                require_none(path_difference(blob, Sphere{origin, any(0.0f, high.x - low.x)}));
            }
        }
    });
}

TEST_CASE("promise: random bits as arguments are safe on every blob") {
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        Random random(6);
        REQUIRE_NOTHROW(exercise(blob.opened.blob, random, static_cast<unsigned>(scaled_share(3'000))));
    }
}

}  // namespace
}  // namespace espalier::tests::blob_hostile_test
