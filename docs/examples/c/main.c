/* Casts a ray at a baked mesh: cast_ray BLOB ORIGIN_X ORIGIN_Y ORIGIN_Z DIRECTION_X DIRECTION_Y DIRECTION_Z */
#include <espalier/espalier.h>

#include <stdio.h>
#include <stdlib.h>

/* The whole file, or null. A program may as well map it, or carry it in itself: any address will do. */
static void* read_file(const char* path, size_t* size) {
    FILE* file = fopen(path, "rb");
    void* bytes = NULL;
    long length = -1;
    if (file != NULL && fseek(file, 0, SEEK_END) == 0) length = ftell(file);
    if (length > 0) bytes = malloc((size_t)length);
    if (bytes != NULL) {
        rewind(file);
        *size = fread(bytes, 1, (size_t)length, file);
    }
    if (file != NULL) fclose(file);
    return bytes;
}

int main(int argc, char** argv) {
    if (argc != 8) {
        fprintf(stderr, "usage: cast_ray BLOB ORIGIN_X ORIGIN_Y ORIGIN_Z DIRECTION_X DIRECTION_Y DIRECTION_Z\n");
        return 2;
    }
    size_t size = 0;
    void* bytes = read_file(argv[1], &size);
    if (bytes == NULL) {
        fprintf(stderr, "cast_ray: %s cannot be read\n", argv[1]);
        return 2;
    }

    /* The blob is a view of the bytes, which must outlive it. Any bytes are safe: espalier_open() checks them. */
    espalier_blob blob;
    const espalier_open_status status = espalier_open(bytes, size, &blob);
    if (status != ESPALIER_OPEN_OK) {
        fprintf(stderr, "cast_ray: %s: %s\n", argv[1], espalier_describe_open_status(status));
        free(bytes);
        return 1;
    }

    float numbers[6];
    for (int i = 0; i < 6; ++i) {
        char* end = NULL;
        numbers[i] = strtof(argv[2 + i], &end);
        if (end == argv[2 + i] || *end != '\0') {
            fprintf(stderr, "cast_ray: \"%s\" is not a number\n", argv[2 + i]);
            free(bytes);
            return 2;
        }
    }
    const espalier_vec3 origin = {numbers[0], numbers[1], numbers[2]};
    const espalier_vec3 direction = {numbers[3], numbers[4], numbers[5]};
    const espalier_ray ray = espalier_default_ray(origin, direction);
    const espalier_ray_hit hit = espalier_raycast(&blob, &ray);
    free(bytes);
    /* A refusal is not a miss, although both have an infinite t and no triangle. */
    if (espalier_is_refused(hit.status)) {
        fprintf(stderr, "cast_ray: %s\n", espalier_describe_query_status(hit.status));
        return 1;
    }
    if (hit.status == ESPALIER_QUERY_OK)
        printf("hit triangle %u at t = %g, normal %g %g %g\n", (unsigned)hit.triangle, (double)hit.t,
               (double)hit.normal.x, (double)hit.normal.y, (double)hit.normal.z);
    else printf("no hit\n");
    return 0;
}
