// Everything that answers from a blob. No heap, no exceptions, no libc. The baker is apart: <espalier/bake.hpp>.
#pragma once

#include <espalier/approximate.hpp>
#include <espalier/blob.hpp>
#include <espalier/bounds.hpp>
#include <espalier/collide.hpp>
#include <espalier/contact.hpp>
#include <espalier/inside.hpp>
#include <espalier/lattice.hpp>
#include <espalier/nearest.hpp>
#include <espalier/original.hpp>
#include <espalier/overlap.hpp>
#include <espalier/ray.hpp>
#include <espalier/rounded_ray.hpp>
#include <espalier/rounding.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/sweep.hpp>
#include <espalier/types.hpp>
#include <espalier/version.hpp>
#include <espalier/walk.hpp>
