// Baking: converts triangle meshes to a blob. This is offline code: it allocates, uses threads and may throw
// std::bad_alloc. scenes/bake.hpp joins blobs into a scene.
//
// Calls keep no state, so any number of threads may bake at once.
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

struct Lattice;  // defined in blob.hpp

/// The vertices of a triangle, as indices into MeshView::positions.
using TriangleVertices = std::array<std::uint32_t, 3>;

/// One input mesh. The baker only reads the arrays and keeps no reference to them.
struct MeshView {
    std::span<const Vec3> positions;              ///< in the source's units; any values, since the baker checks them
    std::span<const TriangleVertices> triangles;  ///< counter-clockwise as seen from the front
    std::span<const std::uint32_t> materials;  ///< one per triangle, 0..65535; if empty, all triangles have material 0
    std::uint32_t file = 0;                    ///< number of the input file, for original ids and messages
    std::uint32_t mesh = 0;                    ///< number of the mesh in that file
    std::string name;                          ///< for messages, such as "level.obj, mesh 3 (walls)"; may be empty
    /// Replaces `positions`, which must then be empty. Positions are rounded once, to lattice points (see
    /// BakeOptions::origin).
    std::span<const Vec3d> float64_positions = {};

    /// Returns the number of positions.
    [[nodiscard]] std::size_t position_count() const { return positions.size() + float64_positions.size(); }
};

/// How finely vertices are rounded to the lattice. The step of the lattice is a power of two in the units of the blob,
/// which are those of the source.
class Resolution {
public:
    /// The meaning of value(); same_as() gives a step.
    enum class Kind : std::uint8_t { bits, tolerance, step };

    /// Returns the smallest step for which the largest extent of the meshes takes at most `count` bits, 1..24.
    [[nodiscard]] static constexpr Resolution bits(unsigned count) noexcept {
        return {Kind::bits, static_cast<double>(count)};
    }
    /// Returns a large step at which source and baked surface differ by at most `length`, above 0, in the blob's units.
    /// At 22 bits or fewer, rounding moves queries near the asset by no more than that either.
    [[nodiscard]] static constexpr Resolution tolerance(double length) noexcept { return {Kind::tolerance, length}; }
    /// Returns the step 2^exponent, -100..100. Blobs of the same step lie on one lattice: a vertex that two sources
    /// share, for example where two pieces of a terrain meet, becomes the same point in both.
    [[nodiscard]] static constexpr Resolution step(int exponent) noexcept {
        return {Kind::step, static_cast<double>(exponent)};
    }
    /// Returns the step of another blob's lattice, Blob::lattice(). That of a blob without triangles is not worth
    /// sharing.
    [[nodiscard]] static Resolution same_as(const Lattice& lattice) noexcept;

    [[nodiscard]] constexpr Kind kind() const noexcept { return kind_; }
    /// Returns the number that was given: bits, a length or an exponent.
    [[nodiscard]] constexpr double value() const noexcept { return value_; }

private:
    constexpr Resolution(Kind kind, double value) noexcept : kind_(kind), value_(value) {}
    Kind kind_;
    double value_;
};

/// How much time the baker spends on a better tree. docs/baking.md has figures.
enum class Effort : std::uint8_t {
    fast,    ///< builds the tree once
    normal,  ///< also moves subtrees to where they cost less
    best,    ///< moves more and smaller subtrees, more often: about three times as long as normal
};

/// The algorithm that builds the binary tree, before subtrees are moved and nodes are widened. All of them respect the
/// depth limit of the format.
enum class Builder : std::uint8_t {
    binned_sah,      ///< surface area heuristic over planes between bins (Wald 2007)
    sweep_sah,       ///< surface area heuristic over every split along every axis (MacDonald and Booth 1990)
    spatial_splits,  ///< like binned_sah, but clips large triangles, which may be in several leaves (Stich et al. 2009)
    agglomerative,   ///< pairs of near clusters, bottom up (Gu, He, Fatahalian and Blelloch 2013)
    linear,     ///< along a space-filling curve (Lauterbach et al. 2009): the fastest to build, with the most visits
    insertion,  ///< one triangle after the other, with rotations (Goldsmith and Salmon 1987)
};

/// Options for studies of the tree. The defaults suit most meshes.
struct BuildOptions {
    Builder builder = Builder::binned_sah;  ///< spatial_splits needs Profile::fast
    /// The largest share of the triangles that Builder::spatial_splits may store again in further leaves, 0..1.
    double duplicate_budget = 0.3;
    /// The price of a byte per triangle, in node visits by an average ray, 0..1000000. A higher price yields smaller
    /// blobs and more visits. Profile::small multiplies it by four, Profile::tiny by six.
    float byte_price = 5.0f;
    /// 1..format::max_leaf_triangles, within the limit of each profile. Smaller leaves test fewer triangles per ray and
    /// take more bytes.
    unsigned max_leaf_triangles = format::max_leaf_triangles;
};

/// Which bounds of the whole asset a blob stores in addition to its axis-aligned box (bounds.hpp).
struct StoredBounds {
    bool oriented_box = false;  ///< 32 bytes
    bool sphere = false;        ///< 16 bytes
    bool k_dop = false;         ///< 80 bytes
};

/// How the vertices of a deformable blob may move (deformation.hpp).
struct Deformation {
    /// The box that contains all positions of all poses, in the blob's units. It is enlarged to contain the meshes and
    /// `poses`. If not set, it is the box around these, enlarged on each side by a tenth of its largest side.
    std::optional<Box> range = std::nullopt;
    /// Poses for which to optimise the tree. Each has the positions of all meshes one after the other, as many as the
    /// meshes have. The baker builds one tree for each pose and one for all at once, and keeps the tree with the
    /// smallest sum of costs over the meshes' own positions and these poses.
    std::vector<std::vector<Vec3>> poses = {};
};

/// What a bake may lose before it is refused.
struct BakePolicy {
    /// The largest percentage of the triangles that may be lost because they are broken, have no area, or were
    /// flattened by the lattice. Duplicates do not count, since the blob contains them once, nor do triangles with two
    /// corners in one place, which had no surface to lose.
    double max_dropped = 10.0;
    bool allow_empty = false;  ///< accepts a bake that leaves no triangle
    bool strict = false;       ///< refuses the bake where there would only be a warning
};

/// The options of bake().
struct BakeOptions {
    Resolution resolution = Resolution::bits(16);  ///< how finely vertices are rounded
    Profile profile = Profile::balanced;           ///< how nodes and leaves are encoded
    Effort effort = Effort::normal;                ///< how long to search for a better tree
    /// Stores the source of each triangle in the blob, for original_triangle() and original_hit(). BakeResult::remap
    /// has the same data without taking bytes of the blob.
    bool original_ids = false;
    /// Drops triangles with a corner that is NaN or infinite or with an index out of range. Without this option, such a
    /// triangle refuses the bake.
    bool drop_bad_triangles = false;
    /// Refuses a bake that loses more than this, with BakeStatus::invalid_mesh, as the command-line tool does. If not
    /// set, losses only appear in the report.
    std::optional<BakePolicy> policy = std::nullopt;
    /// Stores how the surface bends at every edge (contact.hpp), in 6 bits per triangle. The value is the largest angle
    /// between two triangles that counts as flat, in degrees, from 0 to less than 90.
    std::optional<double> flat_angle = std::nullopt;
    StoredBounds bounds = {};  ///< which further bounds to store
    /// Bakes a deformable blob. All triangles are kept, even flat ones, except for repetitions of a triangle over the
    /// same three vertices. Requires Profile::fast, finite positions and at least one triangle. Excludes
    /// Builder::spatial_splits, drop_bad_triangles, flat_angle and bounds.
    std::optional<Deformation> deformation = std::nullopt;
    /// An origin that is subtracted from every position, so that float32 can hold the blob's coordinates, which count
    /// from there. The blob stores it (Blob::source_origin()) unless it is 0.
    ///
    /// If not set, the baker chooses an origin near the middle of the meshes that is a multiple of any step, provided
    /// that float32 rounds positions there by more than a quarter of a step, whether or not the meshes' own positions
    /// need float64; otherwise it is 0. All poses and the range of a deformable blob count from the origin, so none is
    /// chosen for such a blob.
    std::optional<Vec3d> origin = Vec3d{};
    unsigned threads = 1;  ///< 0: as many as the machine has. The bytes do not depend on it
    /// Called from time to time, by the thread that called bake(), with the name of the stage and the completed
    /// fraction of the whole, 0..1. May be empty. An exception thrown by it ends the bake.
    std::function<void(const char* stage, double done)> progress = nullptr;
    BuildOptions build = {};  ///< for studies
};

/// A mesh of the input, or a triangle of it.
struct SourcePlace {
    std::uint32_t file = 0;                                ///< MeshView::file
    std::uint32_t mesh = 0;                                ///< MeshView::mesh
    std::optional<std::uint32_t> triangle = std::nullopt;  ///< its index in the mesh; not set if it is about the mesh
};

/// The triangles that were dropped for one reason.
struct Finding {
    std::uint64_t count = 0;
    std::string first;  ///< such as "level.obj, mesh 3 (walls), triangle 17"; empty if count is 0
    std::optional<SourcePlace> place = std::nullopt;  ///< where the first one is
};

/// The dropped triangles, by reason. Kept triangles are not among them.
struct Findings {
    Finding not_finite;               ///< a corner is NaN, infinite or beyond float32; only with drop_bad_triangles
    Finding index_out_of_range;       ///< only with drop_bad_triangles
    Finding zero_area;                ///< no area in the source
    std::uint64_t equal_corners = 0;  ///< of these, those with two corners in one place
    Finding collapsed;                ///< no area left after rounding to the lattice
    Finding duplicate;                ///< the same three lattice points in the same winding as a kept triangle
};

/// The volumes of the bounds of the whole asset, in the blob's cubic units. Those of bounds that are not stored are 0.
struct BoundsVolumes {
    double box = 0.0;  ///< axis-aligned; 0 if no further bounds are stored
    double oriented_box = 0.0;
    double sphere = 0.0;
    double k_dop = 0.0;
};

/// A property of the input or the blob that the baker accepted but that may be unexpected.
struct BakeWarning {
    enum class Kind : std::uint8_t {
        /// The step is finer than the spacing of float32 around the farthest coordinate. Bits are wasted, and float64
        /// positions lose what exceeds float32 unless there is an origin.
        step_below_float_spacing,
        /// The source is closed and has a triangle with an area, but the baked surface is not closed. A source is
        /// closed if each of its edges, from position to position, runs as often one way as the other. Two things open
        /// it: dropping triangles that have an area on the lattice (duplicates, and triangles without area in the
        /// source), and the collapse of all triangles.
        lost_closed,
        /// At 23 and 24 bits, rays from outside are rounded to whole lattice steps, which is coarser than float32.
        rays_rounded_coarsely,
    };
    Kind kind = Kind::step_below_float_spacing;
    std::string message;  ///< whole sentences that say what was found and what to do
};

/// The figures of a bake: what was read, dropped and written. Lengths are in the blob's units.
struct BakeReport {
    struct Source {
        std::uint64_t triangles = 0;  ///< of all meshes, including dropped ones
        std::uint64_t vertices = 0;   ///< of all meshes, including unused ones
    };
    struct Bounds {
        Vec3 min;  ///< relative to the origin, like all coordinates of the blob
        Vec3 max;
        double extent = 0.0;  ///< the largest side
        BoundsVolumes volumes;
    };
    struct Lattice {
        unsigned bits = 0;       ///< bits that the largest extent takes, 1..24
        double step = 0.0;       ///< the distance between neighbouring lattice points
        double max_error = 0.0;  ///< upper bound on the distance between the source, as given, and the baked surface
    };
    /// Figures of a deformable blob; zero for other blobs.
    struct Motion {
        Box range;                       ///< the box in which positions must lie
        std::uint32_t positions = 0;     ///< how many refit() takes
        std::uint64_t moving_bytes = 0;  ///< bytes that create_deformable() takes; the rest may stay in flash
    };
    struct Tree {
        std::uint32_t triangles = 0;             ///< triangles kept
        std::uint32_t duplicate_references = 0;  ///< kept triangles that Builder::spatial_splits stored once more
        std::uint32_t vertices = 0;              ///< distinct lattice points of the kept triangles
        std::uint32_t nodes = 0;
        std::uint64_t leaves = 0;
        unsigned depth = 0;  ///< nodes on the longest path from the root
    };

    Source source;
    Findings findings;
    Vec3d origin;  ///< subtracted from all positions
    Bounds bounds;
    Lattice lattice;
    Motion motion;
    Tree tree;
    bool closed = false;  ///< the baked surface is closed, so contains() and signed_distance() answer
    /// The fewest bits, above those of the lattice, at which the same source stays closed, found by trying each. 0 if
    /// there are none, or without the warning lost_closed.
    unsigned bits_that_keep_closed = 0;
    std::uint64_t bytes = 0;  ///< size of the blob
    double seconds = 0.0;     ///< time that the bake took
    std::vector<BakeWarning> warnings;

    /// Returns whether there is a warning of this kind.
    [[nodiscard]] bool warns_of(BakeWarning::Kind kind) const noexcept;
};

/// The outcome of a bake: ok, or why nothing was baked.
enum class BakeStatus : std::uint8_t {
    ok,
    invalid_options,  ///< an option is out of range, or two options exclude each other
    invalid_mesh,     ///< broken geometry: a corner that is not finite or an index out of range
    too_fine,         ///< the resolution would need more than 24 bits
    too_large,        ///< exceeds a limit of the format
    internal,         ///< the baker's check of its own result failed, which is a bug in the baker
};

/// The blob, or the reason why there is none. Converts to true if there is a blob.
struct [[nodiscard]] BakeResult {
    std::vector<std::byte> bytes;  ///< the blob; empty unless status is ok
    /// The source of each triangle, by the index of the triangle in the blob, as original_hit() (original.hpp) takes
    /// it. Empty unless status is ok.
    std::vector<OriginalTriangle> remap;
    BakeReport report;  ///< all zero unless status is ok
    BakeStatus status = BakeStatus::internal;
    std::string message;  ///< what is wrong, where, and what to do; empty if status is ok
    std::optional<SourcePlace> place =
        std::nullopt;  ///< the first place with this fault; not set if it concerns the whole

    explicit operator bool() const noexcept { return status == BakeStatus::ok; }
};

/// Bakes all meshes into one blob. Nothing in the meshes is trusted: what a blob cannot hold is either dropped and
/// reported, or refused with its place. No meshes, or meshes without triangles, yield a valid, empty blob.
///
/// Takes about 1 microsecond and 150 bytes of memory per triangle.
BakeResult bake(std::span<const MeshView> meshes, const BakeOptions& options = {});

/// Returns BakeResult::remap as the bytes of a file that read_remap() (original.hpp) reads: a header, then 16 bytes per
/// triangle. Empty unless the result's status is ok.
[[nodiscard]] std::vector<std::byte> remap_file(const BakeResult& result);

/// A blob for join_borders() to change, and the translation of its coordinates. If the pieces lie where their sources
/// do, the translation is the blob's source_origin() minus that of the first blob, not the translation that
/// bake_scene() takes.
struct JoinedBlob {
    std::span<std::byte> bytes;
    Vec3 translation = {};
};

/// The outcome of join_borders(). Converts to true if the borders were joined.
struct [[nodiscard]] JoinReport {
    BakeStatus status = BakeStatus::internal;
    std::string message;      ///< what is wrong, where, and what to do; empty if status is ok
    std::uint64_t edges = 0;  ///< number of edges that two triangles share now

    explicit operator bool() const noexcept { return status == BakeStatus::ok; }
};

/// Joins edges on the borders of blobs, such as the pieces of a ground: each border edge gets the kind that the surface
/// has where it continues in another blob, so that contacts (contact.hpp) do not lean over the seams. Changes edge
/// flags and checksums.
///
/// All blobs must have edge flags of the same flat_angle, and one lattice: the same step, and translations that differ
/// by whole steps. An edge is joined where exactly two triangles of all blobs run along it in opposite directions and
/// neither blob has another triangle there; all other edges with a single triangle become boundaries. Calling again
/// with more blobs has the same effect as a single call. A refusal, with invalid_mesh, changes no blob. If one blob is
/// given for two places, it ends up with the kinds of the last one, so give each place its own bytes.
///
/// Takes about 200 bytes of memory per triangle.
JoinReport join_borders(std::span<const JoinedBlob> blobs);

/// The outcome of verify(), and of verify_scene() in scenes/bake.hpp. Converts to true if the bytes are sound.
struct [[nodiscard]] VerifyReport {
    bool sound = false;
    std::string message;  ///< the first thing that is wrong, and where; empty if sound

    explicit operator bool() const noexcept { return sound; }
};

/// Checks whether a blob is what its header states. Takes any bytes at any alignment.
///
/// A sound blob opens. Every box contains all vertices below it and ends near the asset. No triangle lacks an area, and
/// no two are the same. The vertices of each leaf are numbered by first use. Extent, vertex count, the closed flag,
/// duplicate references, edge flags and stored bounds are correct, except that an edge with a single triangle may be
/// joined to another blob. If a triangle is in several leaves, each of its corners lies in the box of one of them.
///
/// A deformable blob may have triangles without area and equal triangles. Its boxes and the sizes of its leaves are as
/// small as possible, as refit() makes them, and its vertices are those of its positions.
///
/// Takes about 60 bytes of memory per triangle.
VerifyReport verify(std::span<const std::byte> bytes);

}  // namespace espalier

// Numerics. The same arrays and options yield the same bytes on every machine and with any number of threads. max_error
// counts from the positions as given or, for a deformable blob, from the float32 positions that refit() takes.
