#include "dtypes.hpp"

#include <cstddef>
#include <initializer_list>
#include <map>
#include <string>

#include <espalier/approximate.hpp>
#include <espalier/contact.hpp>
#include <espalier/distance.hpp>
#include <espalier/original.hpp>
#include <espalier/pair.hpp>
#include <espalier/ray.hpp>
#include <espalier/scene.hpp>
#include <espalier/scenes/moving_scene.hpp>
#include <espalier/scenes/pairs.hpp>
#include <espalier/status.hpp>
#include <espalier/sweep.hpp>
#include <espalier/types.hpp>

namespace espalier::python {

namespace {

struct Field {
    const char* name;
    const char* format;
    std::size_t offset;
};

py::dtype make(std::initializer_list<Field> fields, std::size_t size) {
    py::list names;
    py::list formats;
    py::list offsets;
    for (const Field& field : fields) {
        names.append(field.name);
        formats.append(field.format);
        offsets.append(field.offset);
    }
    return {names, formats, offsets, static_cast<py::ssize_t>(size)};
}

// Standard layout is conditional for some of these; GCC and Clang lay all of them out as such.
#pragma GCC diagnostic ignored "-Winvalid-offsetof"
// clang-format off
#define ESPALIER_FIELD(Type, name, format) Field{#name, format, offsetof(Type, name)}
#define ESPALIER_IN_HIT(Hit, name, format) Field{#name, format, offsetof(InScene<Hit>, hit) + offsetof(Hit, name)}
#define ESPALIER_RAY_HIT(F, Hit) F(Hit, t, "f4"), F(Hit, u, "f4"), F(Hit, v, "f4"), F(Hit, normal, "3f4"), \
    F(Hit, triangle, "u4"), F(Hit, status, "u1"), F(Hit, side, "u1")
#define ESPALIER_CLOSEST_POINT(F, Hit) F(Hit, point, "3f4"), F(Hit, on_shape, "3f4"), F(Hit, face_normal, "3f4"), \
    F(Hit, distance, "f4"), F(Hit, u, "f4"), F(Hit, v, "f4"), F(Hit, triangle, "u4"), F(Hit, status, "u1"), \
    F(Hit, feature, "u1"), F(Hit, side, "u1")
#define ESPALIER_SWEEP_HIT(F, Hit) F(Hit, t, "f4"), F(Hit, point, "3f4"), F(Hit, normal, "3f4"), \
    F(Hit, face_normal, "3f4"), F(Hit, triangle, "u4"), F(Hit, status, "u1"), \
    F(Hit, feature, "u1"), F(Hit, starts_overlapping, "?")
#define ESPALIER_INSTANCE(Hit) \
    Field{"instance", "u4", offsetof(InScene<Hit>, instance) + offsetof(InstanceId, index)}, \
    Field{"in_tile", "u4", offsetof(InScene<Hit>, instance) + offsetof(InstanceId, in_tile)}

std::map<std::string, py::dtype> make_all() {
    using Original = Result<OriginalTriangle>;
    using Corners = Result<Triangle>;
    const auto original = [](const char* name, std::size_t offset) {
        return Field{name, "u4", offsetof(Original, value) + offset};
    };
    std::map<std::string, py::dtype> all;
    all["ray_hit"] = make({ESPALIER_RAY_HIT(ESPALIER_FIELD, RayHit)}, sizeof(RayHit));
    all["closest_point"] = make({ESPALIER_CLOSEST_POINT(ESPALIER_FIELD, ClosestPoint)}, sizeof(ClosestPoint));
    all["sweep_hit"] = make({ESPALIER_SWEEP_HIT(ESPALIER_FIELD, SweepHit)}, sizeof(SweepHit));
    all["scene_ray_hit"] = make({ESPALIER_RAY_HIT(ESPALIER_IN_HIT, RayHit), ESPALIER_INSTANCE(RayHit)},
                                sizeof(InScene<RayHit>));
    all["scene_closest_point"] = make({ESPALIER_CLOSEST_POINT(ESPALIER_IN_HIT, ClosestPoint),
                                       ESPALIER_INSTANCE(ClosestPoint)}, sizeof(InScene<ClosestPoint>));
    all["scene_sweep_hit"] = make({ESPALIER_SWEEP_HIT(ESPALIER_IN_HIT, SweepHit), ESPALIER_INSTANCE(SweepHit)},
                                  sizeof(InScene<SweepHit>));
    all["scene_triangle"] = make({Field{"instance", "u4", 0}, Field{"in_tile", "u4", 4}, Field{"triangle", "u4", 8}}, 12);
    all["original_hit"] = make({ESPALIER_FIELD(OriginalHit, file, "u4"), ESPALIER_FIELD(OriginalHit, mesh, "u4"),
                                ESPALIER_FIELD(OriginalHit, triangle, "u4"), ESPALIER_FIELD(OriginalHit, u, "f4"),
                                ESPALIER_FIELD(OriginalHit, v, "f4"), ESPALIER_FIELD(OriginalHit, status, "u1")},
                               sizeof(OriginalHit));
    all["original_triangle"] = make({original("file", offsetof(OriginalTriangle, file)),
                                     original("mesh", offsetof(OriginalTriangle, mesh)),
                                     original("triangle", offsetof(OriginalTriangle, triangle)),
                                     original("first_corner", offsetof(OriginalTriangle, first_corner)),
                                     Field{"status", "u1", offsetof(Original, status)}}, sizeof(Original));
    all["remap"] = make({ESPALIER_FIELD(OriginalTriangle, file, "u4"), ESPALIER_FIELD(OriginalTriangle, mesh, "u4"),
                         ESPALIER_FIELD(OriginalTriangle, triangle, "u4"),
                         ESPALIER_FIELD(OriginalTriangle, first_corner, "u4")}, sizeof(OriginalTriangle));
    all["length"] = make({Field{"value", "f4", offsetof(Result<float>, value)},
                          Field{"status", "u1", offsetof(Result<float>, status)}}, sizeof(Result<float>));
    using Kinds = Result<EdgeKinds>;
    const auto kind = [](const char* name, std::size_t offset) { return Field{name, "u1", offsetof(Kinds, value) + offset}; };
    all["edge_kinds"] = make({kind("ab", offsetof(EdgeKinds, ab)), kind("bc", offsetof(EdgeKinds, bc)),
                              kind("ca", offsetof(EdgeKinds, ca)), Field{"status", "u1", offsetof(Kinds, status)}},
                             sizeof(Kinds));
    using Distances = Result<DistanceBounds>;
    all["distance_bounds"] = make({Field{"lower", "f4", offsetof(Distances, value) + offsetof(DistanceBounds, lower)},
                                   Field{"upper", "f4", offsetof(Distances, value) + offsetof(DistanceBounds, upper)},
                                   Field{"status", "u1", offsetof(Distances, status)}}, sizeof(Distances));
    using Boxes = Result<Box>;
    all["box"] = make({Field{"min", "3f4", offsetof(Boxes, value) + offsetof(Box, min)},
                       Field{"max", "3f4", offsetof(Boxes, value) + offsetof(Box, max)},
                       Field{"status", "u1", offsetof(Boxes, status)}}, sizeof(Boxes));
    all["candidate"] = make({Field{"instance", "u4", offsetof(InstanceId, index)},
                             Field{"in_tile", "u4", offsetof(InstanceId, in_tile)}}, sizeof(InstanceId));
    all["winding"] = make({Field{"value", "f4", offsetof(Result<float>, value)},
                           Field{"status", "u1", offsetof(Result<float>, status)}}, sizeof(Result<float>));
    all["corners"] = make({Field{"corners", "(3,3)f4", offsetof(Corners, value)},
                           Field{"status", "u1", offsetof(Corners, status)}}, sizeof(Corners));
    all["contact"] = make({ESPALIER_FIELD(Contact, point, "3f4"), ESPALIER_FIELD(Contact, normal, "3f4"),
                           ESPALIER_FIELD(Contact, distance, "f4"), ESPALIER_FIELD(Contact, triangle, "u4"),
                           ESPALIER_FIELD(Contact, feature, "u1"), ESPALIER_FIELD(Contact, side, "u1")}, sizeof(Contact));
    all["contact_plane"] = make({ESPALIER_FIELD(ContactPlane, normal, "3f4"), ESPALIER_FIELD(ContactPlane, distance, "f4"),
                                 ESPALIER_FIELD(ContactPlane, triangle, "u4")}, sizeof(ContactPlane));
    all["way"] = make({Field{"value", "3f4", offsetof(Result<Vec3>, value)},
                       Field{"status", "u1", offsetof(Result<Vec3>, status)}}, sizeof(Result<Vec3>));
    all["scene_contact"] = make({ESPALIER_IN_HIT(Contact, point, "3f4"), ESPALIER_IN_HIT(Contact, normal, "3f4"),
                                 ESPALIER_IN_HIT(Contact, distance, "f4"), ESPALIER_IN_HIT(Contact, triangle, "u4"),
                                 ESPALIER_IN_HIT(Contact, feature, "u1"), ESPALIER_IN_HIT(Contact, side, "u1"),
                                 ESPALIER_INSTANCE(Contact)}, sizeof(InScene<Contact>));
    all["pair_contact"] = make({ESPALIER_FIELD(PairContact, a, "u4"), ESPALIER_FIELD(PairContact, b, "u4"),
                                ESPALIER_FIELD(PairContact, status, "u1")}, sizeof(PairContact));
    all["pair_touch"] = make({ESPALIER_FIELD(PairTouch, points, "(6,3)f4"), ESPALIER_FIELD(PairTouch, normal, "3f4"),
                              ESPALIER_FIELD(PairTouch, depth, "f4"), ESPALIER_FIELD(PairTouch, a, "u4"),
                              ESPALIER_FIELD(PairTouch, b, "u4"), ESPALIER_FIELD(PairTouch, count, "u1")},
                             sizeof(PairTouch));
    all["blob_distance"] = make({ESPALIER_FIELD(BlobDistance, distance, "f4"), ESPALIER_FIELD(BlobDistance, on_a, "3f4"),
                                 ESPALIER_FIELD(BlobDistance, on_b, "3f4"), ESPALIER_FIELD(BlobDistance, a, "u4"),
                                 ESPALIER_FIELD(BlobDistance, b, "u4"), ESPALIER_FIELD(BlobDistance, status, "u1")},
                                sizeof(BlobDistance));
    all["instance"] = make({Field{"transform", "8f4", offsetof(Instance, transform)}, ESPALIER_FIELD(Instance, mesh, "u4"),
                            ESPALIER_FIELD(Instance, mask, "u4"), ESPALIER_FIELD(Instance, user, "u4"),
                            ESPALIER_FIELD(Instance, source, "u4")}, sizeof(Instance));
    using Handle = Result<InstanceHandle>;
    all["handle"] = make({Field{"slot", "u4", offsetof(Handle, value) + offsetof(InstanceHandle, slot)},
                          Field{"generation", "u4", offsetof(Handle, value) + offsetof(InstanceHandle, generation)},
                          Field{"status", "u1", offsetof(Handle, status)}}, sizeof(Handle));
    all["instance_pair"] = make({ESPALIER_FIELD(InstancePair, a, "u4"), ESPALIER_FIELD(InstancePair, b, "u4")},
                                sizeof(InstancePair));
    all["baked_pair"] = make({ESPALIER_FIELD(BakedPair, moving, "u4"),
                              Field{"instance", "u4", offsetof(BakedPair, baked) + offsetof(InstanceId, index)},
                              Field{"in_tile", "u4", offsetof(BakedPair, baked) + offsetof(InstanceId, in_tile)}},
                             sizeof(BakedPair));
    return all;
}
// clang-format on

const std::map<std::string, py::dtype>& all_types() {
    // Lives as long as the process: an interpreter that ends must not release it.
    static const auto* types = new std::map<std::string, py::dtype>(make_all());
    return *types;
}

}  // namespace

py::dtype dtype_of(const char* name) {
    const auto found = all_types().find(name);
    if (found == all_types().end()) throw py::key_error(name);
    return found->second;
}

void bind_dtypes(py::module_& module) {
    py::dict types;
    for (const auto& [name, type] : all_types()) types[name.c_str()] = type;
    module.attr("dtypes") = types;
}

}  // namespace espalier::python
