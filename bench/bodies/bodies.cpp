// Small bodies near the surface of a level, beside Box3D: whether they touch it, what of it they touch, and where they
// stop. One thread; the systems take turns. JSON, an object for each mesh, size and question.

#include "bodies.hpp"

#include "../../tests/support/base/vectors.hpp"
#include "../../tests/support/meshes/level_maker.hpp"
#include "../../tools/base/choices.hpp"
#include "../program.hpp"

namespace espalier::bench {
namespace {

using tests::cross, tests::difference, tests::dot, tests::sum, tests::times;

struct Options {
    unsigned repetitions = 7;
    std::size_t bodies = 2'000;
    std::vector<std::string> only;
};

constexpr std::array<const char*, static_cast<std::size_t>(Asked::count)> names = {
    "overlaps sphere",   "overlaps capsule",   "overlaps oriented box", "triangles in box",
    "planes of capsule", "contacts of sphere", "contacts of capsule",   "contacts of oriented box",
    "sweep of sphere",   "sweep of capsule",   "sweep of oriented box"};

Vec3 unit(const Vec3& a) { return times(a, 1.0f / std::sqrt(dot(a, a))); }

/// The shapes about a place; `axes` are those of the box.
Shapes shapes_at(const Vec3& center, float radius, const std::array<Vec3, 3>& axes) {
    const Vec3 up = {0.0f, 0.0f, radius}, corner = {radius, radius, radius};
    return {{center, radius},
            {difference(center, up), sum(center, up), radius},
            {center, {axes[0], axes[1], axes[2]}},
            {difference(center, corner), sum(center, corner)}};
}

/// Bodies in front of the surface. A triangle has as many as its area is large: games stand on floors.
std::vector<Body> some_bodies(const Mesh& mesh, std::size_t count, float width) {
    std::vector<double> area;
    for (const TriangleVertices& t : mesh.triangles) {
        const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const Vec3 normal = cross(difference(b, a), difference(c, a));
        area.push_back((area.empty() ? 0.0 : area.back()) + std::sqrt(double(dot(normal, normal))));
    }
    const float radius = 0.5f * width;
    tests::Random random(seed);
    std::vector<Body> bodies(count);
    for (Body& body : bodies) {
        const auto at = std::upper_bound(area.begin(), area.end(), area.back() * double(random.unit()));
        const auto& t = mesh.triangles[std::min<std::size_t>(std::size_t(at - area.begin()), area.size() - 1)];
        float u = random.unit(), v = random.unit();
        if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
        const Vec3& a = mesh.positions[t[0]];
        const Vec3 ab = difference(mesh.positions[t[1]], a), ac = difference(mesh.positions[t[2]], a);
        const Vec3 front = unit(cross(ab, ac)), on = sum(a, sum(times(ab, u), times(ac, v)));
        const Vec3 center = sum(on, times(front, radius * (0.5f + random.unit())));
        const Vec3 x = unit(random.in_cube(1.0f)), y = unit(cross(x, random.in_cube(1.0f)));
        std::array<Vec3, 3> axes = {x, y, cross(x, y)};
        for (Vec3& axis : axes) axis = times(axis, radius * (0.5f + random.unit()));
        body.near = shapes_at(center, radius, axes);
        body.margin = 0.02f;  // which Box3D's contacts have
        body.before = shapes_at(sum(center, times(front, width)), radius, axes);
        body.way = times(unit(random.in_cube(1.0f)), 3.0f * width);
        if (dot(body.way, front) > 0.0f) body.way = times(body.way, -1.0f);
    }
    return bodies;
}

float checked(QueryStatus status) {
    if (is_refused(status)) throw std::runtime_error(std::string("a body is refused: ") + describe(status));
    return status == QueryStatus::ok ? 1.0f : 0.0f;
}

BodySystem espalier_bodies(const Mesh& mesh, Profile profile) {
    const auto made = std::make_shared<BakedBlob>(bake_blob(mesh, profile));
    BodySystem system = {"espalier", tools::name_in(tools::profile_choices, profile), {}};
    const auto whether = [made](auto shape) {
        return [made, shape](const Body& body) { return checked(overlaps(made->blob, body.near.*shape).status()); };
    };
    const auto contacts = [made](auto shape) {
        const auto room = std::make_shared<std::array<Contact, most_contacts>>();
        return [made, shape, room](const Body& body) {
            std::span<Contact> found = *room;
            const Filled filled = find_contacts(made->blob, body.near.*shape, body.margin, found);
            checked(filled.status);
            return float(filled.count);
        };
    };
    const auto sweeps = [made](auto shape) {
        return [made, shape](const Body& body) { return sweep(made->blob, body.before.*shape, body.way).t; };
    };
    system[Asked::overlaps_sphere] = whether(&Shapes::sphere);
    system[Asked::overlaps_capsule] = whether(&Shapes::capsule);
    system[Asked::overlaps_box] = whether(&Shapes::box);
    system[Asked::triangles_in_box] = [made](const Body& body) {
        float corners = 0.0f;
        std::size_t count = 0;
        const QueryStatus status =
            for_each_overlap(made->blob, body.near.bounds, [&](TriangleId, const Triangle& triangle) {
                corners += triangle.a.x + triangle.b.y + triangle.c.z;
                ++count;
            });
        checked(status);
        return std::isnan(corners) ? -1.0f : float(count);
    };
    const auto room = std::make_shared<std::array<ContactPlane, most_contacts>>();
    system[Asked::planes] = [made, room](const Body& body) {
        std::span<ContactPlane> planes = *room;
        const Filled filled = collect_planes(made->blob, body.near.capsule, 0.0f, planes);
        checked(filled.status);
        return float(filled.count);
    };
    system[Asked::contacts_sphere] = contacts(&Shapes::sphere);
    system[Asked::contacts_capsule] = contacts(&Shapes::capsule);
    system[Asked::contacts_box] = contacts(&Shapes::box);
    system[Asked::sweep_sphere] = sweeps(&Shapes::sphere);
    system[Asked::sweep_capsule] = sweeps(&Shapes::capsule);
    system[Asked::sweep_box] = sweeps(&Shapes::box);
    return system;
}

std::vector<BodySystem> systems_over(const Mesh& mesh) {
    std::vector<BodySystem> systems;
    for (const Profile profile : {Profile::fast, Profile::balanced}) systems.push_back(espalier_bodies(mesh, profile));
#if defined(ESPALIER_BENCH_BOX3D)
    systems.push_back(box3d_bodies(mesh));
#endif
    return systems;
}

void measure(const Mesh& mesh, const Options& options) {
    const std::vector<BodySystem> systems = systems_over(mesh);
    const Box around = box_around(mesh.positions);
    const Vec3 sides = difference(around.max, around.min);
    for (const float share : {0.01f, 0.03f}) {
        const std::vector<Body> bodies =
            some_bodies(mesh, options.bodies, share * std::max({sides.x, sides.y, sides.z}));
        for (std::size_t asked = 0; asked < names.size(); ++asked) {
            if (!options.only.empty() && std::ranges::find(options.only, names[asked]) == options.only.end()) continue;
            Contest<Body, float> contest;
            for (const BodySystem& system : systems)
                if (system.answers[asked])
                    contest.push_back({system.name, system.profile, one_by_one(std::cref(system.answers[asked]))});
            take_turns(contest, std::span<const Body>(bodies), options.repetitions);
            JsonObject row;
            row.add("mesh", mesh.name);
            row.add("triangles", mesh.triangles.size());
            add_machine(row);
            row.add("question", names[asked]);
            row.add("size", double(share), 2);
            for (const auto& contestant : contest) {
                const std::string& name = contestant.profile.empty() ? contestant.system : contestant.profile;
                row.add(name + "_us", 1e6 * contestant.least_seconds() / double(bodies.size()), 3);
                row.add(name + "_answer", contestant.sum_of_answers() / double(bodies.size()), 3);
                if (contestant.system == "espalier" && contest.back().system != "espalier")
                    row.add(name + "_ratio", ratio(contest.back().seconds, contestant.seconds).median, 2);
            }
            row.print();
            std::fflush(stdout);
        }
    }
}

}  // namespace

const Subcommand subcommand("bodies", [](int count, char** words) {
    Options options;
    Program program("espalier_bench_peers bodies",
                    "What a game asks of a level in every frame, beside Box3D; JSON. Without a mesh: of three levels");
    program.add_count("--repetitions", options.repetitions, "How often all bodies are asked for");
    program.add_count("--bodies", options.bodies, "Bodies of each size");
    program.add_words("--only", options.only, "Only this question; may be repeated",
                      std::vector<std::string>(names.begin(), names.end()));
    program.allow_no_meshes();
    return program.run(count, words, [&](const std::vector<std::string>& files) {
        std::vector<Mesh> meshes;
        for (const std::string& file : files) meshes.push_back(tests::read_mesh(file));
        if (files.empty())  // what games stand on, of 128, 4,000 and 8,192 triangles
            meshes = {tests::make_plane_grid(8), tests::make_level(4'000, 1), tests::make_terrain(64, 1)};
        for (Mesh& mesh : meshes) {
            bring_to_common_size(mesh);
            measure(mesh, options);
        }
    });
});

}  // namespace espalier::bench
