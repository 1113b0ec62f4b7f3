// What a stage of the baker returns: a value, or the reason why there is none.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include <espalier/bake.hpp>

namespace espalier::baker {

/// Why nothing is baked: the fields of BakeResult with these names.
struct Refusal {
    BakeStatus status = BakeStatus::internal;
    std::string message;
    std::optional<SourcePlace> place = std::nullopt;
};

inline Refusal invalid_options(std::string message) { return {BakeStatus::invalid_options, std::move(message)}; }

template <class Value>
class [[nodiscard]] Expected {
public:
    Expected(Value value) : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT(google-explicit-constructor)
    Expected(Refusal refusal)
        : state_(std::in_place_index<1>, std::move(refusal)) {}  // NOLINT(google-explicit-constructor)

    explicit operator bool() const { return state_.index() == 0; }
    Value& operator*() { return std::get<0>(state_); }
    const Value& operator*() const { return std::get<0>(state_); }
    Value* operator->() { return &**this; }
    const Value* operator->() const { return &**this; }
    [[nodiscard]] const Refusal& refusal() const { return std::get<1>(state_); }

private:
    std::variant<Value, Refusal> state_;
};

}  // namespace espalier::baker
