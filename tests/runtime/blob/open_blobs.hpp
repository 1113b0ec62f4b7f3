// Blobs to break, for tests of the verifier's rules.
#pragma once

#include "support/testing.hpp"

#include "support/blobs/soundness.hpp"
#include "support/exercise/exercise.hpp"
#include "support/format/encoder.hpp"
#include "support/machine/exact_buffer.hpp"
#include "support/machine/guarded_pages.hpp"

namespace espalier::tests::opening {

namespace at = format::header;
namespace feature = format::feature;
inline Bytes plain_blob(Profile profile) {
    return bake_or_throw(make_icosphere(3, 1.0, {0.0f, 0.0f, 0.0f}), with_profile(profile));
}

/// Of three sources with a triangle each.
inline Bytes three_sources(Profile profile) {
    std::array<Mesh, 3> meshes = {make_cube(0.0f, 1.0f), make_cube(2.0f, 3.0f), make_cube(4.0f, 5.0f)};
    std::vector<MeshView> views;
    for (Mesh& mesh : meshes) {
        mesh.triangles.resize(1);
        views.push_back(mesh.view());
    }
    auto baked = bake(views, {.profile = profile, .original_ids = true});
    REQUIRE(baked);
    return baked.bytes;
}

inline Bytes without(Bytes bytes, std::size_t first, std::size_t count) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(first);
    bytes.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
    return bytes;
}

/// Where the first optional section begins.
inline std::size_t sections_of(const Bytes& bytes) {
    return leaves_of(bytes) + get(bytes, at::leaf_bytes_at, 4) + format::guard_bytes;
}

/// The status after the checksum is repaired, of a blob that ends where memory does.
inline OpenStatus status_at_end_of_memory(Bytes bytes) {
    repair_checksum(bytes);
    const GuardedPages pages(bytes, true);
    return open(pages.bytes()).status();
}

inline bool is_empty(const Blob& blob) {
    return blob.triangle_count() == 0 && blob.size() == 0 && detail::data_of(blob).bytes == nullptr &&
           raycast(blob, {{0.0f, 0.0f, 9.0f}, {0.0f, 0.0f, -1.0f}}).status == QueryStatus::not_open;
}

/// Whether the bytes open. What is refused is empty; on what is accepted every query must be safe.
inline bool opens_safely(std::span<const std::byte> bytes, std::uint64_t seed, unsigned rounds) {
    const Blob blob = open(bytes);
    if (!blob) {
        REQUIRE(is_empty(blob));
        return false;
    }
    Random random(seed);
    REQUIRE_NOTHROW(exercise(blob, random, rounds, is_sound(bytes)));
    return true;
}

/// A blob without triangles in steps of 1 from 0 0 0, of nodes that are to be added.
inline PlainBlob plain_blob_of(Profile profile, unsigned bits) {
    PlainBlob blob;
    blob.decoded.profile = profile;
    blob.decoded.bits = bits;
    blob.decoded.extent.fill((1u << bits) - 1);
    blob.decoded.vertex_count = 3;
    return blob;
}

/// Tests that a blob in steps of 1 from 0 0 0 opens and has the triangles of its leaves, which are those of one node.
inline void check_triangles(const PlainBlob& blob) {
    std::vector<GridTriangle> expected;
    for (const PlainChild& child : blob.nodes[0].children)
        for (const GridTriangle& triangle : child.leaf->corners()) expected.push_back(triangle);
    const Bytes bytes = encode(blob);
    const Blob opened = open(bytes);
    REQUIRE(opened);
    REQUIRE(opened.triangle_count() == expected.size());
    const auto is_at = [](const Vec3& point, const GridPoint& corner) {
        return point.x == static_cast<float>(corner[0]) && point.y == static_cast<float>(corner[1]) &&
               point.z == static_cast<float>(corner[2]);
    };
    (void)for_each_triangle(opened, [&](TriangleId triangle, const Triangle& corners) {
        const GridTriangle& same = expected[triangle.index];
        CHECK((is_at(corners.a, same.a) && is_at(corners.b, same.b) && is_at(corners.c, same.c)));
        return Visit::next;
    });
}

/// Changes bits of the data of the first leaf.
inline Bytes with_bits(Bytes bytes, unsigned bit, unsigned width, std::uint64_t value) {
    const std::size_t byte = leaf_data_of(bytes, at::bytes, 0) + bit / 8;
    const std::uint64_t others = get(bytes, byte, 4) & ~(((std::uint64_t{1} << width) - 1) << bit % 8);
    put(bytes, byte, others | value << bit % 8, 4);
    repair_checksum(bytes);
    return bytes;
}
inline OpenStatus status_with_bits(const Bytes& bytes, unsigned bit, unsigned width, std::uint64_t value) {
    return status_of(with_bits(bytes, bit, width, value));
}

}  // namespace espalier::tests::opening
