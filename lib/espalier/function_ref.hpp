// A callable that is passed down and never kept: two pointers, no heap.
#pragma once

#include <type_traits>
#include <utility>

namespace espalier {

template <class Signature>
class FunctionRef;

/// Refers to any callable with a fitting signature: a lambda, a function object, a function. The callable must outlive
/// the call that it is passed to, and must not throw: the runtime is built without exceptions.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
private:
    template <class Callable>
    static constexpr bool refers_to = !std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef> &&
                                      std::is_invocable_r_v<Result, Callable&, Arguments...>;

public:
    template <class Callable>
    // NOLINTNEXTLINE(google-explicit-constructor): a parameter type
    constexpr FunctionRef(Callable&& callable) noexcept requires(refers_to<Callable>) {
        using Target = std::remove_reference_t<Callable>;
        if constexpr (std::is_function_v<Target>) {
            target_.function = reinterpret_cast<void (*)()>(&callable);
            call_ = [](Pointer target, Arguments... arguments) -> Result {
                return (*reinterpret_cast<Target*>(target.function))(std::forward<Arguments>(arguments)...);
            };
        } else {
            target_.object = const_cast<void*>(static_cast<const volatile void*>(&callable));
            call_ = [](Pointer target, Arguments... arguments) -> Result {
                return (*static_cast<Target*>(target.object))(std::forward<Arguments>(arguments)...);
            };
        }
    }

    constexpr Result operator()(Arguments... arguments) const {
        return call_(target_, std::forward<Arguments>(arguments)...);
    }

private:
    union Pointer {
        void* object;
        void (*function)();
    };
    Pointer target_ = {nullptr};
    Result (*call_)(Pointer, Arguments...) = nullptr;
};

}  // namespace espalier
