// Systems that answer the same questions in turns.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

/// A system, its answers to all questions, and what they took.
template <class Question, class Answer>
struct Contestant {
    std::string system, profile;
    std::function<void(std::span<const Question> questions, std::span<Answer> answers)> ask;
    std::size_t bytes = 0;
    std::vector<Answer> answers = {};
    std::vector<double> seconds = {};  ///< processor time of each repetition

    void answer(std::span<const Question> questions) {
        answers.resize(questions.size());
        const ProcessorTime time;
        ask(questions, answers);
        seconds.push_back(time.seconds());
    }
    [[nodiscard]] double least_seconds() const { return *std::min_element(seconds.begin(), seconds.end()); }
    [[nodiscard]] double sum_of_answers() const {
        double sum = 0.0;
        for (const Answer answer : answers) sum += static_cast<double>(answer);
        return sum;
    }
};
template <class Question, class Answer>
using Contest = std::vector<Contestant<Question, Answer>>;

/// Returns what asks one question after the other with `ask(question)`.
template <class Ask>
auto one_by_one(Ask ask) {
    return [ask](auto questions, auto answers) {
        using Answer = std::remove_reference_t<decltype(answers[0])>;
        for (std::size_t i = 0; i < questions.size(); ++i) answers[i] = static_cast<Answer>(ask(questions[i]));
    };
}

/// The systems take turns within each repetition, so that a ratio is taken between neighbours in time.
template <class Question, class Answer>
void take_turns(Contest<Question, Answer>& contest, std::span<const Question> questions, std::size_t repetitions) {
    for (std::size_t repetition = 0; repetition < repetitions; ++repetition)
        for (auto& contestant : contest) contestant.answer(questions);
}

struct Spread {
    double low = 0.0, median = 0.0, high = 0.0;
};
inline Spread spread(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return {values.front(), values[values.size() / 2], values.back()};
}
/// Returns the reference's times by one's own: above 1 is faster.
inline Spread ratio(const std::vector<double>& reference, const std::vector<double>& own) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < own.size(); ++i) ratios.push_back(reference[i] / own[i]);
    return spread(std::move(ratios));
}

}  // namespace espalier::bench
