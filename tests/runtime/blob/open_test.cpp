// Claims about opening: what is refused and why, and that nothing outside the bytes is read or written.
#include "support/testing.hpp"

#include "open_blobs.hpp"

namespace espalier::tests::open_test {
namespace {

using namespace espalier::tests::opening;

/// With every optional section, and small enough to be broken in every place.
Bytes blob_of_one_triangle(Profile profile) {
    Mesh mesh = make_cube(0.0f, 1.0f);
    mesh.triangles.resize(1);
    mesh.materials = {700};
    return bake_or_throw(mesh, with_every_section(profile));
}

struct Field {
    const char* name;
    std::size_t at;
    unsigned size;
};
constexpr std::array header_fields = {
    Field{"magic", at::magic_at, 4},
    Field{"version_major", at::version_major_at, 2},
    Field{"version_minor", at::version_minor_at, 2},
    Field{"total_bytes", at::total_bytes_at, 4},
    Field{"features", at::features_at, 4},
    Field{"profile", at::profile_at, 1},
    Field{"bits", at::bits_at, 1},
    Field{"step_exponent", at::step_exponent_at, 2},
    Field{"triangle_count", at::triangle_count_at, 4},
    Field{"vertex_count", at::vertex_count_at, 4},
    Field{"node_count", at::node_count_at, 4},
    Field{"leaf_bytes", at::leaf_bytes_at, 4},
    Field{"origin x", at::origin_at, 4},
    Field{"origin y", at::origin_at + 4, 4},
    Field{"origin z", at::origin_at + 8, 4},
    Field{"extent x", at::extent_at, 4},
    Field{"extent y", at::extent_at + 4, 4},
    Field{"extent z", at::extent_at + 8, 4},
    Field{"max_error", at::max_error_at, 4},
    Field{"depth", at::depth_at, 1},
    Field{"id_kind_bits", at::id_kind_bits_at, 1},
    Field{"two reserved bytes", 70, 2},
    Field{"source_count", at::source_count_at, 4},
    Field{"source_triangles", at::source_triangles_at, 4},
    Field{"id_step_bytes", at::id_step_bytes_at, 4},
    Field{"reserved", at::reserved_at, 8},
    Field{"the last reserved bytes", at::bytes - 8, 8},
};

TEST_CASE("open: a baked blob opens at every misalignment with the same answers") {
    for_each_profile([](Profile profile) {
        const Bytes bytes = make_blob_with_every_section(profile);
        std::uint64_t expected = 0;
        for (std::size_t misalignment = 0; misalignment < 16; ++misalignment) {
            CAPTURE(misalignment);
            const ExactBuffer buffer(bytes, misalignment);
            const Blob blob = open(buffer.bytes());
            REQUIRE(blob);
            Random random(1);
            const std::uint64_t answers = exercise(blob, random, rounds_per_case(50));
            if (misalignment == 0) expected = answers;
            REQUIRE(answers == expected);
        }
    });
}

TEST_CASE("open: a blob in read-only memory between unreadable pages gives the same answers") {
    for (const TestBlob& test_blob : small_test_blobs()) {
        CAPTURE(test_blob.name);
        for (const bool at_end : {true, false}) {
            const GuardedPages pages(test_blob.opened.bytes, at_end);
            const Blob blob = open(pages.bytes());
            REQUIRE(blob);
            Random random(2);
            Random same_random(2);
            const unsigned rounds = rounds_per_case(30);
            CHECK(exercise(blob, random, rounds) == exercise(test_blob.opened.blob, same_random, rounds));
        }
    }
}

TEST_CASE("open: every truncation is refused as too short at every misalignment") {
    for_each_profile([](Profile profile) {
        const Bytes bytes = make_blob_with_every_section(profile);
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            for (std::size_t misalignment = 0; misalignment < 16; ++misalignment) {
                const ExactBuffer shorter(std::span<const std::byte>(bytes).first(size), misalignment);
                const Blob blob = open(shorter.bytes());
                REQUIRE(blob.status() == OpenStatus::too_short);
                REQUIRE(is_empty(blob));
            }
        }
    });
}

TEST_CASE("open: every truncation with size and checksum repaired is refused and nothing past its end is read") {
    for_each_profile([](Profile profile) {
        for (const Bytes& bytes : {blob_of_one_triangle(profile), make_blob_with_every_section(profile)}) {
            const std::size_t misalignments = bytes.size() < 1000 ? 16 : 1;
            for (std::size_t size = at::bytes; size < bytes.size(); ++size) {
                Bytes shorter(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
                put(shorter, at::total_bytes_at, size, 4);
                repair_checksum(shorter);
                for (std::size_t misalignment = 0; misalignment < misalignments; ++misalignment) {
                    const ExactBuffer buffer(shorter, misalignment);
                    const Blob blob = open(buffer.bytes());
                    REQUIRE(blob.status() != OpenStatus::ok);
                    REQUIRE(is_empty(blob));
                }
                REQUIRE(status_at_end_of_memory(shorter) != OpenStatus::ok);  // also where no sanitizer watches
            }
        }
    });
}

TEST_CASE("open: trailing bytes are refused also when the size includes them") {
    for_each_profile([](Profile profile) {
        Bytes bytes = make_blob_with_every_section(profile);
        for (const std::size_t more : {1u, 3u, 4u, 64u, 1000u}) {
            Bytes longer = bytes;
            longer.resize(bytes.size() + more);
            CHECK(status_of(longer) == OpenStatus::trailing_bytes);
            CHECK(status_with(longer, at::total_bytes_at, longer.size(), 4) == OpenStatus::bad_section);
        }
    });
}

TEST_CASE("open: bytes that were never a blob are refused") {
    for (const std::size_t size : {0u, 1u, 4u, 127u, 128u, 129u, 4096u}) {
        CAPTURE(size);
        for (const std::byte value : {std::byte{0x00}, std::byte{0xFF}}) {
            const ExactBuffer buffer(Bytes(size, value));
            const Blob blob = open(buffer.bytes());
            CHECK(blob.status() == (size < at::bytes ? OpenStatus::too_short : OpenStatus::not_a_blob));
            CHECK(is_empty(blob));
        }
    }
    const Blob blob = open({});
    CHECK(blob.status() == OpenStatus::too_short);
}

TEST_CASE("open: bytes of one value behind a valid header are refused or leave queries safe") {
    for_each_profile([](Profile profile) {
        const auto fill_and_open = [](const Bytes& good, std::size_t from, std::size_t to, std::byte value) {
            Bytes bytes = good;
            std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(from),
                      bytes.begin() + static_cast<std::ptrdiff_t>(to), value);
            put(bytes, at::magic_at, format::magic, 4);
            put(bytes, at::version_major_at, format::version_major, 2);
            put(bytes, at::version_minor_at, format::version_minor, 2);
            put(bytes, at::total_bytes_at, bytes.size(), 4);
            repair_checksum(bytes);
            opens_safely(ExactBuffer(bytes).bytes(), from, rounds_per_case(2));
        };
        for (const std::byte value : {std::byte{0x00}, std::byte{0xFF}}) {
            for (const Bytes& good : {make_blob_with_every_section(profile), blob_of_one_triangle(profile)}) {
                const bool is_small = good.size() < 1000;
                for (std::size_t from = 0; from < good.size(); from += is_small ? 4 : 64)
                    for (const std::size_t count : {std::size_t{4}, std::size_t{64}, good.size()})
                        fill_and_open(good, from, std::min(from + count, good.size()), value);
                fill_and_open(good, 0, at::bytes, value);
            }
        }
    });
}

TEST_CASE("open: each status has its cause") {
    for_each_profile([](Profile profile) {
        const Bytes bytes = make_blob_with_every_section(profile);
        REQUIRE(status_of(bytes) == OpenStatus::ok);
        Bytes changed = bytes;
        changed.back() ^= std::byte{1};
        CHECK(status_of(changed) == OpenStatus::bad_checksum);
        CHECK(status_with(bytes, at::magic_at, 0x4C505346u, 4) == OpenStatus::not_a_blob);
        CHECK(status_with(bytes, at::version_major_at, format::version_major + 1, 2) ==
              OpenStatus::unsupported_version);
        CHECK(status_with(bytes, at::version_major_at, format::version_major - 1, 2) ==
              OpenStatus::unsupported_version);
        CHECK(status_with(bytes, at::version_minor_at, format::version_minor + 1, 2) ==
              OpenStatus::unsupported_version);
        CHECK(status_with(bytes, at::profile_at, 4, 1) == OpenStatus::unsupported_profile);
        CHECK(status_with(bytes, at::features_at, 1u << 31 | get(bytes, at::features_at, 4), 4) ==
              OpenStatus::unsupported_feature);
        CHECK(status_with(bytes, at::bits_at, 0, 1) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::bits_at, 25, 1) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::step_exponent_at, 101, 2) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::step_exponent_at, 0xFFFF - 100, 2) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::origin_at, 0x7F800000u, 4) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::origin_at + 8, 0x7FC00000u, 4) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::max_error_at, 0x7FC00000u, 4) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::max_error_at, 0xBF800000u, 4) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::reserved_at, 1, 4) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::bytes - 4, 1u << 31, 4) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::depth_at, format::max_depth + 1, 1) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::depth_at, get(bytes, at::depth_at, 1) + 1, 1) == OpenStatus::bad_node);
        const std::uint64_t depth = get(bytes, at::depth_at, 1);  // 0 is for empty meshes
        CHECK(status_with(bytes, at::depth_at, depth - 1, 1) ==
              (depth == 1 ? OpenStatus::bad_header : OpenStatus::bad_node));
        // One triangle more: materials that are not there, or leaves.
        CHECK(status_with(bytes, at::triangle_count_at, get(bytes, at::triangle_count_at, 4) + 1, 4) ==
              OpenStatus::bad_section);
        const Bytes plain = bake_or_throw(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}), with_profile(profile));
        CHECK(status_with(plain, at::triangle_count_at, get(plain, at::triangle_count_at, 4) + 1, 4) ==
              OpenStatus::bad_leaf);
        // A child plane above its box, a leaf whose first triangle is another one, a bit in the guard, an unsorted
        // source.
        changed = bytes;
        break_node(changed, at::bytes);
        repair_checksum(changed);
        CHECK(status_of(changed) == OpenStatus::bad_node);
        const std::size_t leaves_at = leaves_of(bytes);
        CHECK(status_with(bytes, leaves_at, 1, 4) == OpenStatus::bad_leaf);
        const std::size_t guard_at = leaves_at + get(bytes, at::leaf_bytes_at, 4);
        CHECK(status_with(bytes, guard_at + 63, 1, 1) == OpenStatus::bad_section);
        CHECK(status_with(bytes, guard_at + format::guard_bytes, 1, 4) == OpenStatus::bad_section);
    });
}

TEST_CASE("open: each header field at its extremes is refused or leaves queries safe") {
    for_each_profile([](Profile profile) {
        const Bytes bytes = make_blob_with_every_section(profile);
        for (const Field& field : header_fields) {
            CAPTURE(std::string(field.name));
            const std::uint64_t was = get(bytes, field.at, field.size);
            std::vector<std::uint64_t> values = {0, 1, ~std::uint64_t{0}, was - 1, was + 1};
            for (unsigned bit = 7; bit < 8 * field.size; ++bit)  // and the numbers beside each power of two
                for (const std::uint64_t beside : {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1}})
                    values.push_back((std::uint64_t{1} << bit) + beside);
            for (const std::uint64_t value : values) {
                Bytes changed = bytes;
                put(changed, field.at, value, field.size);
                for (const bool repaired : {false, true}) {
                    if (repaired) repair_checksum(changed);
                    opens_safely(ExactBuffer(changed).bytes(), 3, rounds_per_case(4));
                }
            }
        }
    });
}

TEST_CASE("open: a blob holds the status of its opening and converts to true only if it is open") {
    static_assert(Blob().status() == OpenStatus::not_opened && !Blob());
    alignas(Blob) std::byte zeros[sizeof(Blob)] = {};  // as C fills it
    CHECK(reinterpret_cast<const Blob*>(zeros)->status() == OpenStatus::not_opened);
    CHECK(detail::query_status_of(Blob()) == QueryStatus::not_open);
    const Bytes bytes = make_blob_with_every_section(Profile::fast);
    const Blob good = open(bytes);
    CHECK(good.status() == OpenStatus::ok);
    CHECK(static_cast<bool>(good));
    CHECK(detail::query_status_of(good) == QueryStatus::ok);
    Blob refused = good;
    refused = open(std::span(bytes).first(100));
    CHECK(refused.status() == OpenStatus::too_short);
    CHECK(is_empty(refused));
    CHECK_FALSE(static_cast<bool>(refused));
    CHECK(detail::query_status_of(refused) == QueryStatus::not_open);
}

TEST_CASE("open: an empty mesh is a valid blob on which every query finds nothing") {
    Mesh nothing;
    nothing.name = "nothing";
    const OpenedBlob opened(nothing);
    CHECK(opened.blob.triangle_count() == 0);
    CHECK(opened.blob.size() == opened.bytes.size());
    Random random(4);
    CHECK_NOTHROW(exercise(opened.blob, random, 100));
}

TEST_CASE("format: the checksum is the CRC-32 of zip and Ethernet") {
    const char* check = "123456789";
    Bytes bytes(at::bytes);
    // The definition's check value, through the four zero bytes that the field counts as: computed by the
    // definition.
    std::memcpy(bytes.data(), check, 9);
    const std::uint32_t before = blob_checksum(bytes);
    bytes[at::checksum_at] = std::byte{0xAB};
    CHECK(blob_checksum(bytes) == before);
    bytes[20] = std::byte{1};
    CHECK(blob_checksum(bytes) != before);
    Bytes short_bytes(9);
    std::memcpy(short_bytes.data(), check, 9);
    CHECK(blob_checksum(short_bytes) == 0xCBF43926u);
}

TEST_CASE("open: every status and every other value has its own sentence") {
    for (unsigned number = 0; number < 256; ++number) {
        const char* text = describe(static_cast<OpenStatus>(number));
        REQUIRE(text != nullptr);
        REQUIRE(std::strlen(text) > 1);
        REQUIRE(text[std::strlen(text) - 1] != '.');
        for (unsigned other = 0; other < number && number <= 16; ++other) {
            if (number == 14 || other == 14) continue;  // has no meaning
            REQUIRE(std::string(text) != describe(static_cast<OpenStatus>(other)));
        }
    }
    for (unsigned number = 0; number < 256; ++number) {
        const std::string text = describe(static_cast<QueryStatus>(number));
        REQUIRE(text.size() > 1);
        REQUIRE(text.back() != '.');
        const auto has_meaning = [](unsigned status) { return status <= 4 || (status >= 16 && status <= 21); };
        for (unsigned other = 0; other < number && has_meaning(number); ++other)
            if (has_meaning(other)) REQUIRE(text != describe(static_cast<QueryStatus>(other)));
    }
}

}  // namespace
}  // namespace espalier::tests::open_test
