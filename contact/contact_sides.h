/* Who may meet whom, and boxes around it. Shared by the search and the checks. */
#ifndef BILLOW_CONTACT_SIDES_H
#define BILLOW_CONTACT_SIDES_H

#include "contact/contact_grid.h"
#include "solver/model.h"

static inline void contact_box_start(ContactBox *box, const double *x)
{
    for (int k = 0; k < 3; k++) box->low[k] = box->high[k] = x[k];
}

static inline void contact_box_add(ContactBox *box, const double *x)
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = x[k] < box->low[k] ? x[k] : box->low[k];
        box->high[k] = x[k] > box->high[k] ? x[k] : box->high[k];
    }
}

static inline void contact_box_grow(ContactBox *box, double by)
{
    for (int k = 0; k < 3; k++) {
        box->low[k] -= by;
        box->high[k] += by;
    }
}

static inline bool contact_sides_meet(int a, int b)
{
    return ((a & CONTACT_SIDE_A) && (b & CONTACT_SIDE_B)) || ((a & CONTACT_SIDE_B) && (b & CONTACT_SIDE_A));
}

/* A node does not meet its own facet, nor a rigid body itself, nor what is fixed what is fixed. */
static inline bool contact_node_meets(const Model *model, const ContactInterface *c, int i, int t)
{
    int32_t node = c->node[i];
    const int32_t *corner = c->triangle + 3 * (ptrdiff_t)t;
    const double *inverse = model->contact_inverse;
    if (!contact_sides_meet(c->node_side[i], c->triangle_side[t])) return false;
    if (corner[0] == node || corner[1] == node || corner[2] == node || c->triangle_fourth[t] == node) return false;
    if (c->node_body[i] != -1 && c->node_body[i] == c->triangle_body[t]) return false;
    return inverse[node] > 0.0 || inverse[corner[0]] > 0.0 || inverse[corner[1]] > 0.0 || inverse[corner[2]] > 0.0;
}

/* Edges of one facet or with a common node do not meet, nor those of one rigid body, nor fixed ones. */
static inline bool contact_edges_meet(const Model *model, const ContactInterface *c, int e, int f)
{
    const int32_t *a = c->edge + 2 * (ptrdiff_t)e, *b = c->edge + 2 * (ptrdiff_t)f;
    const double *inverse = model->contact_inverse;
    if (!contact_sides_meet(c->edge_side[e], c->edge_side[f])) return false;
    if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) return false;
    int32_t t = c->edge_triangle[2 * e], u = c->edge_triangle[2 * f];
    if (c->triangle_body[t] != -1 && c->triangle_body[t] == c->triangle_body[u]) return false;
    if (c->triangle_shell[t] >= 0 && c->triangle_shell[t] == c->triangle_shell[u]) return false;
    return inverse[a[0]] > 0.0 || inverse[a[1]] > 0.0 || inverse[b[0]] > 0.0 || inverse[b[1]] > 0.0;
}

#endif
