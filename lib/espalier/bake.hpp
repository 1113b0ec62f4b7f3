// Baking: turns triangle meshes into one blob. This is offline code: it allocates, uses threads and may throw
// std::bad_alloc. scenes/bake.hpp joins blobs in a scene.
//
// Thread safety: no call keeps state; any number of threads may call them at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <espalier/format.hpp>
#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

namespace espalier {

struct Lattice;  // blob.hpp

/// The vertices of a triangle, as indices into MeshView::positions.
using TriangleVertices = std::array<std::uint32_t, 3>;

/// One input mesh. bake only reads the arrays, and keeps no reference to them.
struct MeshView {
    std::span<const Vec3> positions;              ///< in the source's units; any values: bake checks them
    std::span<const TriangleVertices> triangles;  ///< counter-clockwise when seen from the front
    std::span<const std::uint32_t> materials;     ///< one per triangle, 0..65535; or none at all: material 0
    std::uint32_t file = 0;                       ///< the number of the input file, for original ids and messages
    std::uint32_t mesh = 0;                       ///< the number of the mesh in that file
    std::string name;                             ///< for messages: "level.obj, mesh 3 (walls)"; may be empty
    /// In place of `positions`, which are empty then. They are rounded once, to lattice points (BakeOptions::origin).
    std::span<const Vec3d> float64_positions = {};

    /// Returns how many positions there are.
    [[nodiscard]] std::size_t position_count() const { return positions.size() + float64_positions.size(); }
};

/// The fineness of the lattice on which vertices are rounded. Its step is a power of two in the blob's
/// units, which are those of the source.
class Resolution {
public:
    /// What the number is; same_as gives a step.
    enum class Kind : std::uint8_t { bits, tolerance, step };

    /// Returns the smallest step for which the largest extent of the meshes takes at most `count` bits, 1..24.
    [[nodiscard]] static constexpr Resolution bits(unsigned count) noexcept {
        return {Kind::bits, static_cast<double>(count)};
    }
    /// Returns a large step at which source and baked surface differ by at most `length`, above 0, in the blob's
    /// units. At 22 bits or fewer, queries near the asset also move by no more than that.
    [[nodiscard]] static constexpr Resolution tolerance(double length) noexcept { return {Kind::tolerance, length}; }
    /// Returns the step 2^exponent, -100..100. Blobs of one step lie on one lattice: a vertex that two sources share
    /// becomes the same point in both, for example where two pieces of a terrain meet.
    [[nodiscard]] static constexpr Resolution step(int exponent) noexcept {
        return {Kind::step, static_cast<double>(exponent)};
    }
    /// Returns the step of another blob's lattice, Blob::lattice(). A blob without triangles has none worth sharing.
    [[nodiscard]] static Resolution same_as(const Lattice& lattice) noexcept;

    [[nodiscard]] constexpr Kind kind() const noexcept { return kind_; }
    /// Returns the number given: bits, a length or an exponent.
    [[nodiscard]] constexpr double value() const noexcept { return value_; }

private:
    constexpr Resolution(Kind kind, double value) noexcept : kind_(kind), value_(value) {}
    Kind kind_;
    double value_;
};

/// The time that the baker spends on a better tree. docs/baking.md has the figures.
enum class Effort : std::uint8_t {
    fast,    ///< builds the tree once and keeps it
    normal,  ///< also moves subtrees to places where they cost less
    best,    ///< moves more and smaller subtrees, more often: about three times the time of normal
};

/// The algorithm that builds the binary tree, before subtrees are moved and nodes are made wide. All keep the format's
/// depth.
enum class Builder : std::uint8_t {
    binned_sah,      ///< surface area heuristic over planes between bins (Wald 2007)
    sweep_sah,       ///< surface area heuristic over every split along every axis (MacDonald, Booth 1990)
    spatial_splits,  ///< as binned_sah, but large triangles may be in several leaves, clipped (Stich et al. 2009)
    agglomerative,   ///< pairs of near clusters, bottom up (Gu, He, Fatahalian, Blelloch 2013)
    linear,          ///< along a space-filling curve (Lauterbach et al. 2009): fastest to build, most visits
    insertion,       ///< one triangle after the other, with rotations (Goldsmith, Salmon 1987)
};

/// Options for studies of the tree. The defaults suit most meshes.
struct BuildOptions {
    Builder builder = Builder::binned_sah;  ///< spatial_splits needs Profile::fast
    /// With Builder::spatial_splits: at most this share of the triangles is stored again in further leaves, 0..1.
    double duplicate_budget = 0.3;
    /// The price of one byte per triangle, in visits of a node by an average ray, 0..1000000. A higher price gives
    /// smaller blobs and more visits. Profile::small multiplies it by four, Profile::tiny by six.
    float byte_price = 5.0f;
    /// 1..format::max_leaf_triangles; each profile has a limit of its own as well. Smaller leaves test fewer triangles
    /// per ray and take more bytes.
    unsigned max_leaf_triangles = format::max_leaf_triangles;
};

/// The bounds of the whole asset that a blob stores in addition to its axis-aligned box (bounds.hpp).
struct StoredBounds {
    bool oriented_box = false;  ///< 32 bytes
    bool sphere = false;        ///< 16 bytes
    bool k_dop = false;         ///< 80 bytes
};

/// How the vertices of a deformable blob may move (deformation.hpp).
struct Deformation {
    /// The box in which all positions of all poses lie, in the blob's units. Grows to hold the meshes and `poses`.
    /// None: the box around these, wider by a tenth of its largest side on each side.
    std::optional<Box> range = std::nullopt;
    /// Poses that the tree suits: each has the positions of all meshes in a row, as many as the meshes have. The baked
    /// tree is the one with the least sum of costs over the meshes' own positions and these, of one built for each and
    /// one built for all at once.
    std::vector<std::vector<Vec3>> poses = {};
};

/// What a bake may lose before it is refused.
struct BakePolicy {
    /// The largest share of the triangles that may be lost, in percent: broken ones, those without area and those that
    /// the lattice flattened. A duplicate is in the blob once, and a triangle with two corners in one place had no
    /// surface to lose.
    double max_dropped = 10.0;
    bool allow_empty = false;  ///< accepts that no triangle is left
    bool strict = false;       ///< refuses what else is a warning
};

/// The options of bake().
struct BakeOptions {
    Resolution resolution = Resolution::bits(16);  ///< how finely vertices are rounded
    Profile profile = Profile::balanced;           ///< how nodes and leaves are stored
    Effort effort = Effort::normal;                ///< how long to search for a better tree
    /// Stores the source of each triangle in the blob, for original_triangle and original_hit. BakeResult::remap has
    /// the same without costing bytes of the blob.
    bool original_ids = false;
    /// Drops triangles that have a corner that is NaN or infinite, or an index out of range. Without it, such a
    /// triangle refuses the bake.
    bool drop_bad_triangles = false;
    /// Refuses a bake that loses more, as the command does, with BakeStatus::invalid_mesh. None: only the report has
    /// it.
    std::optional<BakePolicy> policy = std::nullopt;
    /// Stores how the surface bends at every edge (contact.hpp), in 6 bits per triangle. The number is the largest
    /// angle between two triangles that counts as flat, in degrees: from 0 to less than 90.
    std::optional<double> flat_angle = std::nullopt;
    StoredBounds bounds = {};  ///< which further bounds to store
    /// Bakes a deformable blob. All triangles are kept, flat ones too, but for repetitions of one over the same three
    /// vertices. Needs Profile::fast; excludes Builder::spatial_splits, drop_bad_triangles, flat_angle and bounds. All
    /// positions must be finite, and there must be a triangle.
    std::optional<Deformation> deformation = std::nullopt;
    /// Is subtracted from each position: the blob's coordinates count from there, so that float32 holds them. The blob
    /// keeps it (Blob::source_origin), unless it is 0. None: chosen where float32 rounds places at the meshes by more
    /// than a quarter of a step, whether their own positions need that or not: near their middle and a multiple of any
    /// step. Else 0. All poses and the range of a deformable blob count from it, so that none is chosen there.
    std::optional<Vec3d> origin = Vec3d{};
    unsigned threads = 1;  ///< 0: as many as the machine has. The bytes do not depend on it
    /// Called now and then, from the thread that called bake, with the name of the stage and how much of the whole is
    /// done, 0..1. May be empty. An exception that it throws ends the bake.
    std::function<void(const char* stage, double done)> progress = nullptr;
    BuildOptions build = {};  ///< for studies
};

/// A mesh of the input, or a triangle of it.
struct SourcePlace {
    std::uint32_t file = 0;                                ///< MeshView::file
    std::uint32_t mesh = 0;                                ///< MeshView::mesh
    std::optional<std::uint32_t> triangle = std::nullopt;  ///< its number in the mesh; none if it is about the mesh
};

/// The triangles that were dropped for one reason.
struct Finding {
    std::uint64_t count = 0;
    std::string first;                                ///< "level.obj, mesh 3 (walls), triangle 17"; empty if count is 0
    std::optional<SourcePlace> place = std::nullopt;  ///< of the first
};

/// The dropped triangles, by reason. None of the kept triangles is among them.
struct Findings {
    Finding not_finite;               ///< a corner is NaN, infinite or beyond float32; only with drop_bad_triangles
    Finding index_out_of_range;       ///< only with drop_bad_triangles
    Finding zero_area;                ///< no area in the source
    std::uint64_t equal_corners = 0;  ///< of those: with two corners in one place
    Finding collapsed;                ///< no area left on the lattice
    Finding duplicate;                ///< the same three lattice points in the same winding as a kept triangle
};

/// The volumes of the bounds of the whole asset, in the blob's cubic units; 0 for bounds that the options do not
/// store.
struct BoundsVolumes {
    double box = 0.0;  ///< axis-aligned; 0 if no further bounds are stored
    double oriented_box = 0.0;
    double sphere = 0.0;
    double k_dop = 0.0;
};

/// A property of the input or the blob that bake accepted, but that its caller may not expect.
struct BakeWarning {
    enum class Kind : std::uint8_t {
        /// The step is finer than the spacing of float32 around the farthest coordinate: bits are wasted, and float64
        /// positions lose what they have beyond float32 unless there is an origin.
        step_below_float_spacing,
        /// The source is closed and has a triangle with an area, but the baked surface is not closed. The source is
        /// closed if each of its edges, from position to position, runs as often one way as the other. Two things
        /// open it: dropping triangles that have an area on the lattice (duplicates, and triangles that had no area in
        /// the source), and the collapse of all triangles.
        lost_closed,
        /// At 23 and 24 bits, rays from outside are rounded to whole lattice steps, which is coarser than float32.
        rays_rounded_coarsely,
    };
    Kind kind = Kind::step_below_float_spacing;
    std::string message;  ///< whole sentences: what was found, and what to do
};

/// The figures of a bake: what it read, dropped and wrote. Lengths are in the blob's units.
struct BakeReport {
    struct Source {
        std::uint64_t triangles = 0;  ///< of all meshes, dropped ones included
        std::uint64_t vertices = 0;   ///< of all meshes, unused ones included
    };
    struct Bounds {
        Vec3 min;  ///< from the origin, as all coordinates of the blob
        Vec3 max;
        double extent = 0.0;  ///< the largest side
        BoundsVolumes volumes;
    };
    struct Lattice {
        unsigned bits = 0;       ///< what the largest extent takes, 1..24
        double step = 0.0;       ///< the distance between neighbouring lattice points
        double max_error = 0.0;  ///< bounds the distance between the source, as it was given, and the baked surface
    };
    /// What a deformable blob has; zero for others.
    struct Motion {
        Box range;                       ///< in which positions must lie
        std::uint32_t positions = 0;     ///< that refit() takes
        std::uint64_t moving_bytes = 0;  ///< that create_deformable() takes; the rest may stay in flash
    };
    struct Tree {
        std::uint32_t triangles = 0;             ///< kept
        std::uint32_t duplicate_references = 0;  ///< kept triangles stored once more, by Builder::spatial_splits
        std::uint32_t vertices = 0;              ///< distinct lattice points of the kept triangles
        std::uint32_t nodes = 0;
        std::uint64_t leaves = 0;
        unsigned depth = 0;  ///< nodes on the longest way down
    };

    Source source;
    Findings findings;
    Vec3d origin;  ///< that was subtracted from all positions
    Bounds bounds;
    Lattice lattice;
    Motion motion;
    Tree tree;
    bool closed = false;  ///< the baked surface is closed: contains and signed_distance answer
    /// The fewest bits, above those of the lattice, with which the same source stays closed; 0 if there are none, and
    /// without the warning lost_closed. Found by trying each.
    unsigned bits_that_keep_closed = 0;
    std::uint64_t bytes = 0;  ///< of the blob
    double seconds = 0.0;     ///< that the bake took
    std::vector<BakeWarning> warnings;

    /// Returns whether `warnings` has one of this kind.
    [[nodiscard]] bool warns_of(BakeWarning::Kind kind) const noexcept;
};

/// The result of a bake: ok, or why nothing was baked.
enum class BakeStatus : std::uint8_t {
    ok,
    invalid_options,  ///< an option is out of its range, or two exclude each other
    invalid_mesh,     ///< broken geometry: a corner that is not finite, an index out of range
    too_fine,         ///< the resolution would need more than 24 bits
    too_large,        ///< a limit of the format
    internal,         ///< the baker's check of its own result failed: an error in the baker
};

/// The blob, or the reason why there is none. Converts to true if there is a blob.
struct [[nodiscard]] BakeResult {
    std::vector<std::byte> bytes;  ///< the blob; empty unless status is ok
    /// The source of each triangle of the blob, by its index: what original_hit (original.hpp) takes. Empty unless
    /// status is ok.
    std::vector<OriginalTriangle> remap;
    BakeReport report;  ///< all zero unless status is ok
    BakeStatus status = BakeStatus::internal;
    std::string message;  ///< what is wrong, where, and what to do; empty if status is ok
    std::optional<SourcePlace> place =
        std::nullopt;  ///< the first place with this fault; none for a fault of the whole

    explicit operator bool() const noexcept { return status == BakeStatus::ok; }
};

/// Bakes all meshes into one blob. Nothing in the meshes is trusted: what a blob cannot hold is dropped and reported,
/// or refused with the place. No meshes, or meshes without triangles, give a valid, empty blob.
///
/// Takes about 1 microsecond and 150 bytes of memory per triangle.
BakeResult bake(std::span<const MeshView> meshes, const BakeOptions& options = {});

/// Returns BakeResult::remap as the bytes of a file, 16 per triangle after a header, which read_remap (original.hpp)
/// reads. Empty unless the result's status is ok.
[[nodiscard]] std::vector<std::byte> remap_file(const BakeResult& result);

/// A blob that join_borders() changes, and how far that moves what it counts from its source_origin(). Of pieces where
/// their sources are: its source_origin() less that of the first blob, not the translation that bake_scene() takes.
struct JoinedBlob {
    std::span<std::byte> bytes;
    Vec3 translation = {};
};

/// The outcome of join_borders(). Converts to true if the borders are joined.
struct [[nodiscard]] JoinReport {
    BakeStatus status = BakeStatus::internal;
    std::string message;      ///< what is wrong, where, and what to do; empty if status is ok
    std::uint64_t edges = 0;  ///< that two triangles share now

    explicit operator bool() const noexcept { return status == BakeStatus::ok; }
};

/// Gives the edges on the borders of blobs the kind that the surface has where it goes on in another one: the pieces
/// of a ground, on which contacts (contact.hpp) then do not lean over the seams. Changes edge flags and the checksum.
///
/// The blobs have edge flags of one flat_angle, and one lattice: the same step, and places that differ by whole steps.
/// An edge is joined where exactly two triangles of all blobs run along it in opposite directions, and neither blob has
/// another triangle there; all other edges of one triangle become boundaries. A further call with more blobs gives the
/// same as a single one. What is refused, with invalid_mesh, changes no blob. A blob given twice, at two places, has
/// the kinds of its last one: give each place bytes of its own.
///
/// Takes about 200 bytes of memory per triangle.
JoinReport join_borders(std::span<const JoinedBlob> blobs);

/// The outcome of verify(), and of verify_scene() in scenes/bake.hpp. Converts to true if the bytes are sound.
struct [[nodiscard]] VerifyReport {
    bool sound = false;
    std::string message;  ///< the first thing that is wrong, and where; empty if sound

    explicit operator bool() const noexcept { return sound; }
};

/// Tests whether a blob is what its header states. Any bytes, any alignment.
///
/// A sound blob opens. Every box contains all vertices below it and ends near the asset. No triangle is without area,
/// and no two are the same. The vertices of each leaf are numbered by first use. Extent, vertex count, the closed flag,
/// duplicate references, edge flags and stored bounds are true; an edge of one triangle may be joined to another blob.
/// If a triangle is in several leaves, each of its corners lies in the boxes of one of them.
///
/// A deformable blob may have triangles without area and equal ones. Its boxes and the sizes of its leaves are the
/// least, as refit() makes them, and its vertices are those of its positions.
///
/// Takes about 60 bytes of memory per triangle.
VerifyReport verify(std::span<const std::byte> bytes);

}  // namespace espalier

// Numerics. The same arrays and options give the same bytes on every machine and for every number of threads. max_error
// counts from the positions as they were given; of a deformable blob from the float32 positions that refit() takes.
