// Claims about scenes that hold the same instances in another way: in another order, in tiles.
#include "support/testing.hpp"

#include <stdexcept>

#include "maker.hpp"

namespace espalier::tests::metamorphic_test {
namespace {

const TestScene& scene_named(const std::string& name) {
    for (const TestScene& test : test_scenes())
        if (test.name == name) return test;
    throw std::runtime_error("no scene " + name);
}

/// What a ray hits, whatever the number of the instance: its place in the list that was baked.
struct Answer {
    float t = 0.0f;
    std::uint32_t source = 0;
    TriangleId triangle;
    bool is_hit = false;
};

Answer answer_of(const BakedScene& scene, const Ray& ray, const std::vector<std::uint32_t>& source_of) {
    const InScene<RayHit> hit = raycast(scene, ray);
    if (!hit) return {};
    const Instance outer = *instance_at(scene, {hit.instance.index});
    const std::uint32_t at = hit.instance.in_tile == no_instance.in_tile
                                 ? outer.source
                                 : outer.user + instance_at(scene, hit.instance)->source;
    return {hit->t, source_of[at], hit->triangle, true};
}

/// Returns the numbers from 0 on.
std::vector<std::uint32_t> in_order(std::size_t count) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

/// Casts rays into both. Of equal t another instance may come first, where their order is another.
void require_same_hits(const TestScene& test, const BakedScene& other, const std::vector<std::uint32_t>& source_of) {
    const std::vector<std::uint32_t> own = in_order(test.instances.size());
    SceneQueryMaker maker(test, 31);
    std::size_t hits = 0;
    for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
        const Ray ray = maker.ray();
        const Answer expected = answer_of(test.opened.scene, ray, own), answer = answer_of(other, ray, source_of);
        CAPTURE(i);
        REQUIRE(answer.is_hit == expected.is_hit);
        REQUIRE(answer.t == expected.t);
        if (answer.source == expected.source) REQUIRE(answer.triangle == expected.triangle);
        hits += expected.is_hit ? 1u : 0u;
    }
    CHECK(hits > scaled(200));
}

TEST_CASE("scene: instances in another order give the same hits") {
    for (const char* name : {"many, apart", "many, one in the other", "tiles among others"}) {
        CAPTURE(std::string(name));
        const TestScene& test = scene_named(name);
        std::vector<std::uint32_t> order = in_order(test.instances.size());
        Random random(41);
        for (std::size_t i = order.size(); i > 1; --i)
            std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
        std::vector<Instance> shuffled;
        for (const std::uint32_t from : order) shuffled.push_back(test.instances[from]);
        const OpenedScene other(test.blobs, shuffled);
        require_same_hits(test, other.scene, order);
    }
}

TEST_CASE("scene: instances in tiles that do not move give the same hits") {
    for (const char* name : {"many, apart", "tiles among others"}) {
        CAPTURE(std::string(name));
        const TestScene& test = scene_named(name);
        std::vector<OpenedScene> tiles;
        std::vector<Instance> places;
        constexpr std::size_t in_tile = 6;  // the pieces on the lattice are 36
        for (std::size_t from = 0; from < test.instances.size(); from += in_tile) {
            const auto begin = test.instances.begin() + static_cast<std::ptrdiff_t>(from);
            const std::size_t count = std::min(in_tile, test.instances.size() - from);
            tiles.emplace_back(test.blobs, std::vector<Instance>(begin, begin + static_cast<std::ptrdiff_t>(count)));
            Instance place = {.transform = {},
                              .mesh = static_cast<std::uint32_t>(test.blobs.size() + tiles.size() - 1),
                              .user = static_cast<std::uint32_t>(from)};
            places.push_back(place);
        }
        const OpenedScene other(test.blobs, places, tiles);
        REQUIRE(other.scene.tiles().size() > 4);
        require_same_hits(test, other.scene, in_order(test.instances.size()));
    }
}

}  // namespace
}  // namespace espalier::tests::metamorphic_test
