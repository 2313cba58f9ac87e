/* Which edges stand out of their surface: these meet all others near them (docs/theory.md, Edges). */
#include <math.h>

#include "contact/contact_loop.h"
#include "contact/contact_pairs.h"
#include "solver/vector3.h"

/* An edge is sharp where the surface is turned by more than this angle times thickness over longest side: the middle of
 * the edge then stands out by a tenth of the thickness. Never by more than 1.8 degrees. */
#define SHARP_TURN 0.4
#define SHARP_MOST 0.0316

void contact_sharp_planes(ContactRun *run, const double *x, int thread, int threads)
{
    const ContactInterface *c = run->contact;
    int end = contact_first_of(c->triangle_count, thread + 1, threads);
    for (int t = contact_first_of(c->triangle_count, thread, threads); t < end && c->edge_count > 0; t++) {
        double *plane = run->plane + 4 * (ptrdiff_t)t, a[3], b[3], n[3];
        const double *corner = x + 3 * (ptrdiff_t)c->triangle[3 * t];
        vector3_subtract(x + 3 * (ptrdiff_t)c->triangle[3 * t + 1], corner, a);
        vector3_subtract(x + 3 * (ptrdiff_t)c->triangle[3 * t + 2], corner, b);
        vector3_cross(a, b, n);
        double square = vector3_dot(n, n), inverse = square > 0.0 ? 1.0 / sqrt(square) : 0.0;
        for (int k = 0; k < 3; k++) plane[k] = n[k] * inverse;
    }
}

/* A free edge, a branch, or an edge at which the surface is turned. */
static bool is_sharp(const ContactRun *run, int e, double cosine)
{
    const ContactInterface *c = run->contact;
    int32_t t = c->edge_triangle[2 * e], u = c->edge_triangle[2 * e + 1];
    return u < 0 || vector3_dot(run->plane + 4 * (ptrdiff_t)t, run->plane + 4 * (ptrdiff_t)u) < cosine;
}

void contact_sharp_mark(ContactLoop *loop, ContactRun *run, int thread, int threads)
{
    const ContactInterface *c = run->contact;
    unsigned char *sharp = loop->state->contact_sharp + c->first_edge;
    double turn = c->longest_side > 0.0 ? SHARP_TURN * c->thickest / c->longest_side : SHARP_MOST;
    if (turn > SHARP_MOST) turn = SHARP_MOST;
    int end = contact_first_of(run->lines.count, thread + 1, threads);
    for (int g = contact_first_of(run->lines.count, thread, threads); g < end; g++) {
        const ContactLanes *lanes = &run->lines.lanes[g];
        unsigned set = 0;
        for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++) {
            int32_t e = lanes->item[k];
            if (!loop->restored) sharp[e] = is_sharp(run, e, 1.0 - 0.5 * turn * turn);
            set |= (unsigned)(sharp[e] != 0) << k;
        }
        run->lines.sharp[g] = (uint16_t)set;
    }
}
