/* One fold of the stack of layers about a line (eq. O2 to O6), and the kinds of folds made of such folds. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fold/fold.h"
#include "solver/memory.h"
#include "solver/vector3.h"

/* A crease is at least this many times as wide on each side as its largest radius. */
#define LEAST_WIDTH 1.5

/* The fold in the plane of s (across the line, bag->across) and height z (up, or down where sense is -1). */
typedef struct Crease {
    double sense, gap, spread;
    double axis;               /* height of the axis (eq. O2) */
    double width;              /* E: from the line to where layers are flat */
    double least, most;        /* radii of the layers at the line */
    double mean;               /* length that the layer of mean radius takes (eq. O4) */
    double bisector[2], mitre; /* direction from the axis to the corners in (s, z); their distance over r */
} Crease;

/* Distance of a crease's corner from the axis over its radius: the tip of the mitre up to 90 degrees, from there on cut
 * off, down to 1 for a flat fold (eq. O3). half: of the angle. */
static double mitre_of(double half)
{
    const double quarter = 0.5 * acos(0.0);
    if (half <= quarter) return 1.0 / cos(half);
    return sqrt(2.0) + (1.0 - sqrt(2.0)) * (half - quarter) / quarter;
}

static double height_of(const FoldBag *bag, const Crease *c, int node)
{
    return c->sense * bag->x[3 * (ptrdiff_t)node + 2];
}

/* Longest reach of an edge from a node on the line. */
static double longest_reach(const FoldBag *bag)
{
    double reach = 0.0;
    for (int e = 0; e < bag->edge_count; e++) {
        const double a = bag->across[bag->edge[2 * (ptrdiff_t)e]], b = bag->across[bag->edge[2 * (ptrdiff_t)e + 1]];
        if ((a == 0.0) != (b == 0.0)) reach = fmax(reach, fabs(a + b));
    }
    return reach;
}

/* The axis is half a gap above the layers that the fold brings together (eq. O2). place: distance of the nodes from the
 * line as they lie. */
static int find_axis(const FoldBag *bag, const double *place, Crease *c, char problem[FOLD_TEXT])
{
    double extent = 0.0, moving = -INFINITY, fixed = -INFINITY;
    bool rest = false;
    for (int n = 0; n < bag->node_count; n++) {
        rest = rest || bag->across[n] < 0.0;
        if (bag->across[n] < 0.0) continue;
        extent = fmax(extent, place[n]);
        moving = fmax(moving, height_of(bag, c, n));
    }
    if (!(extent > 0.0) || !rest) {
        snprintf(problem, FOLD_TEXT, "the line does not cross the bag as it is folded so far: %s",
                 rest ? "nothing lies on the side that moves" : "all of it lies on the side that moves");
        return -1;
    }
    for (int n = 0; n < bag->node_count; n++)
        if (bag->across[n] <= 0.0 && place[n] >= -extent - c->spread) fixed = fmax(fixed, height_of(bag, c, n));
    c->axis = 0.5 * (moving + fixed + c->gap);
    return 0;
}

/* Length that the half crease of a layer of radius r takes from the layer (eq. O4). */
static double length_taken(const Crease *c, double r)
{
    const double rise = r * (1.0 + c->mitre * c->bisector[1]);
    return c->mitre * r * c->bisector[0] + c->width - sqrt(c->width * c->width - rise * rise);
}

/* Width and radii, which need each other: the layers within the width count. */
static int find_width(const FoldBag *bag, Crease *c, char problem[FOLD_TEXT])
{
    c->width = 1.05 * longest_reach(bag);
    for (int pass = 0; pass < 3; pass++) {
        double low = INFINITY, high = -INFINITY;
        for (int n = 0; n < bag->node_count; n++) {
            if (fabs(bag->across[n]) >= c->width) continue;
            low = fmin(low, height_of(bag, c, n));
            high = fmax(high, height_of(bag, c, n));
        }
        c->most = c->axis - low;
        c->least = c->axis - high;
        c->width = fmax(c->width, LEAST_WIDTH * c->most);
    }
    if (c->least < 0.49 * c->gap) {
        snprintf(
            problem, FOLD_TEXT,
            "layers lie above the crease within %.4g of the line, where the fold needs room; move the line or make "
            "the gap smaller",
            c->width);
        return -1;
    }
    c->mean = length_taken(c, 0.5 * (c->least + c->most));
    return 0;
}

/* Place (s, z) of a node that lies at (-q, z), and lies the distance reach from the line along its layer, as if before
 * the line (eq. O5). */
static void place_before(const Crease *c, double reach, double q, double z, double place[2])
{
    const double r = c->axis - z;
    const double slip = length_taken(c, fmin(fmax(r, c->least), c->most)) - c->mean;
    if (reach >= c->width) {
        const double far = fmin((reach - c->width) / c->spread, 1.0);
        place[0] = -q + slip * (1.0 - far) * (1.0 - far) * (1.0 + 2.0 * far);
        place[1] = z;
        return;
    }
    const double corner[2] = {c->mitre * r * c->bisector[0] - c->mean, c->axis + c->mitre * r * c->bisector[1]};
    const double share = 1.0 - reach / c->width;
    place[0] = (-c->width + slip) * (1.0 - share) + corner[0] * share;
    place[1] = z * (1.0 - share) + corner[1] * share;
}

/* What lies beyond the line is the mirror image of what would lie before it, about the bisector (eq. O6). */
static void reflect(const Crease *c, double place[2])
{
    const double w[2] = {place[0] + c->mean, place[1] - c->axis};
    const double along = w[0] * c->bisector[0] + w[1] * c->bisector[1];
    place[0] = 2.0 * along * c->bisector[0] - w[0] - c->mean;
    place[1] = 2.0 * along * c->bisector[1] - w[1] + c->axis;
}

static int check_rigid(const FoldBag *bag, const Crease *c, char problem[FOLD_TEXT])
{
    for (int f = 0; f < bag->facet_count; f++) {
        if (!bag->rigid[f]) continue;
        for (int k = 0; k < 4; k++) {
            const int32_t node = bag->facet[4 * (ptrdiff_t)f + k];
            if (fabs(bag->across[node]) >= c->width) continue;
            snprintf(problem, FOLD_TEXT,
                     "the crease would bend a rigid part near (%.6g, %.6g) of the flat bag; move the line",
                     bag->flat[3 * (ptrdiff_t)node], bag->flat[3 * (ptrdiff_t)node + 1]);
            return -1;
        }
    }
    return 0;
}

static void measure_across(const FoldBag *bag, const double *x, const double point[2], const double direction[2],
                           double *across)
{
    for (int n = 0; n < bag->node_count; n++)
        across[n] =
            (x[3 * (ptrdiff_t)n] - point[0]) * direction[0] + (x[3 * (ptrdiff_t)n + 1] - point[1]) * direction[1];
}

/* Begins a fold: distances from the line, nodes on it. */
static int begin_line(FoldBag *bag, const double point[2], const double direction[2], char problem[FOLD_TEXT])
{
    if (bag->upright) {
        snprintf(problem, FOLD_TEXT, "a fold of less than 180 degrees must be the last one");
        return -1;
    }
    if (bag->crease_count == 62) {
        snprintf(problem, FOLD_TEXT, "more than 62 lines in all; make fewer folds");
        return -1;
    }
    measure_across(bag, bag->start, point, direction, bag->across);
    return fold_snap(bag, UINT64_C(1) << bag->crease_count++, problem);
}

static void place_node(FoldBag *bag, int node, const double point[2], const double direction[2], double s, double z)
{
    double *x = bag->x + 3 * (ptrdiff_t)node;
    const double along = (x[1] - point[1]) * direction[0] - (x[0] - point[0]) * direction[1];
    x[0] = point[0] + s * direction[0] - along * direction[1];
    x[1] = point[1] + s * direction[1] + along * direction[0];
    x[2] = z;
}

/* The start of a statement, or of one line of a roll: lines are in the bag as it lies now. */
static void keep_start(FoldBag *bag)
{
    memcpy(bag->start, bag->x, (size_t)bag->node_count * 3 * sizeof *bag->x);
}

static int fold_block(FoldBag *bag, const FoldPlan *plan, const double point[2], const double direction[2], int sense,
                      double angle, char problem[FOLD_TEXT])
{
    if (begin_line(bag, point, direction, problem)) return -1;
    const double half = 0.5 * angle;
    Crease c = {.sense = sense, .gap = plan->gap, .bisector = {sin(half), -cos(half)}};
    c.mitre = mitre_of(half);
    c.spread = plan->spread > 0.0 ? plan->spread : 0.1 * bag->size;
    double *lie = memory_alloc((size_t)bag->node_count, sizeof *lie);
    if (!lie) {
        snprintf(problem, FOLD_TEXT, "not enough memory");
        return -1;
    }
    measure_across(bag, bag->x, point, direction, lie);
    const int status =
        find_axis(bag, lie, &c, problem) || find_width(bag, &c, problem) || check_rigid(bag, &c, problem);
    for (int n = 0; n < bag->node_count && !status; n++) {
        const bool beyond = bag->across[n] > 0.0;
        double place[2];
        place_before(&c, fabs(bag->across[n]), beyond ? lie[n] : -lie[n], height_of(bag, &c, n), place);
        if (beyond) reflect(&c, place);
        place_node(bag, n, point, direction, place[0], c.sense * place[1]);
    }
    memory_free(lie);
    if (status) return -1;
    bag->upright = angle < 0.9999 * acos(-1.0);
    return 0;
}

/* Lines from the far one on, turn and turn about, so that the strips lie on each other as a bellows. */
static int fold_zig_zag(FoldBag *bag, const FoldPlan *plan, const Fold *fold, char problem[FOLD_TEXT])
{
    for (int k = fold->count - 1; k >= 0; k--) {
        double point[2];
        for (int i = 0; i < 2; i++) point[i] = fold->point[i] + k * fold->pitch * fold->direction[i];
        const int sense = k % 2 ? -fold->sense : fold->sense;
        if (fold_block(bag, plan, point, fold->direction, sense, fold->angle, problem)) return -1;
    }
    return 0;
}

static double longest_edge(const FoldBag *bag)
{
    double longest = 0.0;
    for (int e = 0; e < bag->edge_count; e++) {
        double u[3];
        vector3_subtract(bag->flat + 3 * (ptrdiff_t)bag->edge[2 * (ptrdiff_t)e],
                         bag->flat + 3 * (ptrdiff_t)bag->edge[2 * (ptrdiff_t)e + 1], u);
        longest = fmax(longest, vector3_norm(u));
    }
    return longest;
}

/* The first line as given; each further one just before the roll so far. */
static int fold_roll(FoldBag *bag, const FoldPlan *plan, const Fold *fold, char problem[FOLD_TEXT])
{
    double point[2] = {fold->point[0], fold->point[1]};
    for (int k = 0; k < fold->count; k++) {
        keep_start(bag);
        if (fold_block(bag, plan, point, fold->direction, fold->sense, fold->angle, problem)) return -1;
        double back = 0.0, low = INFINITY, high = -INFINITY;
        for (int n = 0; n < bag->node_count; n++) {
            const double *x = bag->x + 3 * (ptrdiff_t)n;
            low = fmin(low, x[2]);
            high = fmax(high, x[2]);
            if (bag->across[n] <= 0.0) continue;
            back = fmin(back, (x[0] - point[0]) * fold->direction[0] + (x[1] - point[1]) * fold->direction[1]);
        }
        /* two creases side by side: the roll's own, and room for the next */
        back -= 2.1 * longest_edge(bag) + 2.0 * LEAST_WIDTH * (high - low + plan->gap);
        for (int i = 0; i < 2; i++) point[i] += back * fold->direction[i];
    }
    return 0;
}

/* The side beyond the line goes in between the panels, which move apart to one and a half gaps each (eq. O7). */
static int fold_tuck(FoldBag *bag, const FoldPlan *plan, const Fold *fold, char problem[FOLD_TEXT])
{
    if (bag->crease_count > bag->tuck_count) {
        snprintf(problem, FOLD_TEXT,
                 "tucks are made in the flat bag: put them before every other fold, or leave them out");
        return -1;
    }
    if (begin_line(bag, fold->point, fold->direction, problem)) return -1;
    Crease c = {.sense = 1.0, .width = 1.05 * longest_reach(bag), .spread = plan->spread};
    if (!(c.spread > 0.0)) c.spread = 0.1 * bag->size;
    if (check_rigid(bag, &c, problem)) return -1;
    bag->tuck_count++;
    double depth = 0.0;
    for (int n = 0; n < bag->node_count; n++) depth = fmax(depth, bag->across[n]);
    for (int n = 0; n < bag->node_count; n++) {
        const double s = bag->across[n], z = bag->x[3 * (ptrdiff_t)n + 2], q = fabs(s);
        const double far = fmin(fmax(q - depth - c.width, 0.0) / c.spread, 1.0);
        const double share = fmin(q / c.width, 1.0); /* 0 on the line, where the crease is between its two layers */
        const double factor = s > 0.0 ? 2.0 - share : 2.0 + share - 2.0 * far * far * (3.0 - 2.0 * far);
        place_node(bag, n, fold->point, fold->direction, -q, factor * z);
    }
    return 0;
}

int fold_make(FoldBag *bag, const FoldPlan *plan, const Fold *fold, char problem[FOLD_TEXT])
{
    keep_start(bag);
    switch (fold->kind) {
    case FOLD_THIN:
        return fold_block(bag, plan, fold->point, fold->direction, fold->sense, fold->angle, problem);
    case FOLD_ZIG_ZAG:
        return fold_zig_zag(bag, plan, fold, problem);
    case FOLD_ROLL:
        return fold_roll(bag, plan, fold, problem);
    default:
        return fold_tuck(bag, plan, fold, problem);
    }
}
