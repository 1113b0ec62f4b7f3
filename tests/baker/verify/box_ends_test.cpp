// Claims about how far boxes may end beyond the asset: what the baker makes of any extent, and blobs made to break it.
#include "support/testing.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "baker/baking_support.hpp"
#include "support/blobs/soundness.hpp"
#include "support/format/encoder.hpp"

namespace espalier::tests::box_ends_test {
namespace {

/// One triangle in one leaf, `extent` long on one axis and 3 steps on the others, whose box ends on a plane of choice.
/// In profile `fast` planes count units of the lattice, else 2^shift.
PlainBlob make_one_box(Profile profile, unsigned bits, std::size_t axis, std::int32_t extent, unsigned shift,
                       unsigned plane) {
    const std::size_t second = (axis + 1) % 3, third = (axis + 2) % 3;
    PlainBlob blob;
    blob.decoded.profile = profile;
    blob.decoded.bits = bits;
    blob.decoded.vertex_count = 3;
    blob.decoded.extent.fill(3);
    blob.decoded.extent[axis] = static_cast<std::uint32_t>(extent);
    PlainLeaf leaf;
    leaf.vertices.assign(3, {0, 0, 0});
    leaf.vertices[1][axis] = leaf.vertices[2][axis] = extent;
    leaf.vertices[1][second] = leaf.vertices[2][third] = 3;
    if (profile == Profile::fast) {
        leaf.triangles = {{0, 1, 2}};
    } else {
        leaf.entries = {{0, true, true}, {1, false, false}, {2, false, false}};
    }
    PlainChild child;
    const bool has_units = profile == Profile::fast && bits > 16;
    child.high.fill(has_units ? static_cast<std::uint16_t>(3 >> (bits - 16)) : 3);
    child.high[axis] = static_cast<std::uint16_t>(plane);
    child.leaf = leaf;
    PlainNode node;
    node.shift[axis] = shift;
    node.children.push_back(child);
    blob.nodes.push_back(node);
    return blob;
}

/// The same with a node above its node, whose own box keeps the rule or is the one that breaks it.
PlainBlob make_two_boxes(Profile profile, bool is_upper_too_long) {
    PlainBlob blob = make_one_box(profile, 12, 1, 512, 2, 128);
    PlainNode upper = blob.nodes[0];
    upper.children[0].leaf.reset();
    upper.children[0].node = 1;
    (is_upper_too_long ? upper : blob.nodes[0]).children[0].high[1] = 129;  // 516 steps
    blob.nodes.insert(blob.nodes.begin(), upper);
    return blob;
}

BakeOptions with_splits(unsigned bits) {
    BakeOptions options = with_profile(Profile::fast, with_bits(bits));
    options.build.builder = Builder::spatial_splits;
    options.build.duplicate_budget = 1.0;
    return options;
}

bool has_copies(const DecodedBlob& decoded) { return (decoded.features & format::feature::split_references) != 0; }

/// A step farther and the blob would not be sound.
bool has_farthest_box(DecodedBlob decoded) {
    for (DecodedNode& node : decoded.nodes) {
        for (DecodedChild& child : node.children) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::int32_t end = child.box.high[k]++;
                if (end > static_cast<std::int32_t>(decoded.extent[k]) && !boxes_end_near_asset(decoded)) return true;
                child.box.high[k] = end;
            }
        }
    }
    return false;
}

constexpr Profile packed_profiles[] = {Profile::balanced, Profile::small};

std::string verdict(const std::vector<std::byte>& blob) { return verify(blob).message; }

bool opens(const std::vector<std::byte>& bytes) { return static_cast<bool>(open(bytes)); }

using Extent = std::array<std::uint32_t, 3>;

/// Small triangles all over a box of whole steps with at most one side of 0, and long ones that spatial splits cut.
Mesh make_filled_box(const Extent& extent, Random& random) {
    Mesh mesh;
    const auto place = [](const Extent& at) {
        return Vec3{static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])};
    };
    const auto add = [&](const Extent& a, const Extent& b, const Extent& c) {
        append_triangle(mesh, place(a), place(b), place(c));
    };
    const auto anywhere = [&] {
        return Extent{random.below(extent[0] + 1), random.below(extent[1] + 1), random.below(extent[2] + 1)};
    };
    const auto near = [&](Extent at) {
        for (std::size_t k = 0; k < 3; ++k) at[k] = std::min(extent[k], at[k] + random.below(4));
        return at;
    };
    for (std::size_t k = 0; k < 3; ++k) {
        Extent along{}, across{};
        along[k] = extent[k];
        across[(k + 1) % 3] = extent[(k + 1) % 3];
        add({}, along, across);
    }
    for (int i = 0; i < 60; ++i) {
        const Extent start = i < 4 ? extent : anywhere();
        add(start, near(start), near(start));
    }
    for (int i = 0; i < 20; ++i) {
        Extent start = anywhere(), end = anywhere();
        for (std::size_t k = 0; k < 3; ++k) {
            if (extent[k] != *std::max_element(extent.begin(), extent.end())) continue;
            start[k] = 0;
            end[k] = extent[k];
        }
        add(start, end, near(end));
    }
    return mesh;
}

TEST_CASE("format: a box may extend less than one coarsest plane beyond the extent") {
    struct Ending {
        unsigned least_bits;
        std::int32_t extent;
        unsigned shift, plane;
        bool is_sound;
    };
    const std::int32_t largest = (1 << 24) - 1;
    // clang-format off
        const Ending endings[] = {
            {2, 0, 0, 0, true},              {2, 0, 0, 1, false},           {2, 0, 17, 1, false},
            {2, 1, 0, 1, true},              {2, 1, 0, 2, false},           {2, 1, 1, 1, false},
            {8, 254, 0, 254, true},          {8, 254, 0, 255, false},       {8, 255, 0, 255, true},
            {8, 255, 1, 128, false},         {8, 255, 8, 1, false},         {9, 256, 1, 128, true},
            {9, 256, 1, 129, false},         {9, 257, 1, 129, true},        {9, 257, 1, 130, false},
            {9, 510, 1, 255, true},          {9, 510, 2, 128, false},       {9, 511, 2, 128, true},
            {10, 512, 2, 129, false},        {10, 513, 2, 129, true},       {10, 513, 3, 65, false},
            {16, 65535, 9, 128, true},       {16, 65535, 9, 129, false},    {24, (254 << 16) + 1, 16, 255, true},
            {24, 254 << 16, 16, 255, false}, {24, 255 << 16, 17, 128, false}, {24, (255 << 16) + 1, 17, 128, true},
            {24, largest, 17, 128, true},    {24, largest, 17, 129, false}};
    // clang-format on
    for (const Profile profile : packed_profiles) {
        CAPTURE(name_of(profile));
        for (const Ending& ending : endings) {
            for (unsigned bits = ending.least_bits; bits <= format::max_bits; ++bits) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    CAPTURE(ending.extent);
                    CAPTURE(ending.shift);
                    CAPTURE(ending.plane);
                    CAPTURE(bits);
                    CAPTURE(axis);
                    const auto blob =
                        encode(make_one_box(profile, bits, axis, ending.extent, ending.shift, ending.plane));
                    CHECK(opens(blob));
                    CHECK(is_sound(blob) == ending.is_sound);
                    const std::string message = verdict(blob);
                    CHECK((message == "") == ending.is_sound);
                    if (ending.is_sound) continue;
                    CHECK(contains(message, "node 0 (byte 128) has a box that ends too far beyond the asset"));
                    CHECK(contains(message, std::string("on ") + "xyz"[axis] + " that of its child 0 ends at " +
                                                std::to_string(ending.plane << ending.shift)));
                }
            }
        }
    }
}

TEST_CASE("format: a box of a plain node that ends in another unit than the extent is refused") {
    for (unsigned bits = 2; bits <= format::max_bits; ++bits) {
        const unsigned unit = format::unit_shift(bits);
        const std::int32_t largest = (1 << bits) - 1;
        for (const std::int32_t extent : {3, 4, 255, 256, 257, largest / 2, largest / 2 + 1, largest}) {
            if (extent > largest) continue;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                CAPTURE(bits);
                CAPTURE(extent);
                CAPTURE(axis);
                const auto last = static_cast<unsigned>(extent >> unit);
                const auto good = encode(make_one_box(Profile::fast, bits, axis, extent, 0, last));
                CHECK(opens(good));
                CHECK(is_sound(good));
                CHECK(verdict(good) == "");
                if (last == 0xFFFF) continue;
                const auto bad = encode(make_one_box(Profile::fast, bits, axis, extent, 0, last + 1));
                CHECK_FALSE(opens(bad));
                CHECK_FALSE(is_sound(bad));
            }
        }
    }
}

TEST_CASE("format: a box of a node must end near the extent whatever the boxes below do") {
    for (const Profile profile : packed_profiles) {
        const auto below = encode(make_two_boxes(profile, false)), above = encode(make_two_boxes(profile, true));
        CHECK(opens(below));
        CHECK(opens(above));
        CHECK_FALSE(is_sound(below));
        CHECK_FALSE(is_sound(above));
        CHECK(contains(verdict(below), "node 1 (byte 192) has a box that ends too far beyond the asset: on y"));
        CHECK(contains(verdict(above), "node 0 (byte 128) has a box that ends too far beyond the asset: on y"));
    }
}

TEST_CASE("format: a box with parts of triangles must end near the extent") {
    Random random(3);
    auto blob = bake_or_throw(make_filled_box({511, 256, 256}, random), with_splits(9));
    REQUIRE(has_copies(decode(blob)));
    REQUIRE(verdict(blob) == "");
    REQUIRE(boxes_end_near_asset(decode(blob)));
    const std::size_t plane = format::header::bytes + format::plain_node::hi_at;
    CHECK(status_with(blob, plane, 511, 2) == OpenStatus::ok);
    CHECK(status_with(blob, plane, 512, 2) == OpenStatus::bad_node);
    put(blob, plane, 512, 2);
    CHECK_FALSE(boxes_end_near_asset(decode(blob)));
}

TEST_CASE("format: boxes of baked blobs end near the extent on every lattice and some as far as allowed") {
    Random random(1);
    unsigned blobs_with_copies = 0, lattices_with_farthest = 0;
    for (unsigned bits = 1; bits <= format::max_bits; ++bits) {
        const std::uint32_t largest = (1u << bits) - 1;
        std::vector<std::uint32_t> extents = {0u, 1u, 254u, 255u, 256u, largest};
        for (unsigned shift = 0; shift <= format::packed_node::max_shift;
             ++shift)  // planes of 2^shift reach, or just not
            extents.insert(extents.end(), {(200u << shift) + 1, 255u << shift, (255u << shift) + 1});
        std::erase_if(extents, [&](std::uint32_t extent) { return extent > largest; });
        const auto any_extent = [&] { return extents[random.below(static_cast<std::uint32_t>(extents.size()))]; };
        bool is_any_farthest = false;
        for (const std::uint32_t first : extents) {
            Extent extent = {first, any_extent(), any_extent()};
            extent[1 + random.below(2)] = largest - random.below((largest + 1) / 2);  // so that a step is 1
            std::swap(extent[0], extent[random.below(3)]);
            if (std::count(extent.begin(), extent.end(), 0u) > 1) continue;  // nothing has area
            CAPTURE(bits);
            CAPTURE(extent[0]);
            CAPTURE(extent[1]);
            CAPTURE(extent[2]);
            const Mesh mesh = make_filled_box(extent, random);
            for_each_profile([&](Profile profile) {
                const auto blob = bake_or_throw(mesh, with_profile(profile, with_bits(bits)));
                CHECK(decode(blob).extent == extent);
                CHECK(is_sound(blob));
                CHECK(verdict(blob) == "");
                is_any_farthest = is_any_farthest || has_farthest_box(decode(blob));
            });
            const auto blob = bake_or_throw(mesh, with_splits(bits));
            CHECK(boxes_end_near_asset(decode(blob)));
            CHECK(verdict(blob) == "");
            blobs_with_copies += has_copies(decode(blob)) ? 1u : 0u;
        }
        lattices_with_farthest += is_any_farthest ? 1 : 0;
    }
    CHECK(blobs_with_copies > 100);
    CHECK(lattices_with_farthest == format::max_bits - 8);  // up to 8 bits no box ends beyond
}

TEST_CASE("format: boxes in kept blobs of every version end near the extent") {
    unsigned count = 0;
    const std::filesystem::path folder = std::filesystem::path(ESPALIER_PROJECT_FOLDER) / "tests/format_versions";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (!entry.path().filename().string().starts_with("2.")) continue;  // scenes have versions of their own
        CAPTURE(entry.path().string());
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        const auto bytes = std::as_bytes(std::span(text));
        const DecodedBlob decoded = decode(bytes);
        CHECK(boxes_end_near_asset(decoded));
        CHECK(is_sound(decoded) != has_copies(decoded));  // which sound blobs have not
        CHECK(verify(bytes).message == "");
        ++count;
    }
    CHECK(count >= 12);
}

}  // namespace
}  // namespace espalier::tests::box_ends_test
