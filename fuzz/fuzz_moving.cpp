// Scripts of calls on a moving scene: the first bytes choose the memory, the others one call after the other. After
// each call the scene is what a map of instances says, and a copy of its bytes opens. Queries and pairs are those of
// loops over all instances. Copies with damaged bytes are refused, or hold all of that too.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "judge.hpp"
#include "moving/pairs.hpp"
#include "moving/trial.hpp"
#include "moving/world.hpp"
#include "opening.hpp"
#include "scene_questions.hpp"
#include "support/base/same_bits.hpp"
#include "target.hpp"

using namespace espalier;
using namespace espalier::tests;
using fuzz::require;

namespace {

/// The bytes of an input, as calls.
class Script {
public:
    explicit Script(std::span<const std::byte> bytes) : rest_(bytes) {}

    [[nodiscard]] bool is_over() const { return rest_.empty(); }
    std::uint32_t byte() {
        if (rest_.empty()) return 0;
        const auto value = std::to_integer<std::uint32_t>(rest_[0]);
        rest_ = rest_.subspan(1);
        return value;
    }
    /// Returns what draws the arguments of a call: from the bytes that follow, up to 15 words, then from a seed.
    Random arguments() {
        const std::uint32_t lengths = byte();
        const std::size_t size = std::min<std::size_t>(4 * (lengths % 16), rest_.size());
        const std::span<const std::byte> bytes = rest_.first(size);
        rest_ = rest_.subspan(size);
        return Random(lengths / 16 + 16 * ++calls_, bytes);
    }

private:
    std::span<const std::byte> rest_;
    std::uint64_t calls_ = 0;
};

/// Checks the calls that the loop over all instances does not make.
void ask_for_more(const MovingScene& scene, const fuzz::Model& model, fuzz::ShapesNear shapes, Random& random) {
    Ray rays[5];
    InScene<RayHit> hits[5];
    for (Ray& ray : rays) ray = {shapes.point(), random.below(8) == 0 ? Vec3{} : shapes.way()};
    const std::span<InScene<RayHit>> asked = std::span(hits).first(random.below(6));
    const Filled filled = raycast(scene, std::span<const Ray>(rays).first(asked.size()), asked);
    require(filled.count <= asked.size(), "a batch has more hits than rays");
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const InScene<RayHit> alone = raycast(scene, rays[i]);
        require(same_bits(*alone, *hits[i]) && alone.instance == hits[i].instance,
                "a batch of rays is not each of them");
    }
    const Lattice region = {shapes.point(), random.between(-130, 130), {100, 1 << 20, random.between(-5, 1 << 24)}};
    const RoundedRay rounded = round_ray(region, rays[0]);
    static_cast<void>(raycast(scene, rays[0], rounded));
    static_cast<void>(occluded(scene, rays[0], rounded));
    static_cast<void>(for_each_hit(scene, rays[0], rounded, [](InstanceId, const RayHit&) {}));

    const Vec3 corner = shapes.point();
    const Box box = {corner, {corner.x + shapes.length(), corner.y + shapes.length(), corner.z + shapes.length()}};
    const std::uint32_t mask = random.coin() ? 0xFFFFFFFF : random.below(16);
    std::vector<std::uint32_t> visited;
    const QueryStatus status = for_each_candidate(
        scene, box, [&](InstanceId id) { visited.push_back(id.index); }, mask);
    for (const std::uint32_t slot : visited)
        require(model.live().contains(slot) && (model.live().at(slot).mask & mask) != 0, "a candidate that is masked");
    if (status != QueryStatus::ok) return;
    std::ranges::sort(visited);
    for (const auto& [slot, instance] : model.live()) {
        const Box own = *box_of(scene, model.handle_of(slot));
        // Floats hold boxes of up to 2^24 steps exactly; of a tile only parts may be near.
        const float end = std::ldexp(1.0f, scene.step_exponent() + 24);
        const auto is_near = [&](float low, float high, float own_low, float own_high) {
            return low <= own_high && own_low <= high && std::abs(own_low) <= end && std::abs(own_high) <= end;
        };
        if ((instance.mask & mask) != 0 && instance.mesh < scene.meshes().size() &&
            is_near(box.min.x, box.max.x, own.min.x, own.max.x) &&
            is_near(box.min.y, box.max.y, own.min.y, own.max.y) && is_near(box.min.z, box.max.z, own.min.z, own.max.z))
            require(std::ranges::binary_search(visited, slot), "a candidate is left out");
    }
}

void ask(fuzz::Trial& trial, Random& random) {
    const MovingScene& scene = trial.scene();
    const Ray ray = {{}, {0.0f, 0.0f, 1.0f}};
    const bool must_wait = scene.must_refit();
    require((raycast(scene, ray)->status == QueryStatus::not_refitted) == must_wait, "a ray does not wait for a refit");
    const fuzz::ShapesNear shapes({}, 8.0f * trial.unit(), random);
    if (!must_wait) {
        fuzz::compare_with_loop(scene, true, shapes, random);
        ask_for_more(scene, trial.model(), shapes, random);
    }
    const auto away = [&] {
        return double(random.signed_unit()) * std::ldexp(double(trial.unit()), random.between(0, 40));
    };
    const double x = away(), y = away(), z = away();
    const MovingScene view = seen_from(scene, {x, y, z});
    if (view && !must_wait) fuzz::compare_with_loop(view, true, shapes, random);
    fuzz::ask_with_any_bits(view ? view : scene, random);
}

/// Opens a copy of the scene with damaged bytes. What opens is changed and asked like any scene.
void damage(fuzz::Trial& trial, Random& random) {
    const std::span<const std::byte> whole = trial.scene().bytes();
    const auto size = static_cast<std::uint32_t>(whole.size());
    const std::uint32_t kind = random.below(16);
    if (kind < 2) {
        AlignedBuffer copy(kind == 0 ? whole.first(random.below(size)) : whole, kind == 0 ? 0 : 1 + random.below(31));
        require(!open_moving_scene(copy.bytes(), fuzz::world().meshes(), fuzz::world().tiles()),
                "a truncated or misaligned copy opens");
        return;
    }
    std::vector<std::byte> bytes(whole.begin(), whole.end());
    for (std::uint32_t i = 0; i <= random.below(4); ++i) {
        const std::size_t at = 4 * std::size_t{random.below((random.coin() ? 64 : size) / 4)};
        fuzz::put(bytes, at, fuzz::changed_word(fuzz::get(bytes, at), random));
    }
    fuzz::Trial damaged(bytes);
    if (!damaged.scene()) return;
    damaged.check();
    ask(damaged, random);
    fuzz::check_pairs(damaged, random);
    for (int i = 0; i < 12; ++i) {
        damaged.change(random.below(fuzz::change_kinds), random);
        damaged.check();
    }
    damaged.change(8, random);  // a refit
    ask(damaged, random);
    fuzz::check_pairs(damaged, random);
}

void run(Script& script) {
    constexpr std::uint32_t capacities[] = {1, 2, 7, 8, 9, 20, 33, 64, 65, 150};
    constexpr int exponents[] = {-12, -12, -14, -20, -6, 0, -40, -84, -100, 80, 60, -101, 81};
    const std::uint32_t capacity = capacities[script.byte() % std::size(capacities)];
    const int exponent = exponents[script.byte() % std::size(exponents)];
    const auto least = static_cast<std::size_t>(least_moving_scene_bytes(capacity));
    const auto all = static_cast<std::size_t>(moving_scene_bytes(capacity));
    // The least, all, or some in between; a byte too few is too few.
    const std::uint32_t kind = script.byte();
    const std::size_t memory = kind % 8 == 0 ? least - 1 : least + (all - least) * (kind % 8 - 1) / 6;
    fuzz::Trial trial(capacity, exponent, memory);
    const bool is_created = kind % 8 != 0 && exponent >= -100 && exponent <= 80;
    require(static_cast<bool>(trial.scene()) == is_created, "create_moving_scene() has taken or refused its arguments");
    for (int calls = 0; is_created && calls < 300 && !script.is_over(); ++calls) {
        const std::uint32_t call = script.byte();
        Random arguments = script.arguments();
        switch (call % 16) {
            case 10:
            case 11:
                ask(trial, arguments);
                break;
            case 12:
            case 13:
                fuzz::check_pairs(trial, arguments);
                break;
            case 14:
                damage(trial, arguments);
                break;
            case 15:  // several insertions at once, so that trees of some levels need few bytes
                for (std::uint32_t i = 0; i <= call / 16; ++i) trial.change(0, arguments);
                break;
            default:
                trial.change(call % 16, arguments);
        }
        trial.check();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 4096) return 0;
    Script script(std::as_bytes(std::span(data, size)));
    run(script);
    return 0;
}
