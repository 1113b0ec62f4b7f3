#include "questions.hpp"

namespace espalier::bench {
namespace {

constexpr std::size_t ray_count = 1 << 16;
constexpr std::size_t point_count = 1 << 14;
constexpr std::size_t pose_count = 400;

struct Box3 {
    Vec3 low, size;
    float diagonal;
};

Box3 box_of(const Mesh& mesh) {
    const auto [low, high] = box_around(mesh.positions);
    const Vec3 size = {high.x - low.x, high.y - low.y, high.z - low.z};
    return {low, size, std::sqrt(size.x * size.x + size.y * size.y + size.z * size.z)};
}

void append(std::vector<float>& numbers, const Vec3& v) { numbers.insert(numbers.end(), {v.x, v.y, v.z}); }

std::vector<float> ray_numbers(const std::vector<Ray>& rays) {
    std::vector<float> numbers;
    numbers.reserve(7 * rays.size());
    for (const Ray& ray : rays) {
        append(numbers, ray.origin);
        append(numbers, ray.direction);
        numbers.push_back(ray.t_max);
    }
    return numbers;
}

std::vector<float> incoherent(const Mesh& mesh) { return ray_numbers(incoherent_rays(mesh, ray_count, seed)); }
std::vector<float> coherent(const Mesh& mesh) { return ray_numbers(coherent_rays(mesh)); }

/// Calls `add(numbers, point, diagonal, random)` for points anywhere in the mesh's box.
template <class Add>
std::vector<float> at_points(const Mesh& mesh, Add add) {
    const Box3 box = box_of(mesh);
    tests::Random random(seed);
    std::vector<float> numbers;
    for (std::size_t i = 0; i < point_count; ++i) {
        const float x = box.low.x + box.size.x * random.unit();
        const float y = box.low.y + box.size.y * random.unit();
        const float z = box.low.z + box.size.z * random.unit();
        add(numbers, Vec3{x, y, z}, box.diagonal, random);
    }
    return numbers;
}

std::vector<float> points(const Mesh& mesh) {
    return at_points(mesh, [](std::vector<float>& to, Vec3 p, float, tests::Random&) { append(to, p); });
}

/// The radius is 2 % of the diagonal.
std::vector<float> spheres(const Mesh& mesh) {
    return at_points(mesh, [](std::vector<float>& to, Vec3 p, float diagonal, tests::Random&) {
        append(to, p);
        to.push_back(0.02f * diagonal);
    });
}

/// Cubes with a side of 4 % of the diagonal.
void append_cube(std::vector<float>& to, Vec3 p, float half) {
    append(to, {p.x - half, p.y - half, p.z - half});
    append(to, {p.x + half, p.y + half, p.z + half});
}

std::vector<float> boxes(const Mesh& mesh) {
    return at_points(mesh, [](std::vector<float>& to, Vec3 p, float diagonal, tests::Random&) {
        append_cube(to, p, 0.02f * diagonal);
    });
}

/// In any direction, up to a tenth of the diagonal: a character's step rather than a shot.
void append_way(std::vector<float>& to, float diagonal, tests::Random& random) {
    append(to, random.in_cube(0.1f * diagonal));
}

std::vector<float> moving_spheres(const Mesh& mesh) {
    return at_points(mesh, [](std::vector<float>& to, Vec3 p, float diagonal, tests::Random& random) {
        append(to, p);
        to.push_back(0.01f * diagonal);
        append_way(to, diagonal, random);
    });
}

std::vector<float> moving_capsules(const Mesh& mesh) {
    return at_points(mesh, [](std::vector<float>& to, Vec3 p, float diagonal, tests::Random& random) {
        append(to, p);
        append(to, {p.x, p.y + 0.02f * diagonal, p.z});
        to.push_back(0.01f * diagonal);
        append_way(to, diagonal, random);
    });
}

std::vector<float> moving_boxes(const Mesh& mesh) {
    return at_points(mesh, [](std::vector<float>& to, Vec3 p, float diagonal, tests::Random& random) {
        append_cube(to, p, 0.01f * diagonal);
        append_way(to, diagonal, random);
    });
}

/// Calls `add(numbers, point, radius, way)` for points two to four radii above a random triangle and ways in a random
/// direction. Nothing else is within two radii either. The radius is 1 % of the diagonal, and a way has this share of
/// it.
template <int percent, class Add>
std::vector<float> above_triangles(const Mesh& mesh, const TouchesSphere& touches, Add add) {
    const float diagonal = box_of(mesh).diagonal, radius = 0.01f * diagonal;
    tests::Random random(seed);
    std::vector<float> numbers;
    for (std::size_t found = 0, tries = 0; found < point_count && tries < 100 * point_count; ++tries) {
        const auto& corners = mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
        const Vec3 &a = mesh.positions[corners[0]], &b = mesh.positions[corners[1]], &c = mesh.positions[corners[2]];
        const Vec3 u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
        const Vec3 normal = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        const float length = std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
        const Vec3 way = random.in_cube(1.0f);
        const float size = std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
        if (!(length > 0.0f) || !(size > 0.1f) || size > 1.0f) continue;
        const float by = (2.0f + 2.0f * random.unit()) * radius / length, share = 0.01f * percent * diagonal / size;
        const Vec3 point = {(a.x + b.x + c.x) / 3.0f + normal.x * by, (a.y + b.y + c.y) / 3.0f + normal.y * by,
                            (a.z + b.z + c.z) / 3.0f + normal.z * by};
        if (touches(point, 2.0f * radius)) continue;
        add(numbers, point, radius, Vec3{way.x * share, way.y * share, way.z * share});
        ++found;
    }
    return numbers;
}

template <int percent>
std::vector<float> spheres_above(const Mesh& mesh, const TouchesSphere& touches) {
    return above_triangles<percent>(mesh, touches, [](std::vector<float>& to, Vec3 p, float radius, Vec3 way) {
        append(to, p);
        to.push_back(radius);
        append(to, way);
    });
}

template <int percent>
std::vector<float> capsules_above(const Mesh& mesh, const TouchesSphere& touches) {
    return above_triangles<percent>(mesh, touches, [](std::vector<float>& to, Vec3 p, float radius, Vec3 way) {
        append(to, {p.x, p.y - radius, p.z});
        append(to, {p.x, p.y + radius, p.z});
        to.push_back(radius);
        append(to, way);
    });
}

template <int percent>
std::vector<float> boxes_above(const Mesh& mesh, const TouchesSphere& touches) {
    return above_triangles<percent>(mesh, touches, [](std::vector<float>& to, Vec3 p, float radius, Vec3 way) {
        append_cube(to, p, radius);
        append(to, way);
    });
}

struct Maker {
    const char* name;
    const char* kind;
    std::size_t floats;
    std::vector<float> (*make)(const Mesh&);  ///< null: poses, or nothing where there are no floats
    std::vector<float> (*make_free)(const Mesh&, const TouchesSphere&) = nullptr;  ///< in its place: all start free
};

constexpr Maker makers[] = {
    {"closest_hit_incoherent", "closest_hit", 7, incoherent},
    {"closest_hit_coherent", "closest_hit", 7, coherent},
    {"any_hit_incoherent", "any_hit", 7, incoherent},
    {"closest_hit_batch_incoherent", "closest_hit_batch", 7, incoherent},
    {"closest_hit_batch_coherent", "closest_hit_batch", 7, coherent},
    {"any_hit_batch_incoherent", "any_hit_batch", 7, incoherent},
    {"closest_point", "closest_point", 3, points},
    {"overlaps_sphere", "overlaps_sphere", 4, spheres},
    {"all_overlaps_sphere", "all_overlaps_sphere", 4, spheres},
    {"overlaps_box", "overlaps_box", 6, boxes},
    {"sweep_sphere", "sweep_sphere", 7, moving_spheres},
    {"sweep_capsule", "sweep_capsule", 10, moving_capsules},
    {"sweep_box", "sweep_box", 9, moving_boxes},
    {"sweep_sphere_short", "sweep_sphere", 7, nullptr, spheres_above<3>},
    {"sweep_sphere_long", "sweep_sphere", 7, nullptr, spheres_above<30>},
    {"sweep_capsule_short", "sweep_capsule", 10, nullptr, capsules_above<3>},
    {"sweep_capsule_long", "sweep_capsule", 10, nullptr, capsules_above<30>},
    {"sweep_box_short", "sweep_box", 9, nullptr, boxes_above<3>},
    {"sweep_box_long", "sweep_box", 9, nullptr, boxes_above<30>},
    {"collides", "collides", 8, nullptr},
    {"all_contacts", "all_contacts", 8, nullptr},
    {"minimum_distance", "minimum_distance", 8, nullptr},
    {"open", "open", 0, nullptr},
};

}  // namespace

std::vector<std::string> question_names() {
    std::vector<std::string> names;
    for (const Maker& maker : makers) names.emplace_back(maker.name);
    return names;
}

std::vector<float> numbers_of(const Transform& pose) {
    const Quaternion& q = pose.rotation;
    const Vec3& t = pose.translation;
    return {q.x, q.y, q.z, q.w, t.x, t.y, t.z, pose.scale};
}

QuestionSet make_questions(const std::string& name, const Mesh& mesh,
                           const std::function<bool(const Transform&)>& collides, const TouchesSphere& touches) {
    for (const Maker& maker : makers) {
        if (name != maker.name) continue;
        QuestionSet set = {maker.name, maker.kind, maker.floats, point_count, {}};
        if (maker.floats == 0) return set;
        if (maker.make_free != nullptr) set.numbers = maker.make_free(mesh, touches);
        else if (maker.make != nullptr) set.numbers = maker.make(mesh);
        else
            for (const Transform& pose : some_poses(mesh, pose_count, seed, collides))
                for (const float number : numbers_of(pose)) set.numbers.push_back(number);
        set.count = set.numbers.size() / set.floats;
        if (set.count < 8) throw std::runtime_error("of this mesh, too few questions of " + name + " start free");
        return set;
    }
    throw std::invalid_argument("there are no questions named " + name);
}

}  // namespace espalier::bench
