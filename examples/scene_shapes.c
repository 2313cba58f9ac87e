/* Scene meshes as shapes: grid, disc, ring, sphere, torus, tube, box. */
#include "examples/scene.h"

#include <math.h>

#include "solver/elementary.h"

#define PI 3.14159265358979323846

void scene_add_grid(SceneMesh *mesh, int part, ScenePattern pattern, int nx, int ny, SceneMap *map, const void *user)
{
    int first = mesh->node_count;
    for (int j = 0; j <= ny; j++) {
        for (int i = 0; i <= nx; i++) {
            double x[3];
            map(user, (double)i / nx, (double)j / ny, x);
            scene_add_node(mesh, x[0], x[1], x[2]);
        }
    }
    for (int j = 0; j < ny; j++) {
        for (int i = 0; i < nx; i++) {
            int a = first + j * (nx + 1) + i, b = a + 1, d = a + nx + 1, c = d + 1;
            if (pattern == SCENE_QUADS) {
                scene_add_shell(mesh, part, a, b, c, d);
            } else if (pattern == SCENE_DIAGONAL) {
                scene_add_shell(mesh, part, a, b, c, c);
                scene_add_shell(mesh, part, a, c, d, d);
            } else if (pattern == SCENE_ACROSS) {
                scene_add_shell(mesh, part, a, b, d, d);
                scene_add_shell(mesh, part, b, c, d, d);
            } else {
                double x[3];
                map(user, (i + 0.5) / nx, (j + 0.5) / ny, x);
                int m = scene_add_node(mesh, x[0], x[1], x[2]);
                scene_add_shell(mesh, part, a, b, m, m);
                scene_add_shell(mesh, part, b, c, m, m);
                scene_add_shell(mesh, part, c, d, m, m);
                scene_add_shell(mesh, part, d, a, m, m);
            }
        }
    }
}

static void map_rectangle(const void *user, double s, double t, double x[3])
{
    const double *size = user;
    x[0] = size[0] * s;
    x[1] = size[1] * t;
    x[2] = 0;
}

void scene_add_rectangle(SceneMesh *mesh, int part, ScenePattern pattern, int nx, int ny, double lx, double ly)
{
    scene_add_grid(mesh, part, pattern, nx, ny, map_rectangle, (const double[2]){lx, ly});
}

/* Node j of ring i (6 i nodes) in the numbering of the triangle disc: centre 0, then ring after ring. */
static int ring_node(int first, int i, int j)
{
    return i == 0 ? first : first + 1 + 3 * i * (i - 1) + j % (6 * i);
}

static void add_triangle_disc(SceneMesh *mesh, int part, int n, double radius)
{
    int first = scene_add_node(mesh, 0, 0, 0);
    for (int i = 1; i <= n; i++) {
        for (int j = 0; j < 6 * i; j++) {
            double angle = 2 * PI * j / (6.0 * i), r = radius * i / n;
            scene_add_node(mesh, r * elementary_cos(angle), r * elementary_sin(angle), 0);
        }
    }
    for (int i = 1; i <= n; i++) {
        for (int sector = 0; sector < 6; sector++) {
            for (int j = 0; j < i; j++) {
                int a = ring_node(first, i, sector * i + j), b = ring_node(first, i, sector * i + j + 1);
                int c = ring_node(first, i - 1, sector * (i - 1) + j);
                scene_add_shell(mesh, part, a, b, c, c);
                if (j + 1 == i) continue;
                int d = ring_node(first, i - 1, sector * (i - 1) + j + 1);
                scene_add_shell(mesh, part, c, b, d, d);
            }
        }
    }
}

typedef struct DiscBlock {
    double radius;
    int quarter; /* 0..3 turns of the outer block */
} DiscBlock;

enum { CORE_PERCENT = 50, BULGE_PERCENT = 40 }; /* size of the O-grid's core and how round its edge is */

/* The core block: a square whose edge bulges towards the circle. s, t in [-1, 1], unit disc. */
static void core_point(double s, double t, double x[2])
{
    double core = CORE_PERCENT / 100.0, reach = fmax(fabs(s), fabs(t)), bulge = BULGE_PERCENT / 100.0 * reach;
    double angle, direction[2] = {0, 0};
    if (fabs(s) >= fabs(t) && s != 0) {
        angle = PI / 4 * t / s;
        direction[0] = (s > 0 ? 1 : -1) * elementary_cos(angle);
        direction[1] = (s > 0 ? 1 : -1) * elementary_sin(angle);
    } else if (t != 0) {
        angle = PI / 4 * s / t;
        direction[0] = (t > 0 ? 1 : -1) * elementary_sin(angle);
        direction[1] = (t > 0 ? 1 : -1) * elementary_cos(angle);
    }
    x[0] = core * ((1 - bulge) * s + bulge * 1.25 * reach * direction[0]);
    x[1] = core * ((1 - bulge) * t + bulge * 1.25 * reach * direction[1]);
}

static void map_core(const void *user, double s, double t, double x[3])
{
    double point[2];
    core_point(2 * s - 1, 2 * t - 1, point);
    x[0] = ((const DiscBlock *)user)->radius * point[0];
    x[1] = ((const DiscBlock *)user)->radius * point[1];
    x[2] = 0;
}

static void map_outer(const void *user, double s, double t, double x[3])
{
    const DiscBlock *block = user;
    double inner[2], angle = PI / 4 * (2 * t - 1);
    core_point(1, 2 * t - 1, inner);
    double u = (1 - s) * inner[0] + s * elementary_cos(angle), v = (1 - s) * inner[1] + s * elementary_sin(angle);
    for (int k = 0; k < block->quarter; k++) {
        double swap = u;
        u = -v;
        v = swap;
    }
    x[0] = block->radius * u;
    x[1] = block->radius * v;
    x[2] = 0;
}

void scene_add_disc(SceneMesh *mesh, int part, ScenePattern pattern, int n, double radius)
{
    if (pattern == SCENE_DIAGONAL) {
        add_triangle_disc(mesh, part, n, radius);
        return;
    }
    int first = mesh->node_count, half = n > 1 ? (n + 1) / 2 : 1, outer = n - half > 0 ? n - half : 1;
    DiscBlock block = {radius, 0};
    scene_add_grid(mesh, part, pattern, 2 * half, 2 * half, map_core, &block);
    for (block.quarter = 0; block.quarter < 4; block.quarter++)
        scene_add_grid(mesh, part, pattern, outer, 2 * half, map_outer, &block);
    scene_weld(mesh, first, 1e-6 * radius / n);
}

static void map_ring(const void *user, double s, double t, double x[3])
{
    const double *radii = user;
    double r = radii[0] + s * (radii[1] - radii[0]), angle = 2 * PI * t;
    x[0] = r * elementary_cos(angle);
    x[1] = r * elementary_sin(angle);
    x[2] = 0;
}

void scene_add_ring(SceneMesh *mesh, int part, ScenePattern pattern, int nr, int nt, double inner, double outer)
{
    int first = mesh->node_count;
    scene_add_grid(mesh, part, pattern, nr, nt, map_ring, (const double[2]){inner, outer});
    scene_weld(mesh, first, 1e-6 * inner / nt);
}

static void project_to_sphere(SceneMesh *mesh, int first, double radius)
{
    for (int i = first; i < mesh->node_count; i++) {
        double *x = mesh->x + 3 * i, length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
        for (int c = 0; c < 3; c++) x[c] *= radius / length;
    }
}

/* Face k of the icosahedron divided n times along its edges. */
static void add_icosahedron_face(SceneMesh *mesh, int part, int n, const double corner[3][3])
{
    int first = mesh->node_count;
    for (int j = 0; j <= n; j++) {
        for (int i = 0; i <= n - j; i++) {
            double s = (double)i / n, t = (double)j / n, x[3];
            for (int c = 0; c < 3; c++) x[c] = (1 - s - t) * corner[0][c] + s * corner[1][c] + t * corner[2][c];
            scene_add_node(mesh, x[0], x[1], x[2]);
        }
    }
    int row = first;
    for (int j = 0; j < n; j++) {
        int width = n - j + 1, next = row + width;
        for (int i = 0; i < n - j; i++) {
            scene_add_shell(mesh, part, row + i, row + i + 1, next + i, next + i);
            if (i + 1 < n - j) scene_add_shell(mesh, part, row + i + 1, next + i + 1, next + i, next + i);
        }
        row = next;
    }
}

static void add_icosahedron(SceneMesh *mesh, int part, int n)
{
    static const int face[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    const double g = (1 + sqrt(5)) / 2;
    const double vertex[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (int f = 0; f < 20; f++) {
        double corner[3][3];
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++) corner[k][c] = vertex[face[f][k]][c];
        add_icosahedron_face(mesh, part, n, (const double(*)[3])corner);
    }
}

/* Side k of a cube, equal angles seen from the centre. */
static void map_cube_side(const void *user, double s, double t, double x[3])
{
    int side = *(const int *)user, axis = side % 3;
    double angle_s = PI / 4 * (2 * s - 1), angle_t = PI / 4 * (2 * t - 1);
    double u = elementary_sin(angle_s) / elementary_cos(angle_s), v = elementary_sin(angle_t) / elementary_cos(angle_t);
    double sign = side < 3 ? 1 : -1;
    x[axis] = sign;
    x[(axis + 1) % 3] = sign > 0 ? u : v; /* the swap keeps the normal outwards */
    x[(axis + 2) % 3] = sign > 0 ? v : u;
}

void scene_add_sphere(SceneMesh *mesh, int part, ScenePattern pattern, int n, double radius)
{
    int first = mesh->node_count;
    if (pattern == SCENE_QUADS)
        for (int side = 0; side < 6; side++) scene_add_grid(mesh, part, SCENE_QUADS, n, n, map_cube_side, &side);
    else
        add_icosahedron(mesh, part, n);
    scene_weld(mesh, first, 1e-3 / n);
    project_to_sphere(mesh, first, radius);
}

static void map_torus(const void *user, double s, double t, double x[3])
{
    const double *radii = user;
    double around = 2 * PI * s, section = 2 * PI * t, r = radii[0] + radii[1] * elementary_cos(section);
    x[0] = r * elementary_cos(around);
    x[1] = r * elementary_sin(around);
    x[2] = radii[1] * elementary_sin(section);
}

void scene_add_torus(SceneMesh *mesh, int part, ScenePattern pattern, int n_minor, int n_major, double major,
                     double minor)
{
    int first = mesh->node_count;
    scene_add_grid(mesh, part, pattern, n_major, n_minor, map_torus, (const double[2]){major, minor});
    scene_weld(mesh, first, 1e-6 * minor / (n_minor + n_major));
}

static void map_tube(const void *user, double s, double t, double x[3])
{
    const double *size = user;
    x[0] = size[0] * elementary_cos(2 * PI * s);
    x[1] = size[0] * elementary_sin(2 * PI * s);
    x[2] = size[1] * t;
}

void scene_add_tube(SceneMesh *mesh, int part, ScenePattern pattern, int nz, int nt, double radius, double length)
{
    int first = mesh->node_count;
    scene_add_grid(mesh, part, pattern, nt, nz, map_tube, (const double[2]){radius, length});
    scene_weld(mesh, first, 1e-6 * radius / nt);
}

void scene_add_box(SceneMesh *mesh, int bottom, int lid, int wall, double a, double b, double c)
{
    int n[8];
    for (int k = 0; k < 8; k++) {
        int corner = k % 4;
        n[k] = scene_add_node(mesh, corner == 1 || corner == 2 ? a : 0, corner >= 2 ? b : 0, k < 4 ? 0 : c);
    }
    scene_add_shell(mesh, bottom, n[0], n[3], n[2], n[1]);
    scene_add_shell(mesh, lid, n[4], n[5], n[6], n[7]);
    for (int k = 0; k < 4; k++) {
        int next = (k + 1) % 4;
        scene_add_shell(mesh, wall, n[k], n[next], n[next + 4], n[k + 4]);
    }
}
