// What original ids take in a blob, by the order of the source's triangles: as in the file, shuffled, and as the baker
// put them. Counted in bytes, the same on every machine.

#include "../../tools/base/choices.hpp"
#include "../program.hpp"

namespace espalier::bench {
namespace {

BakeResult bake_with(const Mesh& mesh, Profile profile, bool ids) {
    return bake_blob(mesh, BakeOptions{.profile = profile, .original_ids = ids}).baked;
}

Mesh shuffled(Mesh mesh) {
    tests::Random random(2026);
    for (std::size_t i = mesh.triangles.size(); i > 1; --i)
        std::swap(mesh.triangles[i - 1], mesh.triangles[random.below(static_cast<std::uint32_t>(i))]);
    return mesh;
}

Mesh reordered(const Mesh& mesh, const std::vector<OriginalTriangle>& remap) {
    Mesh result = mesh;
    result.triangles.clear();
    for (const OriginalTriangle& original : remap) {
        TriangleVertices triangle = mesh.triangles[original.triangle];
        std::rotate(triangle.begin(), triangle.begin() + original.first_corner, triangle.end());
        result.triangles.push_back(triangle);
    }
    return result;
}

/// Share of the triangles that have a corner in common with one of the two before them: near 1 in scan order.
double share_in_scan_order(const Mesh& mesh) {
    const auto touch = [&](const TriangleVertices& a, const TriangleVertices& b) {
        return std::any_of(a.begin(), a.end(), [&](std::uint32_t of_a) {
            return std::any_of(b.begin(), b.end(),
                               [&](std::uint32_t of_b) { return mesh.positions[of_a] == mesh.positions[of_b]; });
        });
    };
    std::size_t touching = 0;
    for (std::size_t i = 1; i < mesh.triangles.size(); ++i) {
        if (touch(mesh.triangles[i], mesh.triangles[i - 1]) ||
            (i > 1 && touch(mesh.triangles[i], mesh.triangles[i - 2])))
            ++touching;
    }
    return static_cast<double>(touching) / static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 2) - 1);
}

void measure(const Mesh& mesh) {
    for (const auto& [profile_name, profile] : tools::profile_choices) {
        const BakeResult plain = bake_with(mesh, profile, false);
        const std::array<std::pair<const char*, Mesh>, 3> orders = {
            {{"file", mesh}, {"random", shuffled(mesh)}, {"reordered", reordered(mesh, plain.remap)}}};
        for (const auto& [order, source] : orders) {
            const BakeResult without = bake_with(source, profile, false);
            const BakeResult with = bake_with(source, profile, true);
            const auto triangles = static_cast<double>(with.remap.size());
            // One width for all, and two bits for the first corner of strips.
            const double fixed = (static_cast<double>(std::bit_width(source.triangles.size() - 1)) +
                                  (profile == Profile::fast ? 0.0 : 2.0)) /
                                 8.0;
            const double section = static_cast<double>(with.bytes.size() - without.bytes.size()) / triangles;
            std::printf("| %s | `%s` | %s | %.0f %% | %.2f | %.2f | %.2f | %.0f %% |\n", mesh.name.c_str(),
                        profile_name.c_str(), order, 100.0 * share_in_scan_order(source),
                        static_cast<double>(without.bytes.size()) / triangles, fixed, section, 100.0 * section / fixed);
            std::fflush(stdout);
        }
    }
}

void run(const std::vector<std::string>& files) {
    std::printf(
        "## Bytes of each mesh\n\n"
        "Written by `espalier_bench_study ids MESH...`, in bytes a triangle at 16 bits. *Fixed width*: one width for "
        "all ids "
        "and 2 bits for the first corner of strips.\n"
        "Orders of the source: as in its file, shuffled, and in the order of the blob (`bake --reorder`), where ids "
        "are "
        "not needed at all. A remap table takes 0 bytes of the blob.\n"
        "*In scan order*: triangles of the source that touch one of the two before them.\n\n"
        "| mesh | profile | order | in scan order | without ids | ids, fixed width | ids | of fixed width |\n"
        "|---|---|---|---|---|---|---|---|\n");
    Mesh grid = tests::make_plane_grid(150);
    grid.name = "grid 150 x 150";
    measure(grid);
    for (const std::string& file : files) measure(tests::read_mesh(file));
}

}  // namespace

const Subcommand subcommand("ids", [](int count, char** words) {
    Program program("espalier_bench_study ids",
                    "What original ids take by the order of the source; a table in Markdown");
    return program.run(count, words, [](const std::vector<std::string>& meshes) { run(meshes); });
});

}  // namespace espalier::bench
