// Results for C: one piece of memory each.
#pragma once

#include <espalier/c/bake.h>
#include <espalier/scenes/bake.hpp>

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

/// Returns a static result, which needs no memory and ignores its release.
const espalier_bake_result* no_memory() noexcept;

/// Returns a result, or the one for no memory if there is none for it.
const espalier_bake_result* make_result(const BakeResult& baked, bool with_remap, const ResultMemory& memory) noexcept;
const espalier_bake_result* make_result(const SceneBakeResult& baked, const ResultMemory& memory) noexcept;
const espalier_bake_result* make_result(const Failure& failure, const ResultMemory& memory) noexcept;

/// Returns the result for the exception that is being handled. May throw std::bad_alloc.
const espalier_bake_result* result_of_exception(const ResultMemory& memory);

/// Returns what make() returns, or the result for what it throws.
template <class Make>
const espalier_bake_result* without_exceptions(const ResultMemory& memory, const Make& make) noexcept {
    try {
        return make();
    } catch (...) {
        try {
            return result_of_exception(memory);
        } catch (...) {  // of a message
            return no_memory();
        }
    }
}

void release_result(const espalier_bake_result* result) noexcept;

}  // namespace espalier::baker
