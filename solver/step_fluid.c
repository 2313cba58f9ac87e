/* Fluid in a bag of FLUID_AND_GAS: the volume below a level, the level of a volume, the hydrostatic pressure. */
#include <math.h>

#include "solver/workspace.h"

/* Volume below a level and the free surface of the fluid there. */
typedef struct Below {
    double volume, surface;
} Below;

/* A triangle's share (eq. G52): d are the heights of its corners above the level, area the upward component of its area
 * vector. Mean of min(d, 0) over it, and the part of it that lies below. */
static void add_triangle(double d0, double d1, double d2, double area, Below *below)
{
    if (d0 > d1) {
        double t = d0;
        d0 = d1;
        d1 = t;
    }
    if (d1 > d2) {
        double t = d1;
        d1 = d2;
        d2 = t;
    }
    if (d0 > d1) {
        double t = d0;
        d0 = d1;
        d1 = t;
    }
    double mean = (d0 + d1 + d2) / 3.0, part = 1.0;
    if (d0 >= 0.0) return;
    if (d2 > 0.0 && d1 >= 0.0) {
        part = d0 * d0 / ((d1 - d0) * (d2 - d0));
        mean = part * d0 / 3.0;
    } else if (d2 > 0.0) {
        double above = d2 * d2 / ((d2 - d0) * (d2 - d1));
        part = 1.0 - above;
        mean -= above * d2 / 3.0;
    }
    below->volume += area * mean;
    below->surface -= area * part;
}

/* Upward component of the area vector of a triangle. */
static double upward_area(const double *a, const double *b, const double *c, int axis, double up)
{
    int j = (axis + 1) % 3, k = (axis + 2) % 3;
    return 0.5 * up * ((b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]));
}

static void add_facet(const double *const p[3], int axis, double up, double height, double weight, Below *below)
{
    add_triangle(up * p[0][axis] - height, up * p[1][axis] - height, up * p[2][axis] - height,
                 weight * upward_area(p[0], p[1], p[2], axis, up), below);
}

/* (G52) over facets, quadrilaterals as the mean of their two cuts, and caps as fans about their middle. */
static Below measure_below(const Workspace *w, const Airbag *bag, double level)
{
    const FluidAndGasLaw *law = &bag->gas.fluid_and_gas;
    const double *x = w->state->x;
    double height = law->up * level;
    Below below = {0};
    for (int f = 0; f < bag->facet_count; f++) {
        const int32_t *n = bag->facet + 4 * (ptrdiff_t)f;
        const double *p[4];
        for (int a = 0; a < 4; a++) p[a] = x + 3 * (ptrdiff_t)n[a];
        bool triangle = n[2] == n[3];
        static const int cut[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}};
        for (int t = 0; t < (triangle ? 1 : 4); t++)
            add_facet((const double *const[3]){p[cut[t][0]], p[cut[t][1]], p[cut[t][2]]}, law->axis, law->up, height,
                      triangle ? 1.0 : 0.5, &below);
    }
    for (int c = 0; c < bag->closure.cap_count; c++) {
        const SurfaceCap *cap = &bag->closure.caps[c];
        double middle[3] = {0};
        for (int a = 0; a < cap->count; a++)
            for (int k = 0; k < 3; k++) middle[k] += x[3 * (ptrdiff_t)cap->node[a] + k] / cap->count;
        for (int a = 0; a < cap->count; a++) {
            const double *one = x + 3 * (ptrdiff_t)cap->node[a],
                         *two = x + 3 * (ptrdiff_t)cap->node[(a + 1) % cap->count];
            add_facet((const double *const[3]){one, two, middle}, law->axis, law->up, height, 1.0, &below);
        }
    }
    return below;
}

void step_fluid_begin(Workspace *w, int bag)
{
    GasState *gas = &w->state->gas[bag];
    gas->fluid_volume = w->fluid_volume[bag] = step_fluid_volume(w, bag, gas->fluid_level);
}

double step_fluid_volume(const Workspace *w, int bag, double level)
{
    const Airbag *airbag = &w->model->airbags[bag];
    return airbag->vsca * measure_below(w, airbag, level).volume;
}

/* Level of a volume by Newton's steps within a bracket of the bag's heights. */
void step_fluid_settle(Workspace *w, int bag)
{
    const Airbag *airbag = &w->model->airbags[bag];
    const FluidAndGasLaw *law = &airbag->gas.fluid_and_gas;
    GasState *gas = &w->state->gas[bag];
    if (gas_asleep(&airbag->gas, gas)) return;
    double low = INFINITY, high = -INFINITY, wanted = gas->fluid_volume / airbag->vsca;
    for (int i = 0; i < airbag->node_count; i++) {
        double height = law->up * w->state->x[3 * (ptrdiff_t)airbag->node[i] + law->axis];
        low = fmin(low, height);
        high = fmax(high, height);
    }
    double height = law->up * gas->fluid_level, size = high - low;
    for (int i = 0; i < 60 && high - low > 1e-14 * size; i++) {
        if (!(height > low && height < high)) height = 0.5 * (low + high);
        Below below = measure_below(w, airbag, law->up * height);
        double missing = wanted - below.volume;
        if (fabs(missing) <= 1e-14 * wanted) break;
        if (missing > 0.0)
            low = height;
        else
            high = height;
        height = below.surface > 0.0 ? height + missing / below.surface : 0.5 * (low + high);
    }
    gas->fluid_level = law->up * fmin(fmax(height, low), high);
}

double step_hydrostatic(const Workspace *w, int set, const double *x)
{
    const Model *m = w->model;
    double pressure = 0.0;
    for (int k = 0; k < m->pressure_sets[set].count; k++) {
        int source = m->pressure_sets[set].source[k];
        if (source >= m->airbag_count || m->airbags[source].gas.kind != GAS_FLUID_AND_GAS) continue;
        const Airbag *bag = &m->airbags[source];
        const FluidAndGasLaw *law = &bag->gas.fluid_and_gas;
        if (law->gravity_curve < 0 || gas_asleep(&bag->gas, &w->state->gas[source])) continue;
        double depth = law->up * (w->state->gas[source].fluid_level - x[law->axis]);
        double gravity = fabs(law->gravity * curve_value(&m->curves[law->gravity_curve], w->plan.time));
        if (depth > 0.0) pressure += m->pressure_sets[set].push[k] * bag->psca * bag->gas.density * gravity * depth;
    }
    return pressure;
}
