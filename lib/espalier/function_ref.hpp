// A callable that is passed down and never kept: two pointers, no heap.
#pragma once

#include <type_traits>
#include <utility>

namespace espalier {

template <class Signature>
class FunctionRef;

/// Refers to any callable with a fitting signature. The callable must outlive the call it is passed to.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
public:
    template <class Callable>
        requires(!std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef> &&
                 std::is_invocable_r_v<Result, Callable&, Arguments...>)
    constexpr FunctionRef(Callable&& callable) noexcept  // NOLINT(google-explicit-constructor): a parameter type
        : object_(const_cast<void*>(static_cast<const volatile void*>(&callable))),
          call_([](void* object, Arguments... arguments) -> Result {
              return (*static_cast<std::remove_reference_t<Callable>*>(object))(
                  std::forward<Arguments>(arguments)...);
          }) {}

    constexpr Result operator()(Arguments... arguments) const {
        return call_(object_, std::forward<Arguments>(arguments)...);
    }

private:
    void* object_;
    Result (*call_)(void*, Arguments...);
};

}  // namespace espalier
