#include <malloc.h>

#include "ode.hpp"
#include "system.hpp"

namespace espalier::bench {
namespace {

/// Bytes that this process has from malloc and not given back.
std::size_t live_bytes() {
    const struct mallinfo2 heap = mallinfo2();
    return heap.uordblks + heap.hblkhd;
}

// A dGeomTriMesh: an OPCODE tree over float32 vertices, asked by a dRay. ODE does not tell the size of a tree, so bytes
// are what malloc gave it during the build and did not get back, and the caller's vertices and indices, which it reads
// in place. Its contact holds t, normal and index; u and v come from the ray callback.
class OdeSystem final : public System {
public:
    explicit OdeSystem(const Mesh& mesh) : sphere_(bounding_sphere(mesh)) {
        start_ode();
        const std::size_t before = live_bytes();
        const Stopwatch watch;
        data_ = ode_data(mesh);
        geometry_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
        seconds_ = watch.seconds();
        bytes_ = live_bytes() - before + mesh.positions.size() * sizeof(Vec3) +
                 mesh.triangles.size() * sizeof(TriangleVertices);
        ray_ = dCreateRay(nullptr, 1.0);
        dGeomRaySetBackfaceCull(ray_, 0);
        dGeomSetData(ray_, this);
    }
    ~OdeSystem() override {
        dGeomDestroy(ray_);
        dGeomDestroy(geometry_);
        dGeomTriMeshDataDestroy(data_);
    }
    [[nodiscard]] std::size_t bytes() const override { return bytes_; }
    [[nodiscard]] double build_seconds() const override { return seconds_; }
    void closest(const std::vector<Ray>& rays, bool, std::vector<Hit>& hits) override {
        dGeomRaySetFirstContact(ray_, 0);
        dGeomRaySetClosestHit(ray_, 1);
        dGeomTriMeshSetRayCallback(geometry_, keep_weights);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            dContactGeom contact;
            Hit& hit = hits[i];
            hit.found = collide(rays[i], contact);
            if (!hit.found) continue;
            hit.t = static_cast<float>(contact.depth);
            hit.u = u_;
            hit.v = v_;
            // ODE's points to the back of the triangle.
            hit.normal = {-static_cast<float>(contact.normal[0]), -static_cast<float>(contact.normal[1]),
                          -static_cast<float>(contact.normal[2])};
            hit.id = static_cast<std::uint32_t>(contact.side1);
        }
    }
    void any(const std::vector<Ray>& rays, std::vector<std::uint8_t>& answers) override {
        dGeomRaySetClosestHit(ray_, 0);
        dGeomRaySetFirstContact(ray_, 1);
        dGeomTriMeshSetRayCallback(geometry_, nullptr);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            dContactGeom contact;
            answers[i] = collide(rays[i], contact);
        }
    }

private:
    bool collide(const Ray& ray, dContactGeom& contact) {
        dGeomRaySetLength(ray_, static_cast<dReal>(reach(ray, sphere_)));
        dGeomRaySet(ray_, static_cast<dReal>(ray.origin.x), static_cast<dReal>(ray.origin.y),
                    static_cast<dReal>(ray.origin.z), static_cast<dReal>(ray.direction.x),
                    static_cast<dReal>(ray.direction.y), static_cast<dReal>(ray.direction.z));
        return dCollide(geometry_, ray_, 1, &contact, sizeof contact) > 0;
    }
    static int keep_weights(dGeomID, dGeomID ray, int, dReal u, dReal v) {
        auto* self = static_cast<OdeSystem*>(dGeomGetData(ray));
        self->u_ = static_cast<float>(u);
        self->v_ = static_cast<float>(v);
        return 1;
    }
    BoundingSphere sphere_;
    dTriMeshDataID data_ = nullptr;
    dGeomID geometry_ = nullptr;
    dGeomID ray_ = nullptr;
    float u_ = 0.0f, v_ = 0.0f;
    std::size_t bytes_ = 0;
    double seconds_ = 0.0;
};

}  // namespace

std::vector<Maker> ode_makers() {
    return {{"ode", "opcode", dODE_VERSION, [](const Mesh& mesh) { return std::make_unique<OdeSystem>(mesh); }}};
}

}  // namespace espalier::bench
