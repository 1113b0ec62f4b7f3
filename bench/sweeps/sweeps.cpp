// Oriented boxes and convex hulls that move through a mesh, beside convex sweeps of Bullet and Box3D: one thread, and
// the least time of several repetitions counts. JSON, an object for each mesh, shape and size.

#include "sweeps.hpp"

#include "../../tests/support/base/vectors.hpp"
#include "../peers/contest.hpp"
#include "../program.hpp"

namespace espalier::bench {
namespace {

using tests::cross, tests::dot, tests::sum, tests::times;

struct Options {
    unsigned repetitions = 5;
    std::size_t sweeps = 500;
};

Vec3 unit(const Vec3& a) { return times(a, 1.0f / std::sqrt(dot(a, a))); }

/// Shapes of so many vertices, about `size` wide; with eight vertices they are boxes.
std::vector<Moving> some_shapes(const Mesh& mesh, std::size_t count, std::size_t vertices, float share) {
    const auto [low, high] = box_around(mesh.positions);
    const Vec3 size = {high.x - low.x, high.y - low.y, high.z - low.z};
    const float half = 0.5f * share * std::max({size.x, size.y, size.z});
    tests::Random random(seed);
    const auto place = [&, low = low] {
        return Vec3{low.x + size.x * (1.5f * random.unit() - 0.25f), low.y + size.y * (1.5f * random.unit() - 0.25f),
                    low.z + size.z * (1.5f * random.unit() - 0.25f)};
    };
    std::vector<Moving> shapes(count);
    for (Moving& moving : shapes) {
        moving.start = place();
        moving.way = sum(place(), times(moving.start, -1.0f));
        if (vertices == 8) {
            const Vec3 x = unit(random.in_cube(1.0f)), y = unit(cross(x, random.in_cube(1.0f))), z = cross(x, y);
            moving.box = {moving.start, {}};
            const std::array<Vec3, 3> axes = {x, y, z};
            for (std::size_t i = 0; i < 3; ++i) moving.box.half_axes[i] = times(axes[i], half * (0.5f + random.unit()));
            for (unsigned corner = 0; corner < 8; ++corner) {
                Vec3 at = {0.0f, 0.0f, 0.0f};
                for (unsigned i = 0; i < 3; ++i)
                    at = sum(at, times(moving.box.half_axes[i], (corner >> i & 1u) != 0 ? 1.0f : -1.0f));
                moving.local.push_back(at);
            }
        } else {
            while (moving.local.size() < vertices) moving.local.push_back(times(unit(random.in_cube(1.0f)), half));
        }
        for (const Vec3& vertex : moving.local) moving.vertices.push_back(sum(moving.start, vertex));
    }
    return shapes;
}

Contest<Moving, float> peers(const Mesh& mesh, std::span<const Moving> shapes) {
    Contest<Moving, float> all;
    static_cast<void>(mesh), static_cast<void>(shapes);
#if defined(ESPALIER_BENCH_BULLET)
    all.push_back({"bullet", "", bullet_sweeps(mesh, shapes)});
#endif
#if defined(ESPALIER_BENCH_BOX3D)
    all.push_back({"box3d", "", box3d_sweeps(mesh, shapes)});
#endif
    return all;
}

void measure(const Mesh& mesh, const Options& options) {
    const BakedBlob made = bake_blob(mesh);
    for (const std::size_t vertices : {std::size_t{8}, std::size_t{16}, max_hull_vertices})
        for (const float share : {0.01f, 0.05f, 0.15f}) {
            const std::vector<Moving> shapes = some_shapes(mesh, options.sweeps, vertices, share);
            const auto microseconds = [&](double seconds) { return 1e6 * seconds / double(shapes.size()); };
            Contestant<Moving, float> own = {"espalier", "balanced", one_by_one([&](const Moving& moving) {
                                                 if (vertices == 8) return sweep(made.blob, moving.box, moving.way).t;
                                                 return sweep(made.blob, ConvexHull{moving.vertices}, moving.way).t;
                                             })};
            for (unsigned repetition = 0; repetition < options.repetitions; ++repetition) own.answer(shapes);
            JsonObject row;
            row.add("mesh", mesh.name);
            row.add("triangles", mesh.triangles.size());
            add_machine(row);
            row.add("shape", vertices == 8 ? "oriented box" : "hull");
            row.add("vertices", vertices);
            row.add("size", double(share), 2);
            row.add("hits",
                    static_cast<std::size_t>(std::ranges::count_if(own.answers, [](float t) { return t < 1; })));
            row.add("espalier_us", microseconds(own.least_seconds()), 3);
            for (Contestant<Moving, float>& peer : peers(mesh, shapes)) {
                for (int repetition = 0; repetition < 2; ++repetition) peer.answer(shapes);
                std::size_t differing = 0;
                for (std::size_t i = 0; i < shapes.size();
                     ++i)  // peers have other rules for shapes that start in a contact
                    differing += own.answers[i] > 0.0f && std::fabs(peer.answers[i] - own.answers[i]) > 0.01f ? 1u : 0u;
                row.add(peer.system + "_us", microseconds(peer.least_seconds()), 3);
                row.add(peer.system + "_ratio", peer.least_seconds() / own.least_seconds(), 1);
                row.add(peer.system + "_differing", differing);
            }
            row.print();
            std::fflush(stdout);
        }
}

}  // namespace

const Subcommand subcommand("sweeps", [](int count, char** words) {
    Options options;
    Program program("espalier_bench_peers sweeps",
                    "Oriented boxes and hulls that move, beside convex sweeps of Bullet and Box3D; JSON");
    program.add_count("--repetitions", options.repetitions, "How often all sweeps are answered");
    program.add_count("--sweeps", options.sweeps, "Sweeps of each shape and size");
    return program.run_at_common_size(count, words, [&](const Mesh& mesh) { measure(mesh, options); });
});

}  // namespace espalier::bench
