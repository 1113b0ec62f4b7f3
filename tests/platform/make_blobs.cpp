// make_blobs FOLDER: bakes the blobs that every machine is asked about, as .espl files: five of everything
// that a blob may carry, one by each builder in each profile, scenes of them, and three that deform. The meshes are
// made here, from integers: a landscape and a lumpy closed body above it, so that ids, materials and several inputs
// have something to say.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <espalier/scenes/bake.hpp>

namespace {

struct Mesh {
    std::vector<espalier::Vec3> positions;
    std::vector<espalier::TriangleVertices> triangles;
    std::vector<std::uint32_t> materials;

    void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, std::uint32_t material) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
        materials.insert(materials.end(), 2, material);
    }
};

std::uint32_t scramble(std::uint32_t value) {
    value = (value ^ (value >> 16)) * 0x7FEB352Du;
    value = (value ^ (value >> 15)) * 0x846CA68Bu;
    return value ^ (value >> 16);
}

float height(std::uint32_t column, std::uint32_t row) {
    const auto wide = static_cast<float>(scramble((column / 4) * 1000 + row / 4) >> 8) * 0x1p-23f;
    const auto fine = static_cast<float>(scramble(column * 1000 + row) >> 8) * 0x1p-25f;
    return wide + fine;
}

Mesh make_landscape(std::uint32_t side) {
    Mesh mesh;
    for (std::uint32_t row = 0; row <= side; ++row) {
        for (std::uint32_t column = 0; column <= side; ++column) {
            mesh.positions.push_back({static_cast<float>(column), static_cast<float>(row), height(column, row)});
        }
    }
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            const std::uint32_t corner = row * (side + 1) + column;
            mesh.add_quad(corner, corner + 1, corner + side + 2, corner + side + 1, scramble(corner) % 5);
        }
    }
    return mesh;
}

// The six faces of a cube, each a grid, blown up to a sphere with lumps. Faces share their border points by value.
Mesh make_body(std::int32_t cells, float radius, const espalier::Vec3& center) {
    Mesh mesh;
    const auto add_point = [&](const std::array<std::int32_t, 3>& grid) {
        const auto x = static_cast<float>(grid[0]);
        const auto y = static_cast<float>(grid[1]);
        const auto z = static_cast<float>(grid[2]);
        const std::uint32_t lump = scramble(static_cast<std::uint32_t>(grid[0] * 10007 + grid[1] * 101 + grid[2]));
        const float reach =
            radius * (1.0f + static_cast<float>(lump >> 8) * 0x1p-27f) / std::sqrt(x * x + y * y + z * z);
        mesh.positions.push_back({center.x + x * reach, center.y + y * reach, center.z + z * reach});
    };
    for (unsigned axis = 0; axis < 3; ++axis) {
        for (const std::int32_t side : {-cells, cells}) {
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (std::int32_t row = -cells; row <= cells; row += 2) {
                for (std::int32_t column = -cells; column <= cells; column += 2) {
                    std::array<std::int32_t, 3> grid{};
                    grid[axis] = side;
                    grid[(axis + 1) % 3] = side > 0 ? column : row;
                    grid[(axis + 2) % 3] = side > 0 ? row : column;
                    add_point(grid);
                }
            }
            const auto width = static_cast<std::uint32_t>(cells) + 1;
            for (std::uint32_t row = 0; row + 1 < width; ++row) {
                for (std::uint32_t column = 0; column + 1 < width; ++column) {
                    const std::uint32_t corner = first + row * width + column;
                    mesh.add_quad(corner, corner + 1, corner + width + 1, corner + width, 200 + axis);
                }
            }
        }
    }
    return mesh;
}

espalier::MeshView view(const Mesh& mesh, std::uint32_t file, const char* name) {
    return {.positions = mesh.positions,
            .triangles = mesh.triangles,
            .materials = mesh.materials,
            .file = file,
            .mesh = 0,
            .name = name};
}

/// Ends the program: it is also compiled without exceptions.
[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    std::fprintf(stderr, "make_blobs: %s: %s\n", path.c_str(), reason.c_str());
    std::exit(2);
}

template <class Baked>
void write_baked(const std::string& path, const Baked& baked) {
    if (!baked) fail(path, baked.message);
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr || std::fwrite(baked.bytes.data(), 1, baked.bytes.size(), file) != baked.bytes.size() ||
        std::fclose(file) != 0)
        fail(path, "it could not be written");
    std::fprintf(stderr, "%s: %zu bytes\n", path.c_str(), baked.bytes.size());
}

void bake_to(const std::string& path, const std::vector<espalier::MeshView>& meshes,
             const espalier::BakeOptions& options) {
    write_baked(path, espalier::bake(meshes, options));
}

void bake_by_every_builder(const std::string& folder, const std::vector<espalier::MeshView>& meshes) {
    using espalier::Builder;
    using espalier::Profile;
    constexpr std::pair<Builder, const char*> builders[] = {{Builder::binned_sah, "binned_sah"},
                                                            {Builder::sweep_sah, "sweep_sah"},
                                                            {Builder::spatial_splits, "spatial_splits"},
                                                            {Builder::agglomerative, "agglomerative"},
                                                            {Builder::linear, "linear"},
                                                            {Builder::insertion, "insertion"}};
    constexpr std::pair<Profile, const char*> profiles[] = {
        {Profile::fast, "fast"}, {Profile::balanced, "balanced"}, {Profile::small, "small"}, {Profile::tiny, "tiny"}};
    unsigned number = 0;
    for (const auto& [builder, builder_name] : builders) {
        for (const auto& [profile, profile_name] : profiles) {
            if (builder == Builder::spatial_splits && profile != Profile::fast) continue;
            espalier::BakeOptions options;
            options.build.builder = builder;
            options.profile = profile;
            options.resolution = espalier::Resolution::bits(8 + number);
            options.effort = static_cast<espalier::Effort>(number % 3);
            options.threads = 1 + number % 2;
            options.original_ids = number % 2 == 0;
            const std::string name = std::string("by_") + builder_name + "_" + profile_name + ".espl";
            bake_to(folder + name, meshes, options);
            number = number == 15 ? 1 : number + 1;
        }
    }
}

/// Bakes a scene of four pieces of ground, which share a lattice, and of stones that are turned, scaled and twice in
/// one place; and one in which that scene is a tile.
void bake_scenes(const std::string& folder, const Mesh& meadow, const Mesh& stone) {
    const auto bake_mesh = [](const Mesh& mesh, espalier::Profile profile) {
        espalier::BakeOptions options;
        options.profile = profile;
        options.resolution = espalier::Resolution::step(-10);
        const espalier::MeshView one = view(mesh, 0, "");
        return espalier::bake(std::span(&one, 1), options).bytes;
    };
    const std::vector<std::byte> blobs[] = {bake_mesh(meadow, espalier::Profile::balanced),
                                            bake_mesh(stone, espalier::Profile::fast),
                                            bake_mesh(stone, espalier::Profile::small)};
    std::vector<std::span<const std::byte>> parts(std::begin(blobs), std::end(blobs));
    std::vector<espalier::Instance> instances;
    for (int tile = 0; tile < 4; ++tile)
        instances.push_back({{{}, {static_cast<float>(tile % 2 * 16), static_cast<float>(tile / 2 * 16), 0.0f}}, 0, 1});
    for (std::uint32_t number = 0; number < 24; ++number) {
        const auto coordinate = [&](std::uint32_t axis) {
            return static_cast<float>(scramble(number / 2 * 8 + axis) >> 8) * 0x1p-19f;
        };
        const espalier::Quaternion rotation = {coordinate(0) - 16, coordinate(1) - 16, coordinate(2) - 16, 12};
        instances.push_back(
            {{rotation, {coordinate(3), coordinate(4), coordinate(5) * 0.25f}, 0.25f + coordinate(6) * 0x1p-5f},
             1 + number / 2 % 2,
             2u << number % 2});
    }
    const espalier::SceneBakeResult plain = espalier::bake_scene(parts, instances);
    write_baked(folder + "scene.espl", plain);
    parts.emplace_back(plain.bytes);
    instances.resize(6);
    instances.push_back({{{}, {32, 0, 0}}, 3});
    instances.push_back({{{0, 0, 1, 2}, {-8, 40, 1}, 0.5f}, 3});
    write_baked(folder + "scene_with_tiles.espl", espalier::bake_scene(parts, instances));
}

/// Bakes a cloth with poses and words for each triangle, a body far from the origin on a fine lattice, and a coarse one
/// whose mesh has more positions than two bytes can number.
void bake_deformables(const std::string& folder, const Mesh& meadow) {
    espalier::BakeOptions cloth;
    cloth.profile = espalier::Profile::fast;
    cloth.original_ids = true;
    espalier::Deformation& motion = cloth.deformation.emplace();
    motion.range = {{-4.0f, -4.0f, -8.0f}, {20.0f, 20.0f, 8.0f}};
    std::vector<espalier::Vec3> sagging = meadow.positions;
    for (espalier::Vec3& position : sagging) position.z -= (position.x - 8.0f) * (position.x - 8.0f) * 0.0625f;
    motion.poses.push_back(sagging);
    espalier::BakeOptions fine;
    fine.profile = espalier::Profile::fast;
    fine.resolution = espalier::Resolution::bits(24);
    fine.deformation.emplace();
    espalier::BakeOptions coarse = fine;
    coarse.resolution = espalier::Resolution::bits(6);
    Mesh sparse = make_body(6, 2.0f, {1.0f, -1.0f, 0.5f});
    sparse.positions.resize(70'000, sparse.positions.front());
    bake_to(folder + "cloth.espl", {view(meadow, 0, "cloth")}, cloth);
    bake_to(folder + "far_muscle.espl", {view(make_body(8, 2.0f, {148376.0f, 1234.0f, -223423.0f}), 0, "muscle")},
            fine);
    bake_to(folder + "sparse_muscle.espl", {view(sparse, 0, "muscle")}, coarse);
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: make_blobs FOLDER\n", stderr);
        return 1;
    }
    const std::string folder = std::string(arguments[1]) + "/";
    const Mesh landscape = make_landscape(32);
    const Mesh body = make_body(8, 6.0f, {15.0f, 17.0f, 11.0f});
    Mesh far_body = make_body(32, 2.0f, {148376.0f, 1234.0f, -223423.0f});

    espalier::BakeOptions options;
    options.profile = espalier::Profile::fast;
    options.original_ids = true;
    bake_to(folder + "small.espl", {view(landscape, 0, "landscape"), view(body, 1, "body")}, options);
    options.resolution = espalier::Resolution::bits(24);
    for (std::uint32_t& material : far_body.materials) material += 1000;  // 16 bits
    options.flat_angle = 5.0;
    options.bounds = {.oriented_box = true, .sphere = true, .k_dop = true};
    bake_to(folder + "fine.espl", {view(far_body, 0, "far body"), view(far_body, 1, "twin")}, options);
    espalier::BakeOptions plain;
    plain.profile = espalier::Profile::fast;
    plain.resolution = espalier::Resolution::bits(5);
    Mesh bare = landscape;
    bare.materials.clear();
    bake_to(folder + "coarse.espl", {view(bare, 0, "landscape")}, plain);
    options.profile = espalier::Profile::balanced;
    options.resolution = espalier::Resolution::bits(16);
    bake_to(folder + "strips.espl", {view(landscape, 0, "landscape"), view(body, 1, "body")}, options);
    options.profile = espalier::Profile::small;
    options.resolution = espalier::Resolution::bits(22);
    bake_to(folder + "dense.espl", {view(body, 0, "body"), view(landscape, 1, "landscape")}, options);
    const Mesh meadow = make_landscape(16);
    const Mesh stone = make_body(6, 2.0f, {7.0f, 8.0f, 2.0f});
    bake_by_every_builder(folder, {view(meadow, 0, "meadow"), view(stone, 1, "stone")});
    bake_scenes(folder, meadow, stone);
    bake_deformables(folder, meadow);
    return 0;
}
