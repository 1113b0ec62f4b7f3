// Callables as parameters, for visitors and filters. A reference takes two pointers and no heap; the library passes it
// down and never keeps it.
//
// The callable must outlive the call that receives it, as a lambda written in the argument list does. It must not
// throw, because the runtime is built without exceptions. It may run other queries.
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

/// A reference to any callable with a matching signature: a lambda, a function object or a function. A default
/// reference is empty: it converts to false and must not be called.
///
/// A reference that returns Visit also accepts a callable that returns void and thus never stops. It rejects callables
/// that return bool, which do not say whether true means to stop or to continue.
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

/// A callable that receives each element. It returns void, or a Visit to continue or stop. One that returns bool does
/// not compile.
template <class... Arguments>
using Visitor = FunctionRef<Visit(Arguments...)>;

namespace detail {

struct BlobData;
struct LatticeTriangle;
using CornersAt = Triangle (*)(const BlobData& blob, std::uint32_t index, const LatticeTriangle* triangle);
/// Returns the corners of the triangle with this storage index, which must be below the count. If `triangle` is null,
/// the triangle is looked up in the tree.
Triangle corners_at(const BlobData& blob, std::uint32_t index, const LatticeTriangle* triangle) noexcept;

}  // namespace detail

/// A callable that receives each triangle, as (TriangleId) or as (TriangleId, const Triangle&). It returns void or a
/// Visit. Corners are computed only for a callable that takes them.
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

    /// Calls the callable with these corners, which need to be valid only if takes_corners().
    constexpr Visit operator()(TriangleId triangle, const Triangle& corners) const {
        return takes_corners() ? with_corners_(triangle, corners) : without_corners_(triangle);
    }
    /// Calls the callable. If it takes corners, converts them from `at_hand`, or looks them up by storage index if that
    /// is null.
    constexpr Visit operator()(TriangleId triangle, const detail::BlobData& blob, std::uint32_t reference,
                               const detail::LatticeTriangle* at_hand = nullptr) const {
        return takes_corners() ? look_up_corners(triangle, blob, reference, at_hand) : without_corners_(triangle);
    }

private:
    /// Out of line, so that queries do not reserve stack for the corners.
    ESPALIER_NOINLINE constexpr Visit look_up_corners(TriangleId triangle, const detail::BlobData& blob,
                                                      std::uint32_t reference,
                                                      const detail::LatticeTriangle* at_hand) const {
        return with_corners_(triangle, corners_at_(blob, reference, at_hand));
    }

    union {
        WithCorners with_corners_;  // active if takes_corners()
        WithoutCorners without_corners_;
    };
    detail::CornersAt corners_at_ = nullptr;  // a program that never takes corners does not link it
};

/// A callable that returns whether to keep a triangle. A query behaves as if the other triangles were not in the blob.
/// The filter may be called in any order, also for triangles that turn out not to matter, so its result must depend on
/// nothing but the triangle. An empty filter keeps all triangles.
using TriangleFilter = FunctionRef<bool(TriangleId)>;

namespace detail {
inline constexpr TriangleFilter no_filter;
}

}  // namespace espalier
