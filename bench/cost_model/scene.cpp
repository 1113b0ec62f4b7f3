// The cost of a step of a moving scene: Nv tests of a box against a node, Np pairs found, Nu boxes renewed.

#include <espalier/scenes/statistics.hpp>

#include "../../tests/runtime/moving_scenes/made_scene.hpp"
#include "model.hpp"

namespace espalier::bench {
namespace {

using tests::Random;

// What scenes differ in: else boxes, pairs and nodes grow together.
constexpr double pairs_of_a_cube[] = {0.1, 0.5, 2.0, 6.0};
constexpr float drifts[] = {0.0f, 1.0f, 4.0f};  ///< sides of a cube that all moved by since the tree was packed
constexpr double moved_shares[] = {1.0 / 64, 1.0 / 8, 1.0 / 2, 1.0};
constexpr unsigned variants = 2;
/// A cube moves by up to this share of its side in a step.
constexpr float speed = 0.1f;

[[noreturn]] void fail(const char* what, QueryStatus status) {
    throw std::runtime_error(std::string(what) + ": " + describe(status));
}

Blob open_cube() {
    static const BakedBlob baked = bake_blob(tests::make_cube(-0.5f, 0.5f));
    return baked.blob;
}

/// Cubes of side 1, turned at random, at places in a cubic region.
class CubeScene {
public:
    CubeScene(const Blob& cube, unsigned count, double pairs_of_each, float drift, std::uint64_t number)
        : made_(count, -10, {&cube, 1}), random_(number), scene(made_.scene) {
        // Boxes of turned cubes are 1.5 wide, so that two touch if their middles are within a cube of side 3.
        const double volume = count * 27.0 / (2.0 * pairs_of_each);
        const auto half_side = static_cast<float>(0.5 * std::cbrt(volume));
        for (unsigned i = 0; i < count; ++i) {
            Instance instance;
            instance.transform.rotation = {random_.signed_unit(), random_.signed_unit(), random_.signed_unit(), 0.5f};
            instance.transform.translation = random_.in_cube(half_side);
            const Result<InstanceHandle> handle = insert(scene, instance);
            if (!handle) fail("insert", handle.status);
            handles_.push_back(*handle);
        }
        repack(scene);
        apply(movements(count, drift));
        refit(scene);
    }
    /// Makes random movements of so many cubes from where they are.
    std::vector<Movement> movements(std::size_t count, float distance) {
        std::vector<Movement> all;
        // A random choice: each of the cubes that are left has the same chance.
        for (std::size_t i = 0; i < handles_.size() && all.size() < count; ++i)
            if (random_.below(static_cast<std::uint32_t>(handles_.size() - i)) < count - all.size())
                all.push_back(moved(handles_[i], random_.in_cube(distance)));
        return all;
    }
    /// Returns the movements that undo others.
    [[nodiscard]] std::vector<Movement> back(std::vector<Movement> others) const {
        for (Movement& movement : others) movement.transform = instance_at(scene, movement.instance)->transform;
        return others;
    }
    void apply(const std::vector<Movement>& all) {
        const Filled filled = move(scene, all);
        if (filled.status != QueryStatus::ok) fail("move", filled.status);
    }

private:
    [[nodiscard]] Movement moved(InstanceHandle handle, Vec3 by) const {
        Transform transform = instance_at(scene, handle)->transform;
        transform.translation.x += by.x;
        transform.translation.y += by.y;
        transform.translation.z += by.z;
        return {handle, transform};
    }

    tests::MadeScene made_;
    std::vector<InstanceHandle> handles_;
    Random random_;

public:
    MovingScene& scene;
};

/// Two steps of a scene, of which the second undoes the first, and means of one of them.
struct StepGroup {
    CubeScene* cubes;
    std::vector<Movement> steps[2];
    double box_tests = 0.0;
    double pairs = 0.0;
    double nodes = 0.0;  ///< renewed by refit()
    double boxes = 0.0;  ///< of instances and nodes
};

StepGroup make_group(CubeScene& cubes, std::size_t moved, std::vector<InstancePair>& room) {
    StepGroup group{&cubes, {}};
    group.steps[0] = cubes.movements(moved, speed);
    group.steps[1] = cubes.back(group.steps[0]);
    for (const std::vector<Movement>& step : group.steps) {
        cubes.apply(step);
        const std::uint32_t nodes = refit(cubes.scene);
        SceneCounters counters;
        const auto found = collect_candidate_pairs(cubes.scene, room, counters);
        if (found.status != QueryStatus::ok) fail("pairs", found.status);
        group.box_tests += 0.5 * static_cast<double>(counters.box_tests);
        group.pairs += 0.5 * static_cast<double>(counters.pairs);
        group.nodes += 0.5 * nodes;
        group.boxes += 0.5 * (nodes + static_cast<double>(step.size()));
    }
    return group;
}

/// Makes both steps. Returns how many pairs they found.
unsigned run(const StepGroup& group, std::vector<InstancePair>& room) {
    std::size_t found = 0;
    for (const std::vector<Movement>& step : group.steps) {
        group.cubes->apply(step);
        refit(group.cubes->scene);
        found += collect_candidate_pairs(group.cubes->scene, room).count;
    }
    return static_cast<unsigned>(found);
}

/// What stands for the updates: the boxes of instances that moved and of nodes that refit() renewed (Nu of Klosowski
/// et al. 1998), or the nodes alone.
struct StepTerm {
    Term term;
    double StepGroup::*count;
};
constexpr StepTerm step_terms[] = {{"Nu", &StepGroup::boxes}, {"Nn", &StepGroup::nodes}};

}  // namespace

void model_scene(const CostOptions& options) {
    const Blob cube = open_cube();
    std::vector<InstancePair> room(std::size_t{16} * options.cubes);
    std::vector<std::unique_ptr<CubeScene>> scenes;
    std::vector<StepGroup> groups;
    for (const double pairs : pairs_of_a_cube)
        for (const float drift : drifts)
            for (unsigned variant = 0; variant < variants; ++variant) {
                scenes.push_back(std::make_unique<CubeScene>(cube, options.cubes, pairs, drift, seed + scenes.size()));
                for (const double share : moved_shares)
                    groups.push_back(make_group(*scenes.back(), static_cast<std::size_t>(share * options.cubes), room));
            }
    const std::vector<std::size_t> calls(groups.size(), 2);
    const std::vector<double> times =
        time_in_turns(calls, options.repetitions, true, [&](std::size_t i) { return run(groups[i], room); });
    std::vector<Model> models;
    for (const StepTerm& updates : step_terms) {
        std::vector<Observation> observations;
        for (std::size_t i = 0; i < groups.size(); ++i)
            observations.push_back({{groups[i].box_tests, groups[i].pairs, groups[i].*updates.count, 1.0}, times[i]});
        models.push_back(fit_model("cubes", {"Nv", "Np", updates.term}, observations, Differences::relative));
    }
    print_rows(models, [&](const std::string& measures) {
        JsonObject row = guide_row(measures, "cubes", cube.triangle_count());
        row.add("query", "step");
        row.add("instances", std::size_t{options.cubes});
        return row;
    });
}

}  // namespace espalier::bench
