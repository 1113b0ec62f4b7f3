// Sections of original ids that no baker writes: each rule of their steps is why `open` refuses one, without a read
// behind the blob's last byte, and what it accepts leads to the right triangles.
#include "support/testing.hpp"

#include "open_blobs.hpp"

namespace espalier::tests::open_ids_test {
namespace {

using namespace espalier::tests::opening;
namespace ids = format::ids;
struct Kind {
    std::uint32_t offset = 0, width = 0, prefix = 0, from = 0, replaced = 0;
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
    BitWriter& end_run() {
        bit_ = 8 * static_cast<unsigned>(bytes_.size());
        return *this;
    }
    [[nodiscard]] const Bytes& bytes() const { return bytes_; }

private:
    Bytes bytes_;
    unsigned bit_ = 0;
};

/// Where runs 1, 2 and 3 of a block begin.
std::uint32_t runs(std::uint32_t first, std::uint32_t second = 0, std::uint32_t third = 0) {
    return first | second << 10 | third << 20;
}

Bytes zeros(std::size_t count) { return Bytes(count, std::byte{0}); }

/// A grid of 2 * side * side triangles with another section of ids, which is the last one.
struct Section {
    Profile profile;
    unsigned side;
    std::vector<Kind> kinds;  // a power of two of them
    Bytes steps;
    std::vector<std::uint32_t> blocks = {0, 0};  // where the bits of each begin, and those of its runs
    std::uint64_t source_triangles = 0;          // 0: as baked
    bool has_runs = true;

    [[nodiscard]] Bytes blob() const {
        Bytes bytes = bake_or_throw(make_plane_grid(side), {.profile = profile, .original_ids = true});
        const std::size_t begin = sections_of(bytes) + format::source::bytes;
        bytes.resize(begin);
        const auto append = [&](std::uint32_t value) {
            bytes.resize(bytes.size() + 4);
            put(bytes, bytes.size() - 4, value, 4);
        };
        std::uint64_t kind_bits = 0;
        while (std::size_t{1} << kind_bits < kinds.size()) ++kind_bits;
        for (const Kind& kind : kinds) {
            append(kind.offset);
            append(kind.width | kind.prefix << 8 | kind.from << 16 | kind.replaced << 24);
        }
        bytes.insert(bytes.end(), steps.begin(), steps.end());
        while (bytes.size() % 4 != 0) bytes.push_back(std::byte{0});
        for (const std::uint32_t block : blocks) append(block);
        put(bytes, at::id_kind_bits_at, kind_bits, 1);
        put(bytes, at::id_step_bytes_at, steps.size(), 4);
        if (source_triangles != 0) put(bytes, at::source_triangles_at, source_triangles, 4);
        if (!has_runs)
            put(bytes, at::features_at, get(bytes, at::features_at, 4) & ~std::uint64_t{format::feature::id_runs}, 4);
        put(bytes, at::total_bytes_at, bytes.size(), 4);
        repair_checksum(bytes);
        return bytes;
    }
    [[nodiscard]] OpenStatus status() const { return status_at_end_of_memory(blob()); }
};

TEST_CASE("open: runs of ids need ids and version 2.2") {
    for_each_profile([](Profile profile) {
        const Mesh mesh = make_plane_grid(12);
        const Bytes bytes = bake_or_throw(mesh, {.profile = profile, .original_ids = true});
        const std::uint64_t features = get(bytes, at::features_at, 4);
        REQUIRE((features & format::feature::id_runs) != 0);
        CHECK(get(bytes, at::version_minor_at, 2) == 2);
        CHECK(status_with(bytes, at::version_minor_at, 1, 2) == OpenStatus::bad_header);
        CHECK(status_with(bytes, at::features_at, features & ~std::uint64_t{format::feature::original_ids}, 4) ==
              OpenStatus::bad_header);
        const Bytes without = bake_or_throw(mesh, {.profile = profile});
        CHECK(status_with(without, at::features_at, get(without, at::features_at, 4) | format::feature::id_runs, 4) ==
              OpenStatus::bad_header);
    });
}

TEST_CASE("open: steps of ids end where the header states and no byte behind them is read") {
    for_each_profile([](Profile profile) {
        const std::size_t number_bits = profile == Profile::fast ? 6 : 8;
        // 31 steps after the first number, then 18 in another run.
        for (const std::size_t width : {0u, 4u}) {
            for (const unsigned kind_bits : {0u, 1u, 7u}) {
                CAPTURE(width);
                CAPTURE(kind_bits);
                const std::vector<Kind> kinds(std::size_t{1} << kind_bits,
                                              {0, static_cast<std::uint32_t>(width), kind_bits});
                const std::size_t first_bits = number_bits + 31 * (width + kind_bits), second = (first_bits + 7) / 8;
                const std::size_t bits = 8 * second + 18 * (width + kind_bits);
                const std::size_t bytes = (bits + 7) / 8;
                const auto status = [&](const Bytes& steps) {
                    return Section{profile, 5, kinds, steps, {0, static_cast<std::uint32_t>(second)}}.status();
                };
                CHECK(status(zeros(bytes)) == OpenStatus::ok);
                // Of nothing, of the first number alone, a byte less, a byte more.
                for (const std::size_t other : {std::size_t{0}, std::size_t{1}, bytes - 1, bytes + 1})
                    if (other != bytes) CHECK(status(zeros(other)) == OpenStatus::bad_section);
                for (const std::size_t end : {first_bits, bits}) {
                    if (end % 8 == 0) continue;
                    Bytes padded = zeros(bytes);
                    padded[end / 8] = static_cast<std::byte>(1u << end % 8);
                    CHECK(status(padded) == OpenStatus::bad_section);
                }
            }
        }
    });
}

TEST_CASE("open: steps of ids without runs follow each other without a gap") {
    for_each_profile([](Profile profile) {
        // A first number and 49 steps of 3 bits.
        const std::size_t bits = (profile == Profile::fast ? 6 : 8) + 49 * 3, bytes = (bits + 7) / 8;
        const auto status = [&](const Bytes& steps) {
            return Section{profile, 5, {{0, 3}}, steps, {0}, 0, false}.status();
        };
        CHECK(status(zeros(bytes)) == OpenStatus::ok);
        CHECK(status(zeros(bytes - 1)) == OpenStatus::bad_section);
        CHECK(status(zeros(bytes + 1)) == OpenStatus::bad_section);
        Bytes padded = zeros(bytes);
        padded.back() = static_cast<std::byte>(1u << bits % 8);
        CHECK(status(padded) == OpenStatus::bad_section);
    });
}

TEST_CASE("open: a first number of ids that does not fit into the steps is refused") {
    for (const std::size_t bytes : {0u, 1u, 2u}) {
        // 10 bits, and no step takes any.
        CHECK(Section{Profile::balanced, 7, {{}}, zeros(bytes), {0, runs(2, 2, 2)}, 1024 / 3}.status() ==
              (bytes == 2 ? OpenStatus::ok : OpenStatus::bad_section));
    }
    // 256 numbers take 8 bits, one more takes 9.
    for (const std::uint64_t numbers : {256u, 257u}) {
        CHECK(Section{Profile::fast, 7, {{}}, zeros(1), {0, runs(1, 1, 1)}, numbers}.status() ==
              (numbers == 256 ? OpenStatus::ok : OpenStatus::bad_section));
    }
}

TEST_CASE("open: each block of ids has the steps that are left for it") {
    for_each_profile([](Profile profile) {
        // 8 or 10 bits of a first number, then 31, 32, 32, 32 steps of 4 bits, and 31, 32, 8: 65 and 37 bytes.
        const auto status = [&](std::uint32_t second, std::size_t bytes, std::uint32_t first_runs = runs(17, 33, 49),
                                std::uint32_t second_runs = runs(17, 33)) {
            return Section{profile, 10, {{0, 4}}, zeros(bytes), {0, first_runs, second, second_runs}}.status();
        };
        CHECK(status(65, 102) == OpenStatus::ok);
        CHECK(status(65, 101) == OpenStatus::bad_section);
        CHECK(status(65, 98) == OpenStatus::bad_section);
        CHECK(status(65, 66) == OpenStatus::bad_section);  // the steps would end behind the blob
        CHECK(status(65, 103) == OpenStatus::bad_section);
        CHECK(status(65, 106) == OpenStatus::bad_section);
        CHECK(status(64, 102) == OpenStatus::bad_section);
        CHECK(status(66, 103) == OpenStatus::bad_section);
        CHECK(status(~0u, 102) == OpenStatus::bad_section);
        for (unsigned bit = 0; bit < 32; ++bit) {
            CHECK(status(65, 102, runs(17, 33, 49) ^ 1u << bit) == OpenStatus::bad_section);
            CHECK(status(65, 102, runs(17, 33, 49), runs(17, 33) ^ 1u << bit) == OpenStatus::bad_section);
        }
    });
}

TEST_CASE("open: a kind of step that is not used obeys the rules too") {
    for_each_profile([](Profile profile) {
        const std::uint32_t number_bits = profile == Profile::fast ? 6 : 8;
        const auto status = [&](const Kind& unused) {
            return Section{profile, 5, {{0, 0, 1}, unused}, zeros(8), {0, runs(5)}}.status();
        };
        CHECK(status({~0u, number_bits, 1, 7, 7}) == OpenStatus::ok);
        CHECK(status({0, 0, 0, 0, 0}) == OpenStatus::ok);
        for (const std::uint32_t more : {1u, 255u - number_bits})
            CHECK(status({0, number_bits + more, 1}) == OpenStatus::bad_section);
        for (const std::uint32_t prefix : {2u, 255u}) CHECK(status({0, 0, prefix}) == OpenStatus::bad_section);
        for (const std::uint32_t place : {8u, 255u}) {
            CHECK(status({0, 0, 1, place, 0}) == OpenStatus::bad_section);
            CHECK(status({0, 0, 1, 0, place}) == OpenStatus::bad_section);
        }
    });
}

TEST_CASE("open: numbers of ids fill 32 bits and no more") {
    for_each_profile([](Profile profile) {
        const std::uint32_t corners = profile == Profile::fast ? 1 : 3;
        // A first number and 31 and 18 steps of 7 and 32 bits.
        const auto status = [&](std::uint64_t source_triangles, std::uint32_t number) {
            BitWriter steps;
            steps.add(number, 32);
            for (int i = 0; i < 31; ++i) steps.add(0, 32).add(0, 7);
            const std::uint32_t run = runs(static_cast<std::uint32_t>(steps.end_run().bytes().size()));
            for (int i = 0; i < 18; ++i) steps.add(0, 32).add(0, 7);
            const std::vector<Kind> kinds(128, Kind{0, 32, 7});
            return Section{profile, 5, kinds, steps.bytes(), {0, run}, source_triangles}.status();
        };
        const std::uint32_t most = ~0u / corners;
        CHECK(status(most, corners * most - 1) == OpenStatus::ok);
        CHECK(status(most, corners * most) == OpenStatus::bad_section);
        if (corners != 1) CHECK(status(std::uint64_t{most} + 1, 0) == OpenStatus::bad_header);
    });
}

TEST_CASE("source triangle: steps of several kinds lead through two blocks") {
    // Codes 0, 01 and 11: on by one in the newest row; -1 .. 6 on from the oldest number of three, whose row goes
    // on; and by 9 to a new row.
    const std::vector<Kind> kinds = {{1, 0, 1}, {~0u, 3, 2, 2, 2}, {1, 0, 1}, {9, 0, 2, 0, 7}};
    BitWriter steps;
    std::vector<std::uint32_t> expected, begins;
    for (const auto& [first, count] : {std::pair{5u, 128u}, std::pair{7u, 72u}}) {
        const std::size_t begin = steps.bytes().size();
        begins.insert(begins.end(), {static_cast<std::uint32_t>(begin), 0});
        steps.add(first, 8);
        std::vector<std::uint32_t> recent(8, first);
        for (std::uint32_t i = 0; i < count; ++i) {
            expected.push_back(recent[0]);
            if (i + 1 == count) break;
            if ((i + 1) % 32 == 0) {
                const auto at = static_cast<std::uint32_t>(steps.end_run().bytes().size() - begin);
                begins.back() |= at << 10 * ((i + 1) / 32 - 1);
                recent.assign(8, first);
            }
            std::uint32_t number = recent[0] + 1;
            std::size_t lost = 0;
            if (i % 16 == 5) {
                steps.add(3, 2);
                number = recent[0] + 9;
                lost = 7;
            } else if (i % 3 == 1) {
                steps.add(1, 2).add(i % 8, 3);
                number = recent[2] + i % 8 - 1;
                lost = 2;
            } else {
                steps.add(0, 1);
            }
            recent.erase(recent.begin() + static_cast<std::ptrdiff_t>(lost));
            recent.insert(recent.begin(), number);
        }
        steps.end_run();
    }
    const Section section{Profile::fast, 10, kinds, steps.bytes(), begins};
    const GuardedPages pages(section.blob(), true);
    const Blob blob = open(pages.bytes());
    REQUIRE(blob);
    REQUIRE(blob.triangle_count() == expected.size());
    for (std::uint32_t i = 0; i < blob.triangle_count(); ++i) {
        const Result<OriginalTriangle> found = original_triangle(blob, {i});
        REQUIRE(found);
        const OriginalTriangle& original = *found;
        CHECK(original.triangle == expected[i]);
        CHECK(original.first_corner == 0);
    }
}

}  // namespace
}  // namespace espalier::tests::open_ids_test
