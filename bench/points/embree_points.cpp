#include "points.hpp"

#include "../../tests/support/base/vectors.hpp"
#include "../peers/embree.hpp"

namespace espalier::bench {
namespace {

using tests::difference, tests::dot;

/// Squared distance of a point and a triangle by the regions of its plane (Ericson 2005, 5.1.5), in float32.
float squared_distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 ab = difference(b, a), ac = difference(c, a), ap = difference(p, a);
    const auto from = [&](float v, float w) {
        const Vec3 d = {ap.x - v * ab.x - w * ac.x, ap.y - v * ab.y - w * ac.y, ap.z - v * ab.z - w * ac.z};
        return dot(d, d);
    };
    const float d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0.0f && d2 <= 0.0f) return from(0.0f, 0.0f);
    const Vec3 bp = difference(p, b);
    const float d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0.0f && d4 <= d3) return from(1.0f, 0.0f);
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return from(d1 / (d1 - d3), 0.0f);
    const Vec3 cp = difference(p, c);
    const float d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0.0f && d5 <= d6) return from(0.0f, 1.0f);
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return from(0.0f, d2 / (d2 - d6));
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f) {
        const float w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return from(1.0f - w, w);
    }
    const float share = 1.0f / (va + vb + vc);
    return from(vb * share, vc * share);
}

struct Question {
    const Mesh* mesh;
    float squared_radius;
    std::size_t count;

    [[nodiscard]] float to(const RTCPointQueryFunctionArguments* arguments) const {
        const TriangleVertices& t = mesh->triangles[arguments->primID];
        const RTCPointQuery& query = *arguments->query;
        return squared_distance({query.x, query.y, query.z}, mesh->positions[t[0]], mesh->positions[t[1]],
                                mesh->positions[t[2]]);
    }
};

bool count_triangle(RTCPointQueryFunctionArguments* arguments) {
    Question& question = *static_cast<Question*>(arguments->userPtr);
    question.count += question.to(arguments) <= question.squared_radius ? 1u : 0u;
    return false;
}

bool keep_closest(RTCPointQueryFunctionArguments* arguments) {
    Question& question = *static_cast<Question*>(arguments->userPtr);
    const float squared = question.to(arguments);
    if (squared >= question.squared_radius) return false;
    question.squared_radius = squared;
    arguments->query->radius = std::sqrt(squared);
    return true;
}

/// A scene of Embree that answers by a function.
struct Scene {
    explicit Scene(const Mesh& of) : mesh(of), scene(device.new_scene(of)) { rtcCommitScene(scene); }
    ~Scene() { rtcReleaseScene(scene); }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    [[nodiscard]] Question ask(Vec3 center, float radius, RTCPointQueryFunction function) const {
        Question question = {&mesh, radius * radius, 0};
        RTCPointQuery query = {center.x, center.y, center.z, 0.0f, radius};
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        rtcPointQuery(scene, &query, &context, function, &question);
        return question;
    }

    const Mesh& mesh;
    EmbreeDevice device;
    RTCScene scene;
};

}  // namespace

EmbreePoints embree_points(const Mesh& mesh) {
    const auto scene = std::make_shared<Scene>(mesh);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {[scene](Vec3 center, float radius) { return scene->ask(center, radius, count_triangle).count; },
            [scene](Vec3 point) { return std::sqrt(scene->ask(point, infinity, keep_closest).squared_radius); }};
}

}  // namespace espalier::bench
