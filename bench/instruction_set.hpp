// The name of the instruction set with which the library's queries run here.
#pragma once

#include <runtime/lanes/select.hpp>

namespace espalier::bench {

inline const char* instruction_set_name() {
    switch (detail::instruction_set()) {
        case detail::InstructionSet::scalar:
            return "scalar";
        case detail::InstructionSet::sse42:
            return "sse4.2";
        case detail::InstructionSet::avx2:
            return "avx2";
        case detail::InstructionSet::avx512:
            return "avx512";
        case detail::InstructionSet::neon:
            return "neon";
        case detail::InstructionSet::simd128:
            return "simd128";
    }
    return "";
}

}  // namespace espalier::bench
