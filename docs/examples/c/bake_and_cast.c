/* Bakes a hill from arrays of a program and casts a batch of rays at it. */
#include <espalier/c/bake.h>
#include <espalier/espalier.h>

#include <stdio.h>

enum { side = 65, cells = side - 1, ray_count = 1000 };

/* Where surveys count from: float32 is exact to 0.5 there, which a blob at that place would show. */
static const double corner[3] = {500000.25, 5400000.75, 300};

static double vertices[side * side][3];
static uint32_t triangles[2 * cells * cells][3];

static void make_hill(void) {
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            double* vertex = vertices[y * side + x];
            const double to_edge = (double)(x * (side - 1 - x) * y * (side - 1 - y));
            vertex[0] = corner[0] + x;
            vertex[1] = corner[1] + y;
            vertex[2] = corner[2] + to_edge / 65536;
        }
    for (uint32_t i = 0; i < cells * cells; ++i) {
        const uint32_t a = i / cells * side + i % cells, b = a + 1, c = a + side, d = c + 1;
        const uint32_t two[2][3] = {{a, b, d}, {a, d, c}};
        for (int k = 0; k < 3; ++k) {
            triangles[2 * i][k] = two[0][k];
            triangles[2 * i + 1][k] = two[1][k];
        }
    }
}

/* Both functions named espalier_init_ set the size of their structure and the defaults. */
static const espalier_bake_result* bake_hill(void) {
    espalier_mesh_view mesh;
    espalier_bake_options options;
    espalier_init_mesh_view(&mesh, sizeof mesh);
    mesh.positions = vertices;
    mesh.position_count = side * side;
    mesh.position_stride = sizeof vertices[0];
    mesh.coordinate_type = ESPALIER_COORDINATE_FLOAT64;
    mesh.triangles = triangles;
    mesh.triangle_count = 2 * cells * cells;
    mesh.name = "hill";
    espalier_init_bake_options(&options, sizeof options);
    options.resolution_kind = ESPALIER_RESOLUTION_TOLERANCE;
    options.resolution = 0.001;
    options.origin.x = corner[0]; /* queries count from here */
    options.origin.y = corner[1];
    options.origin.z = corner[2];
    return espalier_bake(&mesh, 1, &options);
}

/* Rays of one direction: their origins are an array, and the direction has a stride of 0. */
static int cast_rays(const espalier_blob* blob) {
    static float origins[ray_count][3];
    static espalier_ray_hit hits[ray_count];
    static const float down[3] = {0, 0, -1};
    espalier_ray_arrays rays = {
        {origins, sizeof origins[0]}, {down, 0}, {NULL, 0}, {NULL, 0}, ESPALIER_FACE_CULLING_NONE};
    espalier_filled filled;
    int hit_count = 0;
    float highest = 0;
    for (int i = 0; i < ray_count; ++i) {
        origins[i][0] = 32;
        origins[i][1] = (float)i * 0.0625f;
        origins[i][2] = 100;
    }
    filled = espalier_raycast_arrays(blob, &rays, hits, ray_count);
    if (filled.status != ESPALIER_QUERY_OK) {
        fprintf(stderr, "bake_and_cast: %s\n", espalier_describe_query_status(filled.status));
        return 1;
    }
    for (size_t i = 0; i < filled.count; ++i) {
        if (hits[i].status != ESPALIER_QUERY_OK) continue;
        ++hit_count;
        if (100 - hits[i].t > highest) highest = 100 - hits[i].t;
    }
    printf("%d of %d rays hit, the highest point is at %g\n", hit_count, ray_count, (double)highest);
    return 0;
}

int main(void) {
    espalier_blob blob;
    espalier_open_status opened;
    int failed = 1;
    make_hill();
    const espalier_bake_result* baked = bake_hill();
    if (baked->status != ESPALIER_BAKE_OK) {
        fprintf(stderr, "bake_and_cast: %s\n", baked->message); /* what is wrong, where, and what to do */
    } else {
        printf("%u triangles in %u bytes, within %g of the source\n", (unsigned)baked->report->triangles,
               (unsigned)baked->byte_count, baked->report->max_error);
        opened = espalier_open(baked->bytes, baked->byte_count, &blob);
        if (opened == ESPALIER_OPEN_OK) failed = cast_rays(&blob);
        else fprintf(stderr, "bake_and_cast: %s\n", espalier_describe_open_status(opened));
    }
    espalier_release_bake_result(baked); /* the blob is a view of its bytes: it ends here too */
    return failed;
}
