/* Distances of the pairs of two groups from below, in single precision with a margin. Compiled once per instruction
 * set, with BILLOW_NEAR_TABLE naming its table; loops over lanes are left to the compiler. Results of a run do not
 * depend on what is found here beyond the pairs that touch (docs/theory.md, Search). */
#include "contact/near_kernels.h"

#include <float.h>
#include <math.h>

enum { LANES = CONTACT_GROUP };

/* What rounding may take off a distance, as a share of the coordinates. */
#define MARGIN 2e-5

/* Triangles with an angle of a smaller sine squared at their first corner have no bound: they count as near. */
#define THIN 1e-3f

/* The triangles of one group, from an origin of their own. */
typedef struct TriangleLanes {
    float corner[3][LANES], a[3][LANES], b[3][LANES], normal[3][LANES];
    float aa[LANES], ab[LANES], bb[LANES], inverse[LANES];
    float over[3][LANES]; /* altitude squared on the edge opposite to each corner */
} TriangleLanes;

/* A box around what a group is made of. */
typedef struct LaneBox {
    float low[3], high[3];
} LaneBox;

static float larger(float a, float b)
{
    return a > b ? a : b;
}

static float smaller(float a, float b)
{
    return a < b ? a : b;
}

/* Component i of nodes lane by lane, from an origin. */
static void load_component(const double *x, const int32_t *node, int i, double origin, float *restrict to)
{
    for (int k = 0; k < LANES; k++) to[k] = (float)(x[3 * (ptrdiff_t)node[k] + i] - origin);
}

static void box_add(LaneBox *box, int i, const float *value)
{
    float low = value[0], high = value[0];
    for (int k = 1; k < LANES; k++) {
        low = smaller(value[k], low);
        high = larger(value[k], high);
    }
    box->low[i] = smaller(low, box->low[i]);
    box->high[i] = larger(high, box->high[i]);
}

static float box_extent(const LaneBox *box)
{
    float extent = 0.0f;
    for (int i = 0; i < 3; i++) extent = larger(extent, larger(fabsf(box->low[i]), fabsf(box->high[i])));
    return extent;
}

static const LaneBox nowhere = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};

/* Squared distance of the box from the box low to high. */
static float box_distance(const LaneBox *box, const float low[3], const float high[3])
{
    float square = 0.0f;
    for (int i = 0; i < 3; i++) {
        float gap = larger(larger(low[i] - box->high[i], box->low[i] - high[i]), 0.0f);
        square += gap * gap;
    }
    return square;
}

static void load_triangles(const ContactLook *look, const double *origin, TriangleLanes *t, LaneBox *box)
{
    *box = nowhere;
    for (int i = 0; i < 3; i++) {
        float b[LANES], c[LANES];
        load_component(look->x, look->others->node[0], i, origin[i], t->corner[i]);
        load_component(look->x, look->others->node[1], i, origin[i], b);
        load_component(look->x, look->others->node[2], i, origin[i], c);
        box_add(box, i, t->corner[i]);
        box_add(box, i, b);
        box_add(box, i, c);
        for (int k = 0; k < LANES; k++) t->a[i][k] = b[k] - t->corner[i][k];
        for (int k = 0; k < LANES; k++) t->b[i][k] = c[k] - t->corner[i][k];
    }
}

static void measure_triangles(TriangleLanes *t)
{
    for (int k = 0; k < LANES; k++) {
        float ax = t->a[0][k], ay = t->a[1][k], az = t->a[2][k], bx = t->b[0][k], by = t->b[1][k], bz = t->b[2][k];
        float aa = ax * ax + ay * ay + az * az, bb = bx * bx + by * by + bz * bz, ab = ax * bx + ay * by + az * bz;
        float nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
        float square = nx * nx + ny * ny + nz * nz, cc = aa - 2.0f * ab + bb;
        float good = square > THIN * aa * bb ? 1.0f : 0.0f, safe = good > 0.0f ? square : 1.0f;
        float inverse = good / safe, length = sqrtf(inverse);
        t->aa[k] = aa, t->ab[k] = ab, t->bb[k] = bb, t->inverse[k] = inverse;
        t->normal[0][k] = nx * length, t->normal[1][k] = ny * length, t->normal[2][k] = nz * length;
        t->over[0][k] = good * safe / (good > 0.0f ? cc : 1.0f);
        t->over[1][k] = good * safe / (good > 0.0f ? bb : 1.0f);
        t->over[2][k] = good * safe / (good > 0.0f ? aa : 1.0f);
    }
}

/* Squared distances of one point from the triangles, from below: height and way beyond an edge. */
static void face_distances(const TriangleLanes *t, const float p[3], float *restrict square)
{
    for (int k = 0; k < LANES; k++) {
        float x = p[0] - t->corner[0][k], y = p[1] - t->corner[1][k], z = p[2] - t->corner[2][k];
        float h = x * t->normal[0][k] + y * t->normal[1][k] + z * t->normal[2][k];
        float ar = x * t->a[0][k] + y * t->a[1][k] + z * t->a[2][k];
        float br = x * t->b[0][k] + y * t->b[1][k] + z * t->b[2][k];
        float v = (t->bb[k] * ar - t->ab[k] * br) * t->inverse[k], w = (t->aa[k] * br - t->ab[k] * ar) * t->inverse[k];
        float u = smaller(1.0f - v - w, 0.0f);
        v = smaller(v, 0.0f), w = smaller(w, 0.0f);
        float over = larger(u * u * t->over[0][k], larger(v * v * t->over[1][k], w * w * t->over[2][k]));
        square[k] = h * h + over;
    }
}

/* Takes out pairs that never meet, keeps the least distance of each lane, tells whether one is within the limit. */
static int sift_faces(const ContactLanes *t, const ContactLanes *owners, int i, float limit, float *restrict square,
                      float *restrict least)
{
    int hit = 0;
    int32_t node = owners->node[0][i], side = owners->side[i], body = owners->body[i];
    for (int k = 0; k < LANES; k++) {
        int swapped = ((t->side[k] & 1) << 1) | (t->side[k] >> 1);
        int out = (t->node[0][k] == node) | (t->node[1][k] == node) | (t->node[2][k] == node) |
                  (t->node[3][k] == node) | (t->body[k] == body) | ((swapped & side) == 0);
        float s = out ? FLT_MAX : square[k];
        square[k] = s;
        least[k] = smaller(s, least[k]);
        hit |= s <= limit;
    }
    return hit;
}

static void note(ContactLook *look, int lane, const float *square, float limit)
{
    for (int k = 0; k < LANES; k++)
        if (square[k] <= limit) look->found[look->count++] = (ContactNearby){lane, look->others->item[k]};
}

static float least_of(const float *least)
{
    float square = FLT_MAX;
    for (int k = 0; k < LANES; k++) square = smaller(least[k], square);
    return square;
}

/* square: least of all pairs. */
static void finish(ContactLook *look, float square, double margin)
{
    look->nearest = square < FLT_MAX ? sqrt((double)square) - margin : DBL_MAX;
}

static void near_faces(ContactLook *look)
{
    const ContactLanes *owners = look->owners, *others = look->others;
    const double *origin = look->x + 3 * (ptrdiff_t)others->node[0][0];
    TriangleLanes lanes;
    LaneBox box, own = nowhere;
    float least[LANES], square[LANES], point[3][LANES], best = FLT_MAX;
    load_triangles(look, origin, &lanes, &box);
    measure_triangles(&lanes);
    for (int k = 0; k < LANES; k++) least[k] = FLT_MAX;
    for (int i = 0; i < 3; i++) {
        load_component(look->x, owners->node[0], i, origin[i], point[i]);
        box_add(&own, i, point[i]);
    }
    double margin = MARGIN * (double)larger(box_extent(&box), box_extent(&own));
    look->count = 0;
    for (int k = 0; k < LANES && owners->item[k] >= 0; k++) {
        const float p[3] = {point[0][k], point[1][k], point[2][k]};
        double reach = look->reach + look->depth[owners->item[k]] + margin;
        float limit = reach > 0.0 ? (float)(reach * reach) : -1.0f;
        if (box_distance(&box, p, p) > larger(best, limit)) continue;
        face_distances(&lanes, p, square);
        if (sift_faces(others, owners, k, limit, square, least)) note(look, k, square, limit);
        best = least_of(least);
    }
    finish(look, best, margin);
}

/* The edges of one group, from an origin of their own. */
typedef struct EdgeLanes {
    float start[3][LANES], end[3][LANES], along[3][LANES], square[LANES], inverse[LANES];
} EdgeLanes;

static void load_edges(const ContactLook *look, const ContactLanes *lanes, const double *origin, EdgeLanes *e,
                       LaneBox *box)
{
    *box = nowhere;
    for (int i = 0; i < 3; i++) {
        load_component(look->x, lanes->node[0], i, origin[i], e->start[i]);
        load_component(look->x, lanes->node[1], i, origin[i], e->end[i]);
        box_add(box, i, e->start[i]);
        box_add(box, i, e->end[i]);
        for (int k = 0; k < LANES; k++) e->along[i][k] = e->end[i][k] - e->start[i][k];
    }
    for (int k = 0; k < LANES; k++) {
        float s = e->along[0][k] * e->along[0][k] + e->along[1][k] * e->along[1][k] + e->along[2][k] * e->along[2][k];
        e->square[k] = s;
        e->inverse[k] = s > 0.0f ? 1.0f / s : 0.0f;
    }
}

/* Squared distances of edge i of e from the edges f, from below. A point of one edge is off the line of the other by no
 * less than the one edge is, and along that line beyond the other's ends by no less. */
static void edge_distances(const EdgeLanes *e, int i, const EdgeLanes *f, float *restrict square)
{
    float ux = e->along[0][i], uy = e->along[1][i], uz = e->along[2][i], uu = e->square[i], iu = e->inverse[i];
    float ax = e->start[0][i], ay = e->start[1][i], az = e->start[2][i];
    for (int k = 0; k < LANES; k++) {
        float x = ax - f->start[0][k], y = ay - f->start[1][k], z = az - f->start[2][k];
        float wx = f->along[0][k], wy = f->along[1][k], wz = f->along[2][k], ww = f->square[k], iw = f->inverse[k];
        float rr = x * x + y * y + z * z, ru = x * ux + y * uy + z * uz, rw = x * wx + y * wy + z * wz;
        float uw = ux * wx + uy * wy + uz * wz;
        /* f against the line of e */
        float qq = ww - uw * uw * iu, q = rw - ru * uw * iu;
        float t = smaller(larger(qq > 1e-6f * ww ? q / qq : 0.5f, 0.0f), 1.0f);
        float off = rr - ru * ru * iu - 2.0f * t * q + t * t * qq;
        float from = -ru * iu, to = from + uw * iu;
        float beyond = larger(larger(smaller(from, to) - 1.0f, -larger(from, to)), 0.0f);
        float one = larger(off, 0.0f) + beyond * beyond * uu;
        /* e against the line of f */
        qq = uu - uw * uw * iw, q = ru - rw * uw * iw;
        t = smaller(larger(qq > 1e-6f * uu ? -q / qq : 0.5f, 0.0f), 1.0f);
        off = rr - rw * rw * iw + 2.0f * t * q + t * t * qq;
        from = rw * iw, to = from + uw * iw;
        beyond = larger(larger(smaller(from, to) - 1.0f, -larger(from, to)), 0.0f);
        float two = larger(off, 0.0f) + beyond * beyond * ww;
        square[k] = larger(larger(one, two) - 2e-6f * (rr + uu + ww), 0.0f);
    }
}

/* As sift_faces; within one group each pair is looked at once. Edges that are not sharp count for the least distance
 * only: they may be so after the next search. */
static int sift_edges(const ContactLanes *e, int i, const ContactLanes *f, float limit, float *restrict square,
                      float *restrict least)
{
    int hit = 0;
    int32_t a = e->node[0][i], b = e->node[1][i], side = e->side[i], body = e->body[i], shell = e->shell[i];
    int32_t from = e == f ? e->item[i] : -1;
    for (int k = 0; k < LANES; k++) {
        int swapped = ((f->side[k] & 1) << 1) | (f->side[k] >> 1);
        int out = (f->node[0][k] == a) | (f->node[1][k] == a) | (f->node[0][k] == b) | (f->node[1][k] == b) |
                  (f->body[k] == body) | (f->shell[k] == shell) | ((swapped & side) == 0) | (f->item[k] <= from);
        float s = out ? FLT_MAX : square[k];
        least[k] = smaller(s, least[k]);
        s = f->sharp[k] & e->sharp[i] ? s : FLT_MAX;
        square[k] = s;
        hit |= s <= limit;
    }
    return hit;
}

static void near_edges(ContactLook *look)
{
    const double *origin = look->x + 3 * (ptrdiff_t)look->others->node[0][0];
    EdgeLanes owners, others;
    LaneBox own, box;
    float least[LANES], square[LANES], best = FLT_MAX;
    load_edges(look, look->owners, origin, &owners, &own);
    load_edges(look, look->others, origin, &others, &box);
    double margin = MARGIN * (double)larger(box_extent(&box), box_extent(&own)), reach = look->reach + margin;
    float limit = reach > 0.0 ? (float)(reach * reach) : -1.0f;
    for (int k = 0; k < LANES; k++) least[k] = FLT_MAX;
    look->count = 0;
    for (int k = 0; k < LANES; k++) {
        float low[3], high[3];
        if (look->owners->side[k] == 0) continue;
        for (int i = 0; i < 3; i++) {
            low[i] = smaller(owners.start[i][k], owners.end[i][k]);
            high[i] = larger(owners.start[i][k], owners.end[i][k]);
        }
        if (box_distance(&box, low, high) > larger(best, limit)) continue;
        edge_distances(&owners, k, &others, square);
        if (sift_edges(look->owners, k, look->others, limit, square, least)) note(look, k, square, limit);
        best = least_of(least);
    }
    finish(look, best, margin);
}

const NearKernels BILLOW_NEAR_TABLE = {.faces = near_faces, .edges = near_edges};
