/* What bench/ab calls of a commit. The names and layouts here never change, so that one program measures any two
   commits: each is a shared object that exports espalier_side(). A new kind of query is a new name in the list that
   `kind` searches; an old adapter without it returns null, and the program skips that row. */
#ifndef ESPALIER_BENCH_AB_SIDE_H
#define ESPALIER_BENCH_AB_SIDE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct EspalierSideMesh {
    const char* name;
    const float* positions; /* 3 for each vertex */
    size_t vertices;
    const uint32_t* corners; /* 3 for each triangle */
    size_t triangles;
} EspalierSideMesh;

/* An opened blob. The program owns both parts of memory. */
typedef struct EspalierSideAsset {
    const void* bytes;
    size_t size;
    void* blob; /* blob_bytes of it, aligned to 64 bytes */
} EspalierSideAsset;

/* One kind of query. Questions come as floats, `prepare` converts them, and `run` alone is timed. */
typedef struct EspalierSideKind {
    const char* name;
    size_t floats;         /* of one question */
    size_t question_bytes; /* of one converted question */
    size_t answer_bytes;   /* of one answer */
    void (*prepare)(const float* floats, size_t count, void* questions);
    void (*run)(const EspalierSideAsset* asset, const void* questions, size_t count, void* answers);
    /* One number for each answer: 0 for no and for nothing found; else made of all that does not depend on the order in
       which triangles are stored. */
    void (*digest)(const void* answers, size_t count, uint64_t* digests);
} EspalierSideKind;

typedef struct EspalierSide {
    const char* compiler; /* with the flags that both sides have in common */
    /* Bakes at `bits` for the largest extent and calls `take` once with the bytes. Returns null, or why it failed. */
    const char* (*bake)(const EspalierSideMesh* mesh, const char* profile, unsigned bits,
                        void (*take)(void* to, const void* bytes, size_t size), void* to);
    size_t blob_bytes;
    /* Returns null, or why the bytes were refused. */
    const char* (*open)(EspalierSideAsset* asset);
    /* Selects the instruction set of all later calls: scalar, sse42, avx2, avx512, neon, or best. Returns the name of
       the one selected, or null where the processor or the commit has no such set. */
    const char* (*use_set)(const char* set);
    /* Returns null for a name that this commit has no query for. */
    const EspalierSideKind* (*kind)(const char* name);
} EspalierSide;

typedef const EspalierSide* (*EspalierSideFunction)(void);

#ifdef __cplusplus
}
#endif

#endif
