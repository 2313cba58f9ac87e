/* Scenes: a square bag folded in eight layers that unfolds against itself; the same brought to rest. SI units. */
#include "examples/scene.h"

#include <math.h>

enum { PART_TOP = 1, PART_BOTTOM, PANELS = 4 };

static const double side = 0.6, thickness = 3.5e-4;

/* A folded square of cells x cells squares a side, and how far the sheet outside at a fold goes beyond the panel. */
typedef struct Fold {
    int cells;
    double width, gap; /* of a panel; between neighbouring layers [L] */
    double beyond;     /* [L] */
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
        double beyond = outside ? f->beyond : f->beyond - f->gap;
        x[0] += right ? beyond : -beyond;
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

/* Nodes of both sheets, the lower first, flat or folded. */
static void add_nodes(SceneMesh *mesh, const Fold *fold, bool flat)
{
    for (int layer = 0; layer < 2; layer++)
        for (int i = 0; i <= fold->cells; i++)
            for (int j = 0; j <= fold->cells; j++) {
                double s = side * i / fold->cells, t = side * j / fold->cells, x[3] = {s, t, layer * fold->gap};
                if (!flat) fold_point(fold, s, t, layer, x);
                scene_add_node(mesh, x[0], x[1], x[2]);
            }
}

/* Shells of both sheets; the rim is a seam: nodes of the lower sheet. */
static void add_shells(SceneMesh *mesh, ScenePattern pattern, int cells)
{
    int upper = (cells + 1) * (cells + 1);
    for (int layer = 0; layer < 2; layer++)
        for (int i = 0; i < cells; i++)
            for (int j = 0; j < cells; j++) {
                int a[4] = {sheet_node(cells, i, j), sheet_node(cells, i + 1, j), sheet_node(cells, i + 1, j + 1),
                            sheet_node(cells, i, j + 1)};
                for (int k = 0; k < 4; k++) {
                    int row = a[k] / (cells + 1), column = a[k] % (cells + 1);
                    bool rim = row == 0 || row == cells || column == 0 || column == cells;
                    if (layer == 1 && !rim) a[k] += upper;
                }
                if (pattern == SCENE_QUADS && layer == 1) {
                    scene_add_shell(mesh, PART_TOP, a[0], a[1], a[2], a[3]);
                } else if (pattern == SCENE_QUADS) {
                    scene_add_shell(mesh, PART_BOTTOM, a[0], a[3], a[2], a[1]);
                } else if (layer == 1) {
                    scene_add_shell(mesh, PART_TOP, a[0], a[1], a[2], a[2]);
                    scene_add_shell(mesh, PART_TOP, a[0], a[2], a[3], a[3]);
                } else {
                    scene_add_shell(mesh, PART_BOTTOM, a[0], a[2], a[1], a[1]);
                    scene_add_shell(mesh, PART_BOTTOM, a[0], a[3], a[2], a[2]);
                }
            }
}

static void write_parts(SceneText *deck, int form)
{
    scene_write_part(deck, PART_TOP, 1, 1, "upper panel");
    scene_write_part(deck, PART_BOTTOM, 1, 1, "lower panel");
    scene_write_section(deck, 1, 9, thickness);
    SceneFabric fabric = {.form = form,
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
}

static const SceneGas gas = {.gamma = 1.4,
                             .molar_mass = 0.0280134,
                             .pressure = 101325,
                             .temperature = 296.15,
                             .inflow_temperature = 600,
                             .inflow_curve = 1,
                             .vent_coefficient = 0.65};

static void write_contact(SceneText *deck)
{
    scene_print(deck, "*CONTACT_AIRBAG_SINGLE_SURFACE\n");
    SCENE_CARD(deck, 0, 0, 5);
    SCENE_CARD(deck, 0.2, 0.2, 0, 0, 10);
    SCENE_CARD(deck, 1, 1);
}

static int even_cells(int n)
{
    return ((n > 0 ? n : 72) + PANELS - 1) / PANELS * PANELS;
}

void scene_folded_bag(Scene *scene, ScenePattern pattern, int n, double gap)
{
    SceneText *deck = &scene->deck;
    Fold fold = {even_cells(n), side / PANELS, gap > 0 ? gap : thickness, gap > 0 ? gap : thickness};
    SceneGas vented = gas;
    vented.vent_area = 1e-3;
    deck->exact = true;
    add_nodes(&scene->mesh, &fold, false);
    add_shells(&scene->mesh, pattern, fold.cells);
    scene_begin(deck, "square bag folded in eight layers", 0.030, 0.9);
    scene_write_output(deck, 1e-4, 1e-4, 1e-3);
    write_parts(deck, 0);
    scene_write_curve(deck, 1, 4, (const double[]){0, 0, 0.003, 3.0, 0.015, 2.0, 0.030, 0});
    scene_write_wang_nefske(deck, 1, &vented);
    write_contact(deck);
    scene_end(deck, &scene->mesh);
}

void scene_resting_bag(Scene *scene, int n, bool folded)
{
    SceneText *deck = &scene->deck;
    SceneMesh flat = {0};
    Fold fold = {even_cells(n), side / PANELS, thickness, -thickness / 8};
    SceneGas relieved = gas;
    relieved.vent_curve = 3;
    deck->exact = true;
    add_nodes(&scene->mesh, &fold, !folded);
    add_shells(&scene->mesh, SCENE_DIAGONAL, fold.cells);
    scene_begin(deck, folded ? "square bag folded in eight layers, brought to rest" : "the same bag from flat", 0.1,
                0.9);
    scene_write_output(deck, 1e-4, 1e-4, 1e-2);
    write_parts(deck, 2);
    scene_write_curve(deck, 1, 6, (const double[]){0, 0, 0.003, 1.8, 0.015, 1.2, 0.030, 0.1, 0.060, 0.1, 0.065, 0});
    scene_write_curve(deck, 2, 4, (const double[]){0, 0, 0.015, 0, 0.030, 400, 1, 400});
    scene_write_curve(deck, 3, 4, (const double[]){0, 0, 115000, 0, 120000, 0.004, 1e6, 0.004});
    scene_write_wang_nefske(deck, 1, &relieved);
    scene_write_damping(deck, 2, 0);
    if (folded) {
        write_contact(deck);
        add_nodes(&flat, &fold, true);
        scene_print(deck, "*AIRBAG_REFERENCE_GEOMETRY\n");
        scene_write_nodes(deck, &flat);
        scene_mesh_free(&flat);
    }
    scene_end(deck, &scene->mesh);
}
