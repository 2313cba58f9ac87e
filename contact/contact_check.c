/* Initial penetrations and intersections of surfaces in contact. */
#include "contact/contact_check.h"

#include <string.h>

#include "contact/contact_geometry.h"
#include "contact/contact_grid.h"
#include "contact/contact_sides.h"
#include "solver/memory.h"

/* Nearer than this share of the thickness: on the surface. */
#define TOUCHING 1e-6

typedef struct Inspection {
    const Model *model;
    const ContactInterface *c;
    const double *x;
    ContactFindings *findings;
    ContactNear *near;
    void *user;
    ContactGrid grid;
    ContactFound found;
    ContactBox *box; /* of the triangles, grown by their radii */
} Inspection;

static void fill_boxes(Inspection *in)
{
    const ContactInterface *c = in->c;
    for (int t = 0; t < c->triangle_count; t++) {
        contact_box_start(&in->box[t], in->x + 3 * (ptrdiff_t)c->triangle[3 * t]);
        contact_box_add(&in->box[t], in->x + 3 * (ptrdiff_t)c->triangle[3 * t + 1]);
        contact_box_add(&in->box[t], in->x + 3 * (ptrdiff_t)c->triangle[3 * t + 2]);
        contact_box_grow(&in->box[t], c->thickest);
    }
}

/* The nearest triangle of one node, if it is nearer than the thickness. */
static int inspect_node(Inspection *in, int i)
{
    const ContactInterface *c = in->c;
    const double *at = in->x + 3 * (ptrdiff_t)c->node[i];
    ContactBox point;
    ClosestPoint best = {0};
    double least = 1.0, thickness = 0.0;
    contact_box_start(&point, at);
    int found = contact_grid_query(&in->grid, &point, &in->found);
    contact_sort(in->found.item, found);
    for (int k = 0; k < found; k++) {
        int t = in->found.item[k];
        ClosestPoint p;
        double g = c->node_radius[i] + c->triangle_radius[t], bound;
        memcpy(p.corner, c->triangle + 3 * (ptrdiff_t)t, sizeof p.corner);
        if (!contact_node_meets(in->model, c, i, t) || !closest_point(&p, at, in->x, g, &bound)) continue;
        if (!(p.distance < least * g)) continue;
        least = p.distance / g;
        thickness = g;
        best = p;
    }
    if (found < 0) return -1;
    if (least >= 1.0 - TOUCHING) return 0;
    ContactFindings *f = in->findings;
    f->near_count++;
    f->touch_count += least < TOUCHING;
    if (least < f->nearest) {
        f->nearest = least;
        f->nearest_node = c->node[i];
        memcpy(f->place, at, sizeof f->place);
    }
    if (!in->near) return 0;
    double shift[3], by = thickness - best.distance;
    for (int k = 0; k < 3; k++) shift[k] = by * (best.distance > 0.0 ? best.toward[k] / best.distance : best.normal[k]);
    in->near(in->user, c, c->node[i], best.distance, thickness, shift);
    return 0;
}

/* Does the edge p-q go through the inside of triangle t? */
static bool goes_through(const Inspection *in, const double *p, const double *q, int t, double place[3])
{
    const int32_t *corner = in->c->triangle + 3 * (ptrdiff_t)t;
    const double *a = in->x + 3 * (ptrdiff_t)corner[0];
    double e[2][3], n[3], r[3], w[3], along[3];
    for (int k = 0; k < 2; k++) vector3_subtract(in->x + 3 * (ptrdiff_t)corner[k + 1], a, e[k]);
    vector3_cross(e[0], e[1], n);
    vector3_subtract(p, a, r);
    vector3_subtract(q, p, along);
    double from = vector3_dot(n, r), rise = vector3_dot(n, along), square = vector3_dot(n, n);
    if (rise == 0.0 || !(square > 0.0)) return false;
    double s = -from / rise;
    if (!(s > ON_EDGE && s < 1.0 - ON_EDGE)) return false;
    for (int k = 0; k < 3; k++) {
        place[k] = p[k] + s * along[k];
        r[k] += s * along[k];
    }
    vector3_cross(r, e[1], w);
    double u = vector3_dot(w, n) / square;
    vector3_cross(e[0], r, w);
    double v = vector3_dot(w, n) / square;
    return u > ON_EDGE && v > ON_EDGE && 1.0 - u - v > ON_EDGE;
}

/* An edge of a triangle against all triangles near it; each edge is looked at from its first triangle. */
static int inspect_edge(Inspection *in, int t, int k)
{
    const ContactInterface *c = in->c;
    int32_t a = c->triangle[3 * t + (k + 1) % 3], b = c->triangle[3 * t + (k + 2) % 3];
    const double *p = in->x + 3 * (ptrdiff_t)a, *q = in->x + 3 * (ptrdiff_t)b;
    ContactBox box;
    contact_box_start(&box, p);
    contact_box_add(&box, q);
    int found = contact_grid_query(&in->grid, &box, &in->found);
    contact_sort(in->found.item, found);
    for (int j = 0; j < found; j++) {
        int u = in->found.item[j];
        const int32_t *corner = c->triangle + 3 * (ptrdiff_t)u;
        double place[3];
        bool own = false;
        for (int i = 0; i < 3; i++) own = own || corner[i] == a || corner[i] == b;
        if (own || !contact_sides_meet(c->triangle_side[t], c->triangle_side[u])) continue;
        if (c->triangle_body[t] != -1 && c->triangle_body[t] == c->triangle_body[u]) continue;
        if (!goes_through(in, p, q, u, place)) continue;
        if (in->findings->cross_count++) continue;
        in->findings->cross_edge[0] = a;
        in->findings->cross_edge[1] = b;
        memcpy(in->findings->cross_place, place, sizeof place);
    }
    return found < 0 ? -1 : 0;
}

int contact_inspect(const Model *model, const ContactInterface *c, const double *x, ContactFindings *findings,
                    ContactNear *near, void *user)
{
    Inspection in = {.model = model, .c = c, .x = x, .findings = findings, .near = near, .user = user};
    *findings = (ContactFindings){.nearest = 1.0, .nearest_node = -1, .cross_edge = {-1, -1}};
    in.box = memory_alloc((size_t)c->triangle_count + 1, sizeof *in.box);
    if (!in.box) return -1;
    fill_boxes(&in);
    int status = contact_grid_fill(&in.grid, in.box, c->triangle_count);
    for (int i = 0; i < c->node_count && !status; i++) status = inspect_node(&in, i);
    for (int t = 0; t < c->triangle_count && !status; t++)
        for (int k = 0; k < 3 && !status; k++) {
            int other = c->neighbour[3 * t + k];
            if (other < 0 || other > t) status = inspect_edge(&in, t, k);
        }
    contact_grid_free(&in.grid);
    memory_free(in.found.item);
    memory_free(in.box);
    return status;
}
