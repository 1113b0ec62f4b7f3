// Results for C: one piece of memory each.
#pragma once

#include <espalier/bake.hpp>
#include <espalier/c/bake.h>

#include <baker/c/failure.hpp>

namespace espalier::baker {

/// Where the memory of a result comes from.
struct ResultMemory {
    espalier_allocate allocate;
    espalier_release release;
    void* user;
};

/// malloc() and free().
extern const ResultMemory default_memory;

/// Returns a result, or the one for no memory if there is none for it.
const espalier_bake_result* make_result(const BakeResult& baked, bool with_remap, double conversion_error,
                                        const ResultMemory& memory) noexcept;
const espalier_bake_result* make_result(const Failure& failure, const ResultMemory& memory) noexcept;

/// Returns a static result, which needs no memory and ignores its release.
const espalier_bake_result* no_memory() noexcept;

void release_result(const espalier_bake_result* result) noexcept;

}  // namespace espalier::baker
