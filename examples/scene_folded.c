/* Scenes: a square bag folded in eight layers that unfolds against itself. SI units. */
#include "examples/scene.h"

#include <math.h>

enum { PART_TOP = 1, PART_BOTTOM, PANELS = 4 };

typedef struct Fold {
    double width, gap; /* of a panel; between neighbouring layers [L] */
} Fold;

/* A point of the flat bag at (s, t), layer 0 below and 1 above, in the zigzag: panels lie on each other in turn to the
 * right and to the left. The sheet that is outside at a fold goes round the one inside by a layer's gap. */
static void fold_point(const Fold *f, double s, double t, int layer, double x[3])
{
    int panel = (int)floor(s / f->width);
    double along = s / f->width - panel, crease = s / f->width;
    if (panel >= PANELS) panel = PANELS - 1;
    if (fabs(crease - round(crease)) < 1e-9 && round(crease) > 0.5 && round(crease) < PANELS - 0.5) {
        int k = (int)round(crease); /* between panels k - 1 and k */
        bool right = k % 2 == 1, outside = (layer == 0) == right;
        x[0] = right ? f->width : 0.0;
        if (outside) x[0] += right ? f->gap : -f->gap;
        x[2] = (2 * k - 0.5) * f->gap;
    } else {
        along = s / f->width - panel;
        bool turned = panel % 2 == 1;
        x[0] = turned ? f->width * (1.0 - along) : f->width * along;
        x[2] = (2 * panel + (turned ? 1 - layer : layer)) * f->gap;
    }
    x[1] = t;
}

static int sheet_node(int n, int i, int j)
{
    return i * (n + 1) + j;
}

void scene_folded_bag(Scene *scene, int n, double gap)
{
    const double side = 0.6, thickness = 3.5e-4;
    int cells = n > 0 ? n : 72;
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    Fold fold = {side / PANELS, gap > 0 ? gap : thickness};
    deck->exact = true;
    cells = (cells + PANELS - 1) / PANELS * PANELS;
    int node[2] = {0, 0};
    for (int layer = 0; layer < 2; layer++) {
        node[layer] = mesh->node_count;
        for (int i = 0; i <= cells; i++)
            for (int j = 0; j <= cells; j++) {
                double x[3];
                fold_point(&fold, side * i / cells, side * j / cells, layer, x);
                scene_add_node(mesh, x[0], x[1], x[2]);
            }
    }
    for (int layer = 0; layer < 2; layer++)
        for (int i = 0; i < cells; i++)
            for (int j = 0; j < cells; j++) {
                int a[4] = {sheet_node(cells, i, j), sheet_node(cells, i + 1, j), sheet_node(cells, i + 1, j + 1),
                            sheet_node(cells, i, j + 1)};
                for (int k = 0; k < 4; k++) {
                    int row = a[k] / (cells + 1), column = a[k] % (cells + 1);
                    bool rim = row == 0 || row == cells || column == 0 || column == cells;
                    a[k] += rim ? node[0] : node[layer]; /* the rim is a seam: nodes of the lower sheet */
                }
                if (layer == 1) {
                    scene_add_shell(mesh, PART_TOP, a[0], a[1], a[2], a[2]);
                    scene_add_shell(mesh, PART_TOP, a[0], a[2], a[3], a[3]);
                } else {
                    scene_add_shell(mesh, PART_BOTTOM, a[0], a[2], a[1], a[1]);
                    scene_add_shell(mesh, PART_BOTTOM, a[0], a[3], a[2], a[2]);
                }
            }
    scene_begin(deck, "square bag folded in eight layers", 0.030, 0.9);
    scene_write_output(deck, 1e-4, 1e-4, 1e-3);
    scene_write_part(deck, PART_TOP, 1, 1, "upper panel");
    scene_write_part(deck, PART_BOTTOM, 1, 1, "lower panel");
    scene_write_section(deck, 1, 9, thickness);
    SceneFabric fabric = {.form = 0,
                          .cse = true,
                          .density = 800,
                          .ea = 3e8,
                          .eb = 2.5e8,
                          .gab = 1.5e7,
                          .prba = 0.25,
                          .prab = 0.3,
                          .damp = 0.05};
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 2, (const int[]){PART_TOP, PART_BOTTOM});
    scene_write_curve(deck, 1, 4, (const double[]){0, 0, 0.003, 3.0, 0.015, 2.0, 0.030, 0});
    SceneGas gas = {.gamma = 1.4,
                    .molar_mass = 0.0280134,
                    .pressure = 101325,
                    .temperature = 296.15,
                    .inflow_temperature = 600,
                    .inflow_curve = 1,
                    .vent_coefficient = 0.65,
                    .vent_area = 1e-3};
    scene_write_wang_nefske(deck, 1, &gas);
    scene_print(deck, "*CONTACT_AIRBAG_SINGLE_SURFACE\n");
    SCENE_CARD(deck, 0, 0, 5);
    SCENE_CARD(deck, 0.2, 0.2, 0, 0, 10);
    SCENE_CARD(deck, 1, 1);
    scene_end(deck, mesh);
}
