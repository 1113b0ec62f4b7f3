// Claims about the table that leads from a blob back to its source without bytes in the blob, and the file of it.
#include "support/testing.hpp"

#include "baker/baking_support.hpp"

namespace espalier::tests::remap_test {
namespace {

std::vector<OriginalTriangle> table_for(const Blob& blob) {
    return std::vector<OriginalTriangle>(blob.triangle_count(), {7, 7, 7, 7});
}

/// A blob with its file, and a table to read it into.
struct BakedCube {
    const BakeResult baked = must_bake_mesh(make_cube(0.0f, 1.0f));
    const OpenedBlob opened{std::vector<std::byte>(baked.bytes)};
    const std::vector<std::byte> file = remap_file(baked);
    std::vector<OriginalTriangle> remap = table_for(opened.blob);
    const std::vector<OriginalTriangle> before = remap;
};

/// Of two files, an empty mesh and a triangle without area among them.
BakeResult bake_two_files(const BakeOptions& options) {
    std::array<Mesh, 3> meshes = {make_torus(16, 8, 4.0, 0.5), Mesh{}, make_terrain(12, 3)};
    meshes[2].triangles.insert(meshes[2].triangles.begin() + 5, {3, 3, 3});
    std::vector<MeshView> views;
    for (const Mesh& mesh : meshes) views.push_back(mesh.view());
    views[0].mesh = 4;
    views[1].file = views[2].file = 9;
    views[2].mesh = 1;
    auto baked = bake(views, options);
    REQUIRE_MESSAGE(baked, baked.message);
    return baked;
}

TEST_CASE("remap: it holds what ids in the blob would whether or not there are any") {
    for_each_profile([](Profile profile) {
        BakeOptions options = with_profile(profile);
        const BakeResult without = bake_two_files(options);
        options.original_ids = true;
        const BakeResult with = bake_two_files(options);
        const OpenedBlob opened(with.bytes);
        REQUIRE(opened.blob.has_original_ids());
        REQUIRE(with.remap.size() == opened.blob.triangle_count());
        CHECK(with.remap == without.remap);
        for (std::uint32_t i = 0; i < with.remap.size(); ++i) {
            const Result<OriginalTriangle> original = original_triangle(opened.blob, {i});
            REQUIRE(original);
            REQUIRE(with.remap[i] == *original);
        }
    });
}

TEST_CASE("remap: copies lead to the triangle of their owner") {
    const auto baked = must_bake_mesh(make_soup(60, 1), with_copies());
    REQUIRE(baked.report.tree.duplicate_references > 0);
    const DecodedBlob decoded = decode(baked.bytes);
    REQUIRE(baked.remap.size() == decoded.triangle_count);
    for (std::uint32_t i = 0; i < decoded.triangle_count; ++i)
        REQUIRE(baked.remap[i] == baked.remap[decoded.owners[i]]);
}

TEST_CASE("remap: a file is read back as the table and only for its own blob") {
    for_each_profile([](Profile profile) {
        const BakeResult baked = bake_two_files(with_profile(profile));
        const std::vector<std::byte> file = remap_file(baked);
        CHECK(file.size() == 16 + 16 * baked.remap.size());
        const OpenedBlob opened(baked.bytes);
        std::vector<OriginalTriangle> remap = table_for(opened.blob);
        REQUIRE(read_remap(file, opened.blob, remap) == OpenStatus::ok);
        CHECK(remap == baked.remap);

        const OpenedBlob other(make_cube(0.0f, 1.0f), with_profile(profile));
        std::vector<OriginalTriangle> untouched = table_for(opened.blob);
        const std::vector<OriginalTriangle> before = untouched;
        CHECK(read_remap(file, other.blob, untouched) == OpenStatus::other_blob);
        CHECK(read_remap(file, Blob(), untouched) == OpenStatus::other_blob);
        CHECK(read_remap(file, opened.blob, std::span(untouched).first(7)) == OpenStatus::other_blob);
        CHECK(read_remap(opened.bytes, opened.blob, untouched) == OpenStatus::not_a_remap);
        CHECK(untouched == before);
    });
}

TEST_CASE("remap: a file that is cut short or changed in any bit is refused") {
    BakedCube cube;
    auto& [baked, opened, file, remap, before] = cube;
    for (std::size_t size = 0; size < file.size(); ++size) {
        const std::vector<std::byte> part(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
        REQUIRE(read_remap(part, opened.blob, remap) == OpenStatus::not_a_remap);
    }
    for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
        std::vector<std::byte> changed = file;
        changed[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
        REQUIRE(read_remap(changed, opened.blob, remap) == OpenStatus::not_a_remap);
    }
    CHECK(remap == before);
    REQUIRE(read_remap(file, opened.blob, remap) == OpenStatus::ok);
    CHECK(remap == baked.remap);
}

TEST_CASE("remap: a file with a good checksum is refused for each other fault that it has") {
    BakedCube cube;
    // Clang 14 captures no structured binding.
    const Blob& blob = cube.opened.blob;
    const std::vector<std::byte>& file = cube.file;
    auto& remap = cube.remap;
    const auto status_of = [&](auto change, std::size_t places) {
        std::vector<std::byte> changed = file;
        change(changed);
        repair_checksum(changed);
        return read_remap(changed, blob, std::span(remap).first(places));
    };
    const auto with_field = [&](std::size_t at, std::uint64_t value) {
        return status_of([&](std::vector<std::byte>& bytes) { put(bytes, at, value, 4); }, remap.size());
    };
    CHECK(with_field(0, get(file, 0, 4) ^ 1) == OpenStatus::not_a_remap);
    CHECK(with_field(4, get(file, 4, 4) ^ 1) == OpenStatus::not_a_remap);
    CHECK(with_field(4, get(file, 4, 4) + 1) == OpenStatus::not_a_remap);
    CHECK(with_field(8, get(file, 8, 4) ^ 1) == OpenStatus::other_blob);
    for (std::size_t i = 0; i < remap.size(); ++i) CHECK(with_field(16 + 16 * i + 12, 3) == OpenStatus::not_a_remap);
    for (std::size_t size = 16; size < file.size() + 20; ++size) {
        if (size == file.size()) continue;
        const auto resize = [&](std::vector<std::byte>& bytes) { bytes.resize(size); };
        const OpenStatus expected = size % 16 == 0 ? OpenStatus::other_blob : OpenStatus::not_a_remap;
        CHECK(status_of(resize, remap.size()) == expected);
        if (size < file.size()) CHECK(status_of(resize, (size - 16) / 16) == expected);
    }
    CHECK(remap == cube.before);
}

TEST_CASE("remap: what lies behind the file does not matter and a blob without triangles has one") {
    const BakeResult baked = bake_two_files({});
    const OpenedBlob opened(baked.bytes);
    std::vector<std::byte> bytes = remap_file(baked);
    const std::size_t size = bytes.size();
    bytes.resize(size + 64, std::byte{0xFF});
    std::vector<OriginalTriangle> remap = table_for(opened.blob);
    REQUIRE(read_remap(std::span(bytes).first(size), opened.blob, remap) == OpenStatus::ok);
    CHECK(remap == baked.remap);
    const auto nothing = bake({}, {});
    REQUIRE(nothing);
    const OpenedBlob empty(nothing.bytes);
    CHECK(remap_file(nothing).size() == 16);
    CHECK(read_remap(remap_file(nothing), empty.blob, {}) == OpenStatus::ok);
}

}  // namespace
}  // namespace espalier::tests::remap_test
