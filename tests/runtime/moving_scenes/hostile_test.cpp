// Claims about blocks of any bytes: open_moving_scene() refuses them, or every call on them is safe, leaves a block
// that opens, and answers as a loop over all instances does.
#include "support/testing.hpp"

#include "made_bytes.hpp"
#include "support/loops/scene_loop.hpp"

namespace espalier::tests::moving_scenes_hostile_test {
namespace {

/// Ends the test case where something does not hold. REQUIRE takes longer than what it is asked for here.
void require(bool holds, const char* what) {
    if (!holds) FAIL(std::string(what));
}

/// Requires that a copy of a scene's bytes opens.
void require_open(const MovingScene& scene) {
    AlignedBuffer copy(scene.bytes());
    require(static_cast<bool>(open_bytes(copy.bytes())), "a copy of the block does not open");
}

std::vector<InstanceHandle> handles_of(const MovingScene& scene) {
    std::vector<InstanceHandle> handles;
    for (std::uint32_t slot = 0; slot < scene.slot_end(); ++slot)
        if (const Result<InstanceHandle> handle = handle_of(scene, slot)) handles.push_back(*handle);
    require(handles.size() == scene.instance_count(), "another number of instances");
    return handles;
}

void check_pairs(MovingScene& scene) {
    const std::vector<InstanceHandle> handles = handles_of(scene);
    std::vector<InstancePair> expected, page(handles.size() * handles.size());
    for (std::size_t i = 0; i < handles.size(); ++i)
        for (std::size_t j = i + 1; j < handles.size(); ++j) {
            const std::uint32_t mask = instance_at(scene, handles[i])->mask & instance_at(scene, handles[j])->mask;
            if (mask != 0 && share_a_point(*box_of(scene, handles[i]), *box_of(scene, handles[j])))
                expected.push_back({handles[i].slot, handles[j].slot});
        }
    const FilledPairs<InstancePair> found = collect_candidate_pairs(scene, page);
    require(found.status == QueryStatus::ok && std::ranges::equal(found.in(page), expected), "other pairs");
    const FilledPairs<InstancePair> moved = collect_candidate_pairs(scene, page, {true, {}});
    require(moved.status == QueryStatus::ok && moved.count <= expected.size(), "more pairs that moved than pairs");
    const FilledPairs<InstancePair> colliding = collect_colliding_pairs(scene, page, WorkLimit(1'000));
    require(colliding.count <= expected.size(), "more pairs that collide than pairs");
}

void check_answers(MovingScene& scene) {
    const auto check = [](const SceneComparison& comparison) {
        require(comparison.fault == nullptr, comparison.fault);
    };
    require(quality(scene) >= 0.0f, "a quality that is no number");
    check(compare_rays(scene, {{-9.0f, 0.1f, 0.2f}, {1.0f, 0.01f, 0.02f}}));
    check(compare_rays(scene, {{1.0f, 2.0f, 9.0f}, {-0.125f, -0.25f, -1.0f}}, 2));
    check(compare_closest_points(scene, {1.0f, 2.0f, 3.0f}, 2.5f));
    check(compare_overlaps(scene, Sphere{{0.5f, 0.5f, 0.5f}, 1.0f}));
    check(compare_overlaps(scene, Box{{-9.0f, -9.0f, -9.0f}, {0.0f, 0.0f, 9.0f}}, 1));
    check(compare_sweeps(scene, Sphere{{-9.0f, 0.0f, 0.0f}, 0.25f}, {20.0f, 1.0f, 0.0f}));
    const Vec3 vertices[] = {{-9.0f, 0.0f, 0.0f}, {-8.0f, 0.0f, 0.0f}, {-9.0f, 1.0f, 0.5f}};
    check(compare_sweeps(scene, ConvexHull{vertices}, {20.0f, 1.0f, 0.0f}, SceneSweepOptions{.skin = 0.5f}));
    check_pairs(scene);
}

/// Calls every function that changes a scene, and checks the scene in between.
void change_and_check(MovingScene& scene) {
    Random random(5);
    std::vector<Movement> movements;
    for (const InstanceHandle& handle : handles_of(scene)) movements.push_back({handle, any_cube(random).transform});
    if (!movements.empty()) require(move(scene, movements[0].instance, {}) == QueryStatus::ok, "no move");
    require_open(scene);
    require(move(scene, movements).count == movements.size(), "no batch of moves");
    require_open(scene);
    require(refit(scene) <= scene.capacity(), "a refit of more nodes than there are");
    require_open(scene);
    check_answers(scene);
    QueryStatus status = QueryStatus::ok;
    for (std::uint32_t i = 0; i <= scene.capacity() && status == QueryStatus::ok; ++i) {
        status = insert(scene, any_cube(random)).status;
        require_open(scene);
    }
    const bool is_small_world = scene.step_exponent() < -20 && status == QueryStatus::out_of_range;
    require(status == QueryStatus::no_room || is_small_world, "no full scene");
    check_answers(scene);
    end_step(scene);
    for (const InstanceHandle& handle : handles_of(scene)) {
        require(set_mask(scene, handle, 3) == QueryStatus::ok, "no mask");
        if (handle.slot % 3 == 0) continue;
        require(remove(scene, handle) == QueryStatus::ok, "no removal");
        require_open(scene);
    }
    check_answers(scene);
    repack(scene);
    require_open(scene);
    check_answers(scene);
    for (const InstanceHandle& handle : handles_of(scene))
        require(remove(scene, handle) == QueryStatus::ok, "no removal");
    require_open(scene);
}

/// Removes every third instance of a scene that waits for a refit, and inserts others.
void change_before_refit(MovingScene& scene) {
    Random random(6);
    std::uint32_t removed = 0;
    for (const InstanceHandle& handle : handles_of(scene)) {
        if (handle.slot % 3 != 1) continue;
        require(remove(scene, handle) == QueryStatus::ok, "no removal");
        ++removed;
    }
    require_open(scene);
    for (; removed > 1; --removed) (void)insert(scene, any_cube(random));
    require_open(scene);
}

/// What became of changed bytes.
struct Tally {
    std::size_t tried = 0, accepted = 0;

    /// Opens the bytes in memory of their size. Asks the scene if they are accepted, and changes every third one, and
    /// every second one that waits for a refit.
    void add(const Bytes& bytes) {
        ++tried;
        AlignedBuffer copy(bytes);
        MovingScene scene = open_bytes(copy.bytes());
        if (!scene) return;
        ++accepted;
        if (scene.must_refit()) {
            const Ray ray = {{}, {0.0f, 0.0f, 1.0f}};
            require(raycast(scene, ray)->status == QueryStatus::not_refitted, "a ray that does not wait for a refit");
            if (accepted % 2 == 0) change_before_refit(scene);
            refit(scene);
        }
        check_answers(scene);
        if (accepted % 3 == 0) change_and_check(scene);
    }
    void require_both() const {
        CHECK(accepted > 0);
        CHECK(accepted < tried);
    }
};

std::uint32_t word_of(const Bytes& bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}
void set_word(Bytes& bytes, std::size_t at, std::uint32_t word) { std::memcpy(bytes.data() + at, &word, sizeof word); }

TEST_CASE("scene: every truncation of a moving scene and every misaligned copy is refused") {
    const Bytes bytes = make_bytes(14, 13, false);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        AlignedBuffer cut(std::span<const std::byte>(bytes).first(size));
        REQUIRE_FALSE(open_bytes(cut.bytes()));
    }
    for (std::size_t by = 1; by < AlignedBuffer::alignment; ++by) {
        AlignedBuffer copy(bytes, by);
        REQUIRE_FALSE(open_bytes(copy.bytes()));
        REQUIRE_FALSE(create_moving_scene(copy.bytes(), 14, -12, cubes_and_tile().meshes));
    }
    AlignedBuffer whole(bytes);
    CHECK(open_bytes(whole.bytes()));
}

TEST_CASE("scene: every flipped bit of a moving scene is refused or safe and exact") {
    for (const bool must_refit : {false, true}) {
        const Bytes original = make_bytes(14, 13, must_refit);
        Tally tally;
        for (const std::size_t bit : sampled(8 * original.size(), 8)) {
            CAPTURE(bit);
            Bytes bytes = original;
            bytes[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
            tally.add(bytes);
        }
        tally.require_both();
    }
}

TEST_CASE("scene: every word of a moving scene may hold any number") {
    for (const bool must_refit : {false, true}) {
        const Bytes original = make_bytes(14, 13, must_refit);
        Tally tally;
        for (std::size_t at = 0; at + 4 <= original.size(); at += 4) {
            const std::uint32_t word = word_of(original, at);
            const std::uint32_t values[] = {
                0u,          1u,          2u,          7u,          13u,         14u,         15u,         1u << 24,
                0x7FFFFFFFu, 0x80000000u, 0x80000001u, 0xFFFFFFFEu, 0xFFFFFFFFu, 0x3F800000u, 0x7F7FFFFFu, 0x7F800000u,
                0x7FC00000u, 0xFF800000u, word + 1,    word - 1,    word + 8,    word - 8,    ~word};
            for (const std::size_t number : sampled(std::size(values), 6, at)) {
                CAPTURE(at);
                CAPTURE(values[number]);
                Bytes bytes = original;
                set_word(bytes, at, values[number]);
                tally.add(bytes);
            }
        }
        tally.require_both();
    }
}

TEST_CASE("scene: every byte of the head of a moving scene may hold any number") {
    for (const std::uint32_t count : {1u, 13u}) {  // all instances are removed again from the first
        const Bytes original = make_bytes(14, count, false);
        Tally tally;
        for (std::size_t at = 0; at < sizeof(detail::BlockHead); ++at)
            for (const std::size_t value : sampled(256, 8, at)) {
                CAPTURE(at);
                CAPTURE(value);
                Bytes bytes = original;
                bytes[at] = static_cast<std::byte>(value);
                tally.add(bytes);
            }
        tally.require_both();
    }
}

TEST_CASE("scene: moving scenes of several levels with changed words are refused or safe and exact") {
    Random random(8);
    for (const bool must_refit : {false, true}) {
        const Bytes original = make_bytes(80, 78, must_refit);
        const auto words = static_cast<std::uint32_t>(original.size() / 4);
        REQUIRE(std::to_integer<unsigned>(original[13]) == 3);  // levels
        Tally tally;
        for (std::uint64_t i = 0; i < scaled(1'500); ++i) {
            CAPTURE(i);
            Bytes bytes = original;
            for (std::uint32_t left = 1 + random.below(2); left > 0; --left) {
                const std::size_t at = 4 * std::size_t{random.below(random.coin() ? 16 : words)};
                // Often the number of another node, slot or place.
                const std::uint32_t other = random.coin() ? random.below(160) : word_of(bytes, 4 * random.below(words));
                set_word(bytes, at, random.coin() ? word_of(bytes, at) + random.below(17) - 8 : other);
            }
            tally.add(bytes);
        }
        tally.require_both();
    }
}

}  // namespace
}  // namespace espalier::tests::moving_scenes_hostile_test
