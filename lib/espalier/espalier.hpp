// Includes the whole runtime: opening a blob, every query, and the library's version. Two parts are separate: the baker
// (<espalier/bake.hpp>) and the byte layout of blobs (<espalier/format.hpp>).
//
// The runtime uses no heap, no exceptions and no libc. Thread safety: any number of threads may query one blob.
#pragma once

#include <espalier/approximate.hpp>
#include <espalier/batches/arrays.hpp>
#include <espalier/batches/lookups.hpp>
#include <espalier/batches/rays.hpp>
#include <espalier/batches/shapes.hpp>
#include <espalier/blob.hpp>
#include <espalier/bounds.hpp>
#include <espalier/contact.hpp>
#include <espalier/deformation.hpp>
#include <espalier/distance.hpp>
#include <espalier/advanced/lattice.hpp>
#include <espalier/scenes/contacts.hpp>
#include <espalier/scenes/moving_scene.hpp>
#include <espalier/original.hpp>
#include <espalier/overlap.hpp>
#include <espalier/pair.hpp>
#include <espalier/ray.hpp>
#include <espalier/advanced/rounding.hpp>
#include <espalier/scene.hpp>
#include <espalier/scenes/pairs.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/sweep.hpp>
#include <espalier/transform.hpp>
#include <espalier/types.hpp>
#include <espalier/walk.hpp>

namespace espalier {

inline constexpr int library_version_major = 0;
inline constexpr int library_version_minor = 1;
inline constexpr int library_version_patch = 0;
inline constexpr const char* library_version = "0.1.0";

}  // namespace espalier
