// The options of sweeps as Python gives them.
#pragma once

#include <tuple>

#include <pybind11/stl.h>

#include <espalier/types.hpp>

namespace espalier::python {

/// The number of the face culling, ignore_leaving, and the skin.
using GivenSweepOptions = std::tuple<int, bool, float>;

/// Returns them as SweepOptions or SceneSweepOptions.
template <class Options>
Options sweep_options(const GivenSweepOptions& given) {
    Options options;
    options.culling = static_cast<FaceCulling>(std::get<0>(given));
    options.ignore_leaving = std::get<1>(given);
    options.skin = std::get<2>(given);
    return options;
}

}  // namespace espalier::python
