// Sections of original ids that no baker writes: each rule of their steps is why `open` refuses one, without a read
// behind the blob's last byte, and what it accepts leads to the right triangles.
#include <doctest/doctest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include <espalier/espalier.hpp>
#include <espalier/original.hpp>

#include "../support/baking.hpp"
#include "../support/blob_edits.hpp"
#include "../support/guarded_pages.hpp"
#include "../support/mesh_makers.hpp"
#include "../support/profiles.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

namespace at = format::header;
namespace ids = format::ids;
using Bytes = std::vector<std::byte>;

struct Kind {
    std::uint32_t offset, width;
};

/// The first number of a block, and where its steps begin.
struct Block {
    std::uint32_t number, steps;
};

/// Bits, low ones first.
class BitWriter {
public:
    BitWriter& add(std::uint32_t value, unsigned width) {
        for (unsigned i = 0; i < width; ++i, ++bit_) {
            if (bit_ % 8 == 0) bytes_.push_back(std::byte{0});
            bytes_.back() |= static_cast<std::byte>((value >> i & 1u) << (bit_ % 8));
        }
        return *this;
    }
    /// Goes on in the next byte.
    BitWriter& end_block() {
        bit_ = 8 * static_cast<unsigned>(bytes_.size());
        return *this;
    }
    [[nodiscard]] const Bytes& bytes() const { return bytes_; }

private:
    Bytes bytes_;
    unsigned bit_ = 0;
};

Bytes zeros(std::size_t count) { return Bytes(count, std::byte{0}); }

/// A grid of 2 * side * side triangles with another section of ids, which is the last one.
struct Section {
    format::Profile profile;
    unsigned side;
    std::vector<Kind> kinds;  // a power of two of them
    std::vector<Block> blocks;
    Bytes steps;
    std::uint64_t source_triangles = 0;  // 0: as baked

    [[nodiscard]] Bytes blob() const {
        BakeOptions options = with_profile(profile);
        options.original_ids = true;
        Bytes bytes = bake_or_throw(make_plane_grid(side), options);
        const std::size_t begin = at::bytes + get(bytes, at::node_count_at, 4) * format::node::bytes +
                                  get(bytes, at::leaf_bytes_at, 4) + format::guard_bytes + format::source::bytes;
        bytes.resize(begin);
        const auto append = [&](std::uint32_t value) {
            bytes.resize(bytes.size() + 4);
            put(bytes, bytes.size() - 4, value, 4);
        };
        std::uint64_t kind_bits = 0;
        while (std::size_t{1} << kind_bits < kinds.size()) ++kind_bits;
        for (const Kind& kind : kinds) {
            append(kind.offset);
            append(kind.width);
        }
        for (const Block& block : blocks) {
            append(block.number);
            append(block.steps);
        }
        bytes.insert(bytes.end(), steps.begin(), steps.end());
        while (bytes.size() % 4 != 0) bytes.push_back(std::byte{0});
        put(bytes, at::id_kind_bits_at, kind_bits, 1);
        put(bytes, at::id_step_bytes_at, steps.size(), 4);
        if (source_triangles != 0) put(bytes, at::source_triangles_at, source_triangles, 4);
        put(bytes, at::total_bytes_at, bytes.size(), 4);
        repair_checksum(bytes);
        return bytes;
    }
    [[nodiscard]] Status status() const {
        const GuardedPages pages(blob(), true);
        Blob opened;
        return open(pages.bytes(), opened);
    }
};

}  // namespace

TEST_SUITE("open ids") {
    TEST_CASE("open: steps of ids end where the header says and no byte behind them is read") {
        for_each_profile([](format::Profile profile) {
            // 49 steps of 4 bits: 24 bytes and a half.
            const auto in_fields = [&](Bytes steps) {
                return Section{profile, 5, {{0, 4}}, {{0, 0}}, std::move(steps)}.status();
            };
            CHECK(in_fields(zeros(25)) == Status::ok);
            CHECK(in_fields(zeros(24)) == Status::bad_section);
            CHECK(in_fields(zeros(26)) == Status::bad_section);
            CHECK(in_fields(zeros(0)) == Status::bad_section);
            Bytes padded = zeros(25);
            padded.back() = std::byte{0x10};
            CHECK(in_fields(padded) == Status::bad_section);
            // 49 steps of a kind alone: 6 bytes and a bit.
            const auto in_kinds = [&](Bytes steps) {
                return Section{profile, 5, {{0, 0}, {0, 0}}, {{0, 0}}, std::move(steps)}.status();
            };
            CHECK(in_kinds(zeros(7)) == Status::ok);
            CHECK(in_kinds(zeros(4)) == Status::bad_section);
            CHECK(in_kinds(zeros(8)) == Status::bad_section);
        });
    }

    TEST_CASE("open: each block of ids has the steps that are left for it") {
        for_each_profile([](format::Profile profile) {
            // 127 and 71 steps of 4 bits: 64 and 36 bytes.
            const auto status = [&](std::uint32_t second, std::size_t bytes) {
                return Section{profile, 10, {{0, 4}}, {{0, 0}, {0, second}}, zeros(bytes)}.status();
            };
            CHECK(status(64, 100) == Status::ok);
            CHECK(status(64, 96) == Status::bad_section);
            CHECK(status(64, 104) == Status::bad_section);
            CHECK(status(63, 100) == Status::bad_section);
            CHECK(status(65, 101) == Status::bad_section);
        });
    }

    TEST_CASE("open: a kind of step that is not used obeys the rules too") {
        for_each_profile([](format::Profile profile) {
            const std::uint32_t number_bits = profile == format::Profile::fast ? 6 : 8;
            const auto status = [&](std::uint32_t width) {
                return Section{profile, 5, {{0, 0}, {0, width}}, {{0, 0}}, zeros(7)}.status();
            };
            CHECK(status(number_bits) == Status::ok);
            CHECK(status(number_bits + 1) == Status::bad_section);
            CHECK(status(33) == Status::bad_section);
            CHECK(status(~0u) == Status::bad_section);
        });
    }

    TEST_CASE("open: numbers of ids fill 32 bits and no more") {
        for_each_profile([](format::Profile profile) {
            const std::uint32_t corners = profile == format::Profile::fast ? 1 : 3;
            // 49 steps of 4 and 32 bits: 220 bytes and a half.
            const auto status = [&](std::uint64_t source_triangles, std::uint32_t number) {
                return Section{profile,       5,          std::vector<Kind>(16, Kind{0, 32}),
                               {{number, 0}}, zeros(221), source_triangles}
                    .status();
            };
            const std::uint32_t most = ~0u / corners;
            CHECK(status(most, corners * most - 1) == Status::ok);
            CHECK(status(most, corners * most) == Status::bad_section);
            if (corners != 1) CHECK(status(std::uint64_t{most} + 1, 0) == Status::bad_header);
        });
    }

    TEST_CASE("source triangle: steps of several kinds lead through two blocks") {
        BitWriter steps;
        std::vector<std::uint32_t> expected;
        for (const auto& [first, count] : {std::pair{0u, 128u}, std::pair{7u, 72u}}) {
            std::uint32_t number = first;
            for (std::uint32_t i = 0; i < count; ++i) {
                expected.push_back(number);
                if (i + 1 == count) break;
                if (i % 2 == 0) {
                    steps.add(0, 1);
                    number += 1;
                } else {
                    steps.add(1, 1).add(i % 4, 3);
                    number = number + i % 4 - 1;
                }
            }
            steps.end_block();
        }
        const std::size_t first_bytes = (63u * 4 + 64 + 7) / 8;
        const Section section{format::Profile::fast,
                              10,
                              {{1, 0}, {~0u, 3}},
                              {{0, 0}, {7, static_cast<std::uint32_t>(first_bytes)}},
                              steps.bytes()};
        const GuardedPages pages(section.blob(), true);
        Blob blob;
        REQUIRE(open(pages.bytes(), blob) == Status::ok);
        REQUIRE(blob.triangle_count() == expected.size());
        for (std::uint32_t i = 0; i < blob.triangle_count(); ++i) {
            OriginalTriangle original;
            REQUIRE(original_triangle(blob, {i}, original));
            CHECK(original.triangle == expected[i]);
            CHECK(original.first_corner == 0);
        }
    }
}
