// Oriented boxes and convex hulls that move through a mesh, beside Bullet's convex sweep: one thread, the systems take
// turns, and the least time of several repetitions counts. JSON, an object for each mesh, shape and size.

#include "../program.hpp"
#if defined(ESPALIER_BENCH_BULLET)
#include "bullet_sweeps.hpp"
#endif

namespace {

using namespace espalier;
using namespace espalier::bench;

struct Options {
    unsigned repetitions = 5;
    std::size_t sweeps = 500;
};

/// A shape that moves from anywhere in or near the mesh's box to anywhere there. The vertices are relative to the
/// start.
struct Moving {
    Vec3 start, way;
    OrientedBox box;  ///< the hull of the vertices, if there are eight
    std::vector<Vec3> local, vertices;
};

Vec3 plus(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 times(const Vec3& a, float by) { return {a.x * by, a.y * by, a.z * by}; }
Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3 unit(const Vec3& a) { return times(a, 1.0f / std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z)); }

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
        moving.way = plus(place(), times(moving.start, -1.0f));
        if (vertices == 8) {
            const Vec3 x = unit(random.in_cube(1.0f)), y = unit(cross(x, random.in_cube(1.0f))), z = cross(x, y);
            moving.box = {moving.start, {}};
            const std::array<Vec3, 3> axes = {x, y, z};
            for (std::size_t i = 0; i < 3; ++i) moving.box.half_axes[i] = times(axes[i], half * (0.5f + random.unit()));
            for (unsigned corner = 0; corner < 8; ++corner) {
                Vec3 at = {0.0f, 0.0f, 0.0f};
                for (unsigned i = 0; i < 3; ++i)
                    at = plus(at, times(moving.box.half_axes[i], (corner >> i & 1u) != 0 ? 1.0f : -1.0f));
                moving.local.push_back(at);
            }
        } else {
            while (moving.local.size() < vertices) moving.local.push_back(times(unit(random.in_cube(1.0f)), half));
        }
        for (const Vec3& vertex : moving.local) moving.vertices.push_back(plus(moving.start, vertex));
    }
    return shapes;
}

void measure(const Mesh& mesh, const Options& options) {
    const BakedBlob made = bake_blob(mesh);
    const Blob& blob = made.blob;
    for (const std::size_t vertices : {std::size_t{8}, std::size_t{16}, max_hull_vertices}) {
        for (const float share : {0.01f, 0.05f, 0.15f}) {
            const std::vector<Moving> shapes = some_shapes(mesh, options.sweeps, vertices, share);
            std::vector<float> times_of_contact(shapes.size());
            double seconds = std::numeric_limits<double>::infinity();
            std::size_t hits = 0;
            for (unsigned repetition = 0; repetition < options.repetitions; ++repetition) {
                const Stopwatch watch;
                for (std::size_t i = 0; i < shapes.size(); ++i) {
                    const Moving& moving = shapes[i];
                    const SweepHit hit = vertices == 8 ? sweep(blob, moving.box, moving.way)
                                                       : sweep(blob, ConvexHull{moving.vertices}, moving.way);
                    times_of_contact[i] = hit.t;
                }
                seconds = std::min(seconds, watch.seconds());
            }
            for (const float t : times_of_contact) hits += t < 1.0f ? 1u : 0u;
            const double per_sweep = seconds / static_cast<double>(shapes.size());
            std::printf(
                "{\"mesh\":\"%s\",\"triangles\":%zu,\"shape\":\"%s\",\"vertices\":%zu,\"size\":%g,\"hits\":%zu,",
                mesh.name.c_str(), mesh.triangles.size(), vertices == 8 ? "oriented box" : "hull", vertices,
                static_cast<double>(share), hits);
            std::printf("\"espalier_us\":%.3f", per_sweep * 1e6);
#if defined(ESPALIER_BENCH_BULLET)
            BulletSweeps bullet(mesh);
            for (const Moving& moving : shapes) {
                if (vertices == 8) bullet.add_box(moving.box);
                else bullet.add_hull(moving.local);
            }
            double bullet_seconds = std::numeric_limits<double>::infinity();
            std::size_t differing = 0;
            for (unsigned repetition = 0; repetition < 2; ++repetition) {
                differing = 0;
                const Stopwatch watch;
                for (std::size_t i = 0; i < shapes.size(); ++i) {
                    const float t = bullet.first_contact(i, shapes[i].start, shapes[i].way);
                    // Bullet moves shapes that start in a contact.
                    differing += times_of_contact[i] > 0.0f && std::fabs(t - times_of_contact[i]) > 0.01f ? 1u : 0u;
                }
                bullet_seconds = std::min(bullet_seconds, watch.seconds());
            }
            std::printf(",\"bullet_us\":%.3f,\"ratio\":%.1f,\"differing\":%zu",
                        bullet_seconds / static_cast<double>(shapes.size()) * 1e6, bullet_seconds / seconds, differing);
#endif
            std::printf("}\n");
            std::fflush(stdout);
        }
    }
}

}  // namespace

int main(int count, char** words) {
    Options options;
    Program program("espalier_bench_sweeps", "Oriented boxes and hulls that move, beside Bullet's convex sweep; JSON");
    program.add_count("--repetitions", options.repetitions, "How often all sweeps are answered");
    program.add_count("--sweeps", options.sweeps, "Sweeps of each shape and size");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        for (const std::string& path : meshes) {
            Mesh mesh = tests::read_mesh(path);
            bring_to_common_size(mesh);
            measure(mesh, options);
        }
    });
}
