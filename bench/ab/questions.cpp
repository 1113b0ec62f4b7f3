#include "questions.hpp"

#include "../../tests/support/base/vectors.hpp"

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

enum class Source : std::uint8_t {
    incoherent,  ///< rays
    coherent,
    anywhere,  ///< shapes at points in the mesh's box
    above,     ///< shapes that start free, above triangles
    poses,
    nothing,
};
enum class Shape : std::uint8_t { point, sphere, capsule, box };

/// What a row asks. Lengths are shares of the diagonal of the mesh's box.
struct Maker {
    const char* name;
    const char* kind;
    Source source;
    Shape shape = Shape::point;
    float radius = 0.0f;
    float way = 0.0f;  ///< of a sweep; anywhere, the half side of a cube of ways: a character's step rather than a shot

    [[nodiscard]] std::size_t floats() const {
        constexpr std::size_t of_shapes[] = {3, 4, 7, 6};
        if (source == Source::nothing) return 0;
        if (source == Source::poses) return 8;
        if (source <= Source::coherent) return 7;
        return of_shapes[static_cast<std::size_t>(shape)] + (way > 0.0f ? 3 : 0);
    }
};

constexpr Maker makers[] = {
    {"closest_hit_incoherent", "closest_hit", Source::incoherent},
    {"closest_hit_coherent", "closest_hit", Source::coherent},
    {"any_hit_incoherent", "any_hit", Source::incoherent},
    {"closest_hit_batch_incoherent", "closest_hit_batch", Source::incoherent},
    {"closest_hit_batch_coherent", "closest_hit_batch", Source::coherent},
    {"any_hit_batch_incoherent", "any_hit_batch", Source::incoherent},
    {"closest_point", "closest_point", Source::anywhere},
    {"overlaps_sphere", "overlaps_sphere", Source::anywhere, Shape::sphere, 0.02f},
    {"all_overlaps_sphere", "all_overlaps_sphere", Source::anywhere, Shape::sphere, 0.02f},
    {"overlaps_box", "overlaps_box", Source::anywhere, Shape::box, 0.02f},
    {"sweep_sphere", "sweep_sphere", Source::anywhere, Shape::sphere, 0.01f, 0.1f},
    {"sweep_capsule", "sweep_capsule", Source::anywhere, Shape::capsule, 0.01f, 0.1f},
    {"sweep_box", "sweep_box", Source::anywhere, Shape::box, 0.01f, 0.1f},
    {"sweep_sphere_short", "sweep_sphere", Source::above, Shape::sphere, 0.01f, 0.03f},
    {"sweep_sphere_long", "sweep_sphere", Source::above, Shape::sphere, 0.01f, 0.3f},
    {"sweep_capsule_short", "sweep_capsule", Source::above, Shape::capsule, 0.01f, 0.03f},
    {"sweep_capsule_long", "sweep_capsule", Source::above, Shape::capsule, 0.01f, 0.3f},
    {"sweep_box_short", "sweep_box", Source::above, Shape::box, 0.01f, 0.03f},
    {"sweep_box_long", "sweep_box", Source::above, Shape::box, 0.01f, 0.3f},
    {"collides", "collides", Source::poses},
    {"all_contacts", "all_contacts", Source::poses},
    {"minimum_distance", "minimum_distance", Source::poses},
    {"open", "open", Source::nothing},
};

/// Around a point.
void append(std::vector<float>& to, Shape shape, Vec3 p, float radius) {
    if (shape == Shape::capsule || shape == Shape::box) {
        const float across = shape == Shape::box ? radius : 0.0f;
        append(to, {p.x - across, p.y - radius, p.z - across});
        append(to, {p.x + across, p.y + radius, p.z + across});
    } else {
        append(to, p);
    }
    if (shape == Shape::sphere || shape == Shape::capsule) to.push_back(radius);
}

std::vector<float> numbers_of(const std::vector<Ray>& rays) {
    std::vector<float> numbers;
    numbers.reserve(7 * rays.size());
    for (const Ray& ray : rays) {
        append(numbers, ray.origin);
        append(numbers, ray.direction);
        numbers.push_back(ray.t_max);
    }
    return numbers;
}

std::vector<float> shapes_anywhere(const Mesh& mesh, const Maker& maker) {
    const Box3 box = box_of(mesh);
    tests::Random random(seed);
    std::vector<float> numbers;
    for (std::size_t i = 0; i < point_count; ++i) {
        const float x = box.low.x + box.size.x * random.unit();
        const float y = box.low.y + box.size.y * random.unit();
        const float z = box.low.z + box.size.z * random.unit();
        append(numbers, maker.shape, {x, y, z}, maker.radius * box.diagonal);
        if (maker.way > 0.0f) append(numbers, random.in_cube(maker.way * box.diagonal));
    }
    return numbers;
}

/// Two to four radii above a random triangle, on ways in a random direction. Nothing else is within two radii either.
std::vector<float> shapes_above(const Mesh& mesh, const Maker& maker, const TouchesSphere& touches) {
    const float diagonal = box_of(mesh).diagonal, radius = maker.radius * diagonal;
    tests::Random random(seed);
    std::vector<float> numbers;
    for (std::size_t found = 0, tries = 0; found < point_count && tries < 100 * point_count; ++tries) {
        const auto& corners = mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
        const Vec3 &a = mesh.positions[corners[0]], &b = mesh.positions[corners[1]], &c = mesh.positions[corners[2]];
        const Vec3 normal = tests::cross(tests::difference(b, a), tests::difference(c, a));
        const float length = std::sqrt(tests::dot(normal, normal));
        const Vec3 way = random.in_cube(1.0f);
        const float size = std::sqrt(tests::dot(way, way));
        if (!(length > 0.0f) || !(size > 0.1f) || size > 1.0f) continue;
        const float by = (2.0f + 2.0f * random.unit()) * radius / length;
        const Vec3 point = {(a.x + b.x + c.x) / 3.0f + normal.x * by, (a.y + b.y + c.y) / 3.0f + normal.y * by,
                            (a.z + b.z + c.z) / 3.0f + normal.z * by};
        if (touches(point, 2.0f * radius)) continue;
        append(numbers, maker.shape, point, radius);
        append(numbers, tests::times(way, maker.way * diagonal / size));
        ++found;
    }
    return numbers;
}

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
        QuestionSet set = {maker.name, maker.kind, maker.floats(), point_count, {}};
        switch (maker.source) {
            case Source::nothing:
                return set;
            case Source::incoherent:
                set.numbers = numbers_of(incoherent_rays(mesh, ray_count, seed));
                break;
            case Source::coherent:
                set.numbers = numbers_of(coherent_rays(mesh));
                break;
            case Source::anywhere:
                set.numbers = shapes_anywhere(mesh, maker);
                break;
            case Source::above:
                set.numbers = shapes_above(mesh, maker, touches);
                break;
            case Source::poses:
                for (const Transform& pose : some_poses(mesh, pose_count, seed, collides))
                    for (const float number : numbers_of(pose)) set.numbers.push_back(number);
        }
        set.count = set.numbers.size() / set.floats;
        if (set.count < 8) throw std::runtime_error("of this mesh, too few questions of " + name + " start free");
        return set;
    }
    throw std::invalid_argument("there are no questions named " + name);
}

}  // namespace espalier::bench
