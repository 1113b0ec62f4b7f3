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

    /* The blob is a view of the bytes, which must outlive it. Whoever made them: opened means safe. */
    espalier_blob blob;
    const espalier_status status = espalier_open(bytes, size, &blob);
    if (status != ESPALIER_STATUS_OK) {
        fprintf(stderr, "cast_ray: %s: %s\n", argv[1], espalier_describe_status(status));
        free(bytes);
        return 1;
    }

    float numbers[6];
    for (int i = 0; i < 6; ++i) numbers[i] = strtof(argv[2 + i], NULL);
    const espalier_vec3 origin = {numbers[0], numbers[1], numbers[2]};
    const espalier_vec3 direction = {numbers[3], numbers[4], numbers[5]};
    const espalier_ray ray = espalier_ray_from(origin, direction);
    espalier_ray_hit hit;
    if (espalier_raycast(&blob, &ray, &hit))
        printf("hit triangle %u at t = %g, normal %g %g %g\n", (unsigned)hit.triangle, (double)hit.t,
               (double)hit.normal.x, (double)hit.normal.y, (double)hit.normal.z);
    else printf("no hit\n");
    free(bytes);
    return 0;
}
