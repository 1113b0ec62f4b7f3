// Callables as parameters: visitors and filters. They are passed down and never kept, two pointers each, without heap.
//
// A callable must outlive the call that it is passed to; a lambda written in the call does. It must not throw: the
// runtime is built without exceptions. It may run other queries.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include <espalier/base/compiler.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

#if defined(__has_cpp_attribute)
#if __has_cpp_attribute(clang::lifetimebound)
#define ESPALIER_LIFETIMEBOUND [[clang::lifetimebound]]
#endif
#endif
#if !defined(ESPALIER_LIFETIMEBOUND)
#define ESPALIER_LIFETIMEBOUND
#endif

namespace espalier {

template <class Signature>
class FunctionRef;

/// A reference to any callable with a fitting signature: a lambda, a function object, a function. The default is empty:
/// it converts to false and must not be called.
///
/// A reference that returns Visit also accepts a callable that returns void, which never stops. It accepts no callable
/// that returns bool.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
private:
    template <class Callable>
    static constexpr bool never_stops = [] {
        if constexpr (std::is_same_v<Result, Visit> && std::is_invocable_v<Callable&, Arguments...>)
            return std::is_void_v<std::invoke_result_t<Callable&, Arguments...>>;
        return false;
    }();
    template <class Callable>
    static constexpr bool refers_to = !std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef> &&
                                      (std::is_invocable_r_v<Result, Callable&, Arguments...> || never_stops<Callable>);

public:
    constexpr FunctionRef() noexcept = default;

    template <class Callable>
    // NOLINTNEXTLINE(google-explicit-constructor): a parameter type
    constexpr FunctionRef(Callable&& callable ESPALIER_LIFETIMEBOUND) noexcept requires(refers_to<Callable>) {
        using Target = std::remove_reference_t<Callable>;
        if constexpr (std::is_function_v<Target>) {
            target_.function = reinterpret_cast<void (*)()>(&callable);
            call_ = [](Pointer target, Arguments... arguments) -> Result {
                return call(*reinterpret_cast<Target*>(target.function), std::forward<Arguments>(arguments)...);
            };
        } else {
            target_.object = const_cast<void*>(static_cast<const volatile void*>(&callable));
            call_ = [](Pointer target, Arguments... arguments) -> Result {
                return call(*static_cast<Target*>(target.object), std::forward<Arguments>(arguments)...);
            };
        }
    }

    constexpr explicit operator bool() const noexcept { return call_ != nullptr; }

    constexpr Result operator()(Arguments... arguments) const {
        return call_(target_, std::forward<Arguments>(arguments)...);
    }

private:
    template <class Target>
    static constexpr Result call(Target& target, Arguments... arguments) {
        if constexpr (never_stops<Target>) {
            target(std::forward<Arguments>(arguments)...);
            return Visit::next;
        } else {
            return target(std::forward<Arguments>(arguments)...);
        }
    }

    union Pointer {
        void* object;
        void (*function)();
    };
    Pointer target_ = {nullptr};
    Result (*call_)(Pointer, Arguments...) = nullptr;
};

/// A callable that is called with each element: it returns void, or a Visit to go on or stop. One that returns bool
/// does not compile.
template <class... Arguments>
using Visitor = FunctionRef<Visit(Arguments...)>;

namespace detail {

struct BlobData;
struct LatticeTriangle;
using CornersAt = Triangle (*)(const BlobData& blob, std::uint32_t index, const LatticeTriangle* triangle);
/// Returns the corners of the triangle at a storage index below the count; null: the triangle is searched.
Triangle corners_at(const BlobData& blob, std::uint32_t index, const LatticeTriangle* triangle) noexcept;

}  // namespace detail

/// A callable that is called with each triangle: of (TriangleId), or of (TriangleId, const Triangle&) to receive the
/// corners too. It returns void or Visit. Corners are computed only for a callable that takes them.
class TriangleVisitor {
private:
    template <class Callable>
    static constexpr bool is_other = !std::is_same_v<std::remove_cvref_t<Callable>, TriangleVisitor>;
    using WithCorners = Visitor<TriangleId, const Triangle&>;
    using WithoutCorners = Visitor<TriangleId>;

public:
    template <class Callable>
    // NOLINTNEXTLINE(google-explicit-constructor): a parameter type
    constexpr TriangleVisitor(Callable&& callable ESPALIER_LIFETIMEBOUND) noexcept
        requires(is_other<Callable>&& std::is_constructible_v<WithCorners, Callable&&>)
        : with_corners_(std::forward<Callable>(callable)), corners_at_(detail::corners_at) {}

    template <class Callable>
    // NOLINTNEXTLINE(google-explicit-constructor): a parameter type
    constexpr TriangleVisitor(Callable&& callable ESPALIER_LIFETIMEBOUND) noexcept
        requires(is_other<Callable> && !std::is_constructible_v<WithCorners, Callable&&> &&
                 std::is_constructible_v<WithoutCorners, Callable&&>)
        : without_corners_(std::forward<Callable>(callable)) {}

    [[nodiscard]] constexpr bool takes_corners() const noexcept { return corners_at_ != nullptr; }

    /// Calls the callable with a triangle whose corners are given. They must be right only if takes_corners().
    constexpr Visit operator()(TriangleId triangle, const Triangle& corners) const {
        return takes_corners() ? with_corners_(triangle, corners) : without_corners_(triangle);
    }
    /// Calls the callable with a triangle whose corners are looked up at a storage index if it takes them, or converted
    /// from those at hand.
    constexpr Visit operator()(TriangleId triangle, const detail::BlobData& blob, std::uint32_t reference,
                               const detail::LatticeTriangle* at_hand = nullptr) const {
        return takes_corners() ? look_up_corners(triangle, blob, reference, at_hand) : without_corners_(triangle);
    }

private:
    /// Has a frame of its own: queries need no room for the corners.
    ESPALIER_NOINLINE constexpr Visit look_up_corners(TriangleId triangle, const detail::BlobData& blob,
                                                      std::uint32_t reference,
                                                      const detail::LatticeTriangle* at_hand) const {
        return with_corners_(triangle, corners_at_(blob, reference, at_hand));
    }

    union {
        WithCorners with_corners_;  // if it takes corners
        WithoutCorners without_corners_;
    };
    detail::CornersAt corners_at_ = nullptr;  // a program without visitors that take corners does not link it
};

/// A callable that returns whether a query keeps a triangle: a query behaves as if the others were not in the blob. It
/// may be called for triangles that turn out not to count, in any order: its result must depend on the triangle
/// alone. Empty, it keeps all.
using TriangleFilter = FunctionRef<bool(TriangleId)>;

}  // namespace espalier
