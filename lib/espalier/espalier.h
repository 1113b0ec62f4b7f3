/* Espalier for C99: every query of the C++ library, with the same results, bit for bit.
 *
 * Each header in espalier/c is the counterpart of the C++ header of the same name, such as ray.h of ray.hpp. It states
 * what each call does; arguments, refusals, costs and numerics are described in the C++ header and hold for both. Where
 * C++ overloads a function, the name in C ends in the shape (espalier_overlaps_box) or, with a filter, in _filtered.
 * Functions on scenes begin with espalier_scene_ and take a mask, and most of them a filter. Functions on moving scenes
 * begin with espalier_moving_scene_, those on deformable meshes with espalier_deformable_.
 *
 * Threads. Any number of threads may query the same blob or scene. Functions use no heap.
 *
 * Structures. They have the fields of the C++ structures and no destructor. A blob is a value, and so is a scene: put
 * it on the stack, into static storage or into a structure of yours, and copy it freely. Its type states that it is
 * aligned to 16 bytes; malloc() of 32-bit machines aligns to only 8. Enumerations are integers of one byte, and
 * visitors return an int.
 *
 * Arguments. Any number and any value of an enumeration is safe. Pointers must be valid, and results must not overlap
 * arguments. Null is valid only for `user`, which is passed on; for arrays without elements; for the counters of
 * approximate.h; for a filter, which then keeps all triangles or pairs; and for a visitor, in which case the query is
 * refused with ESPALIER_QUERY_INVALID_ARGUMENT.
 *
 * Linking takes only a C compiler: the library needs neither libc nor the C++ library. */
#ifndef ESPALIER_ESPALIER_H
#define ESPALIER_ESPALIER_H

#include <espalier/c/abi.h>
#include <espalier/c/approximate.h>
#include <espalier/c/batches/arrays.h>
#include <espalier/c/batches/lookups.h>
#include <espalier/c/batches/rays.h>
#include <espalier/c/batches/shapes.h>
#include <espalier/c/blob.h>
#include <espalier/c/bounds.h>
#include <espalier/c/contact.h>
#include <espalier/c/deformation.h>
#include <espalier/c/distance.h>
#include <espalier/c/advanced/lattice.h>
#include <espalier/c/original.h>
#include <espalier/c/overlap.h>
#include <espalier/c/pair.h>
#include <espalier/c/ray.h>
#include <espalier/c/advanced/rounding.h>
#include <espalier/c/scene.h>
#include <espalier/c/scenes/contacts.h>
#include <espalier/c/scenes/moving_scene.h>
#include <espalier/c/scenes/pairs.h>
#include <espalier/c/shapes.h>
#include <espalier/c/advanced/statistics.h>
#include <espalier/c/status.h>
#include <espalier/c/sweep.h>
#include <espalier/c/transform.h>
#include <espalier/c/types.h>
#include <espalier/c/visitor.h>
#include <espalier/c/walk.h>

#endif
