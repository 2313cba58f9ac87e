/* Small surface meshes for the tests of the bag's surface: builders, and one call that closes a mesh. */
#ifndef SURFACE_MESHES_H
#define SURFACE_MESHES_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "airbag/surface.h"
#include "airbag/volume.h"

typedef struct Mesh {
    int node_count, facet_count;
    double *x;      /* (node_count x 3) */
    int32_t *facet; /* (facet_count x 4) */
    int *node_id, *facet_id, *sign;
    SurfaceClosure closure;
    Diagnostics diagnostics;
    int result;
} Mesh;

static inline Mesh mesh_create(int nodes, int facets)
{
    Mesh mesh = {0};
    mesh.x = calloc((size_t)nodes * 3, sizeof *mesh.x);
    mesh.facet = calloc((size_t)facets * 4, sizeof *mesh.facet);
    mesh.node_id = calloc((size_t)nodes, sizeof *mesh.node_id);
    mesh.facet_id = calloc((size_t)facets, sizeof *mesh.facet_id);
    mesh.sign = calloc((size_t)facets, sizeof *mesh.sign);
    return mesh;
}

static inline void mesh_free(Mesh *mesh)
{
    surface_closure_free(&mesh->closure);
    diagnostics_free(&mesh->diagnostics);
    free(mesh->x);
    free(mesh->facet);
    free(mesh->node_id);
    free(mesh->facet_id);
    free(mesh->sign);
}

/* User's ids are 1000 + index for nodes and 5000 + index for facets. */
static inline int add_node(Mesh *mesh, double x, double y, double z)
{
    int n = mesh->node_count++;
    mesh->x[3 * n] = x;
    mesh->x[3 * n + 1] = y;
    mesh->x[3 * n + 2] = z;
    mesh->node_id[n] = 1000 + n;
    return n;
}

static inline int add_quad(Mesh *mesh, int a, int b, int c, int d)
{
    int f = mesh->facet_count++;
    int node[4] = {a, b, c, d};
    for (int i = 0; i < 4; i++) mesh->facet[4 * f + i] = (int32_t)node[i];
    mesh->facet_id[f] = 5000 + f;
    return f;
}

static inline int add_triangle(Mesh *mesh, int a, int b, int c)
{
    return add_quad(mesh, a, b, c, c);
}

static inline void turn_facet(Mesh *mesh, int f)
{
    int32_t *n = mesh->facet + 4 * f, first = n[0];
    bool triangle = n[2] == n[3];
    n[0] = n[2];
    n[2] = first;
    if (triangle) n[3] = first;
}

/* Deterministic shuffle of windings. */
static inline void scramble(Mesh *mesh, unsigned seed)
{
    unsigned state = seed * 2654435761u + 1u;
    for (int f = 0; f < mesh->facet_count; f++) {
        state = state * 1664525u + 1013904223u;
        if (state >> 31) turn_facet(mesh, f);
    }
}

static inline int mesh_close(Mesh *mesh)
{
    SurfaceInput input = {.facet_count = mesh->facet_count,
                          .node = mesh->facet,
                          .facet_id = mesh->facet_id,
                          .x = mesh->x,
                          .node_id = mesh->node_id,
                          .name = "airbag 1",
                          .source = BILLOW_NO_SOURCE,
                          .keyword = "*AIRBAG_SIMPLE_AIRBAG_MODEL"};
    surface_closure_free(&mesh->closure);
    diagnostics_free(&mesh->diagnostics);
    mesh->result = surface_close(&input, mesh->sign, &mesh->closure, &mesh->diagnostics);
    return mesh->result;
}

/* Whether a message of this severity contains all the given words. */
static inline bool said(const Mesh *mesh, Severity severity, const char *one, const char *other)
{
    for (size_t i = 0; i < mesh->diagnostics.count; i++) {
        const Message *message = &mesh->diagnostics.messages[i];
        if (message->severity == severity && strstr(message->text, one) && strstr(message->text, other)) return true;
    }
    for (size_t i = 0; i < mesh->diagnostics.count; i++) printf("said: %s\n", mesh->diagnostics.messages[i].text);
    return false;
}

/* Volume with signs, caps and seams about an origin. */
static inline double mesh_volume(const Mesh *mesh, const double origin[3])
{
    return volume_surface(mesh->facet_count, mesh->facet, mesh->sign, mesh->x, origin) +
           surface_cap_volume(&mesh->closure, mesh->x, origin);
}

/* Closed means: the volume does not depend on the origin. Returns the largest difference over four origins. */
static inline double mesh_leak(const Mesh *mesh)
{
    static const double origins[4][3] = {{0, 0, 0}, {70, 0, 0}, {0, -90, 0}, {0, 0, 110}};
    double worst = 0.0;
    for (int i = 0; i < 4; i++) worst = fmax(worst, fabs(mesh_volume(mesh, origins[i]) - mesh->closure.volume));
    return worst;
}

/* A grid of n x m quads between four corners; node (i, j) is at a + i/n (b - a) + j/m (d - a). Returns its first node.
 */
static inline int add_grid(Mesh *mesh, int n, int m, const double a[3], const double b[3], const double d[3])
{
    int first = mesh->node_count;
    for (int j = 0; j <= m; j++)
        for (int i = 0; i <= n; i++) {
            double p[3];
            for (int k = 0; k < 3; k++) p[k] = a[k] + (b[k] - a[k]) * i / n + (d[k] - a[k]) * j / m;
            add_node(mesh, p[0], p[1], p[2]);
        }
    for (int j = 0; j < m; j++)
        for (int i = 0; i < n; i++) {
            int at = first + j * (n + 1) + i;
            add_quad(mesh, at, at + 1, at + n + 2, at + n + 1);
        }
    return first;
}

/* Replaces coincident nodes by the first of them in all facets. */
static inline void merge_nodes(Mesh *mesh)
{
    for (int i = 0; i < 4 * mesh->facet_count; i++)
        for (int n = 0; n < mesh->facet[i]; n++) {
            const double *a = mesh->x + 3 * n, *b = mesh->x + 3 * mesh->facet[i];
            if (fabs(a[0] - b[0]) + fabs(a[1] - b[1]) + fabs(a[2] - b[2]) > 1e-9) continue;
            mesh->facet[i] = (int32_t)n;
            break;
        }
}

/* The box [x0, x0 + lx] x [0, ly] x [0, lz] of n quads per side; sides with bit set in leave (1 -x, 2 +x, 4 -y, 8 +y,
 * 16 -z, 32 +z) are left out. Outward winding. Call merge_nodes afterwards. */
static inline void add_box(Mesh *mesh, int n, double x0, double lx, double ly, double lz, int leave)
{
    const double o[3] = {x0, 0, 0}, x[3] = {x0 + lx, 0, 0}, y[3] = {x0, ly, 0}, z[3] = {x0, 0, lz};
    const double xy[3] = {x0 + lx, ly, 0}, xz[3] = {x0 + lx, 0, lz}, yz[3] = {x0, ly, lz};
    if (!(leave & 1)) add_grid(mesh, n, n, o, z, y);
    if (!(leave & 2)) add_grid(mesh, n, n, x, xy, xz);
    if (!(leave & 4)) add_grid(mesh, n, n, o, x, z);
    if (!(leave & 8)) add_grid(mesh, n, n, y, yz, xy);
    if (!(leave & 16)) add_grid(mesh, n, n, o, y, x);
    if (!(leave & 32)) add_grid(mesh, n, n, z, xz, yz);
}

#endif
