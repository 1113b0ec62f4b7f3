#include <cstdarg>

#include <ode/ode.h>

#include "pair_system.hpp"

namespace espalier::bench {
namespace {

/// Started with the first mesh, ended with the process.
struct Library {
    Library() {
        dInitODE2(0);
        // It has a line to say for each contact that its table has no place for: not while it is measured.
        dSetMessageHandler([](int, const char*, va_list) {});
    }
    ~Library() { dCloseODE(); }
};

// Two dGeomTriMesh over one OPCODE tree. Its collision of meshes makes contacts of all pairs of triangles that its tree
// finds; there is no plain yes or no, and no distance.
class OdePairs final : public PairSystem {
public:
    explicit OdePairs(const Mesh& mesh) : mesh_(mesh), contacts_(1 << 16) {
        static const Library library;
        data_ = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildSingle(data_, mesh_.positions.data(), sizeof(Vec3),
                                    static_cast<int>(mesh_.positions.size()), mesh_.triangles.data(),
                                    static_cast<int>(3 * mesh_.triangles.size()), sizeof(TriangleVertices));
        for (dGeomID& geometry : geometries_) geometry = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
    }
    ~OdePairs() override {
        for (const dGeomID geometry : geometries_) dGeomDestroy(geometry);
        dGeomTriMeshDataDestroy(data_);
    }
    [[nodiscard]] bool has_yes_no() const override { return false; }
    [[nodiscard]] bool has_distance() const override { return false; }
    bool yes_no(const Transform&) override { return false; }
    std::size_t all(const Transform& pose) override {
        const Matrix matrix = rotation_matrix(pose);
        dMatrix3 rotation = {};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) rotation[4 * i + j] = static_cast<dReal>(matrix.at[i][j]);
        dGeomSetRotation(geometries_[1], rotation);
        dGeomSetPosition(geometries_[1], static_cast<dReal>(pose.translation.x), static_cast<dReal>(pose.translation.y),
                         static_cast<dReal>(pose.translation.z));
        // The flags hold how many contacts there is room for, 16 bits.
        return static_cast<std::size_t>(
            dCollide(geometries_[0], geometries_[1], 0xFFFF, contacts_.data(), sizeof(dContactGeom)));
    }
    double distance(const Transform&) override { return 0.0; }

private:
    const Mesh& mesh_;
    std::vector<dContactGeom> contacts_;
    dTriMeshDataID data_ = nullptr;
    dGeomID geometries_[2] = {};
};

}  // namespace

std::vector<PairMaker> ode_pair_makers() {
    return {{"ode", "opcode", [](const Mesh& mesh) { return std::make_unique<OdePairs>(mesh); }}};
}

}  // namespace espalier::bench
