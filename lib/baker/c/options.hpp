// Options from C.
#pragma once

#include <optional>

#include <espalier/bake.hpp>
#include <espalier/c/bake.h>

#include <baker/c/failure.hpp>
#include <baker/c/result.hpp>

namespace espalier::baker {

/// Returns the defaults, without their size.
[[nodiscard]] espalier_bake_options default_options();

/// Reads the options, or the defaults if they are null. Returns what is wrong with the structure itself.
std::optional<Failure> read_options(const void* given, espalier_bake_options& options);

/// Returns the memory that the options choose, the default one where they name half of it.
[[nodiscard]] ResultMemory memory_of(const espalier_bake_options& options);

/// Writes the options as bake() takes them, which checks their values. `positions` is the number of all meshes' ones.
std::optional<Failure> translate(const espalier_bake_options& options, std::size_t positions, BakeOptions& translated);

/// What a progress callback throws through bake() that ends it.
struct StoppedByProgress {};

}  // namespace espalier::baker
