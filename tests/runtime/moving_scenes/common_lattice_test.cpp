// Claims about instances of a moving scene that are moved by whole steps of its world: streamed tiles of a ground.
#include "support/testing.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>

#include <espalier/advanced/rounding.hpp>

#include <runtime/moving_scenes/box_tree/block.hpp>

#include "made_scene.hpp"
#include "runtime/scenes/hilly_ground.hpp"

namespace espalier::tests::common_lattice_test {
namespace {

constexpr std::int32_t least_reach = 1 << 17, most_reach = 1 << 23;
constexpr float step = 0x1p-8f;

/// A moving scene for tiles, whose world has their step or another one. What else it places: a cube that is not on
/// their lattice, and a scene of one tile.
struct TileWorld {
    std::vector<OpenedBlob> opened = opened_tile();
    OpenedScene tile{opened, std::vector<Instance>(1)};
    OpenedBlob cube{make_cube(-0.5f, 0.5f)};
    std::vector<Blob> meshes{opened[0].blob, cube.blob};
    std::vector<BakedScene> tiles{tile.scene};
    MadeScene made;
    MovingScene& scene = made.scene;

    explicit TileWorld(int step_exponent = tile_step_exponent) : made(64, step_exponent, meshes, tiles) {}

    Result<InstanceHandle> place(const Vec3& at, std::uint32_t mesh = 0) {
        return insert(scene, {.transform = {{}, at}, .mesh = mesh});
    }
    /// Returns how far the common region reaches from the origin, in steps; 0 if there is none.
    [[nodiscard]] std::int32_t reach() const {
        const Result<Lattice> common = scene.common_lattice();
        if (!common) return 0;
        const std::int32_t reach = common->extent[0] / 2 + 1;
        const float low = static_cast<float>(-reach) * std::ldexp(1.0f, scene.step_exponent());
        const std::int32_t extent = 2 * reach - 1;
        CHECK(*common == Lattice{{low, low, low}, scene.step_exponent(), {extent, extent, extent}});
        return reach;
    }
    [[nodiscard]] bool has_on_lattice(InstanceHandle handle) const {
        return is_on_common_lattice(scene, InstanceId{handle.slot}).yes();
    }
};

TEST_CASE("scene: instances of a moving scene that are moved by whole steps of its world share a lattice") {
    TileWorld world;
    CHECK(world.scene.common_lattice().status == QueryStatus::not_found);
    CHECK(MovingScene().common_lattice().status == QueryStatus::not_open);
    CHECK(is_on_common_lattice(MovingScene(), {0}).status() == QueryStatus::not_open);
    // What is on no lattice with others makes none.
    const std::vector<Transform> apart = {{{0.0f, 1.0f, 0.0f, 0.0f}, {}},
                                          {{}, {}, 2.0f},
                                          {{}, {0.5f * step, 0.0f, 0.0f}},
                                          {{}, {step * static_cast<float>(most_reach), 0.0f, 0.0f}}};
    for (const Transform& transform : apart) {
        const Result<InstanceHandle> handle = insert(world.scene, {.transform = transform});
        REQUIRE(handle);
        CHECK_FALSE(world.has_on_lattice(*handle));
    }
    CHECK_FALSE(world.has_on_lattice(*world.place({}, 1)));
    CHECK(world.reach() == 0);
    const InstanceHandle mesh = *world.place({3.0f, 0.0f, -2.0f});
    const InstanceHandle tile = *world.place({8.0f, 1.0f, 0.0f}, 2);
    CHECK(world.reach() == least_reach);
    CHECK(world.has_on_lattice(mesh));
    CHECK(world.has_on_lattice(tile));
    CHECK(is_on_common_lattice(world.scene, {tile.slot, 0}).yes());
    CHECK(is_on_common_lattice(world.scene, {tile.slot, 1}).status() == QueryStatus::invalid_argument);
    CHECK(is_on_common_lattice(world.scene, {world.scene.slot_end()}).status() == QueryStatus::out_of_range);
    for (std::uint32_t slot = 0; slot < 5; ++slot) CHECK_FALSE(is_on_common_lattice(world.scene, {slot}).yes());
    // One that begins to turn leaves the lattice, and one that stops comes back.
    REQUIRE(move(world.scene, mesh, apart[0]) == QueryStatus::ok);
    CHECK_FALSE(world.has_on_lattice(mesh));
    REQUIRE(move(world.scene, mesh, {}) == QueryStatus::ok);
    CHECK(world.has_on_lattice(mesh));
    REQUIRE(remove(world.scene, mesh) == QueryStatus::ok);
    CHECK(is_on_common_lattice(world.scene, {mesh.slot}).status() == QueryStatus::not_found);
}

TEST_CASE("scene: tiles in a moving scene whose world has another step share no lattice") {
    for (const int exponent : {tile_step_exponent - 1, tile_step_exponent + 1}) {
        TileWorld world(exponent);
        CHECK_FALSE(world.has_on_lattice(*world.place({})));
        CHECK_FALSE(world.has_on_lattice(*world.place({}, 2)));
        CHECK(world.reach() == 0);
    }
}

TEST_CASE("scene: an instance at the origin of a tile that is on no lattice is on none either") {
    std::vector<OpenedBlob> blobs = opened_tile();
    std::vector<Instance> instances(2);
    instances[1].transform = {{}, {8.0f, 0.5f * step, 0.0f}};
    const OpenedScene tile(blobs, instances);
    const std::vector<BakedScene> tiles = {tile.scene};
    MadeScene made(4, tile_step_exponent, {}, tiles);
    REQUIRE(insert(made.scene, {}));
    for (std::uint32_t i = 0; i < 2; ++i)
        CHECK(is_on_common_lattice(made.scene, {0, i}).yes() == (instance_at(tile.scene, {i})->source == 0));
    REQUIRE(move(made.scene, *handle_of(made.scene, 0), {{}, {0.5f * step, 0.0f, 0.0f}}) == QueryStatus::ok);
    for (std::uint32_t i = 0; i < 2; ++i) CHECK_FALSE(is_on_common_lattice(made.scene, {0, i}).yes());
}

TEST_CASE("scene: the common region of a moving scene doubles until it holds all on the lattice and never shrinks") {
    for (const int axis : {0, 1, 2})
        for (const bool is_low : {false, true}) {
            CAPTURE(axis);
            CAPTURE(is_low);
            TileWorld world;
            // A tile whose far side is so many steps from the origin.
            const auto ends_at = [&](std::int32_t steps) {
                const float size = static_cast<float>(world.meshes[0].lattice().extent[axis]) * step;
                const float end = static_cast<float>(steps) * step;
                Vec3 at;
                (axis == 0 ? at.x : axis == 1 ? at.y : at.z) = is_low ? -end : end - step - size;
                return at;
            };
            std::vector<InstanceHandle> handles;
            for (std::int32_t reach = least_reach; reach < most_reach; reach *= 2) {
                Movement movement = {*world.place({}), {{}, ends_at(reach)}};
                REQUIRE(move(world.scene, std::span(&movement, 1)).count == 1);
                CHECK(world.reach() == reach);
                REQUIRE(move(world.scene, movement.instance, {{}, ends_at(reach + 1)}) == QueryStatus::ok);
                CHECK(world.reach() == 2 * reach);
                handles.push_back(movement.instance);
                for (const InstanceHandle& handle : handles) CHECK(world.has_on_lattice(handle));
            }
            CHECK_FALSE(world.has_on_lattice(*world.place(ends_at(most_reach + 1))));
            CHECK(world.reach() == most_reach);
            const MadeScene copy(world.scene.bytes(), world.meshes, world.tiles);
            CHECK(*copy.scene.common_lattice() == *world.scene.common_lattice());
            for (const InstanceHandle& handle : handles) REQUIRE(remove(world.scene, handle) == QueryStatus::ok);
            repack(world.scene);
            CHECK(world.reach() == most_reach);
            // A snapshot states a region that holds all of its instances.
            CHECK(MadeScene(world.scene.bytes(), world.meshes, world.tiles).scene);
            REQUIRE(world.place(ends_at(least_reach + 1)));
            for (const unsigned number : {0u, 1u, 2u, 8u}) {
                CAPTURE(number);
                std::vector<std::byte> bytes = snapshot_of(world.scene);
                bytes[offsetof(detail::BlockHead, common_region)] = static_cast<std::byte>(number);
                CHECK(static_cast<bool>(MadeScene(bytes, world.meshes, world.tiles).scene) == (number == 2));
            }
        }
}

TEST_CASE("scene: batches of tiles leave the common region that single movements leave") {
    Random random(35);
    TileWorld one_by_one, batch;
    std::vector<Movement> movements(40);
    for (Movement& movement : movements) {
        const std::uint32_t mesh = random.below(3);
        movement.instance = *one_by_one.place({}, mesh);
        REQUIRE(batch.place({}, mesh));
    }
    for (int round = 0; round < 200; ++round) {
        CAPTURE(round);
        const int most = random.between(15, 24);
        for (Movement& movement : movements) {
            const auto steps = [&] { return step * static_cast<float>(random.between(-(1 << most), 1 << most)); };
            const float x = steps(), y = steps(), z = steps();
            movement.transform = {{}, {x, y, z}, random.below(4) == 0 ? 2.0f : 1.0f};
            REQUIRE(move(one_by_one.scene, movement.instance, movement.transform) == QueryStatus::ok);
        }
        REQUIRE(move(batch.scene, movements).count == movements.size());
        REQUIRE(batch.reach() == one_by_one.reach());
        refit(batch.scene);
        REQUIRE(MadeScene(batch.scene.bytes(), batch.meshes, batch.tiles).scene);
    }
}

TEST_CASE("scene: a mesh of a moving scene that gets another lattice takes its instances off the common one") {
    TileWorld world;
    const InstanceHandle tile = *world.place({8.0f, 0.0f, 0.0f}), other = *world.place({});
    const OpenedBlob fine(make_tile(), {.resolution = Resolution::step(tile_step_exponent - 1)});
    for (const Blob& mesh : {fine.blob, world.opened[0].blob}) {
        world.meshes[0] = mesh;
        REQUIRE(move_instances_of(world.scene, 0) == QueryStatus::ok);
        refit(world.scene);
        const bool is_on_lattice = mesh.lattice().step_exponent == tile_step_exponent;
        CHECK(world.has_on_lattice(tile) == is_on_lattice);
        CHECK(MadeScene(world.scene.bytes(), world.meshes, world.tiles).scene);
    }
    world.meshes[0] = Blob();  // as a program that unloads a mesh before it removes the instances
    REQUIRE(remove(world.scene, tile) == QueryStatus::ok);
    REQUIRE(remove(world.scene, other) == QueryStatus::ok);
    CHECK(MadeScene(world.scene.bytes(), world.meshes, world.tiles).scene);
}

TEST_CASE("scene: an instance that float32 holds in a small region alone leaves a larger one and its snapshot opens") {
    // The mesh lies so far from its own origin that an odd number of steps back ends beyond 2^24 from a far corner.
    constexpr float way = step * static_cast<float>(most_reach);
    Mesh away = make_tile();
    for (Vec3& position : away.positions) position.x -= way;
    const std::vector<OpenedBlob> opened = opened_blobs({away}, {.resolution = Resolution::step(tile_step_exponent)});
    const std::vector<Blob> meshes = {opened[0].blob};
    MadeScene made(4, tile_step_exponent, meshes);
    const auto place = [&](float x) {
        const InstanceHandle handle = *insert(made.scene, {.transform = {{}, {x, 0.0f, 0.0f}}});
        CHECK(MadeScene(made.scene.bytes(), meshes).scene);
        return handle;
    };
    const auto is_on_lattice = [&](InstanceHandle handle) {
        CHECK(MadeScene(made.scene.bytes(), meshes).scene);
        return is_on_common_lattice(made.scene, {handle.slot}).yes();
    };
    const InstanceHandle odd = place(way + step);
    CHECK_FALSE(is_on_lattice(odd));
    CHECK_FALSE(made.scene.common_lattice());
    const InstanceHandle even = place(way);
    CHECK(is_on_lattice(even));
    CHECK(is_on_lattice(odd));
    REQUIRE(move(made.scene, even, {{}, {0.25f * way, 0.0f, 0.0f}}) == QueryStatus::ok);
    CHECK(is_on_lattice(even));
    CHECK_FALSE(is_on_lattice(odd));
}

/// The hits of a ray, sorted by the instances that tiles were made for.
struct HitOf {
    std::uint32_t source;
    RayHit hit;
};

void check_equal(std::vector<HitOf> a, std::vector<HitOf> b) {
    std::ranges::stable_sort(a, {}, &HitOf::source);
    std::ranges::stable_sort(b, {}, &HitOf::source);
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        REQUIRE(a[i].source == b[i].source);
        REQUIRE(same_bits(a[i].hit, b[i].hit));
    }
}

/// A ground of tiles around a traveller, who goes along x: tiles behind are removed or moved to the front.
class Stream {
public:
    static constexpr int side = 5;

    Stream(TileWorld& world, const Vec3& from, Random& random) : world_(world), random_(random), from_(from) {
        for (int column = 0; column < side; ++column) add_column();
        bird_ = *world_.place({from.x, from.y + 700.0f, from.z}, 1);
    }

    /// Goes on by a column. The bird turns, so it is on no lattice.
    void go_on() {
        from_.x += static_cast<float>(tile_cells);
        const auto column = [&](std::size_t place) { return columns_.front()[place]; };
        if (random_.coin()) {
            for (std::size_t i = 0; i < side; ++i) REQUIRE(remove(world_.scene, column(i)) == QueryStatus::ok);
            columns_.pop_front();
            add_column();
        } else {
            std::vector<Movement> movements;
            for (std::size_t i = 0; i < side; ++i)
                movements.push_back({column(i), {{}, place_of(side - 1, static_cast<int>(i))}});
            REQUIRE(move(world_.scene, movements).count == movements.size());
            columns_.push_back(columns_.front());
            columns_.pop_front();
        }
        const Quaternion turn = {random_.signed_unit(), random_.signed_unit(), random_.signed_unit(), 1.0f};
        REQUIRE(move(world_.scene, bird_, {turn, {from_.x, from_.y + 700.0f, from_.z}}) == QueryStatus::ok);
        if (random_.below(8) == 0) repack(world_.scene);
        else refit(world_.scene);
    }

    [[nodiscard]] const Vec3& from() const { return from_; }

    /// Returns a baked scene of the same instances; the source of each is its slot's place in `slots`.
    [[nodiscard]] OpenedScene baked(std::vector<std::uint32_t>& slots) const {
        std::vector<Instance> instances;
        slots.clear();
        for (std::uint32_t slot = 0; slot < world_.scene.slot_end(); ++slot)
            if (const Result<Instance> instance = instance_at(world_.scene, InstanceId{slot}); instance) {
                instances.push_back(*instance);
                slots.push_back(slot);
            }
        return {blobs(), instances, baked_tiles()};
    }

private:
    [[nodiscard]] Vec3 place_of(int column, int row) const {
        return sum(from_, {static_cast<float>(tile_cells * column), 0.0f, static_cast<float>(tile_cells * row)});
    }
    void add_column() {
        std::vector<InstanceHandle> column;
        // Scenes of tiles between tiles, as they come.
        for (int row = 0; row < side; ++row)
            column.push_back(*world_.place(place_of(static_cast<int>(columns_.size()), row), random_.coin() ? 0 : 2));
        columns_.push_back(column);
    }
    [[nodiscard]] static std::vector<OpenedBlob> blobs() {
        std::vector<OpenedBlob> all = opened_tile();
        all.emplace_back(make_cube(-0.5f, 0.5f));
        return all;
    }
    [[nodiscard]] static std::vector<OpenedScene> baked_tiles() {
        std::vector<OpenedScene> all;
        all.emplace_back(opened_tile(), std::vector<Instance>(1));
        return all;
    }

    TileWorld& world_;
    Random& random_;
    Vec3 from_;
    std::deque<std::vector<InstanceHandle>> columns_;
    InstanceHandle bird_;
};

/// Places along the way of a traveller: at the origin, where the region doubles, and near the end of the largest.
const std::vector<Vec3>& starts() {
    static const std::vector<Vec3> all = {{-24.0f, 0.0f, -8.0f},
                                          {460.0f, 3.0f, 0.0f},
                                          {4040.0f, -200.0f, -1024.0f},
                                          {32600.0f, 512.0f, 12288.0f},
                                          {-32768.0f, 0.0f, -32768.0f}};
    return all;
}

TEST_CASE("scene: rays aimed at the borders of streamed tiles pass between none") {
    for (const Vec3& start : starts()) {
        CAPTURE(describe(start));
        TileWorld world;
        Random random(31);
        Stream stream(world, start, random);
        for (int column = 0; column < 20; ++column, stream.go_on()) {
            CAPTURE(column);
            std::vector<Ray> rays;
            for (std::uint64_t i = 0; i < scaled(600); ++i)
                rays.push_back(aimed_at_border(random, Stream::side, stream.from()));
            std::vector<InScene<RayHit>> hits(rays.size());
            REQUIRE(raycast(world.scene, rays, hits).count == rays.size());
            for (std::size_t i = 0; i < rays.size(); ++i) {
                CAPTURE(i);
                REQUIRE(hits[i]);
                REQUIRE(occluded(world.scene, rays[i]).yes());
            }
        }
    }
}

TEST_CASE("scene: streamed tiles have the hits of a baked scene that rounds rays for the same region") {
    for (const Vec3& start : starts()) {
        CAPTURE(describe(start));
        TileWorld world;
        Random random(33);
        Stream stream(world, start, random);
        for (int column = 0; column < 10; ++column, stream.go_on()) {
            CAPTURE(column);
            std::vector<std::uint32_t> slots;
            const OpenedScene baked = stream.baked(slots);
            const Result<Lattice> region = world.scene.common_lattice();
            REQUIRE(region);
            for (std::uint64_t i = 0; i < scaled(200); ++i) {
                const Ray ray = aimed_at_border(random, Stream::side, stream.from());
                const RoundedRay rounded = round_ray(*region, ray);
                CAPTURE(i);
                std::vector<HitOf> of_moving, of_baked;
                const auto add_moving = [&](InstanceId instance, const RayHit& hit) {
                    of_moving.push_back({instance.index, hit});
                };
                const auto add_baked = [&](InstanceId instance, const RayHit& hit) {
                    of_baked.push_back({slots[instance_at(baked.scene, InstanceId{instance.index})->source], hit});
                };
                REQUIRE(for_each_hit(world.scene, ray, add_moving) == QueryStatus::ok);
                REQUIRE(for_each_hit(baked.scene, ray, rounded, add_baked) == QueryStatus::ok);
                check_equal(of_moving, of_baked);
                REQUIRE(same_bits(raycast(world.scene, ray)->t, raycast(baked.scene, ray, rounded)->t));
                REQUIRE(occluded(world.scene, ray) == occluded(baked.scene, ray, rounded));
                checked(compare_rays(world.scene, ray));
            }
        }
    }
}

}  // namespace
}  // namespace espalier::tests::common_lattice_test
