/* Load curves: *DEFINE_CURVE with its scales and offsets, ready for look-up. */
#include <math.h>

#include "solver/builder.h"
#include "solver/memory.h"

static int build_curve(Builder *b, const CurveDefinition *definition, Curve *curve)
{
    int count = (int)definition->x.count;
    curve->id = definition->id;
    curve->sidr = definition->sidr;
    curve->count = count;
    if (count == 0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, definition->source, "*DEFINE_CURVE",
                        "curve LCID = %d has no points; give at least one line of abscissa and ordinate",
                        definition->id);
        return -1;
    }
    curve->x = builder_alloc(b, (size_t)count, sizeof *curve->x);
    curve->y = builder_alloc(b, (size_t)count, sizeof *curve->y);
    curve->area = builder_alloc(b, (size_t)count, sizeof *curve->area);
    if (!curve->x || !curve->y || !curve->area) return -1;
    for (int i = 0; i < count; i++) {
        curve->x[i] = definition->sfa * (definition->x.items[i] + definition->offa);
        curve->y[i] = definition->sfo * (definition->y.items[i] + definition->offo);
        if (!isfinite(curve->x[i]) || !isfinite(curve->y[i])) {
            diagnostics_add(b->diagnostics, SEVERITY_ERROR, definition->source, "*DEFINE_CURVE",
                            "curve LCID = %d: point %d is not a finite number", definition->id, i + 1);
            return -1;
        }
        if (i == 0) continue;
        if (!(curve->x[i] > curve->x[i - 1])) {
            diagnostics_add(
                b->diagnostics, SEVERITY_ERROR, (Source){definition->source.file, definition->lines.items[i]},
                "*DEFINE_CURVE",
                "curve LCID = %d: abscissa %g of point %d does not exceed %g before it; abscissae must grow",
                definition->id, curve->x[i], i + 1, curve->x[i - 1]);
            return -1;
        }
        curve->area[i] = curve->area[i - 1] + 0.5 * (curve->y[i] + curve->y[i - 1]) * (curve->x[i] - curve->x[i - 1]);
    }
    return 0;
}

/* The spline follows the curves of the deck in the model's list, each at most once. */
int build_spline(Builder *b, int linear)
{
    Model *m = b->model;
    const Curve *from = &m->curves[linear];
    for (int i = (int)b->definitions->curves.count; i < m->curve_count; i++)
        if (m->curves[i].id == from->id) return i;
    Curve *curve = &m->curves[m->curve_count];
    size_t count = (size_t)from->count;
    *curve = *from;
    curve->area = builder_alloc(b, count, sizeof *curve->area);
    curve->bend = builder_alloc(b, count, sizeof *curve->bend);
    double *work = memory_alloc(count, sizeof *work);
    if (curve->area && curve->bend && work) curve_fill_spline(curve, work);
    memory_free(work);
    return curve->area && curve->bend && work ? m->curve_count++ : -1;
}

int build_curves(Builder *b)
{
    const Definitions *d = b->definitions;
    int status = 0;
    b->model->first_function = 2 * (int)d->curves.count; /* room for a spline of each curve */
    b->model->curves = builder_alloc(b, 2 * d->curves.count + d->functions.count + 1, sizeof *b->model->curves);
    if (!b->model->curves) return -1;
    b->model->curve_count = (int)d->curves.count;
    for (size_t i = 0; i < d->curves.count; i++)
        if (build_curve(b, &d->curves.items[i], &b->model->curves[i])) status = -1;
    if (build_functions(b)) status = -1;
    return status;
}
