// What the namespace of an instruction set offers, for a fragment (.inl) of this folder that is parsed alone.
#pragma once

#include <runtime/blob/alone.hpp>
#include <runtime/lanes/fragments.hpp>

inline constexpr unsigned lanes = 4;
using Floats = Vector<float, lanes>;
using Ints = Vector<std::uint32_t, lanes>;
using SignedInts = Vector<std::int32_t, lanes>;
using WideInts = Vector<std::uint64_t, lanes / 2>;
using Compared = SignedInts;
using Axes = Vector<float, 4>;
using AxisInts = Vector<std::int32_t, 4>;
unsigned bits_of(SignedInts comparison);
Ints load_bytes(const std::byte* at);
Ints load_words(const std::byte* at);
Ints load_ints(const std::uint32_t* from);
Ints shuffle_bytes(const std::byte* bytes, const std::uint8_t* numbers);
Floats splat(float x);
Floats to_floats(Ints a);
Floats bytes_to_floats(const std::byte* at);
void store(float* to, Floats a);
Floats square_roots(Floats a);
Floats multiply_add(Floats a, Floats b, Floats c);
template <class To, class From>
To load_as(const From* from);
template <class FloatTable>
struct PairTableIn;
Axes words_to_axes(const std::byte* at);
Axes bytes_to_axes(std::uint32_t bytes);
template <int x, int y, int z>
AxisInts shift_left_each(const std::byte* word);
template <class Vector>
void store_axes(void* to, Vector a);
WideInts multiply_even(WideInts a, std::int32_t b);
template <unsigned shift>
void store_fields(std::uint32_t* to, const std::uint64_t* words);
