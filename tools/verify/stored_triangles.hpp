// The triangles of a blob or a scene, and which of them have a source.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <espalier/blob.hpp>
#include <espalier/scene.hpp>

#include "source_places.hpp"

namespace espalier::tools {

/// What a triangle of the source is among the stored ones.
enum class Match : std::uint8_t {
    none,
    again,  ///< stored triangles that have a source already
    first,  ///< a stored triangle that had no source yet
};

/// Stored triangles without a source.
struct Sourceless {
    std::uint64_t count = 0;
    std::string first;  ///< "triangle 7"
};

class StoredTriangles {
public:
    virtual ~StoredTriangles() = default;

    [[nodiscard]] virtual std::uint64_t size() const = 0;
    /// Finds what a triangle of the source became: stored triangles of the same winding, each corner within
    /// corner_tolerance() of its own. They have a source from then on.
    virtual Match match(const SourceCorners& corners) = 0;
    /// Returns whether a bake may have left a triangle without area.
    [[nodiscard]] virtual bool may_collapse(const SourceCorners& corners) const = 0;
    [[nodiscard]] virtual Sourceless sourceless() const = 0;
};

/// Returns how far a stored corner may be from that of a source. The bake moves it by max error at most; where the
/// source was written anew, with other digits, that moved it too.
inline double corner_tolerance(float max_error) { return 2.0 * static_cast<double>(max_error); }

/// The blob or the scene must outlive the result.
std::unique_ptr<StoredTriangles> triangles_of_blob(const Blob& blob);
std::unique_ptr<StoredTriangles> triangles_of_scene(const BakedScene& scene);

}  // namespace espalier::tools
