// scene_judge BLOB SCENE: compares a scene with the loop over its instances, and with the blob of the same models.
// Prints a line of figures. Exit status: 0 they agree, 1 they differ, 2 usage or a file that cannot be opened.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <espalier/espalier.hpp>
#include <espalier/scene.hpp>

#include "support/base/random.hpp"
#include "support/loops/scene_loop.hpp"

using namespace espalier;

namespace {

constexpr int questions = 300;  ///< of a kind

std::vector<std::byte> read_file(const char* path) {
    std::ifstream file(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    const auto* const bytes = reinterpret_cast<const std::byte*>(text.data());
    return {bytes, bytes + text.size()};
}

/// Points in and around a box.
class Places {
public:
    explicit Places(const Box& box) : box_(box) {}

    Vec3 next() {
        const auto between = [&](float low, float high) {
            const float half = 0.5f * high - 0.5f * low;
            return (low + half) + 1.5f * half * random_.signed_unit();
        };
        return {between(box_.min.x, box_.max.x), between(box_.min.y, box_.max.y), between(box_.min.z, box_.max.z)};
    }

private:
    Box box_;
    tests::Random random_{28};
};

double length(const Vec3& v) { return std::hypot(double(v.x), double(v.y), double(v.z)); }

/// Returns how far the distances of a blob and of a scene may be apart, of points about that far away.
double allowed_difference(const Blob& blob, const BakedScene& scene, double magnitude) {
    return double(blob.max_error()) + double(scene.max_error()) + magnitude * 0x1p-20;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 3) return 2;
    const std::vector<std::byte> blob_bytes = read_file(arguments[1]), bytes = read_file(arguments[2]);
    const Blob blob = open(blob_bytes);
    std::vector<Blob> meshes(mesh_count_of_scene(bytes));
    const BakedScene scene = open_scene(bytes, meshes);
    if (!blob || !scene) {
        std::fprintf(stderr, "%s: %s, %s: %s\n", arguments[1], describe(blob.status()), arguments[2],
                     describe(scene.status()));
        return 2;
    }
    Places places(scene.bounds());
    int found = 0;
    double farthest = 0.0;
    for (int i = 0; i < questions; ++i) {
        const Vec3 from = places.next(), to = places.next();
        const Ray ray = {from, {to.x - from.x, to.y - from.y, to.z - from.z}};
        const tests::SceneComparison rays =
            length(ray.direction) > 0.0 ? tests::compare_rays(scene, ray) : tests::SceneComparison{};
        const tests::SceneComparison points =
            tests::compare_closest_points(scene, from, std::numeric_limits<float>::infinity());
        for (const char* const fault : {rays.fault, points.fault})
            if (fault != nullptr) {
                std::fprintf(stderr, "%s: not the loop's answer: %s\n", arguments[2], fault);
                return 1;
            }
        found += rays.is_found ? 1 : 0;
        const double of_blob = double(closest_point(blob, from).distance);
        const double of_scene = double(closest_point(scene, from)->distance);
        const double difference = std::abs(of_blob - of_scene);
        const double allowed = allowed_difference(blob, scene, length(from) + of_blob);
        if (!(difference <= allowed)) {
            std::fprintf(stderr, "%s: %g from a point, and %s: %g, although %g is allowed\n", arguments[1], of_blob,
                         arguments[2], of_scene, allowed);
            return 1;
        }
        farthest = std::max(farthest, difference / allowed);
    }
    std::printf("%u instances of %zu meshes, %d of %d rays hit, distances differ by %.2f of what is allowed\n",
                scene.instance_count(), meshes.size(), found, questions, farthest);
    return 0;
}
