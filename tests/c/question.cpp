#include "question.hpp"

#include "support/base/vectors.hpp"
#include "support/queries/hostile_arguments.hpp"

namespace espalier::tests {

question some_question(const Blob& blob, Random& random) {
    question result = {};
    for (Vec3& point : result.points) point = some_point(blob, random);
    const Vec3 size = difference(blob.bounds().max, blob.bounds().min);
    for (Vec3& direction : result.directions) {
        const Vec3 unit = random.in_cube(1.0f);
        direction =
            random.below(6) == 0 ? some_point(blob, random) : Vec3{unit.x * size.x, unit.y * size.y, unit.z * size.z};
    }
    for (float& length : result.lengths) length = some_length(blob, random);
    for (float& number : result.rotation)
        number = random.below(12) == 0 ? some_length(blob, random) : random.signed_unit();
    result.bits = static_cast<std::uint32_t>(random.next());
    return result;
}

question some_question(const BakedScene& scene, Random& random) {
    const InstanceId id = {random.below(scene.instance_count())};
    const Instance instance = *instance_at(scene, id);
    const Result<Blob> mesh = mesh_at(scene, id);
    question result = some_question(mesh ? *mesh : scene.tiles()[0].meshes()[0], random);
    for (Vec3& point : result.points) point = to_world(instance.transform, point);
    for (Vec3& way : result.directions) way = direction_to_world(instance.transform, way);
    for (float& length : result.lengths) length *= instance.transform.scale;
    return result;
}

}  // namespace espalier::tests
