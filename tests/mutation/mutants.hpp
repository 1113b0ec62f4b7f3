// What instrument.py writes into the library: each change of it is in the program at once and one, by its number, is
// switched on when the program starts. An operator is mutated by a value that stands between it and its right side:
// `a < b` becomes `a < Less{} < b`, which keeps the precedence of everything around it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <type_traits>

namespace mutation {

extern int active;
/// By number: whether the program came by.
extern unsigned char reached[];

/// Constants that the compiler works out are not mutated.
constexpr bool on(int number) {
    if (std::is_constant_evaluated()) return false;
    reached[number] = 1;
    return active == number;
}

/// Between an operator and its right side. It has two mutants, this number and the next.
template <int number>
struct Between {};

template <int number, class Left>
struct Held {
    Left left;
};

/// Sums and differences. Vectors whose operators are not visible here have three coordinates.
template <class Left, class Right>
[[gnu::always_inline]] constexpr auto sum(Left left, Right right) {
    if constexpr (requires { left + right; }) return left + right;
    else if constexpr (requires { left.x; }) return Left{left.x + right.x, left.y + right.y, left.z + right.z};
    else return Left{left[0] + right[0], left[1] + right[1], left[2] + right[2]};
}
template <class Left, class Right>
[[gnu::always_inline]] constexpr auto difference(Left left, Right right) {
    if constexpr (requires { left - right; }) return left - right;
    else if constexpr (requires { left.x; }) return Left{left.x - right.x, left.y - right.y, left.z - right.z};
    else return Left{left[0] - right[0], left[1] - right[1], left[2] - right[2]};
}
/// Not everything that can be added can be subtracted: then the right side is dropped. Iterators are not added.
template <class Left, class Right>
[[gnu::always_inline]] constexpr auto opposite_of_plus(Left left, Right right) {
    if constexpr (
        requires { left + right; } && !requires { left - right; })
        return left;
    else return difference(left, right);
}
template <class Left, class Right>
[[gnu::always_inline]] constexpr auto opposite_of_minus(Left left, Right right) {
    if constexpr (
        requires { left - right; } && !requires { left + right; })
        return left - right;
    else return sum(left, right);
}
/// Numbers wider than the machine's have `<` alone of the comparisons by size.
template <class Left, class Right>
[[gnu::always_inline]] constexpr auto at_most(Left left, Right right) {
    if constexpr (requires { left <= right; }) return left <= right;
    else return !(right < left);
}
/// Of lanes each.
template <class Result>
[[gnu::always_inline]] constexpr Result always() {
    if constexpr (std::is_same_v<Result, bool>) return true;
    else return ~Result{};
}
/// Where the difference is a number and the left side is none, as of iterators, 0.
template <class Result, class Left>
[[gnu::always_inline]] constexpr Result drop_right(Left left) {
    if constexpr (std::is_convertible_v<Left, Result>) return static_cast<Result>(left);
    else return Result{};
}

// clang-format off
#define MUTATION_OPERATOR(op, plain, first, second)                                                              \
    template <class Left, int number>                                                                            \
    [[gnu::always_inline]] constexpr Held<number, Left> operator op(Left left, Between<number>) { return {left}; } \
    template <int number, class Left, class Right>                                                               \
    [[gnu::always_inline]] constexpr auto operator op(Held<number, Left> held, Right right) {                    \
        const Left left = held.left;                                                                             \
        using Result = std::remove_cvref_t<decltype((plain))>;                                                   \
        if (on(number)) return static_cast<Result>(first);                                                       \
        if (on(number + 1)) return static_cast<Result>(second);                                                  \
        return static_cast<Result>(plain);                                                                       \
    }
// clang-format on

MUTATION_OPERATOR(<, left < right, (at_most(left, right)), !(left < right))
MUTATION_OPERATOR(<=, left <= right, left < right, !(left <= right))
MUTATION_OPERATOR(>, left > right, left >= right, !(left > right))
MUTATION_OPERATOR(>=, left >= right, left > right, !(left >= right))
MUTATION_OPERATOR(==, left == right, left != right, always<Result>())
MUTATION_OPERATOR(!=, left != right, left == right, always<Result>())
MUTATION_OPERATOR(+, (sum(left, right)), (opposite_of_plus(left, right)), (drop_right<Result>(left)))
MUTATION_OPERATOR(-, (difference(left, right)), (opposite_of_minus(left, right)), (drop_right<Result>(left)))
MUTATION_OPERATOR(<<, left << right, left << (right + 1), left << (right - 1))
MUTATION_OPERATOR(>>, left >> right, left >> (right + 1), left >> (right - 1))

/// What is added, or put into bits: nothing.
template <int number, class T>
constexpr T nothing(T value) {
    return on(number) ? T{} : value;
}

/// What bits are cut down to: all of them.
template <int number, class T>
constexpr T everything(T value) {
    if constexpr (std::is_same_v<T, bool>) return on(number) || value;
    else return on(number) ? static_cast<T>(~T{}) : value;
}

template <int number, class T>
constexpr T least(T a, T b) {
    return on(number) ? std::max(a, b) : std::min(a, b);
}
template <int number, class T>
constexpr T least(std::initializer_list<T> list) {
    return on(number) ? std::max(list) : std::min(list);
}
template <int number, class T>
constexpr T most(T a, T b) {
    return on(number) ? std::min(a, b) : std::max(a, b);
}
template <int number, class T>
constexpr T most(std::initializer_list<T> list) {
    return on(number) ? std::min(list) : std::max(list);
}

}  // namespace mutation
