// The claim that contacts can be trusted by physics: bodies that begin a little deep in a floor of many triangles come
// to rest on it, with the solver of docs/cookbook.md. A wrong normal or depth throws them into the air, and a reduction
// that keeps other contacts in every step rocks them for ever.
#include "support/testing.hpp"

namespace espalier::tests::falling_bodies_test {
namespace {

Vec3 plus(Vec3 a, Vec3 b, float s) { return {a.x + b.x * s, a.y + b.y * s, a.z + b.z * s}; }
float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

constexpr float time_step = 1.0f / 60, margin = 0.05f, slop = 0.001f, friction = 0.6f, gravity = 9.81f;

/// One kilogram that turns alike about every axis.
struct Body {
    int kind;  ///< sphere, capsule, crate, hull
    Transform place;
    float inertia;
    Vec3 half = {0.25f, 0.3f, 0.25f};  ///< of the crate
    Vec3 speed = {}, spin = {};
    struct Pushed {
        Vec3 point;
        std::array<float, 3> by;
    };
    std::vector<Pushed> pushed = {};

    [[nodiscard]] Vec3 at(Vec3 own) const { return plus(place.translation, direction_to_world(place, own), 1.0f); }
    [[nodiscard]] Filled contacts(const Blob& blob, std::span<Contact> room) const {
        if (kind == 0) return find_contacts(blob, Sphere{place.translation, 0.25f}, margin, room);
        if (kind == 1)
            return find_contacts(blob, Capsule{at({0.3f, 0.0f, 0.0f}), at({-0.3f, 0.0f, 0.0f}), 0.25f}, margin, room);
        const auto along = [this](Vec3 axis) { return direction_to_world(place, axis); };
        const OrientedBox crate = {place.translation,
                                   {along({half.x, 0, 0}), along({0, half.y, 0}), along({0, 0, half.z})}};
        if (kind == 2) return find_contacts(blob, crate, margin, room);
        std::array<Vec3, 12> corners;  // a prism of six sides
        for (unsigned i = 0; i < 12; ++i) {
            const float angle = static_cast<float>(i % 6) * 1.0471976f;
            corners[i] = at({0.3f * std::cos(angle), 0.3f * std::sin(angle), i < 6 ? -0.25f : 0.25f});
        }
        return find_contacts(blob, ConvexHull{corners}, margin, room);
    }
    [[nodiscard]] float moving() const { return 0.5f * dot(speed, speed) + 0.5f * inertia * dot(spin, spin); }
    [[nodiscard]] float energy() const { return moving() + gravity * place.translation.z; }
    /// As the recipe "A ball that rolls and a box that rests". Returns whether all normals are those of a floor with
    /// this normal.
    bool step(const Blob& blob, Vec3 up) {
        std::array<Contact, 512> room;
        const Filled found = this->contacts(blob, room);
        bool are_up = true;
        for (const Contact& contact : found.in(room)) are_up = are_up && dot(contact.normal, up) > 0.999f;
        const auto contacts = found.in(room).first(reduce_contacts(found.in(room)));
        const Vec3 middle = place.translation;
        speed.z -= gravity * time_step;
        std::vector<Pushed> now_pushed;
        for (const Contact& contact : contacts) {
            now_pushed.push_back({contact.point, {}});
            float nearest = std::numeric_limits<float>::max();
            for (const Pushed& last : pushed) {
                const Vec3 apart = plus(last.point, contact.point, -1);
                if (dot(apart, apart) >= nearest) continue;
                nearest = dot(apart, apart);
                now_pushed.back().by = last.by;
            }
        }
        pushed = now_pushed;
        for (int round = 0; round <= 20; ++round) {
            for (std::size_t i = 0; i < contacts.size(); ++i) {
                const Vec3 normal = contacts[i].normal, arm = plus(contacts[i].point, middle, -1);
                const auto push = [&](Vec3 way, float wanted, float least, float most, float& sum) {
                    const Vec3 lever = cross(arm, way);
                    const float now = dot(speed, way) + dot(spin, lever), before = round == 0 ? 0 : sum;
                    if (round != 0)
                        sum = std::clamp(before + (wanted - now) / (1 + dot(lever, lever) / inertia), least, most);
                    speed = plus(speed, way, sum - before);
                    spin = plus(spin, lever, (sum - before) / inertia);
                };
                auto& [along, aside, over] = pushed[i].by;
                const float gap = contacts[i].distance, out = std::max(-gap - slop, 0.0f) / 5;
                push(normal, (gap > 0 ? -gap : out) / time_step, 0, std::numeric_limits<float>::max(), along);
                const Vec3 any = std::abs(normal.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, flat = cross(normal, any);
                const Vec3 across = plus({}, flat, 1 / std::sqrt(dot(flat, flat)));
                const float most = friction * along;
                push(across, 0, -most, most, aside);
                push(cross(normal, across), 0, -most, most, over);
            }
        }
        const Vec3 turn = plus({}, spin, -0.5f * time_step);
        place.rotation = to_local(Transform{{turn.x, turn.y, turn.z, 1}, {}, 1}, place).rotation;
        place.translation = plus(middle, speed, time_step);
        return are_up;
    }
};

/// A floor of side * side cells about the origin, each of this size.
template <typename Height>
Mesh make_floor(std::uint32_t side, double width, double depth, Height height) {
    Mesh mesh;
    for (std::uint32_t j = 0; j <= side; ++j) {
        for (std::uint32_t i = 0; i <= side; ++i) {
            const double x = width * (i - 0.5 * side), y = depth * (j - 0.5 * side);
            mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(height(x, y))});
        }
    }
    for (std::uint32_t j = 0; j < side; ++j) {
        for (std::uint32_t i = 0; i < side; ++i) {
            const std::uint32_t a = j * (side + 1) + i, b = a + 1, c = b + side + 1, d = a + side + 1;
            if ((i + j) % 2 == 0) mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
            else mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
        }
    }
    return mesh;
}

TEST_CASE("contact: no body on a level or sloped floor gains speed by the solver of the cookbook") {
    constexpr const char* names[] = {"sphere", "capsule", "crate", "hull"};
    for (const double degrees : {0.0, 5.0, 20.0}) {
        const double slope = std::tan(degrees * 3.14159265358979 / 180.0);
        const OpenedBlob floor(make_floor(9, 1.1, 0.9, [&](double x, double) { return slope * x; }),
                               {.flat_angle = 5.0});
        const float angle = static_cast<float>(degrees * 3.14159265358979 / 180.0);
        const Vec3 up = {-std::sin(angle), 0.0f, std::cos(angle)};
        for (int kind = 0; kind < 4; ++kind) {
            CAPTURE(degrees);
            CAPTURE(kind);
            Random random(static_cast<std::uint64_t>(kind) + 3);
            std::uint64_t thrown = 0, wrong = 0, steps = 0;
            float most = -1.0f;
            for (std::uint64_t i = 0; i < scaled(100); ++i) {
                const float depths[] = {0.0002f, 0.001f, 0.005f};
                const float depth = depths[i % 3];
                // Along the slope, turned about its normal, and leaning by a milliradian or two.
                const float turn = i % 2 == 0 ? 0.0f : 3.0f * random.signed_unit(),
                            lean = 0.002f * random.signed_unit(), tip = 0.002f * random.signed_unit();
                const Transform about = {{0, 0, std::sin(0.5f * turn), std::cos(0.5f * turn)}, {}, 1};
                const Transform back = {
                    {-0.5f * lean, std::sin(0.5f * (angle + tip)), 0, std::cos(0.5f * (angle + tip))},
                    {},
                    1};  // to_local() turns forwards
                Body body = {kind, {}, 0.4f * 0.25f * 0.25f};
                body.place.rotation = to_local(back, about).rotation;
                // Every other one stands with a side a little before a seam.
                const float x = i % 2 == 0 ? 0.55f + 0.25f + margin * random.unit() : 2.0f * random.signed_unit();
                const float y = 2.0f * random.signed_unit();
                const float height = 0.25f - depth;
                body.place.translation = {x - height * std::sin(angle), y,
                                          static_cast<float>(slope) * x + height * std::cos(angle)};
                const float before = body.energy();
                // What the solver's bias may add: the height of the depth, and its speed.
                const float bias = depth / 5 / time_step, allowed = gravity * 2 * depth + 0.5f * bias * bias + 0.001f;
                float gained = 0.0f;
                for (int k = 0; k < 60; ++k) {
                    wrong += body.step(floor.blob, up) ? 0u : 1u;
                    gained = std::max(gained, body.energy() - before);
                    if (std::abs(body.place.translation.x) > 4.0f || std::abs(body.place.translation.y) > 4.0f) break;
                    ++steps;
                }
                most = std::max(most, gained - allowed);
                thrown += gained > allowed ? 1u : 0u;
            }
            CHECK(thrown == 0);
            CHECK(wrong == 0);
            MESSAGE(degrees, " degrees, ", std::string(names[kind]), ": ", steps,
                    " steps; the most energy above that of the bias ", most, " J");
        }
    }
}

TEST_CASE("contact: a cube and a plank come to rest on a low dome by the solver of the cookbook") {
    for (const double height : {0.0005, 0.0012, 0.008}) {
        for (const double radius : {0.4, 0.7}) {
            const Mesh mesh = make_floor(20, 0.16, 0.16, [&](double x, double y) {
                return std::max(height * (1.0 - (x * x + y * y) / (radius * radius)), 0.0);
            });
            const OpenedBlob dome(mesh, {.resolution = Resolution::bits(20), .flat_angle = 5.0});
            for (const float breadth : {0.5f, 0.125f}) {
                CAPTURE(height);
                CAPTURE(radius);
                CAPTURE(breadth);
                Body body = {2, {{0.0005f, 0.0003f, 0, 1}, {0, 0, 0.5f + static_cast<float>(height)}, 1}, 0.5f / 3};
                body.half = {0.5f, breadth, 0.5f};
                for (int k = 0; k < 450; ++k) body.step(dome.blob, {0, 0, 1});
                float most = 0.0f;
                for (int k = 0; k < 60; ++k) {
                    body.step(dome.blob, {0, 0, 1});
                    most = std::max(most, body.moving());
                }
                CHECK(most < 1e-10f);
            }
        }
    }
}

}  // namespace
}  // namespace espalier::tests::falling_bodies_test
