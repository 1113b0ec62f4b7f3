// The rays of a batch.
#pragma once

#include <espalier/batches/rays.hpp>

#include "floats.hpp"

namespace espalier::python {

/// The rays of a batch. Those for a blob with an origin begin in the coordinates of the source.
struct Rays {
    Floats origins;
    Floats directions;
    Floats t_min;
    Floats t_max;
    Batch batch;
    RayArrays arrays;

    Rays(const py::handle& given_origins, const py::handle& given_directions, const py::handle& given_t_min,
         const py::handle& given_t_max, int culling, const Origin& origin = {})
        : origins(given_origins, "origins", {3}, origin),
          directions(given_directions, "directions", {3}),
          t_min(given_t_min, "t_min", {}),
          t_max(given_t_max, "t_max", {}),
          batch({&origins, &directions, &t_min, &t_max}),
          arrays{origins.as<Vec3>(), directions.as<Vec3>(), t_min.as<float>(), t_max.as<float>(),
                 static_cast<FaceCulling>(culling)} {}
};

}  // namespace espalier::python
