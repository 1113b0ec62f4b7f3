// One line about the answers, made without the C library, so that every machine prints it alike.
#pragma once

#include <cstddef>
#include <cstdint>

#include "answers.hpp"

namespace espalier::platform {

class Line {
public:
    void text(const char* characters) {
        while (*characters != '\0') put(*characters++);
    }
    void decimal(std::uint32_t number) {
        char digits[10];
        int count = 0;
        do {
            digits[count++] = static_cast<char>('0' + number % 10);
            number /= 10;
        } while (number != 0);
        while (count > 0) put(digits[--count]);
    }
    void hexadecimal(std::uint64_t number) {
        for (int shift = 60; shift >= 0; shift -= 4) put("0123456789abcdef"[(number >> shift) & 0xFu]);
    }
    [[nodiscard]] const char* c_str() const { return characters_; }

private:
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
    line.text("questions ");
    line.decimal(questions);
    line.text(": ");
    line.decimal(count);
    line.text(" ");
    line.text(kind);
    line.text(" ");
    line.hexadecimal(bytes.value());
    line.text(", ");
    line.decimal(answers.calls);
    line.text(" answers ");
    line.hexadecimal(answers.fingerprint.value());
    line.text("\n");
    return line;
}

/// "answers 0123456789abcdef: 2000 rays, ..."
inline Line report(const Answers& answers) {
    Line line;
    line.text("answers ");
    line.hexadecimal(answers.fingerprint.value());
    line.text(": ");
    line.decimal(answers.rays);
    line.text(" rays (");
    line.decimal(answers.rays_hit);
    line.text(" of the unfiltered hit, ");
    line.decimal(answers.hits);
    line.text(" hits listed), ");
    line.decimal(answers.spheres);
    line.text(" spheres (");
    line.decimal(answers.overlaps);
    line.text(" overlaps), ");
    line.decimal(answers.points);
    line.text(" points (");
    line.decimal(answers.points_found);
    line.text(" found), ");
    line.decimal(answers.pairs_near);
    line.text(" placed blobs near, ");
    line.decimal(answers.calls);
    line.text(" calls\n");
    return line;
}

}  // namespace espalier::platform
