#include "../peers/ode.hpp"
#include "pairs.hpp"

namespace espalier::bench {
namespace {

// Two dGeomTriMesh over one OPCODE tree. Its collision of meshes makes contacts of all pairs of triangles that its tree
// finds; there is no plain yes or no, and no distance.
class OdePairs {
public:
    explicit OdePairs(const Mesh& mesh) : contacts_(1 << 16) {
        start_ode();
        data_ = ode_data(mesh);
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
