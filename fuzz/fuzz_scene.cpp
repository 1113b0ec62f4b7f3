// Any bytes as a scene: opened as they are, then with magic, version, size and checksums made to fit, so that the
// fuzzer reaches what lies behind them. Whatever opens is asked everything; where verify_scene() finds nothing wrong,
// the answers are those of the loop over all instances. Bytes behind the size that the header states are what the
// arguments of the queries are made of.
#include <algorithm>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>
#include <espalier/scenes/bake.hpp>

#include "judge.hpp"
#include "opening.hpp"
#include "scene_questions.hpp"
#include "support/base/checksum.hpp"
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

/// Asks about instances by any numbers.
void ask_for_instances(const BakedScene& scene, Random& random) {
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
        fuzz::compare_with_loop(scene, is_sound, fuzz::ShapesNear(scene.bounds(), random), random);
        fuzz::ask_with_any_bits(scene, random);
        ask_for_instances(scene, random);
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
