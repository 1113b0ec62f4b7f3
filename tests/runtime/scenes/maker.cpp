#include "maker.hpp"

#include <stdexcept>

namespace espalier::tests {

namespace {

std::vector<std::byte> bake_or_throw(const std::vector<OpenedBlob>& blobs, const std::vector<Instance>& instances,
                                     const std::vector<OpenedScene>& tiles) {
    std::vector<std::span<const std::byte>> bytes;
    for (const OpenedBlob& blob : blobs) bytes.emplace_back(blob.bytes);
    for (const OpenedScene& tile : tiles) bytes.emplace_back(tile.bytes);
    SceneBakeResult baked = bake_scene(bytes, instances);
    if (!baked) throw std::runtime_error(baked.message);
    return std::move(baked.bytes);
}

std::vector<OpenedBlob> make_meshes(unsigned bits) {
    std::vector<OpenedBlob> blobs;
    const auto add = [&](const Mesh& mesh, Profile profile) {
        blobs.emplace_back(mesh, BakeOptions{.resolution = Resolution::bits(bits), .profile = profile});
    };
    add(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}), Profile::balanced);
    add(make_torus(16, 8, 2.0, 0.5), Profile::fast);
    add(make_cube(-1.0f, 1.0f), Profile::small);
    add(make_soup(40, 7), Profile::tiny);
    add(make_terrain(8, 3), Profile::balanced);
    return blobs;
}

Transform any_transform(Random& random, float place, int most_exponent) {
    Transform transform = {{random.signed_unit(), random.signed_unit(), random.signed_unit(), random.signed_unit()},
                           {}};
    if (random.below(4) == 0) transform.rotation = {};
    transform.translation = random.in_cube(place);
    const int exponent = random.between(-most_exponent, most_exponent);  // drawn first by every compiler
    transform.scale = std::ldexp(1.0f + random.unit(), exponent);
    return transform;
}

std::vector<Instance> make_instances(std::size_t count, std::uint64_t seed, float place, int most_exponent) {
    Random random(seed);
    std::vector<Instance> instances(count);
    for (Instance& instance : instances) {
        instance.transform = any_transform(random, place, most_exponent);
        instance.mesh = random.below(5);
        instance.mask = 1u << random.below(4);
        instance.user = static_cast<std::uint32_t>(random.next() & 0xFFFFFFFFu);
    }
    return instances;
}

/// Tiles, of which one is a ground of four pieces on one lattice, and something that turns beside them.
std::vector<OpenedScene> make_tiles(const std::vector<OpenedBlob>& blobs) {
    std::vector<OpenedScene> tiles;
    tiles.emplace_back(blobs, make_instances(5, 21, 4.0f, 1));
    tiles.emplace_back(blobs, make_instances(40, 22, 6.0f, 2));
    tiles.emplace_back(blobs, std::vector<Instance>{});
    std::vector<Instance> pieces = ground(2, 4, 8.0f);
    const std::vector<Instance> beside = make_instances(3, 23, 8.0f, 1);
    pieces.insert(pieces.end(), beside.begin(), beside.end());
    tiles.emplace_back(blobs, pieces);
    return tiles;
}

std::vector<TestScene> make_scenes() {
    std::vector<TestScene> scenes;
    const auto add_tiled = [&](std::string name, std::vector<OpenedBlob> blobs, std::vector<OpenedScene> tiles,
                               std::vector<Instance> instances) {
        OpenedScene opened(blobs, instances, tiles);
        scenes.push_back(
            {std::move(name), std::move(blobs), std::move(tiles), std::move(instances), std::move(opened)});
    };
    const auto add = [&](std::string name, unsigned bits, std::vector<Instance> instances) {
        add_tiled(std::move(name), make_meshes(bits), {}, std::move(instances));
    };
    add("empty", 16, {});
    add("one, unmoved", 16, {Instance{}});
    add("few", 16, make_instances(5, 1, 4.0f, 1));
    add("many, apart", 16, make_instances(200, 2, 40.0f, 1));
    add("many, one in the other", 16, make_instances(120, 3, 2.0f, 2));
    add("dust and giants", 16, make_instances(150, 4, 100.0f, 9));
    add("coarse lattices", 3, make_instances(100, 5, 12.0f, 1));
    std::vector<Instance> far = make_instances(60, 6, 20.0f, 1);
    for (Instance& instance : far) {
        instance.transform.translation.x += 1e6f;
        instance.transform.translation.z -= 3e6f;
    }
    add("far from the origin", 16, std::move(far));
    std::vector<Instance> equal = make_instances(40, 7, 6.0f, 1);
    for (std::size_t i = 0; i < 20; ++i) equal.push_back(equal[i]);
    for (std::size_t i = 0; i < 6; ++i) equal.push_back(equal[0]);
    add("equal ones", 16, std::move(equal));
    std::vector<Instance> row(64);
    for (std::size_t i = 0; i < row.size(); ++i) {
        row[i].mesh = 2;
        row[i].transform.translation.x = 2.0f * static_cast<float>(i);
    }
    add("a row of cubes that touch", 16, std::move(row));
    std::vector<Instance> tiles = ground(6, 4, 8.0f);
    const std::vector<Instance> among = make_instances(20, 9, 20.0f, 1);
    tiles.insert(tiles.end(), among.begin(), among.end());
    add("tiles among others", 16, std::move(tiles));
    for (const int exponent : {-92, 80}) {
        std::vector<Instance> scaled = make_instances(40, 8, 20.0f, 1);
        for (Instance& instance : scaled) {
            for (float* const x : {&instance.transform.translation.x, &instance.transform.translation.y,
                                   &instance.transform.translation.z, &instance.transform.scale})
                *x = std::ldexp(*x, exponent);
        }
        add(exponent < 0 ? "tiny" : "huge", 16, std::move(scaled));
    }
    std::vector<OpenedBlob> blobs = make_meshes(16);
    std::vector<OpenedScene> turned = make_tiles(blobs);
    std::vector<Instance> mixed = make_instances(40, 24, 60.0f, 2);
    for (std::size_t i = 0; i < 24; ++i) mixed[i].mesh = static_cast<std::uint32_t>(blobs.size() + i % turned.size());
    for (std::size_t i = 0; i < 24; ++i) mixed[i].mask |= i % 2 == 0 ? 0xFFu : 0u;
    add_tiled("tiles that turn, among meshes", std::move(blobs), std::move(turned), std::move(mixed));
    blobs = make_meshes(16);
    std::vector<OpenedScene> still = make_tiles(blobs);
    std::vector<Instance> world = ground(3, static_cast<std::uint32_t>(blobs.size() + 3), 16.0f);
    const std::vector<Instance> beside = make_instances(10, 25, 40.0f, 1);
    world.insert(world.end(), beside.begin(), beside.end());
    const std::vector<Instance> more = ground(2, 4, -8.0f);
    world.insert(world.end(), more.begin(), more.end());
    world[9].mesh = static_cast<std::uint32_t>(blobs.size() + 3);  // a tile off the lattice
    add_tiled("tiles of a ground", std::move(blobs), std::move(still), std::move(world));
    return scenes;
}

}  // namespace

OpenedScene::OpenedScene(std::vector<std::byte> scene_bytes)
    : bytes(std::move(scene_bytes)),
      meshes(mesh_count_of_scene(bytes)),
      tiles(tile_count_of_scene(bytes)),
      scene(open_scene(bytes, meshes, tiles)) {
    if (!scene) throw std::runtime_error(describe(scene.status()));
}

OpenedScene::OpenedScene(const std::vector<OpenedBlob>& blobs, const std::vector<Instance>& instances,
                         const std::vector<OpenedScene>& given_tiles)
    : OpenedScene(bake_or_throw(blobs, instances, given_tiles)) {}

std::vector<Instance> ground(int side, std::uint32_t mesh, float width, const Vec3& from) {
    std::vector<Instance> pieces;
    for (int z = 0; z < side; ++z)
        for (int x = 0; x < side; ++x) {
            Instance& piece = pieces.emplace_back();
            piece.mesh = mesh;
            piece.transform.translation = {from.x + width * static_cast<float>(x), from.y,
                                           from.z + width * static_cast<float>(z)};
        }
    return pieces;
}

const std::vector<TestScene>& test_scenes() {
    static const std::vector<TestScene> scenes = make_scenes();
    return scenes;
}

SceneQueryMaker::SceneQueryMaker(const TestScene& scene, std::uint64_t seed) : scene_(scene), random_(seed) {
    const Box bounds = scene.opened.scene.bounds();
    center_ = middle(bounds.min, bounds.max);
    size_ = longest_side(bounds);
    if (size_ == 0.0f) size_ = 1.0f;
}

Vec3 SceneQueryMaker::anywhere() { return sum(center_, random_.in_cube(0.75f * size_)); }

Vec3 SceneQueryMaker::on_surface() {
    if (scene_.instances.empty()) return anywhere();
    const Instance& instance = scene_.instances[random_.below(static_cast<std::uint32_t>(scene_.instances.size()))];
    if (instance.mesh >= scene_.blobs.size()) {
        const BakedScene& tile = scene_.tiles[instance.mesh - scene_.blobs.size()].scene;
        if (tile.instance_count() == 0) return anywhere();
        const InstanceId in_tile = {random_.below(tile.instance_count())};
        return to_world(instance.transform,
                        to_world(instance_at(tile, in_tile)->transform, on_surface_of(mesh_at(tile, in_tile).value)));
    }
    return to_world(instance.transform, on_surface_of(scene_.blobs[instance.mesh].blob));
}

Vec3 SceneQueryMaker::on_surface_of(const Blob& mesh) {
    const Triangle corners = triangle_at(mesh, {random_.below(mesh.triangle_count())}).value;
    return random_.coin() ? middle(corners.a, corners.b) : corners.a;
}

float SceneQueryMaker::length() { return size_ * std::ldexp(random_.unit(), -static_cast<int>(random_.below(12))); }

Ray SceneQueryMaker::ray() {
    Vec3 from = anywhere();
    const std::uint32_t kind = random_.below(8);
    if (kind < 2) {  // from afar
        const float sizes = kind == 0 ? 1e2f : 1e5f;
        from = sum(center_, random_.in_cube(sizes * size_));
    }
    const Vec3 to = random_.below(4) == 0 ? anywhere() : on_surface();
    Ray ray = Ray::between(from, to);
    ray.t_max = infinity;
    if (random_.below(4) == 0) ray.direction = {random_.signed_unit(), 0.0f, 0.0f};
    if (random_.below(4) == 0) ray.origin = on_surface();
    if (ray.direction == Vec3{}) ray.direction.y = 1.0f;
    if (random_.below(4) == 0) ray.t_max = 2.0f * random_.unit();
    if (random_.below(6) == 0) ray.t_min = random_.unit();
    if (random_.below(4) == 0) ray.culling = FaceCulling::back;
    return ray;
}

Vec3 SceneQueryMaker::point() {
    if (random_.below(3) == 0) return anywhere();
    const Vec3 near = on_surface(), moved = sum(near, random_.in_cube(random_.coin() ? length() : 0.0f));
    if (random_.below(16) != 0) return moved;
    return {1e4f * moved.x, moved.y - 1e5f * size_, moved.z};
}

Vec3 SceneQueryMaker::displacement() { return random_.below(8) == 0 ? Vec3{} : random_.in_cube(4.0f * length()); }

Sphere SceneQueryMaker::sphere() { return {point(), random_.below(8) == 0 ? 0.0f : length()}; }

Capsule SceneQueryMaker::capsule() {
    const Vec3 from = point(), way = random_.in_cube(length());
    return {from, sum(from, way), length()};
}

Box SceneQueryMaker::box() {
    const Vec3 min = point();
    return {min, {min.x + length(), min.y + length(), min.z + length()}};
}

OrientedBox SceneQueryMaker::oriented_box() {
    OrientedBox box;
    box.center = point();
    for (Vec3& axis : box.half_axes) axis = random_.in_cube(length());
    return box;
}

std::vector<Vec3> SceneQueryMaker::hull_vertices() {
    const Vec3 middle = point();
    const float size = length();
    const bool is_flat = random_.below(4) == 0;
    const std::uint32_t most = random_.below(8) == 0 ? static_cast<std::uint32_t>(max_hull_vertices) + 1 : 12;
    std::vector<Vec3> vertices(random_.below(most));
    for (Vec3& vertex : vertices) {
        const Vec3 way = random_.in_cube(size);
        vertex = {middle.x + way.x, middle.y + (is_flat ? 0.0f : way.y), middle.z + way.z};
    }
    return vertices;
}

SceneSweepOptions SceneQueryMaker::sweep_options(const SceneFilter& filter) {
    SceneSweepOptions options = {.filter = filter};
    if (random_.below(4) == 0) return options;
    options.culling = static_cast<FaceCulling>(random_.below(3));
    options.ignore_leaving = random_.coin();
    options.skin = random_.coin() ? 0.0f : 0.25f * length();
    return options;
}

Triangle SceneQueryMaker::triangle() {
    Triangle triangle;
    triangle.a = point();
    for (Vec3* corner : {&triangle.b, &triangle.c}) *corner = sum(triangle.a, random_.in_cube(length()));
    return triangle;
}

Cone SceneQueryMaker::cone() { return {point(), random_.in_cube(length() + 1e-3f * size_), length()}; }

}  // namespace espalier::tests
