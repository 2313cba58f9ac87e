/* Scenes: two flat panels of different cut, a disc and an ellipse of the same perimeter, sewn rim to rim. SI units. */
#include "examples/scene.h"

#include <math.h>

enum { PART_DISC = 1, PART_ELLIPSE, RIM_POINTS = 4096, DISC_NODES = 10000, ELLIPSE_NODES = 20000 };

static const double PI = 3.14159265358979323846;

/* The rim of an ellipse of half axes a, b as a function of the length along it. */
typedef struct Rim {
    double a, b, length[RIM_POINTS + 1];
} Rim;

static void measure_rim(Rim *rim)
{
    rim->length[0] = 0;
    for (int i = 0; i < RIM_POINTS; i++) {
        double t = 2 * PI * i / RIM_POINTS, u = 2 * PI * (i + 1) / RIM_POINTS;
        rim->length[i + 1] = rim->length[i] + hypot(rim->a * (cos(u) - cos(t)), rim->b * (sin(u) - sin(t)));
    }
}

/* The point at a share of the perimeter. */
static void rim_point(const Rim *rim, double share, double x[2])
{
    double want = share * rim->length[RIM_POINTS];
    int low = 0, high = RIM_POINTS;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        *(rim->length[middle] <= want ? &low : &high) = middle;
    }
    double t = 2 * PI / RIM_POINTS * (low + (want - rim->length[low]) / (rim->length[low + 1] - rim->length[low]));
    x[0] = rim->a * cos(t);
    x[1] = rim->b * sin(t);
}

/* The half axes of the ellipse whose shorter one has this share of the longer, with the perimeter of a circle. */
static void fit_rim(Rim *rim, double share, double radius)
{
    rim->a = 1;
    rim->b = share;
    measure_rim(rim);
    rim->a = 2 * PI * radius / rim->length[RIM_POINTS];
    rim->b = share * rim->a;
    measure_rim(rim);
}

/* Reference of the shells of one part: nodes of their own, those of the disc mapped to the panel's cut. disc: its
 * nodes come first. */
static void write_panel(SceneText *deck, const SceneMesh *mesh, int part, int disc, int offset, const Rim *cut,
                        double radius)
{
    scene_print(deck, "$ the panel as it was cut\n*NODE\n");
    for (int i = 0; i < mesh->node_count; i++) {
        const double *x = mesh->x + 3 * i;
        double r = hypot(x[0], x[1]) / radius, share = atan2(x[1], x[0]) / (2 * PI), edge[2];
        if (r < 1 - 1e-9 && (i < disc) != (part == PART_DISC)) continue; /* inside of the other panel */
        rim_point(cut, share < 0 ? share + 1 : share, edge);
        scene_print(deck, "%8d%16.9g%16.9g%16d\n", offset + i + 1, r * edge[0], r * edge[1], 0);
    }
    scene_print(deck, "*AIRBAG_SHELL_REFERENCE_GEOMETRY_RDT\n$    eid     pid      n1      n2      n3      n4\n");
    for (int e = 0; e < mesh->shell_count; e++) {
        if (mesh->part[e] != part) continue;
        const int *n = mesh->shell[e];
        scene_print(deck, "%8d%8d%8d%8d%8d%8d\n", e + 1, part, offset + n[0] + 1, offset + n[1] + 1, offset + n[2] + 1,
                    offset + n[3] + 1);
    }
}

void scene_sewn_bag(Scene *scene, int n)
{
    const double radius = 0.3, start = 0.4;
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    scene_add_disc(mesh, PART_DISC, SCENE_DIAGONAL, n > 0 ? n : 16, radius);
    int disc = mesh->node_count;
    scene_sew_copy(mesh, PART_ELLIPSE, scene_select_radius, &radius);

    scene_begin(deck, "disc and ellipse of one perimeter, sewn and inflated", 0.150, 0.9);
    scene_write_output(deck, 1e-3, 1e-3, 5e-3);
    scene_write_part(deck, PART_DISC, 1, 1, "disc");
    scene_write_part(deck, PART_ELLIPSE, 1, 1, "ellipse");
    scene_write_section(deck, 1, 9, 4e-4);
    SceneFabric fabric = scene_isotropic(2, true, 800, 4e8, 0.4);
    fabric.damp = 0.05;
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 2, (const int[]){PART_DISC, PART_ELLIPSE});
    scene_print(deck, "$ cold air: 0.0344 kg in 100 ms at 296 K\n");
    scene_write_curve(deck, 1, 5, (const double[]){0, 0, 0.020, 0.43, 0.080, 0.43, 0.100, 0, 0.150, 0});
    SceneGas gas = scene_air(101325, 296.15);
    gas.inflow_temperature = 296.15;
    gas.inflow_curve = 1;
    scene_write_simple_airbag(deck, 1, &gas);
    scene_write_damping(deck, 0, 30);
    Rim circle = {.a = radius, .b = radius}, ellipse;
    measure_rim(&circle);
    fit_rim(&ellipse, 0.5, radius);
    write_panel(deck, mesh, PART_DISC, disc, DISC_NODES, &circle, radius);
    write_panel(deck, mesh, PART_ELLIPSE, disc, ELLIPSE_NODES, &ellipse, radius);
    for (int i = 0; i < mesh->node_count; i++) { /* the mesh: small, a thin lens */
        double *x = mesh->x + 3 * i, r = hypot(x[0], x[1]) / radius;
        x[2] = (i < disc ? 0.01 : -0.01) * (1 - r * r);
        x[0] *= start;
        x[1] *= start;
    }
    scene_end(deck, mesh);
}
