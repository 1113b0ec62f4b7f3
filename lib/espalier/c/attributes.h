/* Attributes of the structures that C and C++ share. Internal to the library. */
#ifndef ESPALIER_C_ATTRIBUTES_H
#define ESPALIER_C_ATTRIBUTES_H

/* The library is C++ and accesses these structures as its own. This attribute lets them alias, even where a compiler
 * optimises C and C++ together. */
#if defined(__GNUC__)
#define ESPALIER_SHARED_ __attribute__((__may_alias__))
#define ESPALIER_BLOB_ __attribute__((__may_alias__, __aligned__(16)))
#else
#define ESPALIER_SHARED_
#define ESPALIER_BLOB_ __declspec(align(16))
#endif

#endif
