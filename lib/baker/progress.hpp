// Reports the progress of a bake to the caller.
#pragma once

#include <functional>
#include <utility>

namespace espalier::baker {

/// A share of the whole, as measured on large meshes. Only the look of a progress bar depends on it.
struct Stage {
    const char* name;
    double start;
    double end;
};
namespace stages {
inline constexpr Stage check = {"check", 0.0, 0.06};
inline constexpr Stage snap = {"snap", 0.06, 0.3};
inline constexpr Stage build = {"build", 0.3, 0.7};
inline constexpr Stage collapse = {"collapse", 0.7, 0.85};
inline constexpr Stage order = {"order", 0.85, 0.88};
inline constexpr Stage encode = {"encode", 0.88, 0.95};
inline constexpr Stage verify = {"verify", 0.95, 1.0};
}  // namespace stages

class Progress {
public:
    using Callback = std::function<void(const char* stage, double done)>;

    explicit Progress(const Callback& callback) : callback_(callback) {}

    void begin(const Stage& stage) const { tell(stage, 0.0); }
    void tell(const Stage& stage, double share) const {
        if (callback_) callback_(stage.name, stage.start + share * (stage.end - stage.start));
    }
    void finish() const { tell(stages::verify, 1.0); }

    /// For a stage that reports on itself; empty when nobody listens.
    [[nodiscard]] std::function<void(double)> within(const Stage& stage) const {
        if (!callback_) return {};
        return [this, stage](double share) { tell(stage, share); };
    }

private:
    const Callback& callback_;
};

}  // namespace espalier::baker
