// The words that a call leaves: each field of its result, of the arrays that it writes and of what it passes to
// callbacks.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <espalier/espalier.h>

#include "in_cpp.hpp"

namespace espalier::tests {

class Log {
public:
    std::vector<std::uint32_t> words;

    template <class T>
    void tell(T number) requires(std::is_integral_v<T>) {
        words.push_back(static_cast<std::uint32_t>(number));
        if constexpr (sizeof number == 8)
            words.push_back(static_cast<std::uint32_t>(static_cast<std::uint64_t>(number) >> 32));
    }
    void tell(float number) { words.push_back(std::bit_cast<std::uint32_t>(number)); }
    void tell(double number) { tell(std::bit_cast<std::uint64_t>(number)); }
    void tell(const char* text) {
        for (; *text != '\0'; ++text) tell(*text);
    }
    template <class T, std::size_t size>
    void tell(const T (&array)[size]) {
        for (const T& element : array) tell(element);
    }
    template <class T>
    void tell(std::span<T> array) {
        tell(array.size());
        for (const T& element : array) {
            if constexpr (std::is_same_v<const T, const std::byte>) tell(std::to_integer<std::uint32_t>(element));
            else if constexpr (requires { espalier::tests::Log().tell(element); }) tell(element);
            else tell(*passed(element));
        }
    }
    void tell(const espalier_blob* blob) { tell(*blob); }
    void tell(const espalier_blob& blob) {
        tell(espalier_blob_status(&blob));
        tell(espalier_blob_checksum(&blob));
        tell(espalier_blob_bounds(&blob));
    }
    void tell(const espalier_scene& scene) { tell(espalier_scene_size(&scene)); }
    void tell(const espalier_mesh_result& mesh) {
        tell(mesh.status);
        tell(mesh.value);
    }
#include <tells.inc>
};

}  // namespace espalier::tests
