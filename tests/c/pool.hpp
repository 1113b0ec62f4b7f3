// The arguments of calls and their results. C has one pool and C++ another: both get the same calls, and must log the
// same words.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include <c99.h>

#include "in_cpp.hpp"
#include "log.hpp"
#include "question.hpp"
#include "support/base/random.hpp"

namespace espalier::tests {

constexpr std::size_t slots = 40;

/// What calls take, and the arrays that they write.
struct Arguments {
#include <slots.inc>
    std::uint8_t statuses[slots] = {};
    std::size_t offsets[slots + 1] = {};
    std::uint16_t materials[slots] = {};
    float number[slots] = {}, rows[12] = {};
};

class Pool : public Arguments {
public:
    /// Makes arguments of a question. `common` is the lattice of rounded rays. Memory, handles to scenes and meshes,
    /// and what they are made of stay.
    void fill(const question& from, const Lattice& common);
    /// Replaces arguments by any bits.
    void spoil(Random random);
    void start_page();

    // ---- what calls take -----------------------------------------------------------------------------------------

    std::uint32_t bits = 0, mask = 0, mesh = 0, slot = 0;
    std::uint64_t work_limit = 0;
    std::size_t capacity = 0, count = 0, places = 0, position_count = 0, found = 0;
    std::uint8_t byte = 0;
    bool nothing = false;  ///< null functions, filters, counters and arrays
    int null_array = -1;   ///< the number of an array that is null in any case
    int arrays = -1;       ///< how many were passed, less 1
    const espalier_vec3* positions = nullptr;
    std::vector<std::byte> room, input;

    [[nodiscard]] std::size_t given(std::size_t size) const { return nothing ? 0 : size; }
    template <class T>
    T* list(T* array, std::size_t size) {
        return ++arrays == null_array || (nothing && size == 0) ? nullptr : array;
    }
    template <class T>
    T* optional(T* one) const {
        return nothing ? nullptr : one;
    }
    template <class Function>
    Function callback() const {
        return nothing ? nullptr : Callback<Function>::call;
    }

    // ---- what they return ----------------------------------------------------------------------------------------

    Log log;
    espalier_query_status status = 0;  ///< of the last result

    template <class C>
    void tell_result(const C& result) {
        log.tell(result);
        remember(result);
    }
    template <class T>
    void tell_list(T* array) {
        log.tell(std::span(static_cast<std::conditional_t<std::is_void_v<T>, const std::byte, T>*>(array), found));
    }
    template <class T>
    void tell_list(std::span<T> array) {
        log.tell(array);
    }
    template <class T, std::size_t size>
    void tell_all(const T (&array)[size]) {
        log.tell(array);
    }

private:
    template <class Function>
    struct Callback;
    template <class Result, class... Arguments>
    struct Callback<Result (*)(Arguments...)> {
        static Result call(Arguments... arguments) {
            void* const user = std::get<sizeof...(Arguments) - 1>(std::tuple(arguments...));
            return static_cast<Pool*>(user)->called<Result>(arguments...);
        }
    };

    /// Logs the arguments of a callback and answers: of a filter, by what it is called with.
    template <class Result, class... Arguments>
    Result called(Arguments... arguments) {
        const std::size_t before = log.words.size();
        (tell_argument(arguments), ...);
        std::uint32_t sum = bits;
        for (std::size_t i = before; i < log.words.size(); ++i) sum += log.words[i];
        if constexpr (std::is_same_v<Result, bool>) return sum % 2 == 0;
        else if (visits_left_-- == 0) return 17;  // stops, as any value does that is none of the others
        else
            return std::is_same_v<std::tuple<Arguments...>, std::tuple<const espalier_tree_node*, void*>> &&
                   sum % 3 == 0;
    }
    void tell_argument(const void*) {}  // to the pool
    template <class T>
    void tell_argument(const T* object) {
        log.tell(*object);
    }
    template <class T>
    void tell_argument(T value) requires(!std::is_pointer_v<T>) {
        log.tell(value);
    }

    // Later calls take what earlier ones found.
    template <class T>
    void remember(const T& result) {
        if constexpr (std::is_same_v<T, espalier_query_status>) status = result;
        else if constexpr (requires { result.status; }) status = result.status;
        else if constexpr (requires { result.hit.status; }) status = result.hit.status;
        else status = ESPALIER_QUERY_OK;
        if constexpr (requires { keep(result); }) keep(result);
        if constexpr (requires { keep(result.value); }) keep(result.value);
        if constexpr (requires { keep_next(result.next); }) keep_next(result.next);
    }
    void keep(const espalier_lattice_box& result) { lattice_box[0] = result; }
    void keep(const espalier_lattice_point& result) { lattice_point[0] = result; }
    void keep(const espalier_rounded_ray& result) { rounded_ray[0] = result; }
    void keep(const espalier_ray_hit& result) { ray_hit[0] = result; }
    void keep(const espalier_pair_contact& result) { pair_contact[0] = result; }
    void keep(const espalier_pair_touch& result) { pair_touch[0] = result; }
    void keep(const espalier_instance_handle& result) { instance_handle[0] = result; }
    void keep_next(const espalier_cursor& next) { cursor[slots - 1] = next; }
    void keep_next(const espalier_instance_pair& next) { instance_pair[slots - 1] = next; }
    void keep_next(const espalier_baked_pair& next) { baked_pair[slots - 1] = next; }

    std::uint32_t visits_ = 0, visits_left_ = 0;
    espalier_vec3 hull_vertices_[ESPALIER_MAX_HULL_VERTICES + 2] = {};
};

enum class Takes { blob, scene, moving, changes, deformable };

/// A function of C and its counterpart.
struct Entry {
    const char* name;
    Takes takes;
    bool has_pages;
    void (*c)(Pool&);
    void (*cpp)(Pool&);
};
extern const std::vector<Entry> entries;

}  // namespace espalier::tests
