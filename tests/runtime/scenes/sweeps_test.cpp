// Claims about sweeps of scenes as the header words them: shapes, options and skins at places of any scale, and shapes
// that touch instances exactly.
#include "support/testing.hpp"

#include "maker.hpp"

namespace espalier::tests::scenes_sweeps_test {
namespace {

constexpr float half_root = 0.70710678f;

constexpr Quaternion quarter_turns[] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1},
                                        {0, 0, 1, 1}, {1, 1, 1, 1}, {0, 1, 0, 0}};

std::vector<OpenedBlob> one_cube() { return opened_blobs({make_cube(-1.0f, 1.0f)}); }

/// A triangle in the plane z = 0 that faces up.
std::vector<OpenedBlob> one_triangle() { return opened_blobs({make_triangle({-4, -4, 0}, {4, -4, 0}, {0, 4, 0})}); }

Instance placed_at(Vec3 translation, float scale = 1.0f, Quaternion rotation = {}) {
    return {.transform = {rotation, translation, scale}};
}

std::array<Vec3, 8> corners_of(const Box& box) {
    std::array<Vec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners[i] = {(i & 1u) != 0 ? box.max.x : box.min.x, (i & 2u) != 0 ? box.max.y : box.min.y,
                      (i & 4u) != 0 ? box.max.z : box.min.z};
    return corners;
}

OrientedBox oriented(const Box& box) {
    const Vec3& a = box.min;
    const Vec3& b = box.max;
    return {middle(a, b), {{0.5f * (b.x - a.x), 0, 0}, {0, 0.5f * (b.y - a.y), 0}, {0, 0, 0.5f * (b.z - a.z)}}};
}

/// Calls `call` with a shape of each kind that is half a unit large around a place.
template <class Call>
void for_each_shape(const Vec3& at, Call call) {
    const Box box = {{at.x - 0.5f, at.y - 0.5f, at.z - 0.5f}, {at.x + 0.5f, at.y + 0.5f, at.z + 0.5f}};
    const std::array<Vec3, 8> corners = corners_of(box);
    call(Sphere{at, 0.5f});
    call(Capsule{at, {at.x, at.y, at.z + 0.25f}, 0.5f});
    call(box);
    call(oriented(box));
    call(ConvexHull{corners});
}

/// Cubes on a grid of whole numbers, turned by quarters and larger by powers of two, so that nothing is rounded.
std::vector<Instance> cubes_on_grid(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<Instance> instances(count);
    for (Instance& instance : instances) {
        const auto whole = [&] { return static_cast<float>(random.between(-6, 6)); };
        const float x = whole(), y = whole(), z = whole();
        const Quaternion rotation = quarter_turns[random.below(6)];
        instance = placed_at({x, y, z}, std::ldexp(1.0f, random.between(-2, 1)), rotation);
        instance.mask = 1u << random.below(3);
    }
    return instances;
}

TEST_CASE("scene: a skin is a length in the world at every scale and in tiles") {
    const float skin = 0.25f;
    // The face of the cube is at x = 6 in each of them.
    std::vector<OpenedScene> scenes;
    for (const float scale : {0.125f, 1.0f, 4.0f, 3.0f, 1e-3f, 1e2f})
        scenes.emplace_back(one_cube(), std::vector<Instance>{placed_at({6.0f + scale, 0, 0}, scale)});
    std::vector<OpenedScene> tiles;
    tiles.emplace_back(one_cube(), std::vector<Instance>{placed_at({3.0f, 0, 0}, 2.0f)});
    // In the tile the face is at x = 1.
    scenes.emplace_back(std::vector<OpenedBlob>(), std::vector<Instance>{placed_at({3.0f, 0, 0}, 3.0f)}, tiles);
    const float way = 20.0f;
    for (const OpenedScene& opened : scenes) {
        for_each_shape({0, 0, 0}, [&](const auto& shape) {
            const InScene<SweepHit> bare = sweep(opened.scene, shape, {way, 0, 0});
            const InScene<SweepHit> hit = sweep(opened.scene, shape, {way, 0, 0}, SceneSweepOptions{.skin = skin});
            REQUIRE(bare);
            REQUIRE(hit);
            CHECK(std::fabs(bare->t * way + 0.5f - 6.0f) < 1e-3f);
            const float gap = (bare->t - hit->t) * way;
            // The displacement is rounded to the grid of the instance.
            CHECK(gap > skin * (1.0f - 0x1p-17f));
            CHECK(gap < skin * (1.0f + 0x1p-15f) + 4.0f * way * 0x1p-24f);
            CHECK(hit->point == bare->point);
            CHECK(hit->normal == bare->normal);
        });
    }
}

TEST_CASE("scene: the first contact is found without the skin that stops the shape in front of it") {
    // A wall at x = 10, and behind it a slope on which a skin stops far in front.
    const Mesh wall = make_triangle({10, -4, -4}, {10, 4, -4}, {10, 0, 4});
    const Mesh slope = make_triangle({0, -40, 1.4f}, {0, 40, 1.4f}, {40, 0, -0.1f});
    const std::vector<OpenedBlob> blobs = opened_blobs({wall, slope});
    std::vector<Instance> instances(2);
    instances[0].mask = 1;
    instances[1].mesh = 1;
    instances[1].mask = 2;
    const OpenedScene opened(blobs, instances);
    const SceneSweepOptions with_skin = {.skin = 0.125f};
    const Sphere ball = {{0, 0, 0}, 1.0f};
    const Vec3 way = {40, 0, 0};
    SceneSweepOptions of_wall = with_skin, of_slope = with_skin;
    of_wall.filter = 1;
    of_slope.filter = 2;
    const InScene<SweepHit> at_wall = sweep(opened.scene, ball, way, of_wall);
    const InScene<SweepHit> at_slope = sweep(opened.scene, ball, way, of_slope);
    REQUIRE(at_wall);
    REQUIRE(at_slope);
    REQUIRE(sweep(opened.scene, ball, way, 1)->t < sweep(opened.scene, ball, way, 2)->t);
    REQUIRE(at_slope->t < at_wall->t);
    const InScene<SweepHit> hit = sweep(opened.scene, ball, way, with_skin);
    CHECK(hit.instance == at_wall.instance);
    CHECK(same_bits(*hit, *at_wall));
    CHECK(checked(compare_sweeps(opened.scene, ball, way, with_skin)) == 1);
}

TEST_CASE("scene: culling follows the rotation of an instance and a filter its triangles") {
    // The upper one is turned over: it faces down.
    const std::vector<Instance> instances = {placed_at({0, 0, 4}, 2.0f, {1, 0, 0, 0}), placed_at({0, 0, 0}, 0.5f)};
    const OpenedScene opened(one_triangle(), instances);
    const auto source_of = [&](const InScene<SweepHit>& hit) {
        return instance_at(opened.scene, hit.instance)->source;
    };
    for_each_shape({0, -0.5f, 8}, [&](const auto& shape) {
        const auto fall = [&](const SceneSweepOptions& options) {
            return sweep(opened.scene, shape, {0, 0, -16}, options);
        };
        REQUIRE(fall({}));
        CHECK(source_of(fall({})) == 0);
        REQUIRE(fall({.culling = FaceCulling::back}));
        CHECK(source_of(fall({.culling = FaceCulling::back})) == 1);
        CHECK(source_of(fall({.culling = FaceCulling::front})) == 0);
        CHECK(std::fabs(fall({.culling = FaceCulling::back})->face_normal.z - 1.0f) < 0x1p-20f);
        CHECK(std::fabs(fall({.culling = FaceCulling::front})->face_normal.z + 1.0f) < 0x1p-20f);
        const InstanceId upper = fall({}).instance;
        const auto keep = [&](InstanceId instance, TriangleId) { return instance != upper; };
        CHECK(source_of(fall({.filter = keep})) == 1);
        CHECK_FALSE(fall({.filter = keep, .culling = FaceCulling::front}));
        CHECK(fall({.filter = keep, .culling = FaceCulling::front})->t == 1.0f);
    });
}

TEST_CASE("scene: a shape that leaves an instance at the start passes on to the next") {
    const OpenedScene opened(one_cube(), {placed_at({0, 0, 0}, 2.0f), placed_at({10, 0, 0}, 0.5f)});
    for_each_shape({2.25f, 0.25f, 0.125f}, [&](const auto& shape) {  // in the face of the first one at x = 2
        const InScene<SweepHit> stuck = sweep(opened.scene, shape, {8, 0, 0});
        REQUIRE(stuck);
        CHECK(stuck->starts_overlapping);
        const SceneSweepOptions leaving = {.ignore_leaving = true};
        const InScene<SweepHit> free = sweep(opened.scene, shape, {8, 0, 0}, leaving);
        REQUIRE(free);
        CHECK(instance_at(opened.scene, free.instance)->source == 1);
        CHECK(std::fabs(2.75f + 8.0f * free->t - 9.5f) < 1e-5f);
        CHECK_FALSE(free->starts_overlapping);
        CHECK(sweep(opened.scene, shape, {-8, 0, 0}, leaving)->starts_overlapping);
    });
}

TEST_CASE("scene: an axis-aligned box is swept as the oriented box and the hull that it is") {
    const OpenedScene opened(one_cube(), cubes_on_grid(30, 3));
    Random random(4);
    std::size_t hits = 0;
    for (std::uint64_t i = 0; i < scaled(300); ++i) {
        const auto whole = [&] { return static_cast<float>(random.between(-8, 8)); };
        const float x = whole(), y = whole(), z = whole();
        const Box box = {{x, y, z}, {x + 0.5f, y + 0.25f, z + 0.5f}};
        const auto half = [&] { return 0.5f * static_cast<float>(random.between(-32, 32)); };
        const float right = half(), forward = half(), up = half();
        const Vec3 way = {right, forward, up};
        const InScene<SweepHit> own = sweep(opened.scene, box, way);
        const InScene<SweepHit> turned = sweep(opened.scene, oriented(box), way);
        CHECK(same_bits(*own, *turned));
        CHECK(own.instance == turned.instance);
        const std::array<Vec3, 8> corners = corners_of(box);
        const InScene<SweepHit> hull = sweep(opened.scene, ConvexHull{corners}, way);
        CHECK(hull->t == own->t);
        CHECK(hull->starts_overlapping == own->starts_overlapping);
        hits += own ? 1u : 0u;
    }
    CHECK(hits > scaled(50));
}

TEST_CASE("scene: shapes that touch and leave instances exactly equal the loop over all instances") {
    std::vector<OpenedScene> scenes;
    scenes.emplace_back(one_cube(), cubes_on_grid(40, 5));
    std::vector<OpenedScene> tiles;
    tiles.emplace_back(one_cube(), cubes_on_grid(12, 6));
    std::vector<Instance> placed = cubes_on_grid(6, 7);
    for (std::uint32_t i = 0; i < 6; ++i) placed[i].mesh = i / 3;
    scenes.emplace_back(one_cube(), placed, tiles);
    Random random(8);
    std::size_t hits = 0, starts = 0, left = 0;
    const auto keep = [](InstanceId instance, TriangleId triangle) {
        return (instance.index + instance.in_tile + triangle.index) % 3 != 0;
    };
    for (const OpenedScene& opened : scenes)
        for (std::uint64_t i = 0; i < scaled(400); ++i) {
            CAPTURE(i);
            const auto half = [&](int most) { return 0.5f * static_cast<float>(random.between(-most, most)); };
            const Vec3 at = {half(14), half(14), half(14)};
            Vec3 way = {half(16), half(16), half(16)};
            if (random.coin()) way.x = 0;
            if (random.coin()) way.y = 0;
            if (random.below(4) == 0) way.z = 0;
            SceneSweepOptions options = {
                .filter = random.below(4) == 0 ? SceneFilter(random.below(8), keep) : SceneFilter(),
                .culling = static_cast<FaceCulling>(random.below(3)),
                .ignore_leaving = random.coin(),
                .skin = random.coin() ? 0.0f : std::ldexp(1.0f, random.between(-8, 1))};
            for_each_shape(at, [&](const auto& shape) {
                hits += checked(compare_sweeps(opened.scene, shape, way, options));
                SceneSweepOptions staying = options;
                staying.ignore_leaving = false;
                const InScene<SweepHit> hit = sweep(opened.scene, shape, way, staying);
                starts += hit->starts_overlapping ? 1u : 0u;
                left += options.ignore_leaving && hit->starts_overlapping &&
                                !sweep(opened.scene, shape, way, options)->starts_overlapping
                            ? 1u
                            : 0u;
            });
        }
    CHECK(hits > scaled(1'000));
    CHECK(starts > scaled(200));
    CHECK(left > scaled(10));
}

TEST_CASE("scene: sweeps refuse what sweeps of blobs refuse and empty shapes touch nothing") {
    const OpenedScene opened(one_cube(), {placed_at({0, 0, 0}), placed_at({10, 0, 0}, half_root)});
    const BakedScene& scene = opened.scene;
    const BakedScene closed;
    for_each_shape({0, 0, 0}, [&](const auto& shape) {
        CHECK(sweep(closed, shape, {})->status == QueryStatus::not_open);
        for (const float bad : {not_a_number, infinity, -infinity}) {
            CHECK(sweep(scene, shape, {0, bad, 0})->status == QueryStatus::invalid_argument);
            CHECK(sweep(scene, shape, {}, SceneSweepOptions{.skin = bad})->status == QueryStatus::invalid_argument);
        }
        const InScene<SweepHit> refused = sweep(scene, shape, {}, SceneSweepOptions{.skin = -0x1p-140f});
        CHECK(refused->status == QueryStatus::invalid_argument);
        CHECK(refused->t == 0.0f);
        CHECK(refused.instance == no_instance);
        CHECK(sweep(scene, shape, {4, 0, 0}, SceneSweepOptions{.skin = -0.0f}));
    });
    for_each_shape({0, 0, 1e7f}, [&](const auto& shape) {
        CHECK(sweep(scene, shape, {0, 0, -2e7f})->status == QueryStatus::out_of_range);
    });
    for_each_shape({0, 0, 8}, [&](const auto& shape) {
        const InScene<SweepHit> miss = sweep(scene, shape, {0, 0, 50});
        CHECK(miss->status == QueryStatus::not_found);
        CHECK(miss->t == 1.0f);
    });
    for (const float bad : {not_a_number, infinity, -infinity}) {
        CHECK(sweep(scene, Box{{bad, 0, 0}, {1, 1, 1}}, {})->status == QueryStatus::invalid_argument);
        CHECK(sweep(scene, OrientedBox{{}, {{}, {0, bad, 0}, {}}}, {})->status == QueryStatus::invalid_argument);
        const Vec3 vertices[] = {{}, {0, 0, bad}};
        CHECK(sweep(scene, ConvexHull{vertices}, {})->status == QueryStatus::invalid_argument);
    }
    std::vector<Vec3> vertices(max_hull_vertices);
    CHECK(sweep(scene, ConvexHull{vertices}, {2, 0, 0}));
    vertices.resize(max_hull_vertices + 1);
    CHECK(sweep(scene, ConvexHull{vertices}, {2, 0, 0})->status == QueryStatus::invalid_argument);
    const InScene<SweepHit> none = sweep(scene, ConvexHull{}, {2, 0, 0});
    CHECK(none->status == QueryStatus::not_found);
    CHECK(none->t == 1.0f);
    const InScene<SweepHit> empty = sweep(scene, Box{{1, 0, 0}, {0, 1, 1}}, {2, 0, 0});
    CHECK(empty->status == QueryStatus::not_found);
    CHECK(empty->t == 1.0f);
    // A skin that no number holds in local space.
    const OpenedScene small(one_cube(), {placed_at({0, 0, 0}, 0x1p-10f)});
    const Sphere ball = {{-1, 0, 0}, 0.5f};
    REQUIRE(sweep(small.scene, ball, {2, 0, 0}));
    CHECK(sweep(small.scene, ball, {2, 0, 0}, SceneSweepOptions{.skin = 0x1p120f})->status ==
          QueryStatus::out_of_range);
}

}  // namespace
}  // namespace espalier::tests::scenes_sweeps_test
