// The verifier's rules for the sections of ids, sources and copies: each, broken alone, is the reason of the refusal.
#include "support/testing.hpp"

#include "open_blobs.hpp"

namespace espalier::tests::open_sections_test {
namespace {

using namespace espalier::tests::opening;

Bytes blob_with_copies() {
    const Bytes bytes = bake_or_throw(make_soup(60, 1), with_copies());
    REQUIRE((get(bytes, at::features_at, 4) & feature::split_references) != 0);
    return bytes;
}

TEST_CASE("open: each rule of sources and ids is enforced") {
    for_each_profile([](Profile profile) {
        const Bytes bytes = three_sources(profile);
        REQUIRE(status_of(bytes) == OpenStatus::ok);
        REQUIRE(get(bytes, at::source_count_at, 4) == 3);
        const std::size_t table = sections_of(bytes);
        const auto with_first = [&](std::size_t source, std::uint64_t first) {
            return status_with(bytes, table + source * format::source::bytes, first, 4);
        };
        CHECK(with_first(1, 1) == OpenStatus::ok);
        CHECK(with_first(0, 1) == OpenStatus::bad_section);  // the first begins at 0
        CHECK(with_first(1, 3) == OpenStatus::bad_section);  // later than the next
        CHECK(with_first(2, 3) == OpenStatus::ok);           // the last without a triangle
        CHECK(with_first(2, 4) == OpenStatus::bad_section);  // more than there are
        CHECK(status_with(bytes, at::source_triangles_at, 1, 4) == OpenStatus::bad_section);
        CHECK(status_with(bytes, at::source_count_at, 0xFFFFFFFFu, 4) == OpenStatus::bad_section);
        Bytes no_sources = without(bytes, table, 3 * format::source::bytes);
        put(no_sources, at::source_count_at, 0, 4);
        CHECK(status_resized(no_sources) == OpenStatus::bad_section);
        for (std::size_t i = table; i < no_sources.size(); ++i) put(no_sources, i, 0, 1);
        CHECK(status_resized(no_sources) == OpenStatus::bad_section);
        CHECK(status_resized(without(bytes, bytes.size() - 4, 4)) == OpenStatus::bad_section);
        const auto nothing = bake({}, {.profile = profile, .original_ids = true});
        REQUIRE(nothing);
        REQUIRE(get(nothing.bytes, at::source_count_at, 4) == 0);
        // No source is looked at behind its end.
        CHECK(status_at_end_of_memory(nothing.bytes) == OpenStatus::ok);
    });
}

TEST_CASE("open: each rule of the steps of ids is enforced") {
    for_each_profile([](Profile profile) {
        namespace ids = format::ids;
        const Bytes bytes = bake_or_throw(make_plane_grid(10),
                                          {.profile = profile, .original_ids = true});  // 200 triangles: two blocks
        REQUIRE(status_of(bytes) == OpenStatus::ok);
        const std::size_t kinds = sections_of(bytes) + format::source::bytes;
        const std::uint64_t kind_bits = get(bytes, at::id_kind_bits_at, 1);
        REQUIRE(kind_bits > 0);
        const std::size_t steps = kinds + (ids::kind_bytes << kind_bits);
        const std::uint64_t step_bytes = get(bytes, at::id_step_bytes_at, 4);
        const std::size_t blocks = (steps + step_bytes + 3) / 4 * 4;
        REQUIRE(bytes.size() == blocks + 2 * ids::block_bytes(true));
        const std::uint64_t numbers = profile == Profile::fast ? 200 : 600;
        const unsigned number_bits = profile == Profile::fast ? 8 : 10;
        const auto status = [&](std::size_t place, std::uint64_t value, unsigned size = 4) {
            return status_with(bytes, place, value, size);
        };

        // Fields, prefixes and places of recent numbers are in range.
        for (std::size_t kind = 0; kind >> kind_bits == 0; ++kind) {
            const std::size_t place = kinds + kind * ids::kind_bytes;
            CHECK(status(place + ids::width_at, number_bits + 1, 1) == OpenStatus::bad_section);
            CHECK(status(place + ids::prefix_at, kind_bits + 1, 1) == OpenStatus::bad_section);
            CHECK(status(place + ids::from_at, ids::recent_numbers, 1) == OpenStatus::bad_section);
            CHECK(status(place + ids::replaced_at, ids::recent_numbers, 1) == OpenStatus::bad_section);
        }
        // A block begins with a number that a source can have, and where the one before it ends.
        const std::uint64_t first_bits = get(bytes, steps, 2);
        const std::uint64_t number_mask = (1u << number_bits) - 1;
        CHECK(status(steps, (first_bits & ~number_mask) | numbers, 2) == OpenStatus::bad_section);
        CHECK(status(steps, first_bits | number_mask, 2) == OpenStatus::bad_section);
        CHECK(status(blocks, 1) == OpenStatus::bad_section);
        const std::uint64_t second = get(bytes, blocks + ids::block_bytes(true), 4);
        CHECK(status(blocks + ids::block_bytes(true), second - 1) == OpenStatus::bad_section);
        CHECK(status(blocks + ids::block_bytes(true), second + 1) == OpenStatus::bad_section);
        CHECK(status(blocks + ids::block_bytes(true), ~0u) == OpenStatus::bad_section);
        // So does a run of a block.
        const std::uint64_t runs = get(bytes, blocks + ids::runs_at, 4);
        for (const std::uint64_t other : {std::uint64_t{0}, runs + 1, runs + (1u << 10), runs | 1u << 30})
            CHECK(status(blocks + ids::runs_at, other) == OpenStatus::bad_section);
        // Steps end where the header says, and bits that fill them up are zero.
        CHECK(status(at::id_step_bytes_at, step_bytes - 4) == OpenStatus::bad_section);
        CHECK(status(at::id_step_bytes_at, step_bytes + 4) == OpenStatus::bad_section);
        CHECK(status(at::id_step_bytes_at, ~0u) == OpenStatus::bad_section);
        for (const std::uint64_t fewer : {1u, 2u, 3u}) {
            if ((step_bytes - 1) / 4 == (step_bytes - fewer - 1) / 4)
                CHECK(status(at::id_step_bytes_at, step_bytes - fewer) == OpenStatus::bad_section);
        }
        for (std::size_t end = steps + step_bytes; end < blocks; ++end)
            CHECK(status(end, 1, 1) == OpenStatus::bad_section);

        // Any other steps are refused, or lead to triangles that the source has.
        Random random(9);
        int opened = 0;
        for (int i = 0; i < 2000; ++i) {
            Bytes changed = bytes;
            const std::size_t place = kinds + random.below(static_cast<std::uint32_t>(bytes.size() - kinds));
            changed[place] ^= static_cast<std::byte>(1u << random.below(8));
            repair_checksum(changed);
            const Blob blob = open(changed);
            if (!blob) continue;
            ++opened;
            for (std::uint32_t triangle = 0; triangle < 200; ++triangle) {
                const Result<OriginalTriangle> found = original_triangle(blob, {triangle});
                REQUIRE(found);
                const OriginalTriangle& original = *found;
                REQUIRE(original.triangle < 200);
                REQUIRE(original.first_corner < (profile == Profile::fast ? 1 : 3));
            }
        }
        CHECK(opened > 0);
        CHECK(opened < 2000);
    });
}

TEST_CASE("open: ids may have steps of every kind and width up to numbers of 32 bits") {
    for_each_profile([](Profile profile) {
        const std::uint64_t factor = profile == Profile::fast ? 1 : 3;
        const Bytes bytes = bake_or_throw(make_cube(0.0f, 1.0f), {.profile = profile, .original_ids = true});
        const std::size_t kinds = sections_of(bytes) + format::source::bytes;
        REQUIRE(get(bytes, at::id_kind_bits_at, 1) == 0);
        const auto most = static_cast<std::uint32_t>((std::uint64_t{1} << 32) / factor - (factor == 1 ? 1 : 0));
        for (const std::uint32_t count : {most, most + 1}) {
            Bytes widest(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(kinds));
            const auto last = static_cast<std::uint32_t>(factor * most - 1);
            const auto append = [&](std::uint32_t word) {
                widest.resize(widest.size() + 4);
                put(widest, widest.size() - 4, word, 4);
            };
            for (const std::uint32_t word : {0u, 32u, last}) append(word);
            for (unsigned step = 1; step < 12; ++step)  // from the last number to the first and back
                append(step % 2 != 0 ? 0u - last : last);
            append(0);
            append(0);
            put(widest, at::source_triangles_at, count, 4);
            put(widest, at::id_step_bytes_at, 48, 4);
            if (count != most) {  // of profile fast, 0: numbers of no bits
                CHECK(status_resized(widest) == (factor == 1 ? OpenStatus::bad_section : OpenStatus::bad_header));
                continue;
            }
            REQUIRE(status_resized(widest) == OpenStatus::ok);
            put(widest, at::total_bytes_at, widest.size(), 4);
            repair_checksum(widest);
            const GuardedPages pages(widest, true);
            const Blob blob = open(pages.bytes());
            REQUIRE(blob);
            for (std::uint32_t triangle = 0; triangle < 12; ++triangle) {
                const Result<OriginalTriangle> found = original_triangle(blob, {triangle});
                REQUIRE(found);
                const OriginalTriangle& original = *found;
                CHECK(original.triangle == (triangle % 2 != 0 ? 0 : most - 1));
                CHECK(original.first_corner == (triangle % 2 != 0 ? 0 : factor - 1));
            }
        }
    });
}

TEST_CASE("open: each rule of copies is enforced") {
    const Bytes bytes = blob_with_copies();
    REQUIRE(status_of(bytes) == OpenStatus::ok);
    const std::size_t section = sections_of(bytes);
    CHECK(status_with(bytes, section, 0, 4) == OpenStatus::bad_section);  // none, though the map has some
    CHECK(status_with(bytes, section, 1u << 30, 4) == OpenStatus::bad_section);
    CHECK(status_with(bytes, section + format::copies::blocks_at, 1, 4) ==
          OpenStatus::bad_section);  // one before the first
    const std::uint64_t count = get(bytes, section, 4);
    CHECK(status_with(bytes, section, count - 1, 4) == OpenStatus::bad_section);
    // An owner more than there are copies; and one for a copy just behind the last triangle.
    Bytes longer = bytes;
    longer.insert(longer.end(), 4, std::byte{});
    put(longer, section, count + 1, 4);
    CHECK(status_resized(longer) == OpenStatus::bad_section);
    const std::uint64_t triangles = get(bytes, at::triangle_count_at, 4);
    REQUIRE(triangles % format::copies::block_indices != 0);
    const std::size_t block =
        section + format::copies::blocks_at + triangles / format::copies::block_indices * format::copies::block_bytes;
    const std::size_t map_byte = block + format::copies::bits_at + triangles % format::copies::block_indices / 8;
    put(longer, map_byte, get(bytes, map_byte, 1) | 1u << triangles % 8, 1);
    CHECK(status_resized(longer) == OpenStatus::bad_section);
    // A copy of a copy.
    const auto map_byte_of = [&](std::uint64_t index) {
        return section + format::copies::blocks_at +
               index / format::copies::block_indices * format::copies::block_bytes + format::copies::bits_at +
               index % format::copies::block_indices / 8;
    };
    std::vector<std::uint64_t> copies, others;
    for (std::uint64_t i = 0; i < triangles; ++i)
        ((get(bytes, map_byte_of(i), 1) >> i % 8 & 1) != 0 ? copies : others).push_back(i);
    REQUIRE(copies.size() == count);
    REQUIRE(count > 1);
    const std::size_t owners = bytes.size() - 4 * count;
    CHECK(status_with(bytes, owners + 4, copies[0], 4) == OpenStatus::bad_section);
    // More copies than owners: nothing behind the last owner is read, even where the blob's memory ends there.
    REQUIRE(others.back() > copies[0]);
    Bytes marked = bytes;
    const std::size_t extra = map_byte_of(others.back());
    put(marked, extra, get(bytes, extra, 1) | 1u << others.back() % 8, 1);
    CHECK(status_at_end_of_memory(marked) == OpenStatus::bad_section);
    // Cut short: before the section, after the count, before the last owner.
    const std::size_t size = bytes.size() - section;
    CHECK(status_resized(without(bytes, section, size)) == OpenStatus::bad_section);
    CHECK(status_resized(without(bytes, section + 4, size - 4)) == OpenStatus::bad_section);
    CHECK(status_resized(without(bytes, bytes.size() - 4, 4)) == OpenStatus::bad_section);
}

TEST_CASE("open: a map of copies behind the blob is refused before it is read") {
    Bytes bytes = blob_with_copies();
    const std::uint64_t to_the_end = bytes.size() - sections_of(bytes);
    REQUIRE(to_the_end % 4 == 0);
    put(bytes, at::leaf_bytes_at, get(bytes, at::leaf_bytes_at, 4) + to_the_end, 4);
    CHECK(status_at_end_of_memory(bytes) == OpenStatus::bad_section);
}

TEST_CASE("open: each section is checked for every combination of the others") {
    for_each_profile([](Profile profile) {
        BakeOptions options = with_profile(profile);
        if (profile == Profile::fast) {
            options.build.builder = Builder::spatial_splits;
            options.build.duplicate_budget = 1.0;
        }
        options.original_ids = true;
        options.flat_angle = 5.0;
        options.bounds = {true, true, true};
        Bytes bytes;
        Blob blob;
        // How many copies there are depends on the tree. Materials are to need filling up.
        for (unsigned count = 61; blob.triangle_count() % 4 == 0; ++count) {
            Mesh mesh = make_soup(count, 1);
            mesh.materials.assign(mesh.triangles.size(), 7);
            bytes = bake_or_throw(mesh, options);
            blob = open(bytes);
            REQUIRE(blob);
        }
        const detail::BlobData& sections = detail::data_of(blob);
        const auto place_of = [&](const std::byte* section) {
            return static_cast<std::size_t>(section - sections.bytes);
        };
        const auto is_bad = [&](std::size_t place, std::uint64_t value, unsigned size) {
            return status_with(bytes, place, value, size) == OpenStatus::bad_section;
        };
        CHECK(is_bad(place_of(sections.ids) - format::source::bytes, ~0u, 4));
        CHECK(is_bad(place_of(sections.materials) + sections.triangle_count, 1, 1));
        if (profile == Profile::fast) {
            REQUIRE(sections.copy_count != 0);
            CHECK(is_bad(place_of(sections.edge_flags) - format::copies::owner_bytes, ~0u, 4));
        }
        CHECK(is_bad(place_of(sections.edge_flags), ~0u, 4));
        CHECK(is_bad(bytes.size() - 4, ~0u >> 1, 4));
    });
}

}  // namespace
}  // namespace espalier::tests::open_sections_test
