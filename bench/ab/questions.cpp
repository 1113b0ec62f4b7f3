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
    touching,  ///< shapes whose middle is within their radius of a triangle, on its front
    above,     ///< shapes that start free, above triangles
    poses,
    nothing,
};
enum class Shape : std::uint8_t { point, sphere, capsule, box, oriented_box };

/// What a row asks. Lengths are shares of the diagonal of the mesh's box.
struct Maker {
    const char* name;
    const char* kind;
    Source source;
    Shape shape = Shape::point;
    float radius = 0.0f;
    float way = 0.0f;  ///< of a sweep; anywhere, the half side of a cube of ways: a character's step rather than a shot

    [[nodiscard]] std::size_t floats() const {
        constexpr std::size_t of_shapes[] = {3, 4, 7, 6, 12};
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
    {"all_overlaps_box", "all_overlaps_box", Source::touching, Shape::box, 0.02f},
    {"overlaps_capsule", "overlaps_capsule", Source::anywhere, Shape::capsule, 0.01f},
    {"overlaps_capsule_touching", "overlaps_capsule", Source::touching, Shape::capsule, 0.01f},
    {"overlaps_oriented_box", "overlaps_oriented_box", Source::anywhere, Shape::oriented_box, 0.01f},
    {"overlaps_oriented_box_touching", "overlaps_oriented_box", Source::touching, Shape::oriented_box, 0.01f},
    {"contacts_sphere", "contacts_sphere", Source::touching, Shape::sphere, 0.01f},
    {"contacts_capsule", "contacts_capsule", Source::touching, Shape::capsule, 0.01f},
    {"contacts_oriented_box", "contacts_oriented_box", Source::touching, Shape::oriented_box, 0.01f},
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

/// Around a point. Oriented boxes are cubes, each turned in another way.
void append(std::vector<float>& to, Shape shape, Vec3 p, float radius, tests::Random& random) {
    if (shape == Shape::capsule || shape == Shape::box) {
        const float across = shape == Shape::box ? radius : 0.0f;
        append(to, {p.x - across, p.y - radius, p.z - across});
        append(to, {p.x + across, p.y + radius, p.z + across});
    } else {
        append(to, p);
    }
    if (shape == Shape::sphere || shape == Shape::capsule) to.push_back(radius);
    if (shape != Shape::oriented_box) return;
    Vec3 a, b, c;
    do {
        a = random.in_cube(1.0f);
        b = tests::cross(a, random.in_cube(1.0f));
        c = tests::cross(a, b);
    } while (!(tests::dot(c, c) > 1e-4f));
    for (const Vec3& axis : {a, b, c}) append(to, tests::times(axis, radius / std::sqrt(tests::dot(axis, axis))));
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
        append(numbers, maker.shape, {x, y, z}, maker.radius * box.diagonal, random);
        if (maker.way > 0.0f) append(numbers, random.in_cube(maker.way * box.diagonal));
    }
    return numbers;
}

/// The middle of a random triangle, and its unit normal; zero where it has no area.
struct Place {
    Vec3 middle, normal;

    Place(const Mesh& mesh, tests::Random& random) {
        const auto& corners = mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
        const Vec3 &a = mesh.positions[corners[0]], &b = mesh.positions[corners[1]], &c = mesh.positions[corners[2]];
        middle = {(a.x + b.x + c.x) / 3.0f, (a.y + b.y + c.y) / 3.0f, (a.z + b.z + c.z) / 3.0f};
        const Vec3 across = tests::cross(tests::difference(b, a), tests::difference(c, a));
        const float length = std::sqrt(tests::dot(across, across));
        if (length > 0.0f) normal = tests::times(across, 1.0f / length);
    }
    [[nodiscard]] Vec3 above(float by) const {
        return {middle.x + normal.x * by, middle.y + normal.y * by, middle.z + normal.z * by};
    }
};

std::vector<float> shapes_touching(const Mesh& mesh, const Maker& maker) {
    const float radius = maker.radius * box_of(mesh).diagonal;
    tests::Random random(seed);
    std::vector<float> numbers;
    for (std::size_t i = 0; i < point_count; ++i) {
        const Place place(mesh, random);
        append(numbers, maker.shape, place.above(radius * random.unit()), radius, random);
    }
    return numbers;
}

/// Two to four radii above a random triangle, on ways in a random direction. Nothing else is within two radii either.
std::vector<float> shapes_above(const Mesh& mesh, const Maker& maker, const TouchesSphere& touches) {
    const float diagonal = box_of(mesh).diagonal, radius = maker.radius * diagonal;
    tests::Random random(seed);
    std::vector<float> numbers;
    for (std::size_t found = 0, tries = 0; found < point_count && tries < 100 * point_count; ++tries) {
        const Place place(mesh, random);
        const Vec3 way = random.in_cube(1.0f);
        const float size = std::sqrt(tests::dot(way, way));
        if (!(tests::dot(place.normal, place.normal) > 0.0f) || !(size > 0.1f) || size > 1.0f) continue;
        const Vec3 point = place.above((2.0f + 2.0f * random.unit()) * radius);
        if (touches(point, 2.0f * radius)) continue;
        append(numbers, maker.shape, point, radius, random);
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
            case Source::touching:
                set.numbers = shapes_touching(mesh, maker);
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
