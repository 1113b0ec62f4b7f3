// One step of a simulation in which objects move: new boxes or places, and all pairs that touch. Or the tree of a
// moving scene under insertions and removals, or meshes that tumble. JSON, an object a line.

#include "../program.hpp"
#include "broad_phase.hpp"
#include "turns.hpp"

namespace espalier::bench::moving {
namespace {

BroadPhaseMakers all_makers(const Scenario& scenario) {
    BroadPhaseMakers makers;
    const auto append = [&](BroadPhaseMakers more) {
        for (BroadPhaseMaker& maker : more) makers.push_back(std::move(maker));
    };
    append(espalier_box_makers(scenario));
    append(espalier_placement_makers(scenario));
    append(placement_loop_makers());
    append(grid_makers());
    append(sort_and_sweep_makers());
#ifdef ESPALIER_BENCH_BULLET
    append(bullet_box_makers());
#endif
#ifdef ESPALIER_BENCH_ODE
    append(ode_box_makers());
#endif
#ifdef ESPALIER_BENCH_FCL
    append(fcl_box_makers());
#endif
    return makers;
}

struct Options {
    Scenario scenario;
    std::string sizes = "cubes";
    std::size_t aged = 1'000;
    std::size_t churn = 0;
    bool bunnies = false;
};

/// Brings the mesh into a unit cube around the origin.
void fit_into_unit_cube(tests::Mesh& mesh) {
    if (mesh.positions.empty()) throw std::runtime_error(mesh.name + ": has no vertices");
    const auto [low, high] = box_around(mesh.positions);
    const float longest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    const Vec3 middle = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)};
    for (Vec3& p : mesh.positions)
        p = {(p.x - middle.x) / longest, (p.y - middle.y) / longest, (p.z - middle.z) / longest};
}

/// Scales and moves the mesh so that it fills a unit cube around the origin, runs the scenario with it in place of a
/// cube, and prints rows. Peers find pairs with the mesh itself, which the library has rounded to a
/// lattice: pairs that only just touch may differ.
void print_bunnies(const Scenario& scenario, tests::Mesh mesh) {
    fit_into_unit_cube(mesh);
    BroadPhaseMakers makers = espalier_colliding_makers();
#ifdef ESPALIER_BENCH_FCL
    for (BroadPhaseMaker& maker : fcl_colliding_makers(mesh)) makers.push_back(std::move(maker));
#endif
    print_steps(measure(selected(std::move(makers), scenario), scenario, bake_blob(mesh, Profile::fast).baked, true),
                scenario, "collisions of " + mesh.name);
}

void run_bunnies(Scenario scenario, const std::vector<std::string>& meshes) {
    scenario.turning = true;
    if (!meshes.empty()) {
        for (const std::string& file : meshes) print_bunnies(scenario, tests::read_mesh(file));
        return;
    }
    const auto bunny = tests::mesh_file("bunny.obj");
    if (!bunny) throw std::invalid_argument("name a mesh, or a folder with bunny.obj in ESPALIER_MESHES");
    print_bunnies(scenario, tests::read_mesh(*bunny));
}

void run(Options& options, const std::vector<std::string>& meshes) {
    Scenario& scenario = options.scenario;
    scenario.sizes = options.sizes == "mixed" ? Sizes::mixed : Sizes::cubes;
    if (options.bunnies) return run_bunnies(scenario, meshes);
    if (!meshes.empty()) throw std::invalid_argument("a mesh is measured with --bunnies alone");
    if (options.churn > 0) return print_churn(scenario, options.churn);
    const std::vector<Measured> measured = measure(selected(all_makers(scenario), scenario), scenario, baked_cube());
    print_steps(measured, scenario, "broad phase");
    if (options.aged > 0) print_upkeep(scenario, options.aged);
    for (const Measured& one : measured)
        if (one.differing_steps > 0) throw std::runtime_error(one.name + ": finds other pairs of boxes");
}

}  // namespace

const Subcommand subcommand("moving", [](int count, char** words) {
    Options options;
    Scenario& scenario = options.scenario;
    Program program("espalier_bench_study moving",
                    "A step of many moving objects: new boxes, and all pairs whose boxes touch; JSON");
    program.allow_no_meshes();
    program.add_number("--objects", scenario.objects, std::size_t{2}, std::size_t{1'000'000}, "Objects");
    program.add_number("--speed", scenario.speed, 0.0, 10.0, "The largest step of an object in multiples of its edge");
    program.add_number("--moving", scenario.moving, 0.001, 1.0, "The share of the objects that moves");
    program.add_flag("--turning", scenario.turning, "Objects are turned at random, and those that move also turn");
    program.add_word("--sizes", options.sizes,
                     "Unit cubes in ten times their volume, or cubes of edge 1 + 99 u^10 with one pair an object",
                     {"cubes", "mixed"});
    program.add_number("--unmeasured", scenario.unmeasured, std::size_t{0}, std::size_t{1'000'000},
                       "Steps before those that are measured");
    program.add_count("--steps", scenario.steps, "Steps that are measured; the median counts");
    program.add_count("--repeats", scenario.repeats, "How often each step is measured; the least counts");
    program.add_number("--aged", options.aged, std::size_t{0}, std::size_t{1'000'000'000},
                       "Steps after which the area of the tree is compared with that of a fresh one; 0: not at all");
    program.add_number("--churn", options.churn, std::size_t{0}, std::size_t{1'000'000'000},
                       "In place of steps: removals and insertions in a tree that is never packed");
    program.add_flag("--bunnies", options.bunnies,
                     "In place of boxes: tumbling meshes, and pairs whose triangles touch; bunny.obj of the folder in "
                     "ESPALIER_MESHES if none is named");
    program.add_words("--only", scenario.only, "Only the systems whose names begin so, and Espalier; may be repeated");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) { run(options, meshes); });
});

}  // namespace espalier::bench::moving
