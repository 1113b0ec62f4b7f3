#include "turns.hpp"

#include <chrono>

#include "ratio.hpp"

namespace espalier::bench {
namespace {

/// A measurement is eight turns: each side answers four windows, which are stretches of the questions. So no window is
/// answered twice in a row, when all that it needs would lie in the nearest cache.
constexpr std::size_t windows_of_measurement = 4;
constexpr std::size_t most_measurements = 16;  // of different windows
constexpr unsigned least_visits = 4;           // the sides exchange their places, and who begins

const EspalierSideKind* kind_of(const Instance& instance, const QuestionSet& set) {
    const EspalierSideKind* kind = instance.calls().kind(set.kind.c_str());
    if (kind != nullptr && kind->floats != set.floats)
        throw std::runtime_error("bench/ab/questions.cpp and an adapter disagree about the questions of " + set.kind);
    return kind;
}

/// An instance with questions as it takes them.
struct Prepared {
    const EspalierSideKind* kind;
    const EspalierSideAsset* asset;
    Memory questions;

    void answer(std::size_t first, std::size_t count, std::byte* answers) const {
        kind->run(asset, questions.data() + first * kind->question_bytes, count, answers);
    }
};

Prepared prepare(const Instance& instance, const QuestionSet& set, const std::vector<float>& numbers,
                 std::size_t count) {
    const EspalierSideKind* kind = kind_of(instance, set);
    Prepared prepared{kind, &instance.asset(), Memory(std::max<std::size_t>(1, count * kind->question_bytes))};
    kind->prepare(numbers.data(), count, prepared.questions.data());
    return prepared;
}

/// Windows are spread evenly over all questions and are all of one size.
struct Windows {
    std::size_t count = 1;
    std::size_t size = 1;
    [[nodiscard]] std::size_t questions() const { return count * size; }
};

std::vector<float> numbers_in(const QuestionSet& set, const Windows& windows) {
    std::vector<float> numbers;
    if (set.floats == 0) return numbers;
    for (std::size_t w = 0; w < windows.count; ++w) {
        const std::size_t middle = (2 * w + 1) * set.count / (2 * windows.count);
        const auto first = set.numbers.begin() + static_cast<std::ptrdiff_t>(set.floats * (middle - windows.size / 2));
        numbers.insert(numbers.end(), first, first + static_cast<std::ptrdiff_t>(set.floats * windows.size));
    }
    return numbers;
}

/// What one question takes, by the fastest of three tries, about.
double seconds_of_question(const Instance& instance, const QuestionSet& set, double slice) {
    Windows windows = {2 * windows_of_measurement, 1};
    for (;;) {
        const Prepared prepared = prepare(instance, set, numbers_in(set, windows), windows.questions());
        const Memory answers(windows.questions() * prepared.kind->answer_bytes);
        prepared.answer(0, windows.questions(), answers.data());
        double fastest = std::numeric_limits<double>::infinity();
        for (int repetition = 0; repetition < 3; ++repetition) {
            const double start = thread_seconds();
            prepared.answer(0, windows.questions(), answers.data());
            fastest = std::min(fastest, thread_seconds() - start);
        }
        if (fastest > slice || 2 * windows.questions() > set.count)
            return fastest / static_cast<double>(windows.questions());
        windows.size *= 2;
    }
}

/// As many questions to a window as fill a turn, and as many windows as leave time for four visits of each.
Windows choose_windows(const Instance& instance, const QuestionSet& set, std::size_t loads, const Turns& turns) {
    const double slice = 1e-3 * turns.slice_milliseconds;
    const double question = seconds_of_question(instance, set, slice);
    const double fitting =
        turns.seconds / (least_visits * static_cast<double>(loads) * static_cast<double>(2 * windows_of_measurement) *
                         std::max(slice, question));
    const auto most = static_cast<double>(std::min(most_measurements, set.count / windows_of_measurement));
    Windows windows;
    windows.count = windows_of_measurement * static_cast<std::size_t>(std::clamp(fitting, 1.0, most));
    windows.size =
        static_cast<std::size_t>(std::clamp(slice / question, 1.0, static_cast<double>(set.count / windows.count)));
    return windows;
}

/// Four windows from `first` on, in turns A B B A B A A B, or with the sides exchanged: each side is as often early as
/// late, and as often after itself as after the other.
PairOfTimes eight_turns(const Prepared& base, const Prepared& other, bool other_begins, std::size_t first,
                        std::size_t size, std::byte* answers) {
    constexpr std::array<bool, 2 * windows_of_measurement> order = {false, true, true, false, true, false, false, true};
    std::array<double, 2> seconds = {};
    double start = thread_seconds();
    for (std::size_t turn = 0; turn < order.size(); ++turn) {
        const bool is_other = order[turn] != other_begins;
        (is_other ? other : base).answer((first + turn / 2) * size, size, answers);
        const double end = thread_seconds();
        seconds[is_other ? 1 : 0] += end - start;
        start = end;
    }
    return {seconds[0], seconds[1]};
}

std::vector<std::uint64_t> digests(const Prepared& prepared, std::size_t count, std::byte* answers) {
    std::vector<std::uint64_t> result(count);
    prepared.answer(0, count, answers);
    prepared.kind->digest(answers, count, result.data());
    return result;
}

}  // namespace

std::optional<Comparison> take_turns(std::vector<PairOfInstances>& pairs, const QuestionSet& set, const Turns& turns) {
    const EspalierSideKind* const base_kind = kind_of(pairs.front().base(), set);
    const EspalierSideKind* const other_kind = kind_of(pairs.front().other(), set);
    if (base_kind == nullptr || other_kind == nullptr) return std::nullopt;
    const Windows windows = choose_windows(pairs.front().base(), set, pairs.size(), turns);
    const std::size_t count = windows.questions();
    const std::vector<float> numbers = numbers_in(set, windows);
    std::vector<Prepared> base, other;
    for (const PairOfInstances& pair : pairs) {
        base.push_back(prepare(pair.base(), set, numbers, count));
        other.push_back(prepare(pair.other(), set, numbers, count));
    }
    // One place for all answers: where it lies is the same luck for both sides.
    const Memory answers(count * std::max(base_kind->answer_bytes, other_kind->answer_bytes));

    Comparison result;
    result.questions = count;
    const auto expected = digests(base.front(), count, answers.data());
    const auto given = digests(other.front(), count, answers.data());
    for (std::size_t i = 0; i < count; ++i) {
        result.found += expected[i] != 0 ? 1u : 0u;
        result.differing += expected[i] != given[i] ? 1u : 0u;
    }

    const std::size_t parts = windows.count / windows_of_measurement;
    std::vector<TimesOfLoad> times(pairs.size());
    for (TimesOfLoad& load : times)
        for (auto& placement : load) placement.resize(parts);
    const double end = thread_seconds() + turns.seconds;
    for (unsigned visit = 0; visit < least_visits || visit % least_visits != 0 || thread_seconds() < end; ++visit) {
        const bool exchanged = visit % 2 == 1;
        const bool other_begins = visit % 4 >= 2;
        for (std::size_t load = 0; load < pairs.size(); ++load) {
            pairs[load].place(exchanged);
            for (std::size_t part = 0; part < parts; ++part)
                times[load][exchanged ? 1 : 0][part].push_back(
                    eight_turns(base[load], other[load], other_begins != (part % 2 == 1), windows_of_measurement * part,
                                windows.size, answers.data()));
        }
    }
    result.ratio = ratio_of(times);
    result.ratio.base_seconds /= static_cast<double>(count);
    return result;
}

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
