#include <cstdarg>

#include <ode/ode.h>

#include "pairs.hpp"

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
class OdePairs {
public:
    explicit OdePairs(const Mesh& mesh) : mesh_(mesh), contacts_(1 << 16) {
        static const Library library;
        data_ = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildSingle(data_, mesh_.positions.data(), sizeof(Vec3),
                                    static_cast<int>(mesh_.positions.size()), mesh_.triangles.data(),
                                    static_cast<int>(3 * mesh_.triangles.size()), sizeof(TriangleVertices));
        for (dGeomID& geometry : geometries_) geometry = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
    }
    ~OdePairs() {
        for (const dGeomID geometry : geometries_) dGeomDestroy(geometry);
        dGeomTriMeshDataDestroy(data_);
    }
    OdePairs(const OdePairs&) = delete;
    OdePairs& operator=(const OdePairs&) = delete;
    std::size_t all(const Transform& pose) {
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

private:
    const Mesh& mesh_;
    std::vector<dContactGeom> contacts_;
    dTriMeshDataID data_ = nullptr;
    dGeomID geometries_[2] = {};
};

}  // namespace

void add_ode_pairs(const Mesh& mesh, PairContests& to) {
    const auto pairs = std::make_shared<OdePairs>(mesh);
    to.all.push_back({"ode", "opcode", one_by_one([pairs](const Transform& pose) { return pairs->all(pose); })});
}

}  // namespace espalier::bench
