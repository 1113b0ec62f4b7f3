// One line about the answers, made without the C library, so that every machine prints it alike.
#pragma once

#include <cstddef>
#include <cstdint>

#include "answers.hpp"

namespace espalier::platform {

class Line {
public:
    /// Adds texts, numbers in decimal, and fingerprints in hexadecimal.
    template <class... Parts>
    void add(const Parts&... parts) {
        (add_part(parts), ...);
    }
    [[nodiscard]] const char* c_str() const { return characters_; }

private:
    void add_part(const char* characters) {
        while (*characters != '\0') put(*characters++);
    }
    void add_part(std::uint32_t number) {
        char digits[10];
        int count = 0;
        do {
            digits[count++] = static_cast<char>('0' + number % 10);
            number /= 10;
        } while (number != 0);
        while (count > 0) put(digits[--count]);
    }
    void add_part(const Fingerprint& hash) {
        for (int shift = 60; shift >= 0; shift -= 4) put("0123456789abcdef"[(hash.value() >> shift) & 0xFu]);
    }
    void put(char character) {
        if (length_ + 1 < sizeof characters_) characters_[length_++] = character;
    }
    char characters_[256] = {};
    std::size_t length_ = 0;
};

/// A line of tests/platform/golden.txt: "questions 40: 24 blobs 0123456789abcdef, 50000 answers 0123456789abcdef".
/// `kind` is blobs or scenes.
inline Line summary(std::uint32_t questions, std::uint32_t count, const char* kind, const Fingerprint& bytes,
                    const Answers& answers) {
    Line line;
    line.add("questions ", questions, ": ", count, " ", kind, " ", bytes, ", ", answers.calls, " answers ",
             answers.fingerprint, "\n");
    return line;
}

/// "answers 0123456789abcdef: 2000 rays, ..."
inline Line report(const Answers& answers) {
    Line line;
    line.add("answers ", answers.fingerprint, ": ", answers.rays, " rays (", answers.rays_hit,
             " of the unfiltered hit, ", answers.hits, " hits listed), ", answers.spheres, " spheres (",
             answers.overlaps, " overlaps), ", answers.points, " points (", answers.points_found, " found), ",
             answers.pairs_near, " placed blobs near, ", answers.calls, " calls\n");
    return line;
}

}  // namespace espalier::platform
