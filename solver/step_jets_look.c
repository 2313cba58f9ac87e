/* The line of sight of jets (docs/theory.md, J10, J11) and what follows from it for the rows of corner sums (J12). */
#include <math.h>

#include "solver/vector3.h"
#include "solver/workspace.h"

static const double VIEW_MARGIN = 0.01; /* layers nearer than this share of a facet's size do not hide each other */

/* Centroid, area and inner side of a facet. */
static void facet_geometry(const Jet *jet, int f, const double *x, double middle[3], double outward[3])
{
    const int32_t *node = jet->node + 4 * (ptrdiff_t)f;
    const double *a = x + 3 * (ptrdiff_t)node[0], *b = x + 3 * (ptrdiff_t)node[1], *c = x + 3 * (ptrdiff_t)node[2],
                 *d = x + 3 * (ptrdiff_t)node[3];
    double u[3], v[3];
    int corners = jet->facet[f].corner_count;
    vector3_subtract(c, a, u);
    vector3_subtract(d, b, v);
    vector3_cross(u, v, outward);
    for (int k = 0; k < 3; k++) {
        outward[k] *= 0.5 * jet->side[f];
        middle[k] = (a[k] + b[k] + c[k] + (corners == 4 ? d[k] : 0.0)) / corners;
    }
}

/* (J10): shape where the jet sees the facet's inner side, -1 where it does not, 0 out of its reach. A facet in the jet
 * is looked at anew at every second look. */
static double view_facet(const Workspace *w, const Jet *jet, JetWork *work, int f, double before, double *area)
{
    double middle[3], outward[3], origin[3], sight[3];
    *area = 0.0;
    if (work->side && work->side[f] == 0) return 0.0;
    facet_geometry(jet, f, w->state->x, middle, outward);
    *area = vector3_norm(outward);
    if (before != 0.0 && (f + w->state->jet[work - w->jets].looks) % 2 != 0) return before;
    bool target = jet->facet[f].target;
    if (!target && jet->knock_curve < 0) return 0.0;
    jet_origin(&work->frame, middle, origin);
    vector3_subtract(middle, origin, sight);
    if (!(vector3_dot(sight, outward) > 0.0)) return -1.0;
    double shape = target ? jet_shape(jet, w->model->curves, &work->frame, middle, origin, *area) : 0.0;
    if (!(shape > 0.0) && jet->knock_curve < 0) return 0.0;
    return ray_tree_blocked(&work->tree, w->state->x, origin, middle, f, VIEW_MARGIN * sqrt(*area)) ? -1.0 : shape;
}

/* (J12a): means of the facets around a row, weighted by area. */
void step_jets_look(Workspace *w, int number, int chunk)
{
    const Jet *jet = &w->model->jets[number];
    JetWork *work = &w->jets[number];
    double *shape = w->state->jet_shape + jet->first_facet;
    int first = jet->first_weight + jet->chunk_weight[chunk],
        count = jet->chunk_weight[chunk + 1] - jet->chunk_weight[chunk];
    JetWeight *weight = w->state->jet_weight + first;
    double *sum = w->jet_area + first;
    for (int i = 0; i < count; i++) {
        weight[i] = (JetWeight){0};
        sum[i] = 0.0;
    }
    for (int f = jet->chunk_start[chunk]; f < jet->chunk_start[chunk + 1]; f++) {
        const JetFacet *facet = &jet->facet[f];
        double area;
        shape[f] = view_facet(w, jet, work, f, shape[f], &area);
        for (int c = 0; c < facet->corner_count; c++) {
            JetWeight *at = &weight[facet->row[c]];
            sum[facet->row[c]] += area;
            if (shape[f] > 0.0) at->shape += area * shape[f];
            if (shape[f] < 0.0 && jet->knock_curve >= 0) at->hidden += area;
        }
    }
    for (int i = 0; i < count; i++) {
        double inverse = sum[i] > 0.0 ? 1.0 / sum[i] : 0.0;
        weight[i].shape *= inverse;
        weight[i].hidden *= inverse;
    }
}
