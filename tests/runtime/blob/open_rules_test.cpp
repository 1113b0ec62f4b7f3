// Claims about opening: each rule of the header, the ids, the copies and the padding, broken alone, is why a blob is
// refused. open_test.cpp has those of nodes, leaves, edge flags and bounds.
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include <espalier/espalier.hpp>

#include "support/base/profiles.hpp"
#include "support/base/random.hpp"
#include "support/blobs/baking.hpp"
#include "support/format/node_edits.hpp"
#include "support/machine/guarded_pages.hpp"
#include "support/meshes/makers.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

namespace at = format::header;
namespace feature = format::feature;
using Bytes = std::vector<std::byte>;

Bytes plain_blob(format::Profile profile) {
    return bake_or_throw(make_icosphere(3, 1.0, {0.0f, 0.0f, 0.0f}), with_profile(profile));
}

Bytes blob_with_copies() {
    BakeOptions options = with_profile(format::Profile::fast);
    options.builder = Builder::spatial_splits;
    options.duplicates = 1.0;
    const Bytes bytes = bake_or_throw(make_soup(60, 1), options);
    REQUIRE((get(bytes, at::features_at, 4) & feature::split_references) != 0);
    return bytes;
}

/// Of three sources with a triangle each.
Bytes three_sources(format::Profile profile) {
    std::array<Mesh, 3> meshes = {make_cube(0.0f, 1.0f), make_cube(2.0f, 3.0f), make_cube(4.0f, 5.0f)};
    std::vector<MeshView> views;
    for (Mesh& mesh : meshes) {
        mesh.triangles.resize(1);
        views.push_back(mesh.view());
    }
    BakeOptions options = with_profile(profile);
    options.original_ids = true;
    auto baked = bake(views, options);
    REQUIRE(baked.has_value());
    return baked->blob;
}

Bytes without(Bytes bytes, std::size_t first, std::size_t count) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(first);
    bytes.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
    return bytes;
}

/// Where the first optional section begins.
std::size_t sections_of(const Bytes& bytes) {
    return leaves_of(bytes) + get(bytes, at::leaf_bytes_at, 4) + format::guard_bytes;
}

/// Makes a leaf one of 56 vertices, all but three of them predicted, whose bytes are those up to the end of the
/// section.
void put_widest_predicted_strip(Bytes& bytes, std::size_t descriptor_at, std::size_t data) {
    constexpr unsigned entries = format::predicted_strip::max_vertices;
    const std::size_t left = leaves_of(bytes) + get(bytes, at::leaf_bytes_at, 4) - data;
    put(bytes, descriptor_at, left | (entries - 3) << format::predicted_strip::entries_shift, 2);
    for (unsigned entry = 3; entry < entries; ++entry) {
        const std::size_t bit = format::predicted_strip::marks_at + (entries - 3) + (entry - 3);
        put(bytes, data + bit / 8, get(bytes, data + bit / 8, 1) | 1u << bit % 8, 1);
    }
}

}  // namespace

TEST_SUITE("open rules") {
    TEST_CASE("open: each rule of the header is enforced") {
        for_each_profile([](format::Profile profile) {
            const Bytes bytes = plain_blob(profile);
            REQUIRE(status_of(bytes) == Status::ok);
            const std::uint64_t features = get(bytes, at::features_at, 4);
            const auto refused = [&](std::size_t field, std::uint64_t value, unsigned size) {
                return status_with(bytes, field, value, size) == Status::bad_header;
            };
            CHECK(refused(at::triangle_count_at, std::uint64_t{format::max_triangles} + 1, 4));
            CHECK(refused(at::node_count_at, std::uint64_t{format::max_nodes} + 1, 4));
            CHECK_FALSE(refused(at::triangle_count_at, format::max_triangles, 4));  // wrong, but not for the header
            CHECK_FALSE(refused(at::node_count_at, format::max_nodes, 4));
            CHECK(refused(at::triangle_count_at, 0, 4));  // no triangles, and all the rest
            CHECK(refused(at::node_count_at, 0, 4));
            CHECK(refused(at::leaf_bytes_at, 0, 4));
            CHECK(refused(at::vertex_count_at, 0, 4));
            CHECK(refused(at::depth_at, 0, 1));
            CHECK(refused(at::leaf_bytes_at, get(bytes, at::leaf_bytes_at, 4) + 2, 4));  // no whole words
            CHECK(refused(at::features_at, features | feature::materials_8 | feature::materials_16, 4));
            CHECK((refused(at::features_at, features | feature::split_references, 4) ||
                   profile == format::Profile::fast));
            CHECK(refused(at::max_error_at, 0x7F800000u, 4));
            CHECK_FALSE(refused(at::max_error_at, 0x7F7FFFFFu, 4));
            CHECK(refused(at::id_kind_bits_at, 1, 1));  // ids that are not there
            CHECK(refused(at::source_count_at, 1, 4));
            CHECK(refused(at::id_step_bytes_at, 1, 4));
            CHECK(refused(at::id_kind_bits_at + 1, 1, 1));
            CHECK(refused(at::id_kind_bits_at + 2, 1, 1));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                CHECK(refused(at::origin_at + 4 * axis, 0x00000001u, 4));  // a subnormal number
                CHECK(refused(at::origin_at + 4 * axis, 0x80000000u, 4));  // -0
                CHECK(refused(at::origin_at + 4 * axis, 0x7F800000u, 4));
                CHECK(refused(at::extent_at + 4 * axis, std::uint64_t{1} << get(bytes, at::bits_at, 1), 4));
            }
            Bytes at_zero = bytes;
            put(at_zero, at::origin_at, 0, 4);
            put(at_zero, at::origin_at + 4, 0, 4);
            put(at_zero, at::origin_at + 8, 0, 4);
            CHECK(status_with(three_sources(profile), at::id_kind_bits_at, 8, 1) == Status::bad_header);
            const auto with_step = [&](int exponent) {
                return status_with(at_zero, at::step_exponent_at, static_cast<std::uint16_t>(exponent), 2);
            };
            CHECK(with_step(format::min_step_exponent) == Status::ok);
            CHECK(with_step(format::min_step_exponent - 1) == Status::bad_header);
            CHECK(with_step(format::max_step_exponent) == Status::ok);
            CHECK(with_step(format::max_step_exponent + 1) == Status::bad_header);
            // An origin of 1.5 steps, of 3 and of 2^24 + 2: the last is the step's multiple in its last place.
            const int step = static_cast<std::int16_t>(get(bytes, at::step_exponent_at, 2));
            for (const auto& [steps, expected] :
                 {std::pair(1.5f, Status::bad_header), std::pair(3.0f, Status::ok),
                  std::pair(0x1p-1f, Status::bad_header), std::pair(-0x1.8p0f, Status::bad_header),
                  std::pair(-8388609.0f, Status::ok), std::pair(-4194304.5f, Status::bad_header),
                  std::pair(0x1p24f + 2.0f, Status::ok)}) {
                const auto origin = std::bit_cast<std::uint32_t>(std::ldexp(steps, step));
                CHECK(status_with(at_zero, at::origin_at + 4, origin, 4) == expected);
            }

            const Bytes empty = bake_or_throw(Mesh{}, with_profile(profile));
            REQUIRE(status_of(empty) == Status::ok);
            for (const std::size_t field :
                 {at::triangle_count_at, at::node_count_at, at::leaf_bytes_at, at::vertex_count_at}) {
                CHECK(status_with(empty, field, 4, 4) == Status::bad_header);
            }
            CHECK(status_with(empty, at::depth_at, 1, 1) == Status::bad_header);
            CHECK(status_with(empty, at::bits_at, 0, 1) == Status::bad_header);
            CHECK(status_with(empty, at::features_at, feature::closed, 4) == Status::bad_header);
        });
    }

    TEST_CASE("open: a vertex just outside the extent is refused along each axis") {
        for_each_profile([](format::Profile profile) {
            const Bytes bytes = plain_blob(profile);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::size_t extent_at = at::extent_at + 4 * axis;
                const std::uint64_t extent = get(bytes, extent_at, 4);
                CHECK(status_with(bytes, extent_at, extent - 1, 4) ==
                      (profile == format::Profile::fast ? Status::bad_node : Status::bad_leaf));
            }
        });
    }

    TEST_CASE("open: a node without a parent is refused") {
        for_each_profile([](format::Profile profile) {
            Bytes bytes = plain_blob(profile);
            const std::size_t end = leaves_of(bytes);
            bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(end), format::node_bytes(profile), std::byte{});
            put(bytes, at::node_count_at, get(bytes, at::node_count_at, 4) + 1, 4);
            CHECK(status_resized(bytes) == Status::bad_node);
        });
    }

    TEST_CASE("open: a node with children behind the last node is refused before they are read") {
        for_each_profile([](format::Profile profile) {
            // A root with nodes for children, and those with leaves only. One node fewer, and the last becomes leaves.
            unsigned found = 0;
            for (unsigned side = 4; side <= 16; ++side) {
                const Bytes bytes = bake_or_throw(make_plane_grid(side), with_profile(profile));
                const std::uint64_t nodes = get(bytes, at::node_count_at, 4);
                const std::uint64_t of_root = counts_of(bytes, at::bytes).nodes;
                if (of_root == 0 || nodes != 1 + of_root) continue;
                ++found;
                Bytes changed = bytes;
                put(changed, at::node_count_at, nodes - 1, 4);
                put(changed, at::leaf_bytes_at, get(bytes, at::leaf_bytes_at, 4) + format::node_bytes(profile), 4);
                CHECK(status_resized(changed) == Status::bad_node);
            }
            CHECK(found > 0);
        });
    }

    TEST_CASE("open: a node without children is refused also without planes") {
        for_each_profile([](format::Profile profile) {
            Bytes bytes = bake_or_throw(make_plane_grid(1), with_profile(profile));
            put_counts(bytes, at::bytes, {});
            const NodeLayout layout = layout_of(profile);
            for (std::size_t plane = layout.lo_at; plane < layout.hi_at + 3 * layout.row_bytes; ++plane)
                put(bytes, at::bytes + plane, 0, 1);
            CHECK(status_resized(bytes) == Status::bad_node);
        });
    }

    TEST_CASE("open: a tree deeper than its header is refused on the way down") {
        for_each_profile([](format::Profile profile) {
            constexpr std::uint32_t nodes = 100000;  // so many levels are no part of any stack
            Bytes bytes = bake_or_throw(make_plane_grid(1), with_profile(profile));
            bytes.insert(bytes.begin() + at::bytes, nodes * format::node_bytes(profile), std::byte{});
            for (std::uint32_t i = 0; i < nodes; ++i) put_counts(bytes, node_of(bytes, i), {i + 1, 1, 0});
            put(bytes, at::node_count_at, nodes + 1, 4);
            put(bytes, at::depth_at, format::max_depth, 1);
            CHECK(status_resized(bytes) == Status::bad_node);
        });
    }

    TEST_CASE("open: a leaf beyond the blob is refused before it is read") {
        for_each_profile([](format::Profile profile) {
            namespace plain = format::plain_leaf;
            namespace strips = format::strip_leaf;
            BakeOptions options = with_profile(profile);
            options.bits = 24;
            const Bytes bytes = bake_or_throw(make_plane_grid(1), options);
            const std::size_t descriptor_at = descriptor_of(bytes, at::bytes, 0);
            const unsigned size = descriptor_bytes_of(bytes);
            const auto descriptor = static_cast<std::uint32_t>(get(bytes, descriptor_at, size));
            const std::size_t data = leaf_data_of(bytes, at::bytes, 0);
            const auto is_refused = [](Bytes changed) {
                repair_checksum(changed);
                const GuardedPages pages(changed, true);
                Blob blob;
                return open(pages.bytes(), blob) == Status::bad_leaf;
            };
            const bool has_strips = profile != format::Profile::fast;
            if (!has_strips) {  // a corner that is just no vertex
                Bytes changed = bytes;
                put(changed, data + plain::words_at + 6 * 4, 4, 1);
                CHECK(is_refused(changed));
            }
            // Its data far behind the end.
            Bytes elsewhere = bytes;
            put(elsewhere, descriptor_at, descriptor | ((1u << plain::offset_bits) - 1u), size);
            CHECK(is_refused(elsewhere));
            // More data than there is, of the widest vertices, all of them in one corner.
            Bytes longer = bytes;
            for (std::size_t i = data; i < leaves_of(bytes) + get(bytes, at::leaf_bytes_at, 4); ++i)
                put(longer, i, 0, 1);
            if (profile == format::Profile::tiny) {
                put_widest_predicted_strip(longer, descriptor_at, data);
            } else if (has_strips) {
                put(longer, descriptor_at, std::uint64_t{strips::max_balanced_entries - 3} << strips::entries_shift, 4);
                for (std::size_t i = 0; i < 11; ++i) put(longer, data + i, 0xFF, 1);
                put(longer, data + 11, 0x1F, 1);  // 3 * 31 marks
            } else {
                put(longer, descriptor_at, (descriptor & ~(15u << plain::size_shift)) | 31u << plain::vertices_shift,
                    size);
            }
            CHECK(is_refused(longer));
            // No data at all: in its place is the guard, which would do for a few vertices in one corner.
            Bytes shorter = bytes;
            if (!has_strips) put(shorter, descriptor_at, descriptor & ~(15u << plain::size_shift), size);
            const std::size_t end = leaves_of(bytes) + get(bytes, at::leaf_bytes_at, 4);
            // Of a predicted strip two bytes, since a section is whole words.
            const std::size_t kept_end = !has_strips                        ? data + plain::words_at
                                         : profile == format::Profile::tiny ? data + 2
                                                                            : data;
            put(shorter, at::leaf_bytes_at, kept_end - leaves_of(bytes), 4);
            if (has_strips) put(shorter, at::triangle_count_at, 1, 4);
            shorter = without(shorter, kept_end, end - kept_end);
            CHECK(status_resized(shorter) == Status::bad_leaf);
            // More leaves than there are, and the first descriptor states much data.
            put_counts(shorter, at::bytes, {0, 0, 8});
            for (std::size_t axis = 0; axis < 3 && !has_strips; ++axis)
                for (std::size_t leaf = 1; leaf < 8; ++leaf)
                    put(shorter, at::bytes + format::plain_node::hi_at + 32 * axis + 2 * leaf,
                        get(shorter, at::bytes + format::plain_node::hi_at + 32 * axis, 2), 2);
            put(shorter, descriptor_at, descriptor | 31u << plain::vertices_shift, size);
            put(shorter, at::total_bytes_at, shorter.size(), 4);
            CHECK((has_strips || is_refused(shorter)));
        });
    }

    TEST_CASE("open: the last of many leaves beyond the blob is refused before it is read") {
        for_each_profile([](format::Profile profile) {
            namespace plain = format::plain_leaf;
            namespace strips = format::strip_leaf;
            BakeOptions options = with_profile(profile);
            options.bits = 24;
            const Bytes bytes = bake_or_throw(make_icosphere(3, 1.0, {0.0f, 0.0f, 0.0f}), options);
            std::size_t block = 0, last = 0;  // the block that lies last, and its node
            for (std::size_t node = at::bytes; node < leaves_of(bytes); node += format::node_bytes(profile)) {
                if (counts_of(bytes, node).leaves == 0 || leaf_block_of(bytes, node) < block) continue;
                block = leaf_block_of(bytes, node);
                last = node;
            }
            REQUIRE(block > leaves_of(bytes));
            const std::size_t leaves = counts_of(bytes, last).leaves;
            REQUIRE(leaves > 1);
            const std::size_t descriptor_at = descriptor_of(bytes, last, leaves - 1);
            const unsigned size = descriptor_bytes_of(bytes);
            auto descriptor = static_cast<std::uint32_t>(get(bytes, descriptor_at, size));
            const std::size_t data = leaf_data_of(bytes, last, leaves - 1);
            Bytes longer = bytes;
            const bool has_strips = profile != format::Profile::fast;
            for (std::size_t i = data; i < leaves_of(bytes) + get(bytes, at::leaf_bytes_at, 4); ++i)
                put(longer, i, 0, 1);
            if (profile == format::Profile::tiny) {
                put_widest_predicted_strip(longer, descriptor_at, data);
                descriptor = static_cast<std::uint32_t>(get(longer, descriptor_at, 2));
            } else if (has_strips) {
                descriptor &= ~(63u << strips::entries_shift);
                descriptor |= (strips::max_balanced_entries - 3) << strips::entries_shift;
                for (std::size_t i = 0; i < 11; ++i) put(longer, data + i, 0xFF, 1);
                put(longer, data + 11, 0x1F, 1);
            } else {
                descriptor = (descriptor & ~(15u << plain::size_shift)) | 31u << plain::vertices_shift;
            }
            put(longer, descriptor_at, descriptor, size);
            repair_checksum(longer);
            const GuardedPages pages(longer, true);
            Blob blob;
            CHECK(open(pages.bytes(), blob) == Status::bad_leaf);
        });
    }

    TEST_CASE("open: bad planes of the first absent child are refused") {
        for_each_profile([](format::Profile profile) {
            const Bytes bytes = bake_or_throw(make_plane_grid(1), with_profile(profile));  // one leaf
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const NodeLayout layout = layout_of(profile);
                const std::size_t plane = at::bytes + layout.row_bytes * axis + layout.plane_bytes;
                Bytes changed = bytes;
                put(changed, plane + layout.lo_at, 1, 1);
                put(changed, plane + layout.hi_at, 1, 1);
                CHECK(status_resized(changed) == Status::bad_node);
            }
        });
    }

    TEST_CASE("open: more triangles than in the header are refused at their leaves") {
        for_each_profile([](format::Profile profile) {
            Bytes bytes = plain_blob(profile);
            put_counts(bytes, leaves_of(bytes) - format::node_bytes(profile), {});  // behind them
            CHECK(status_resized(bytes) == Status::bad_node);
            put(bytes, at::triangle_count_at, 1, 4);
            CHECK(status_resized(bytes) == Status::bad_leaf);
        });
    }

    TEST_CASE("open: each part that ends too early is refused") {
        for_each_profile([](format::Profile profile) {
            for (const Materials materials : {Materials::bits_8, Materials::bits_16}) {
                Mesh mesh = make_cube(0.0f, 1.0f);
                mesh.materials.assign(mesh.triangles.size(), 7);
                BakeOptions options = with_profile(profile);
                options.materials = materials;
                options.edge_flags = 5.0;
                options.bounds = {true, true, true};
                const Bytes bytes = bake_or_throw(mesh, options);
                REQUIRE(status_of(bytes) == Status::ok);
                for (std::size_t end = at::bytes; end < bytes.size(); end += 4)
                    CHECK(status_resized(without(bytes, end, bytes.size() - end)) == Status::bad_section);
            }
        });
    }

    TEST_CASE("open: each rule of sources and ids is enforced") {
        for_each_profile([](format::Profile profile) {
            const Bytes bytes = three_sources(profile);
            REQUIRE(status_of(bytes) == Status::ok);
            REQUIRE(get(bytes, at::source_count_at, 4) == 3);
            const std::size_t table = sections_of(bytes);
            const auto with_first = [&](std::size_t source, std::uint64_t first) {
                return status_with(bytes, table + source * format::source::bytes, first, 4);
            };
            CHECK(with_first(1, 1) == Status::ok);
            CHECK(with_first(0, 1) == Status::bad_section);  // the first begins at 0
            CHECK(with_first(1, 3) == Status::bad_section);  // later than the next
            CHECK(with_first(2, 3) == Status::ok);           // the last without a triangle
            CHECK(with_first(2, 4) == Status::bad_section);  // more than there are
            CHECK(status_with(bytes, at::source_triangles_at, 1, 4) == Status::bad_section);
            CHECK(status_with(bytes, at::source_count_at, 0xFFFFFFFFu, 4) == Status::bad_section);
            Bytes no_sources = without(bytes, table, 3 * format::source::bytes);
            put(no_sources, at::source_count_at, 0, 4);
            CHECK(status_resized(no_sources) == Status::bad_section);
            for (std::size_t i = table; i < no_sources.size(); ++i) put(no_sources, i, 0, 1);
            CHECK(status_resized(no_sources) == Status::bad_section);
            CHECK(status_resized(without(bytes, bytes.size() - 4, 4)) == Status::bad_section);
            BakeOptions options = with_profile(profile);
            options.original_ids = true;
            const auto nothing = bake({}, options);
            REQUIRE(nothing.has_value());
            REQUIRE(get(nothing->blob, at::source_count_at, 4) == 0);
            const GuardedPages pages(nothing->blob, true);  // no source is looked at behind its end
            Blob blob;
            CHECK(open(pages.bytes(), blob) == Status::ok);
        });
    }

    TEST_CASE("open: each rule of the steps of ids is enforced") {
        for_each_profile([](format::Profile profile) {
            namespace ids = format::ids;
            BakeOptions options = with_profile(profile);
            options.original_ids = true;
            const Bytes bytes = bake_or_throw(make_plane_grid(10), options);  // 200 triangles: two blocks
            REQUIRE(status_of(bytes) == Status::ok);
            const std::size_t kinds = sections_of(bytes) + format::source::bytes;
            const std::uint64_t kind_bits = get(bytes, at::id_kind_bits_at, 1);
            REQUIRE(kind_bits > 0);
            const std::size_t steps = kinds + (ids::kind_bytes << kind_bits);
            const std::uint64_t step_bytes = get(bytes, at::id_step_bytes_at, 4);
            const std::size_t blocks = (steps + step_bytes + 3) / 4 * 4;
            REQUIRE(bytes.size() == blocks + 2 * ids::block_bytes);
            const std::uint64_t numbers = profile == format::Profile::fast ? 200 : 600;
            const unsigned number_bits = profile == format::Profile::fast ? 8 : 10;
            const auto status = [&](std::size_t place, std::uint64_t value, unsigned size = 4) {
                return status_with(bytes, place, value, size);
            };

            // Fields, prefixes and places of recent numbers are in range.
            for (std::size_t kind = 0; kind >> kind_bits == 0; ++kind) {
                const std::size_t place = kinds + kind * ids::kind_bytes;
                CHECK(status(place + ids::width_at, number_bits + 1, 1) == Status::bad_section);
                CHECK(status(place + ids::prefix_at, kind_bits + 1, 1) == Status::bad_section);
                CHECK(status(place + ids::from_at, ids::recent_numbers, 1) == Status::bad_section);
                CHECK(status(place + ids::replaced_at, ids::recent_numbers, 1) == Status::bad_section);
            }
            // A block begins with a number that a source can have, and where the one before it ends.
            const std::uint64_t first_bits = get(bytes, steps, 2);
            const std::uint64_t number_mask = (1u << number_bits) - 1;
            CHECK(status(steps, (first_bits & ~number_mask) | numbers, 2) == Status::bad_section);
            CHECK(status(steps, first_bits | number_mask, 2) == Status::bad_section);
            CHECK(status(blocks, 1) == Status::bad_section);
            const std::uint64_t second = get(bytes, blocks + ids::block_bytes, 4);
            CHECK(status(blocks + ids::block_bytes, second - 1) == Status::bad_section);
            CHECK(status(blocks + ids::block_bytes, second + 1) == Status::bad_section);
            CHECK(status(blocks + ids::block_bytes, ~0u) == Status::bad_section);
            // Steps end where the header says, and bits that fill them up are zero.
            CHECK(status(at::id_step_bytes_at, step_bytes - 4) == Status::bad_section);
            CHECK(status(at::id_step_bytes_at, step_bytes + 4) == Status::bad_section);
            CHECK(status(at::id_step_bytes_at, ~0u) == Status::bad_section);
            for (const std::uint64_t fewer : {1u, 2u, 3u}) {
                if ((step_bytes - 1) / 4 == (step_bytes - fewer - 1) / 4)
                    CHECK(status(at::id_step_bytes_at, step_bytes - fewer) == Status::bad_section);
            }
            for (std::size_t end = steps + step_bytes; end < blocks; ++end)
                CHECK(status(end, 1, 1) == Status::bad_section);

            // Any other steps are refused, or lead to triangles that the source has.
            Random random(9);
            int opened = 0;
            for (int i = 0; i < 2000; ++i) {
                Bytes changed = bytes;
                const std::size_t place = kinds + random.below(static_cast<std::uint32_t>(bytes.size() - kinds));
                changed[place] ^= static_cast<std::byte>(1u << random.below(8));
                repair_checksum(changed);
                Blob blob;
                if (open(changed, blob) != Status::ok) continue;
                ++opened;
                for (std::uint32_t triangle = 0; triangle < 200; ++triangle) {
                    OriginalTriangle original;
                    REQUIRE(original_triangle(blob, {triangle}, original));
                    REQUIRE(original.triangle < 200);
                    REQUIRE(original.first_corner < (profile == format::Profile::fast ? 1 : 3));
                }
            }
            CHECK(opened > 0);
            CHECK(opened < 2000);
        });
    }

    TEST_CASE("open: ids may have steps of every kind and width up to numbers of 32 bits") {
        for_each_profile([](format::Profile profile) {
            const std::uint64_t factor = profile == format::Profile::fast ? 1 : 3;
            BakeOptions options = with_profile(profile);
            options.original_ids = true;
            const Bytes bytes = bake_or_throw(make_cube(0.0f, 1.0f), options);
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
                put(widest, at::source_triangles_at, count, 4);
                put(widest, at::id_step_bytes_at, 48, 4);
                if (count != most) {  // of profile fast, 0: numbers of no bits
                    CHECK(status_resized(widest) == (factor == 1 ? Status::bad_section : Status::bad_header));
                    continue;
                }
                REQUIRE(status_resized(widest) == Status::ok);
                put(widest, at::total_bytes_at, widest.size(), 4);
                repair_checksum(widest);
                const GuardedPages pages(widest, true);
                Blob blob;
                REQUIRE(open(pages.bytes(), blob) == Status::ok);
                OriginalTriangle original;
                for (std::uint32_t triangle = 0; triangle < 12; ++triangle) {
                    REQUIRE(original_triangle(blob, {triangle}, original));
                    CHECK(original.triangle == (triangle % 2 != 0 ? 0 : most - 1));
                    CHECK(original.first_corner == (triangle % 2 != 0 ? 0 : factor - 1));
                }
            }
        });
    }

    TEST_CASE("open: each rule of copies is enforced") {
        const Bytes bytes = blob_with_copies();
        REQUIRE(status_of(bytes) == Status::ok);
        const std::size_t section = sections_of(bytes);
        CHECK(status_with(bytes, section, 0, 4) == Status::bad_section);  // none, though the map has some
        CHECK(status_with(bytes, section, 1u << 30, 4) == Status::bad_section);
        const std::uint64_t count = get(bytes, section, 4);
        CHECK(status_with(bytes, section, count - 1, 4) == Status::bad_section);
        // An owner more than there are copies; and one for a copy just behind the last triangle.
        Bytes longer = bytes;
        longer.insert(longer.end(), 4, std::byte{});
        put(longer, section, count + 1, 4);
        CHECK(status_resized(longer) == Status::bad_section);
        const std::uint64_t triangles = get(bytes, at::triangle_count_at, 4);
        REQUIRE(triangles % format::copies::block_indices != 0);
        const std::size_t block = section + format::copies::blocks_at +
                                  triangles / format::copies::block_indices * format::copies::block_bytes;
        const std::size_t map_byte = block + format::copies::bits_at + triangles % format::copies::block_indices / 8;
        put(longer, map_byte, get(bytes, map_byte, 1) | 1u << triangles % 8, 1);
        CHECK(status_resized(longer) == Status::bad_section);
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
        CHECK(status_with(bytes, owners + 4, copies[0], 4) == Status::bad_section);
        // More copies than owners: nothing behind the last owner is read, even where the blob's memory ends there.
        REQUIRE(others.back() > copies[0]);
        Bytes marked = bytes;
        const std::size_t extra = map_byte_of(others.back());
        put(marked, extra, get(bytes, extra, 1) | 1u << others.back() % 8, 1);
        repair_checksum(marked);
        const GuardedPages pages(marked, true);
        Blob blob;
        CHECK(open(pages.bytes(), blob) == Status::bad_section);
        // Cut short: before the section, after the count, before the last owner.
        const std::size_t size = bytes.size() - section;
        CHECK(status_resized(without(bytes, section, size)) == Status::bad_section);
        CHECK(status_resized(without(bytes, section + 4, size - 4)) == Status::bad_section);
        CHECK(status_resized(without(bytes, bytes.size() - 4, 4)) == Status::bad_section);
    }

    TEST_CASE("open: a map of copies behind the blob is refused before it is read") {
        Bytes bytes = blob_with_copies();
        const std::uint64_t to_the_end = bytes.size() - sections_of(bytes);
        REQUIRE(to_the_end % 4 == 0);
        put(bytes, at::leaf_bytes_at, get(bytes, at::leaf_bytes_at, 4) + to_the_end, 4);
        repair_checksum(bytes);
        const GuardedPages pages(bytes, true);
        Blob blob;
        CHECK(open(pages.bytes(), blob) == Status::bad_section);
    }

    TEST_CASE("open: each section is checked for every combination of the others") {
        for_each_profile([](format::Profile profile) {
            BakeOptions options = with_profile(profile);
            if (profile == format::Profile::fast) {
                options.builder = Builder::spatial_splits;
                options.duplicates = 1.0;
            }
            options.original_ids = true;
            options.materials = Materials::bits_8;
            options.edge_flags = 5.0;
            options.bounds = {true, true, true};
            Bytes bytes;
            Blob blob;
            // How many copies there are depends on the tree. Materials are to need filling up.
            for (unsigned count = 61; blob.triangle_count() % 4 == 0; ++count) {
                Mesh mesh = make_soup(count, 1);
                mesh.materials.assign(mesh.triangles.size(), 7);
                bytes = bake_or_throw(mesh, options);
                REQUIRE(open(bytes, blob) == Status::ok);
            }
            const detail::BlobData& sections = blob.data();
            const auto place_of = [&](const std::byte* section) {
                return static_cast<std::size_t>(section - sections.bytes);
            };
            const auto is_bad = [&](std::size_t place, std::uint64_t value, unsigned size) {
                return status_with(bytes, place, value, size) == Status::bad_section;
            };
            CHECK(is_bad(place_of(sections.ids) - format::source::bytes, ~0u, 4));
            CHECK(is_bad(place_of(sections.materials) + sections.triangle_count, 1, 1));
            if (profile == format::Profile::fast) {
                REQUIRE(sections.copy_count != 0);
                CHECK(is_bad(place_of(sections.edge_flags) - format::copies::owner_bytes, ~0u, 4));
            }
            CHECK(is_bad(place_of(sections.edge_flags), ~0u, 4));
            CHECK(is_bad(bytes.size() - 4, ~0u >> 1, 4));
        });
    }

    TEST_CASE("open: an empty map of copies is refused") {
        Bytes bytes = plain_blob(format::Profile::fast);
        const std::uint32_t triangles = static_cast<std::uint32_t>(get(bytes, at::triangle_count_at, 4));
        const std::size_t section = bytes.size();
        bytes.resize(section + format::copies::blocks_at + format::copies::blocks_bytes(triangles));
        put(bytes, at::features_at, get(bytes, at::features_at, 4) | feature::split_references, 4);
        CHECK(status_resized(bytes) == Status::bad_section);
        // With one it is a blob: the last triangle as a copy of the first.
        put(bytes, section, 1, 4);
        const std::size_t block = bytes.size() - format::copies::block_bytes;
        const unsigned last = (triangles - 1) % format::copies::block_indices;
        put(bytes, block + format::copies::bits_at + last / 8, 1u << last % 8, 1);
        bytes.resize(bytes.size() + format::copies::owner_bytes);
        CHECK(status_resized(bytes) == Status::ok);
    }

    TEST_CASE("open: each rule of plain leaves is enforced in each leaf") {
        namespace leaf = format::plain_leaf;
        for (const unsigned bits : {12u, 20u}) {
            BakeOptions options = with_profile(format::Profile::fast);
            options.bits = bits;
            const Bytes bytes = bake_or_throw(make_icosphere(4, 1.0, {0.0f, 0.0f, 0.0f}), options);
            REQUIRE(get(bytes, at::bits_at, 1) == bits);
            std::size_t blocks = 0, without_block = 0, gaps = 0, later = 0;
            for (std::size_t node = at::bytes; node < leaves_of(bytes); node += format::plain_node::bytes) {
                const std::size_t leaves = counts_of(bytes, node).leaves;
                if (leaves == 0) {  // then it has no block either
                    CHECK(status_with(bytes, node + format::plain_node::leaf_block_at, 1, 4) == Status::bad_node);
                    ++without_block;
                    continue;
                }
                ++blocks;
                for (std::size_t number = 0; number < leaves; ++number) {
                    const std::size_t descriptor_at = descriptor_of(bytes, node, number);
                    const auto descriptor = static_cast<std::uint32_t>(get(bytes, descriptor_at, 3));
                    const std::size_t vertices = (descriptor >> leaf::vertices_shift & 31u) + 1;
                    const std::size_t slots = (descriptor >> leaf::triangles_shift & 15u) + 1;
                    const std::size_t begin = leaf_data_of(bytes, node, number);
                    for (const unsigned shift : {0u, leaf::size_shift}) {
                        CHECK(status_with(bytes, descriptor_at, descriptor + (1u << shift), 3) == Status::bad_leaf);
                        CHECK(status_with(bytes, descriptor_at, descriptor - (1u << shift), 3) == Status::bad_leaf);
                    }
                    const std::uint64_t first = get(bytes, begin + leaf::first_at, 4);
                    CHECK(status_with(bytes, begin + leaf::first_at, first + 1, 4) == Status::bad_leaf);
                    CHECK(status_with(bytes, begin + leaf::first_at, first - 1, 4) == Status::bad_leaf);
                    if (number != 0) ++later;
                    const std::size_t corners = begin + leaf::words_at + 6 * vertices;
                    for (const std::size_t corner : {std::size_t{0}, slots - 1, 3 * slots - 1})
                        CHECK(status_with(bytes, corners + corner, vertices, 1) == Status::bad_leaf);
                    const std::size_t leaf_end = corners + 3 * slots + (bits > 16 ? 3 * vertices : 0);
                    const std::size_t padding = (4 - (leaf_end - begin) % 4) % 4;  // to the next leaf or the end
                    gaps += padding;
                    for (std::size_t i = 0; i < padding; ++i)
                        CHECK(status_with(bytes, leaf_end + i, 1, 1) == Status::bad_leaf);
                }
            }
            CHECK(blocks > 4);
            CHECK(without_block > 0);
            CHECK(later > 4);
            CHECK(gaps > 4);
        }
    }

    TEST_CASE("open: a plain leaf wholly beyond the extent is refused in each bit") {
        namespace leaf = format::plain_leaf;
        for (const unsigned bits : {7u, 16u, 17u, 24u}) {
            BakeOptions options = with_profile(format::Profile::fast);
            options.bits = bits;
            const Bytes bytes = bake_or_throw(make_plane_grid(1), options);  // 4 vertices whose z is 0, 2 triangles
            REQUIRE(get(bytes, at::bits_at, 1) == bits);
            REQUIRE(get(bytes, at::extent_at + 8, 4) == 0);
            const std::size_t data = leaf_data_of(bytes, at::bytes, 0) + leaf::words_at;
            const std::size_t bytes_above = data + 6 * 4 + 3 * 2;
            for (unsigned bit = 0; bit < (bits > 16 ? 24u : 16u); ++bit) {
                Bytes moved = bytes;
                for (std::size_t vertex = 0; vertex < 4; ++vertex) {
                    if (bit < 16) put(moved, data + 2 * (8 + vertex), 1u << bit, 2);
                    else put(moved, bytes_above + 8 + vertex, 1u << (bit - 16), 1);
                }
                CHECK(status_resized(moved) == Status::bad_leaf);
                put(moved, at::extent_at + 8, 1u << bit, 4);
                CHECK(status_resized(moved) == (bit < bits ? Status::ok : Status::bad_header));
            }
        }
    }
}
