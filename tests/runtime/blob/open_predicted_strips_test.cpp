// The verifier's rules for predicted strips, each broken alone, and the largest ones. Blobs come from the encoder.
#include "support/testing.hpp"

#include "open_blobs.hpp"

#include <runtime/blob/plain_leaf.hpp>
#include <runtime/blob/strip_leaf.hpp>

namespace espalier::tests::open_predicted_strips_test {
namespace {

using namespace espalier::format::predicted_strip;

using namespace espalier::tests::opening;
/// Of one node, whose leaves have boxes of so many steps from 0 0 0 on.
PlainBlob make_blob(unsigned bits, std::uint16_t planes, unsigned shift, const std::vector<PlainLeaf>& leaves) {
    PlainBlob blob = plain_blob_of(Profile::tiny, bits);
    blob.nodes.resize(1);
    blob.nodes[0].shift.fill(shift);
    for (const PlainLeaf& leaf : leaves)
        blob.nodes[0].children.push_back({{0, 0, 0}, {planes, planes, planes}, 0, leaf});
    return blob;
}

/// A strip over three vertices, each named again and again, so no vertex is predicted.
PlainLeaf make_strip_of_references(unsigned entries) {
    PlainLeaf leaf;
    leaf.vertices = {{0, 0, 0}, {15, 0, 1}, {0, 15, 2}};
    for (unsigned i = 0; i < entries; ++i) leaf.entries.push_back({i % 3, i == 0, i + 2 < entries});
    return leaf;
}

/// A strip that uses each vertex once.
PlainLeaf make_strip(const std::vector<GridPoint>& vertices) {
    PlainLeaf leaf;
    leaf.vertices = vertices;
    for (unsigned i = 0; i < vertices.size(); ++i) leaf.entries.push_back({i, i == 0, i + 2 < vertices.size()});
    return leaf;
}

TEST_CASE("open: joints of a predicted strip are in order and have triangles on both sides") {
    constexpr unsigned entries = 12;
    PlainLeaf leaf = make_strip_of_references(entries);
    for (const std::size_t window : {1u, 2u, 5u, 6u}) leaf.entries[window].is_triangle = false;
    const Bytes good = encode(make_blob(4, 15, 0, {leaf}));
    constexpr unsigned joint_at = marks_at + 2 * (entries - 3);
    for (unsigned first = 0; first < 64; ++first) {
        for (unsigned second = 0; second < 64; ++second) {
            const bool is_sound = first >= 1 && second >= first + 3 && second + 2 < entries - 2;
            CAPTURE(first);
            CAPTURE(second);
            CHECK(status_with_bits(good, joint_at, 2 * place_bits, first | second << place_bits) ==
                  (is_sound ? OpenStatus::ok : OpenStatus::bad_leaf));
        }
    }
}

TEST_CASE("open: an entry of a predicted strip names a vertex that was used before") {
    // The seventh entry is the first use of the fourth vertex.
    constexpr unsigned entries = 12, fourth = 6;
    PlainLeaf leaf = make_strip_of_references(entries);
    leaf.vertices.push_back({3, 3, 3});
    leaf.entries[fourth].vertex = 3;
    leaf.entries[fourth - 2].is_triangle = leaf.entries[fourth - 3].is_triangle = false;
    const Bytes good = encode(make_blob(4, 15, 0, {leaf}));
    REQUIRE(status_of(good) == OpenStatus::ok);
    for (unsigned entry = 3; entry < entries; ++entry) {
        if (entry == fourth) continue;
        const unsigned reference = entry < fourth ? entry - 3 : entry - 4;
        CHECK(status_with_bits(good, references_at(entries, 1) + 2 * reference, 2, 3) ==
              (entry < fourth ? OpenStatus::bad_leaf : OpenStatus::ok));
    }
    // With three vertices there is none of number 3.
    const Bytes three = encode(make_blob(4, 15, 0, {make_strip_of_references(entries)}));
    for (unsigned entry = 3; entry < entries; ++entry)
        CHECK(status_with_bits(three, references_at(entries, 0) + 2 * (entry - 3), 2, 3) == OpenStatus::bad_leaf);
}

TEST_CASE("open: widths of residuals are refused also where no vertex is predicted") {
    const Bytes good = encode(make_blob(4, 15, 0, {make_strip_of_references(3)}));
    for (unsigned axis = 0; axis < 3; ++axis) {
        for (unsigned large = 0; large < 32; ++large) {
            for (unsigned small = 0; small < 32; ++small) {
                const bool is_sound = small <= large && large <= max_width(4);
                CHECK(status_with_bits(good, 2 * width_bits * axis, 2 * width_bits, large | small << width_bits) ==
                      (is_sound ? OpenStatus::ok : OpenStatus::bad_leaf));
            }
        }
    }
}

TEST_CASE("open: a predicted strip has at most 64 entries and 56 vertices") {
    check_triangles(make_blob(4, 15, 0, {make_strip_of_references(max_entries)}));
    check_triangles(make_blob(24, 128, 17, {make_strip_of_references(max_entries)}));
    CHECK(status_of(encode(make_blob(4, 15, 0, {make_strip_of_references(max_entries + 1)}))) == OpenStatus::bad_leaf);
    CHECK(status_of(encode(make_blob(4, 15, 0, {make_strip_of_references(max_entries + 2)}))) == OpenStatus::bad_leaf);
    std::vector<GridPoint> vertices;
    for (unsigned i = 0; i < max_vertices; ++i) {
        const auto x = static_cast<std::int32_t>(i);
        vertices.push_back({x % 16, x / 16, x * x % 13});
    }
    check_triangles(make_blob(4, 15, 0, {make_strip(vertices)}));
    vertices.push_back({1, 2, 3});
    CHECK(status_of(encode(make_blob(4, 15, 0, {make_strip(vertices)}))) == OpenStatus::bad_leaf);
}

TEST_CASE("open: a predicted strip on one point has no numbers") {
    // The bits before them fill whole bytes with nine entries.
    for (unsigned entries = 3; entries <= 16; ++entries)
        check_triangles(make_blob(4, 0, 0, {make_strip(std::vector<GridPoint>(entries))}));
}

TEST_CASE("open: a predicted vertex outside of its leaf is refused along each axis") {
    // Of 3 bits in a lattice of 4, and of 23 in one of 24, too wide to be decoded axes at once.
    struct Lattice {
        unsigned bits, planes, shift, side;
    };
    for (const Lattice& lattice : {Lattice{4, 7, 0, 8}, Lattice{24, 32, 17, 1u << 23}}) {
        const auto end = static_cast<std::int32_t>(lattice.side);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const std::int32_t coordinate : {-end / 2, -1, 0, end - 1, end, end + end / 2}) {
                std::vector<GridPoint> vertices = {{1, 2, 3}, {3, 1, 2}, {2, 3, 1}, {1, 1, 1}, {0, 1, 2}};
                vertices[3][axis] = coordinate;
                const PlainBlob blob = make_blob(lattice.bits, static_cast<std::uint16_t>(lattice.planes),
                                                 lattice.shift, {make_strip(vertices)});
                CAPTURE(lattice.bits);
                CAPTURE(coordinate);
                if (coordinate >= 0 && coordinate < end) check_triangles(blob);
                else CHECK(status_of(encode(blob)) == OpenStatus::bad_leaf);
            }
        }
    }
}

TEST_CASE("open: predicted strips of more than 512 bytes are read at their places") {
    Random random(20);
    std::vector<PlainLeaf> leaves;
    for (unsigned number = 0; number < 3; ++number) {
        std::vector<GridPoint> vertices(max_vertices);
        for (GridPoint& vertex : vertices)
            for (std::int32_t& coordinate : vertex) coordinate = static_cast<std::int32_t>(random.next() >> 40);
        // Residuals of 26 bits, the most.
        vertices[0] = vertices[2] = {0, 0, 0};
        vertices[1] = vertices[3] = {(1 << 24) - 1, (1 << 24) - 1, (1 << 24) - 1};
        leaves.push_back(make_strip(vertices));
    }
    const PlainBlob blob = make_blob(24, 128, 17, leaves);
    const Bytes bytes = encode(blob);
    for (std::size_t number = 0; number < 2; ++number)
        REQUIRE((get(bytes, descriptor_of(bytes, at::bytes, number), 2) & ((1u << entries_shift) - 1u)) >= 512);
    check_triangles(blob);
}

TEST_CASE("open: a predicted strip stores as many vertices as it has") {
    std::vector<GridPoint> vertices;
    for (std::int32_t x = 0; x < static_cast<std::int32_t>(max_vertices); ++x)
        vertices.push_back({x % 16, x / 16, x * x % 13});
    const Bytes bytes = encode(make_blob(4, 15, 0, {make_strip(vertices)}));
    alignas(64) std::array<std::byte, 2048> buffer{};
    REQUIRE(bytes.size() <= buffer.size());
    std::copy(bytes.begin(), bytes.end(), buffer.begin());
    const Blob blob = open(std::span(buffer).first(bytes.size()));
    REQUIRE(blob);
    detail::StripLeaf leaf;
    detail::decode_predicted_marks(detail::data_of(blob), detail::node_at<detail::PackedNode>(detail::data_of(blob), 0),
                                   0, leaf);
    constexpr std::uint32_t untouched = 0xABCDEF01;
    std::array<std::array<std::uint32_t, max_vertices + 1>, 3> stored;
    for (auto& row : stored) row.fill(untouched);
    detail::store_predicted_vertices(leaf, stored[0].data(), stored[1].data(), stored[2].data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < vertices.size(); ++i)
            CHECK(stored[axis][i] == static_cast<std::uint32_t>(vertices[i][axis]));
        CHECK(stored[axis][max_vertices] == untouched);
    }
}

}  // namespace
}  // namespace espalier::tests::open_predicted_strips_test
