// Bounds of a whole blob that are tighter than its box.
#include "bindings.hpp"
#include "held_blob.hpp"

#include <array>
#include <tuple>
#include <vector>

#include <pybind11/stl.h>

#include <espalier/bounds.hpp>

namespace espalier::python {

namespace {

using Numbers = std::array<float, 3>;

Numbers numbers(const Vec3& vector) { return {vector.x, vector.y, vector.z}; }

/// Returns (status, value): the value as make(bounds) has it, which counts where the status is ok.
template <class Bounds, class Make>
auto with_status(const Result<Bounds>& bounds, const Make& make) {
    return std::make_tuple(static_cast<int>(bounds.status), make(bounds.value));
}

}  // namespace

void bind_bounds(py::module_& module) {
    module.def("bounding_sphere", [](const HeldBlob& self) {
        return with_status(bounding_sphere(self.blob),
                           [](const Sphere& sphere) { return std::make_tuple(numbers(sphere.center), sphere.radius); });
    });
    module.def("oriented_bounds", [](const HeldBlob& self) {
        return with_status(oriented_bounds(self.blob), [](const OrientedBox& box) {
            return std::make_tuple(numbers(box.center), std::array{numbers(box.half_axes[0]), numbers(box.half_axes[1]),
                                                                   numbers(box.half_axes[2])});
        });
    });
    module.def("k_dop_bounds", [](const HeldBlob& self) {
        return with_status(k_dop_bounds(self.blob), [](const KDop& slabs) {
            std::vector<Numbers> directions;
            for (const Vec3& direction : KDop::directions) directions.push_back(numbers(direction));
            return std::make_tuple(directions, std::vector<float>(slabs.lo, slabs.lo + KDop::count),
                                   std::vector<float>(slabs.hi, slabs.hi + KDop::count));
        });
    });
}

}  // namespace espalier::python
