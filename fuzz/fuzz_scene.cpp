// Any bytes as a scene: opened as they are, then with magic, version, size and checksums made to fit, so that the
// fuzzer reaches what lies behind them. Whatever opens is asked everything; where verify_scene() finds nothing wrong,
// the answers are those of the loop over all instances. Bytes behind the size that the header states are what the
// arguments of the queries are made of.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

#include "judge.hpp"
#include "opening.hpp"
#include "support/base/checksum.hpp"
#include "support/loops/scene_loop.hpp"
#include "target.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

namespace layout = format::scene;

/// Calls `visit` with each mesh and tile that lies inside the scene and returns where what follows them begins.
template <class Visit>
std::size_t for_each_part(std::span<std::byte> scene, Visit visit) {
    const std::size_t stated =
        std::size_t{fuzz::get(scene, layout::mesh_count_at)} + fuzz::get(scene, layout::tile_count_at);
    const std::size_t count = std::min<std::size_t>(stated, scene.size() / 4);
    std::size_t at = layout::header_bytes + layout::part_size_bytes * count;
    for (std::size_t i = 0; i < count && at <= scene.size(); ++i) {
        const std::size_t size = fuzz::get(scene, layout::header_bytes + layout::part_size_bytes * i);
        at = layout::aligned(at);
        if (at > scene.size() || size > scene.size() - at) return scene.size();
        visit(scene.subspan(at, size));
        at += size;
    }
    return std::min(layout::aligned(at), scene.size());
}

/// Repairs the parts too, whose checksums are part of what the scene's own covers.
void repair(std::span<std::byte> scene) {
    for_each_part(scene, [](std::span<std::byte> part) {
        const bool is_tile = part.size() >= layout::header_bytes && fuzz::get(part, layout::magic_at) == layout::magic;
        if (is_tile) for_each_part(part, [](std::span<std::byte> mesh) { repair_checksum(mesh); });
        repair_checksum(part);
    });
    fuzz::repair_header(scene, layout::magic, layout::version_major, layout::version_minor);
}

/// Shapes near a scene, from arguments that the fuzzer chooses.
class Shapes {
public:
    Shapes(const BakedScene& scene, Random& random) : random_(random) {
        const Box box = scene.bounds();
        center_ = {0.5f * box.min.x + 0.5f * box.max.x, 0.5f * box.min.y + 0.5f * box.max.y,
                   0.5f * box.min.z + 0.5f * box.max.z};
        size_ = std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z, 0x1p-120f});
        size_ = std::min(size_, 0x1p120f);
    }
    float length() { return random_.unit() * std::ldexp(size_, random_.between(-20, 2)); }
    Vec3 way() { return random_.in_cube(length()); }
    Vec3 point() {
        const Vec3 from = way();
        return {center_.x + from.x, center_.y + from.y, center_.z + from.z};
    }

private:
    Random& random_;
    Vec3 center_;
    float size_;
};

Vec3 any_bits(Random& random) {
    const auto number = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(random.next() >> 32)); };
    const float x = number(), y = number(), z = number();
    return {x, y, z};
}

/// Asks the scene everything about shapes that no query refuses for their numbers.
void compare_all(const BakedScene& scene, bool is_sound, Random& random) {
    const auto judge = [&](const SceneComparison& comparison) {
        if (is_sound && comparison.fault != nullptr) fuzz::fail("scene", comparison.fault);
    };
    Shapes shapes(scene, random);
    const SceneFilter filter(random.coin() ? 0xFFFFFFFF : random.below(16));
    Ray ray = {shapes.point(), shapes.way()};
    if (ray.direction == Vec3{}) ray.direction.x = 1.0f;
    judge(compare_rays(scene, ray, filter));
    judge(compare_closest_points(scene, shapes.point(), shapes.length(), filter.mask()));
    const Sphere sphere = {shapes.point(), shapes.length()};
    const Capsule capsule = {shapes.point(), shapes.point(), shapes.length()};
    const Vec3 corner = shapes.point();
    const Box box = {corner, {corner.x + shapes.length(), corner.y + shapes.length(), corner.z + shapes.length()}};
    Cone cone = {shapes.point(), shapes.way(), shapes.length()};
    if (cone.axis == Vec3{}) cone.axis.y = 1.0f;
    judge(compare_overlaps(scene, sphere, filter));
    judge(compare_overlaps(scene, capsule, filter));
    judge(compare_overlaps(scene, box, filter));
    judge(compare_overlaps(scene, OrientedBox{corner, {shapes.way(), shapes.way(), shapes.way()}}, filter));
    judge(compare_overlaps(scene, Triangle{shapes.point(), shapes.point(), shapes.point()}, filter));
    judge(compare_overlaps(scene, cone, filter));
    judge(compare_sweeps(scene, sphere, shapes.way(), filter));
    judge(compare_sweeps(scene, capsule, shapes.way(), filter));
}

/// Asks with any bits: only that nothing breaks counts.
void ask_with_any_bits(const BakedScene& scene, Random& random) {
    const Vec3 a = any_bits(random), b = any_bits(random), c = any_bits(random), d = any_bits(random);
    const auto ignore = [](InstanceId, TriangleId) {};
    static_cast<void>(raycast(scene, Ray{a, b, c.x, c.y}));
    static_cast<void>(occluded(scene, Ray{a, b, c.x, c.y}));
    static_cast<void>(for_each_hit(scene, Ray{a, b}, [](InstanceId, const RayHit&) {}));
    static_cast<void>(closest_point(scene, a, b.x));
    static_cast<void>(for_each_overlap(scene, Sphere{a, b.x}, ignore));
    static_cast<void>(for_each_overlap(scene, Capsule{a, b, c.x}, ignore));
    static_cast<void>(for_each_overlap(scene, Box{a, b}, ignore));
    static_cast<void>(for_each_overlap(scene, OrientedBox{a, {b, c, d}}, ignore));
    static_cast<void>(for_each_overlap(scene, Triangle{a, b, c}, ignore));
    static_cast<void>(for_each_overlap(scene, Cone{a, b, c.x}, ignore));
    static_cast<void>(for_each_candidate(scene, Box{a, b}, [](InstanceId) {}));
    static_cast<void>(sweep(scene, Sphere{a, b.x}, c));
    static_cast<void>(sweep(scene, Capsule{a, b, c.x}, d));
    const InstanceId id = {random.below(scene.instance_count() + 2), random.coin() ? random.below(4) : 0xFFFFFFFF};
    static_cast<void>(instance_at(scene, id));
    static_cast<void>(mesh_at(scene, id));
    static_cast<void>(is_on_common_lattice(scene, id));
}

void open_and_ask(std::span<const std::byte> bytes, std::span<const std::byte> arguments) {
    std::vector<Blob> meshes(mesh_count_of_scene(bytes));
    std::vector<BakedScene> tiles(tile_count_of_scene(bytes));
    const BakedScene scene = open_scene(bytes, meshes, tiles);
    const bool is_sound = verify_scene(bytes).sound;
    if (!scene) {
        if (is_sound || scene.instance_count() != 0 || scene.size() != 0)
            fuzz::fail("open_scene", "refused and not empty");
        return;
    }
    Random random(bytes.size(), arguments);
    for (int i = 0; i < 4; ++i) {
        compare_all(scene, is_sound, random);
        ask_with_any_bits(scene, random);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::judge_repaired_too(std::as_bytes(std::span(data, size)), open_and_ask, repair);
    return 0;
}

#if defined(ESPALIER_FUZZ)

namespace {

/// Changes a word of the header, or of the nodes and records.
void change_a_word(std::span<std::byte> scene, Random& random) {
    const std::size_t from = random.below(4) == 0 ? 0 : for_each_part(scene, [](std::span<std::byte>) {});
    const std::size_t end = from == 0 ? layout::header_bytes + 16 : scene.size();
    if (end > scene.size() || end < from + 4) return;
    const std::size_t at = from + 4 * std::size_t{random.below(static_cast<std::uint32_t>((end - from) / 4))};
    fuzz::put(scene, at, fuzz::changed_word(fuzz::get(scene, at), random));
}

}  // namespace

/// Changes the scene or the arguments, and repairs what the first checks of `open_scene` would stop at.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    Random random(seed);
    const auto bytes_of = [&](std::size_t count) { return std::as_writable_bytes(std::span(data, count)); };
    const std::size_t scene_bytes = fuzz::stated_size(bytes_of(size));
    if (scene_bytes < layout::header_bytes || random.below(8) == 0) return LLVMFuzzerMutate(data, size, max_size);
    if (random.below(3) == 0) {  // other arguments
        const std::size_t room = std::min<std::size_t>(max_size - scene_bytes, 512);
        return scene_bytes + LLVMFuzzerMutate(data + scene_bytes, std::min(size - scene_bytes, room), room);
    }
    for (std::uint32_t i = 0; i <= random.below(3); ++i) change_a_word(bytes_of(scene_bytes), random);
    repair(bytes_of(scene_bytes));
    return size;
}

#endif
