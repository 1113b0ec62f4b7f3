// What a run measures.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

struct DeformationOptions {
    std::size_t cloth = 100;         ///< squares along a side; 0: no cloth
    std::size_t times = 4;           ///< poses of each motion
    std::size_t rounds = 3;          ///< the median counts
    std::size_t rays = 100'000;      ///< into each pose
    unsigned bits = 16;              ///< of the lattice over the range of motion
    std::vector<std::string> parts;  ///< what to measure; all if it is empty
    std::vector<std::string> only;   ///< systems that refit; all if it is empty
};

// Motions of a mesh: positions as a function of time, 0 at rest and 1 at their end.

enum class Motion {
    bend,      ///< into an arc of 90 degrees
    twist,     ///< one end against the other, by 90 degrees
    wave,      ///< across the two longer axes, with two crests
    fold,      ///< one half onto the other
    collapse,  ///< to a plane; a mesh that is flat already, to a line
    noise,     ///< each position on a line of its own, by up to 2 % of the longest side along each axis
    turn,      ///< rigid: by 60 degrees about the diagonal of the axes
};
/// Those that deform. A turn is measured beside them where rigid motion is compared.
inline constexpr std::array deforming = {Motion::bend, Motion::twist,    Motion::wave,
                                         Motion::fold, Motion::collapse, Motion::noise};
const char* name_of(Motion motion);

/// The axes of a mesh, in the order of the sides of its box: the longest first.
class MovingMesh {
public:
    explicit MovingMesh(Mesh mesh);

    [[nodiscard]] const Mesh& rest() const { return mesh_; }
    [[nodiscard]] std::vector<Vec3> positions(Motion motion, double time) const;
    /// Returns the mesh in a pose.
    [[nodiscard]] Mesh posed(Motion motion, double time) const;
    /// Returns the transform from rest to Motion::turn.
    [[nodiscard]] Transform turned(double time) const;

private:
    /// A position along the axes, from the middle of the box.
    using Along = std::array<double, 3>;
    [[nodiscard]] Along moved(Motion motion, double time, const Along& along, std::size_t index) const;
    [[nodiscard]] Along noise_of(std::size_t index) const;

    Mesh mesh_;
    std::array<std::size_t, 3> axes_{};
    Along middle_{}, side_{};  ///< in the order of axes_
};

/// A mesh at one time of a motion.
struct TimedPose {
    Motion motion;
    double time;
    std::vector<Vec3> positions;
};

/// Returns the poses of all motions that deform, at `times` times each, in an order in which motions alternate.
std::vector<TimedPose> poses_of(const MovingMesh& mesh, std::size_t times);
/// Returns the box around the mesh in all poses, and in a turn at its end.
Box range_of(const MovingMesh& mesh, std::span<const TimedPose> poses);

/// Returns a flat square of side * side squares, two triangles each.
Mesh make_cloth(std::size_t side);

// The interface of a system whose tree over a mesh is renewed when the mesh moves.

/// What a refit of Espalier renews, and the memory that it needs.
struct RefitWork {
    std::size_t nodes = 0;
    std::size_t leaves = 0;
    std::size_t leaf_vertices = 0;  ///< of all leaves together
    std::size_t moving_bytes = 0;   ///< in RAM
    std::size_t source_bytes = 0;   ///< of the rest, which may stay in flash: where each leaf vertex comes from
    std::size_t still_bytes = 0;    ///< the rest
    double step = 0.0;              ///< of the lattice
};

/// A tree, and a copy of the mesh that belongs to the system.
class RefitSystem {
public:
    explicit RefitSystem(const Mesh& mesh) : mesh_(mesh) {}
    RefitSystem(const RefitSystem&) = delete;
    RefitSystem& operator=(const RefitSystem&) = delete;
    virtual ~RefitSystem() = default;
    /// Copies positions to where refit() reads them. No part of a measurement.
    virtual void set_positions(const std::vector<Vec3>& positions) {
        std::copy(positions.begin(), positions.end(), mesh_.positions.begin());
    }
    virtual void refit() = 0;
    /// Tests whether the outermost box contains a point, up to `rounding`.
    [[nodiscard]] virtual bool contains(const Vec3& point, float rounding) const = 0;
    /// Returns the bytes of the tree and of everything else that its queries read.
    [[nodiscard]] virtual std::size_t bytes() const = 0;
    [[nodiscard]] virtual std::optional<RefitWork> work() const { return std::nullopt; }

protected:
    Mesh mesh_;
};

struct RefitMaker {
    std::string system, profile, version;
    /// The mesh is at rest and outlives the system. All poses lie in `range`.
    std::function<std::unique_ptr<RefitSystem>(const Mesh& mesh, const Box& range)> make;
    /// Whether the outermost box may lack positions of a pose with flat triangles; such poses are then counted.
    bool may_lose_flat_poses = false;

    [[nodiscard]] std::string name() const { return system + ' ' + profile; }
};
using RefitMakers = std::vector<RefitMaker>;

inline bool is_within(const Vec3& point, const Box& box, float rounding) {
    return point.x >= box.min.x - rounding && point.x <= box.max.x + rounding && point.y >= box.min.y - rounding &&
           point.y <= box.max.y + rounding && point.z >= box.min.z - rounding && point.z <= box.max.z + rounding;
}

// Each in a file of its own, which is compiled where the system is installed.
RefitMakers espalier_refit_makers(unsigned bits);
RefitMakers textbook_refit_makers();
RefitMakers embree_refit_makers();
RefitMakers bullet_refit_makers();
RefitMakers fcl_refit_makers();

// A deformable mesh that owns its bytes: blob and moving part.

/// How to bake a deformable mesh.
struct DeformableOptions {
    Box range;
    unsigned bits = 16;
    std::vector<std::vector<Vec3>> poses = {};
    unsigned max_leaf_triangles = format::max_leaf_triangles;
    Effort effort = Effort::normal;
};

class DeformableMesh {
public:
    /// Throws std::runtime_error with the reason of the baker.
    DeformableMesh(const Mesh& mesh, const DeformableOptions& options);
    DeformableMesh(const DeformableMesh&) = delete;
    DeformableMesh& operator=(const DeformableMesh&) = delete;

    /// Throws std::runtime_error if refit() refuses the positions. Returns the quality.
    float move(std::span<const Vec3> positions);
    /// Returns what move() calls.
    [[nodiscard]] RefitResult refit(std::span<const Vec3> positions) { return espalier::refit(deformable_, positions); }
    [[nodiscard]] const Blob& blob() const { return deformable_.blob(); }
    [[nodiscard]] const RefitWork& work() const { return work_; }
    [[nodiscard]] double bake_seconds() const { return bake_seconds_; }

private:
    std::vector<std::byte> bytes_, memory_;
    Deformable deformable_;
    RefitWork work_;
    double bake_seconds_ = 0.0;
};

// A mesh that is measured: its motions, their poses, and the fields that all rows about it have.

class MotionSubject {
public:
    /// Brings the mesh to a common size.
    MotionSubject(Mesh mesh, const DeformationOptions& options);

    [[nodiscard]] const MovingMesh& moving() const { return moving_; }
    [[nodiscard]] const Mesh& rest() const { return moving_.rest(); }
    [[nodiscard]] const std::vector<TimedPose>& poses() const { return poses_; }
    [[nodiscard]] const Box& range() const { return range_; }
    [[nodiscard]] double triangles() const { return static_cast<double>(rest().triangles.size()); }
    [[nodiscard]] const DeformationOptions& options() const { return options_; }
    /// Returns a row with the fields that all have.
    [[nodiscard]] JsonObject row(const std::string& measures) const;

private:
    const DeformationOptions& options_;
    MovingMesh moving_;
    std::vector<TimedPose> poses_;
    Box range_;
};

/// Prints the time of a refit of each system, in the poses of all motions. Throws std::runtime_error if a system's
/// outermost box does not contain its pose.
void measure_refits(const MotionSubject& subject);
}  // namespace espalier::bench
