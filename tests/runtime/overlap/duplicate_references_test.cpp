// Claims about enumerating the triangles of a blob with duplicate references: each one comes once, whatever the shape.
#include "support/testing.hpp"

#include "support/loops/triangle_loop.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/queries/shape_maker.hpp"

namespace espalier::tests::overlap_duplicate_references_test {
namespace {

using detail::round_volume;

using Indices = std::vector<std::uint32_t>;

/// Half of the triangles of a soup, and long ones through all of it, with as many references as splits can make.
struct SplitBlob {
    explicit SplitBlob(std::uint64_t seed)
        : opened(crossed_by_beams(40, 400, seed), options()), decoded(decode(opened.bytes)), loop(decoded) {
        REQUIRE(opened.blob.duplicate_reference_count() > 100);
    }
    static BakeOptions options() { return with_copies(); }

    OpenedBlob opened;
    DecodedBlob decoded;
    TriangleLoop loop;
};

struct Tally {
    std::uint64_t shapes = 0, overlapping = 0;
    std::uint64_t reordered = 0;  ///< not in ascending order: a duplicate reference was the first one
};

template <class Shape>
void check_pages(const Blob& blob, const Shape& shape, const Indices& found, std::size_t size) {
    std::vector<TriangleId> page(size);
    std::size_t seen = 0;
    for (Cursor from;;) {
        const Filled filled = collect_overlaps(blob, shape, page, from);
        for (const TriangleId triangle : filled.in(page)) {
            REQUIRE(seen < found.size());
            REQUIRE(triangle.index == found[seen++]);
        }
        if (filled.status == QueryStatus::ok) break;
        REQUIRE(filled.status == QueryStatus::output_full);
        REQUIRE(filled.count == size);
        // What is left is not a matter of how much was asked for.
        REQUIRE(collect_overlaps(blob, shape, std::span<TriangleId>(), filled.next).status == QueryStatus::output_full);
        from = filled.next;
    }
    REQUIRE(seen == found.size());
}

template <class Shape>
void check_shape(const SplitBlob& split, const Shape& shape, const Indices& expected, Tally& tally) {
    const Blob& blob = split.opened.blob;
    Indices found;
    REQUIRE(for_each_overlap(blob, shape, [&](TriangleId triangle, const Triangle& corners) {
                found.push_back(triangle.index);
                REQUIRE(corners.c == triangle_at(blob, triangle)->c);
            }) == QueryStatus::ok);
    for (std::size_t size = 1; size <= found.size() + 1; size += 1 + size / 8) check_pages(blob, shape, found, size);
    REQUIRE(overlaps(blob, shape).yes() == !expected.empty());
    ++tally.shapes;
    tally.overlapping += expected.empty() ? 0u : 1u;
    tally.reordered += std::is_sorted(found.begin(), found.end()) ? 0u : 1u;
    std::sort(found.begin(), found.end());
    REQUIRE(found == expected);
}

template <class Shape, class Rounded = detail::Rounded<Shape>>
void check_volume(const SplitBlob& split, const Shape& shape, Tally& tally) {
    Rounded rounded;
    const QueryStatus status = round_volume(detail::data_of(split.opened.blob), shape, rounded);
    if (is_refused(status)) return;
    check_shape(split, shape, status == QueryStatus::not_found ? Indices() : split.loop.every_overlap(rounded), tally);
}

TEST_CASE("overlap: duplicate references are reported once each and pages of them resume anywhere") {
    Tally tally[7];
    for (std::uint64_t seed = 0; seed < scaled(6); ++seed) {
        const SplitBlob split(seed);
        ShapeMaker shapes(split.decoded, seed + 7);
        QueryMaker spheres(split.decoded, seed + 8);
        for (int i = 0; i < 40; ++i) {
            const bool awkward = i % 2 == 0;
            std::size_t kind = 0;
            shapes.make_volumes(awkward, [&](const auto& shape) { check_volume(split, shape, tally[kind++]); });
            const Sphere sphere = awkward ? spheres.sphere() : spheres.random_sphere();
            detail::RoundedPoint rounded;
            if (detail::round_point(detail::data_of(split.opened.blob), sphere.center, sphere.radius, rounded) ==
                QueryStatus::ok)
                check_shape(split, sphere, split.loop.every_overlap(rounded), tally[5]);
            if (const auto box = to_lattice(split.opened.blob.lattice(), shapes.box(awkward)))
                check_volume<LatticeBox, detail::Rounded<Box>>(split, *box, tally[6]);
        }
    }
    for (const Tally& each : tally) {
        CHECK(each.overlapping > each.shapes / 8);
        CHECK(each.reordered > 0);
    }
}

TEST_CASE("overlap: a shape around a blob with duplicate references reports its triangles in ascending order") {
    const SplitBlob split(3);
    const Blob& blob = split.opened.blob;
    Indices found;
    CHECK(for_each_overlap(blob, ConvexVolume{}, [&](TriangleId triangle) { found.push_back(triangle.index); }) ==
          QueryStatus::ok);
    CHECK(found.size() == blob.triangle_count() - blob.duplicate_reference_count());
    CHECK(std::is_sorted(found.begin(), found.end()));
}

TEST_CASE("ray: duplicate references are hit once each and in one order on every path") {
    std::uint64_t hits = 0, reordered = 0;
    for (std::uint64_t seed = 0; seed < scaled(6); ++seed) {
        const SplitBlob split(seed + 50);
        const Blob& blob = split.opened.blob;
        QueryMaker maker(split.decoded, seed);
        for (int i = 0; i < 500; ++i) {
            Ray ray = maker.any_ray();
            if (i % 3 == 0) maker.restrict(ray);
            Indices found, expected;
            (void)for_each_hit(blob, ray, [&](const RayHit& hit) { found.push_back(hit.triangle.index); });
            for (const InstructionPath& path : instruction_paths()) {
                CAPTURE(path.name);
                Indices again;
                (void)path.every_hit(detail::data_of(blob), ray,
                                     [&](const RayHit& hit) { again.push_back(hit.triangle.index); });
                REQUIRE(again == found);
            }
            detail::LatticeRay rounded;
            if (detail::round_ray(detail::data_of(blob), ray, rounded))
                for (const detail::FoundHit& hit : split.loop.every_hit(rounded)) expected.push_back(hit.index);
            hits += found.size();
            reordered += std::is_sorted(found.begin(), found.end()) ? 0u : 1u;
            std::sort(found.begin(), found.end());
            REQUIRE(found == expected);
        }
    }
    CHECK(hits > 80 * scaled(6));
    CHECK(reordered > 0);
}

}  // namespace
}  // namespace espalier::tests::overlap_duplicate_references_test
