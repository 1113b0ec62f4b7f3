#include "call.hpp"

#include <cmath>

#include "base/lengths.hpp"
#include "base/numbers.hpp"
#include "kinds.hpp"

namespace espalier::tools {

float number_argument(const std::string& input, std::string_view name) {
    const std::optional<float> value = parse_float(input);
    if (!value) throw CommandError(ExitCode::usage, text(name, ": '", printable(input), "' is no number."));
    return *value;
}

float length_argument(const std::string& input, std::string_view name) {
    const std::optional<float> value = parse_float(input);
    return value ? *value : static_cast<float>(parse_length(input, name));
}

QueryCall::QueryCall(const QueryKind& kind, const QueryArguments& arguments) : arguments_(arguments) {
    const unsigned count = word_count(kind);
    const std::size_t given = arguments.words.size();
    if (kind.repeats_words ? given == 0 || given % count != 0 : given != count) {
        throw CommandError(ExitCode::usage, text("query ", kind.name, " takes ", counted(count, "argument"),
                                                 kind.repeats_words ? ", once or more: " : ": ", words_text(kind),
                                                 ", not ", given, '.'));
    }
    std::size_t next = 0;
    while (next < given) {
        for (const QueryWord& word : kind.words) {
            for (unsigned i = 0; i < word.count; ++i) {
                std::string input = arguments.words[next++];
                if (input.starts_with(" -")) input.erase(0, 1);  // main.cpp marks negative numbers
                read_word(input, word);
            }
        }
    }
    file_ = open_blob_file(arguments.blob);
}

void QueryCall::read_word(const std::string& input, const QueryWord& word) {
    switch (word.type) {
        case QueryWord::Type::length:
            numbers_.push_back(length_argument(input, word.name));
            return;
        case QueryWord::Type::number:
            numbers_.push_back(number_argument(input, word.name));
            return;
        case QueryWord::Type::index: {
            const std::optional<double> value = parse_double(input);
            if (!value || !(*value >= 0.0 && *value <= 4294967295.0) || *value != std::floor(*value)) {
                throw CommandError(ExitCode::usage,
                                   text(word.name, ": '", printable(input), "' is no whole number from 0 on."));
            }
            indices_.push_back(static_cast<std::uint32_t>(*value));
            return;
        }
        case QueryWord::Type::steps: {
            const std::optional<double> value = parse_double(input);
            if (!value || !(*value >= -2147483648.0 && *value <= 2147483647.0) || *value != std::floor(*value)) {
                throw CommandError(ExitCode::usage, text(word.name, ": '", printable(input),
                                                         "' is no whole number of lattice steps of 32 bits."));
            }
            steps_.push_back(static_cast<std::int32_t>(*value));
            return;
        }
        case QueryWord::Type::name:
            names_.push_back(input);
            return;
    }
}

float QueryCall::next_number() { return numbers_.at(number_++); }

Vec3 QueryCall::next_vector() {
    Vec3 result;
    result.x = next_number();
    result.y = next_number();
    result.z = next_number();
    return result;
}

std::uint32_t QueryCall::next_index() { return indices_.at(index_++); }

LatticePoint QueryCall::next_steps() {
    LatticePoint result;
    result.x = steps_.at(step_++);
    result.y = steps_.at(step_++);
    result.z = steps_.at(step_++);
    return result;
}

TriangleId QueryCall::next_triangle() {
    const TriangleId triangle{next_index()};
    if (triangle.index >= blob().triangle_count()) {
        throw CommandError(ExitCode::usage, text("triangle ", triangle.index, ": the blob has ",
                                                 counted(blob().triangle_count(), "triangle"), ", counted from 0."));
    }
    return triangle;
}

const std::string& QueryCall::next_name() { return names_.at(name_++); }

}  // namespace espalier::tools
