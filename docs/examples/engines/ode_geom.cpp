#include "ode_geom.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace {

using espalier::Contact;
using espalier::Vec3;

int geom_class = -1;

const espalier::Blob& blob_of(dGeomID geom) { return **static_cast<const espalier::Blob**>(dGeomGetClassData(geom)); }

/// A point or direction of the world in the space of the geom, and back. Rows of ODE's rotations have four numbers.
struct Frame {
    const dReal* place;
    const dReal* rotation;

    explicit Frame(dGeomID geom) : place(dGeomGetPosition(geom)), rotation(dGeomGetRotation(geom)) {}
    [[nodiscard]] Vec3 direction_to_local(dReal x, dReal y, dReal z) const {
        const auto along = [&](int column) {
            return float(rotation[column] * x + rotation[4 + column] * y + rotation[8 + column] * z);
        };
        return {along(0), along(1), along(2)};
    }
    [[nodiscard]] Vec3 to_local(const dReal* p) const {
        return direction_to_local(p[0] - place[0], p[1] - place[1], p[2] - place[2]);
    }
    void direction_to_world(const Vec3& v, dReal* result) const {
        for (int row = 0; row < 3; ++row)
            result[row] = rotation[4 * row] * dReal(v.x) + rotation[4 * row + 1] * dReal(v.y) +
                          rotation[4 * row + 2] * dReal(v.z);
    }
};

/// Column of a rotation: where it takes an axis.
struct Axis {
    dReal x, y, z;
};
Axis axis_of(dGeomID geom, int column) {
    const dReal* r = dGeomGetRotation(geom);
    return {r[column], r[4 + column], r[8 + column]};
}

/// Contacts of the other geom within no margin, in the space of the mesh.
std::size_t contacts_of(dGeomID mesh, dGeomID other, std::span<Contact> contacts) {
    const Frame frame(mesh);
    const espalier::Blob& blob = blob_of(mesh);
    const Vec3 middle = frame.to_local(dGeomGetPosition(other));
    espalier::Filled found;
    switch (dGeomGetClass(other)) {
        case dSphereClass:
            found = find_contacts(blob, espalier::Sphere{middle, float(dGeomSphereGetRadius(other))}, 0, contacts);
            break;
        case dCapsuleClass: {
            dReal radius = 0, length = 0;
            dGeomCapsuleGetParams(other, &radius, &length);
            const Axis along = axis_of(other, 2);
            const Vec3 half =
                frame.direction_to_local(along.x * length / 2, along.y * length / 2, along.z * length / 2);
            const espalier::Capsule capsule = {{middle.x - half.x, middle.y - half.y, middle.z - half.z},
                                               {middle.x + half.x, middle.y + half.y, middle.z + half.z},
                                               float(radius)};
            found = find_contacts(blob, capsule, 0, contacts);
            break;
        }
        default: {
            dVector3 sides;
            dGeomBoxGetLengths(other, sides);
            espalier::OrientedBox box = {middle, {}};
            for (int i = 0; i < 3; ++i) {
                const Axis along = axis_of(other, i);
                const dReal half = sides[i] / 2;
                box.half_axes[i] = frame.direction_to_local(along.x * half, along.y * half, along.z * half);
            }
            found = find_contacts(blob, box, 0, contacts);
        }
    }
    return reduce_contacts(found.in(contacts));
}

int collide(dGeomID mesh, dGeomID other, int flags, dContactGeom* out, int skip) {
    std::array<Contact, 64> contacts;
    const std::size_t kept = contacts_of(mesh, other, contacts);
    const std::size_t count = std::min(kept, std::size_t(flags & 0xFFFF));
    const Frame frame(mesh);
    for (std::size_t i = 0; i < count; ++i) {
        auto& contact = *reinterpret_cast<dContactGeom*>(reinterpret_cast<char*>(out) + std::size_t(skip) * i);
        const Contact& at = contacts[i];
        frame.direction_to_world(at.point, contact.pos);
        for (int k = 0; k < 3; ++k) contact.pos[k] += frame.place[k];
        // The normal of ODE leads into the first geom, which is the mesh.
        frame.direction_to_world({-at.normal.x, -at.normal.y, -at.normal.z}, contact.normal);
        contact.depth = dReal(-at.distance);
        contact.g1 = mesh;
        contact.g2 = other;
        contact.side1 = int(at.triangle.index);
        contact.side2 = -1;
    }
    return int(count);
}

dColliderFn* collider_of(int other) {
    return other == dSphereClass || other == dCapsuleClass || other == dBoxClass ? &collide : nullptr;
}

void bounds_of(dGeomID mesh, dReal aabb[6]) {
    const espalier::Box box = blob_of(mesh).bounds();
    const Frame frame(mesh);
    const float low[3] = {box.min.x, box.min.y, box.min.z}, high[3] = {box.max.x, box.max.y, box.max.z};
    for (int row = 0; row < 3; ++row) {
        dReal middle = frame.place[row], reach = 0;
        for (int k = 0; k < 3; ++k) {
            const dReal along = frame.rotation[4 * row + k];
            middle += along * dReal(low[k] + high[k]) / 2;
            reach += std::abs(along) * dReal(high[k] - low[k]) / 2;
        }
        aabb[2 * row] = middle - reach;
        aabb[2 * row + 1] = middle + reach;
    }
}

}  // namespace

dGeomID create_espalier_geom(dSpaceID space, const espalier::Blob& blob) {
    if (geom_class < 0) {
        dGeomClass description = {};
        description.bytes = sizeof(const espalier::Blob*);
        description.collider = &collider_of;
        description.aabb = &bounds_of;
        geom_class = dCreateGeomClass(&description);
    }
    const dGeomID geom = dCreateGeom(geom_class);
    *static_cast<const espalier::Blob**>(dGeomGetClassData(geom)) = &blob;
    if (space != nullptr) dSpaceAdd(space, geom);
    return geom;
}
