/* The version of these headers; espalier_abi() returns that of the library. Counterpart of version.hpp. */
#ifndef ESPALIER_C_VERSION_H
#define ESPALIER_C_VERSION_H

#define ESPALIER_VERSION "0.1.0"
#define ESPALIER_VERSION_MAJOR 0
#define ESPALIER_VERSION_MINOR 1
#define ESPALIER_VERSION_PATCH 0

#endif
