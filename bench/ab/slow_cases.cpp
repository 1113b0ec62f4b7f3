#include "slow_cases.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include "ratio.hpp"

namespace espalier::bench {
namespace {

/// An interrupt would have to strike a question in each pass.
constexpr unsigned passes = 7;

std::vector<float> spread(const QuestionSet& set, std::size_t count) {
    std::vector<float> numbers;
    for (std::size_t i = 0; i < count && set.floats != 0; ++i) {
        const auto first = set.numbers.begin() + static_cast<std::ptrdiff_t>(i * set.count / count * set.floats);
        numbers.insert(numbers.end(), first, first + static_cast<std::ptrdiff_t>(set.floats));
    }
    return numbers;
}

}  // namespace

std::optional<SlowCases> slow_cases(const Instance& instance, const QuestionSet& set, std::size_t count) {
    using Clock = std::chrono::steady_clock;
    const EspalierSideKind* kind = instance.calls().kind(set.kind.c_str());
    if (kind == nullptr) return std::nullopt;
    count = std::min(count, set.count);
    const Memory questions(std::max<std::size_t>(1, count * kind->question_bytes)), answer(kind->answer_bytes);
    kind->prepare(spread(set, count).data(), count, questions.data());
    std::vector<double> seconds(count, std::numeric_limits<double>::infinity());
    for (unsigned pass = 0; pass < passes; ++pass) {
        for (std::size_t i = 0; i < count; ++i) {
            const Clock::time_point start = Clock::now();
            kind->run(&instance.asset(), questions.data() + i * kind->question_bytes, 1, answer.data());
            seconds[i] = std::min(seconds[i], std::chrono::duration<double>(Clock::now() - start).count());
        }
    }
    const auto at = seconds.begin() + static_cast<std::ptrdiff_t>((count - 1) * 99 / 100);
    std::nth_element(seconds.begin(), at, seconds.end());
    const double slow = *at;
    return SlowCases{median(std::move(seconds)), slow, count};
}

}  // namespace espalier::bench
