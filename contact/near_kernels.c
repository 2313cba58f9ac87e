/* Distances of the pairs of two groups from below, in single precision with a margin. Compiled once per instruction
 * set, with BILLOW_NEAR_TABLE naming its table. Results of a run do not depend on what is found here beyond the pairs
 * that touch (docs/theory.md, Search). */
#include "contact/near_kernels.h"

#include <float.h>
#include <math.h>

#include "contact/near_lanes.h"

enum { LANES = CONTACT_GROUP };

#define ALL_LANES ((1u << LANES) - 1u)

/* What rounding may take off a distance, as a share of the coordinates. */
#define MARGIN 2e-5

/* Triangles with an angle of a smaller sine squared at their first corner have no bound: they count as near. */
#define THIN 1e-3f

#define FOR_LANES(r) for (int r = 0; r < LANES; r += NEAR_WIDTH)

/* A box around what a group is made of. */
typedef struct LaneBox {
    float low[3], high[3];
} LaneBox;

/* The triangles of one group, from an origin of their own. */
typedef struct TriangleLanes {
    LaneArray corner[3], a[3], b[3], normal[3];
    LaneArray aa, ab, bb, inverse;
    LaneArray over[3]; /* altitude squared on the edge opposite to each corner */
    LaneBox box;
} TriangleLanes;

/* The edges of one group, from an origin of their own. */
typedef struct EdgeLanes {
    LaneArray start[3], along[3], low[3], high[3], square, inverse;
    LaneBox box;
} EdgeLanes;

/* Owners against one group: what they have found. */
typedef struct Search {
    LaneArray off;             /* squared distance of each owner from the group's box */
    LaneArray limit;           /* squared distance within which pairs are found, -1 none */
    unsigned meets_a, meets_b; /* others that owners of side A, of side B may meet */
    float best;                /* least squared distance so far */
} Search;

static float larger(float a, float b)
{
    return a > b ? a : b;
}

static float box_extent(const LaneBox *box)
{
    float extent = 0.0f;
    for (int i = 0; i < 3; i++) extent = larger(extent, larger(fabsf(box->low[i]), fabsf(box->high[i])));
    return extent;
}

/* Squared distances of the boxes low to high from a box. */
static void box_distances(const LaneBox *box, const LaneArray *low, const LaneArray *high, LaneArray *square)
{
    FOR_LANES(r)
    {
        Lanes sum = lanes_of(0.0f);
        for (int i = 0; i < 3; i++) {
            Lanes gap = lanes_larger(lanes_load(&low[i], r) - box->high[i], box->low[i] - lanes_load(&high[i], r));
            gap = lanes_larger(gap, lanes_of(0.0f));
            sum += gap * gap;
        }
        lanes_store(square, r, sum);
    }
}

static void close_box(LaneBox *box, const Lanes low[3], const Lanes high[3])
{
    for (int i = 0; i < 3; i++) {
        box->low[i] = lanes_least(low[i]);
        box->high[i] = lanes_largest(high[i]);
    }
}

static void load_triangles(const ContactLook *look, const double *origin, TriangleLanes *t)
{
    const ContactLanes *lanes = look->others;
    Lanes low[3], high[3];
    FOR_LANES(r)
    {
        Lanes p[3], q[3], s[3];
        lanes_points(look->x, lanes->node[0] + r, origin, p);
        lanes_points(look->x, lanes->node[1] + r, origin, q);
        lanes_points(look->x, lanes->node[2] + r, origin, s);
        for (int i = 0; i < 3; i++) {
            lanes_store(&t->corner[i], r, p[i]);
            lanes_store(&t->a[i], r, q[i] - p[i]);
            lanes_store(&t->b[i], r, s[i] - p[i]);
            Lanes least = lanes_smaller(lanes_smaller(p[i], q[i]), s[i]);
            Lanes most = lanes_larger(lanes_larger(p[i], q[i]), s[i]);
            low[i] = r == 0 ? least : lanes_smaller(low[i], least);
            high[i] = r == 0 ? most : lanes_larger(high[i], most);
        }
    }
    close_box(&t->box, low, high);
}

static void measure_triangles(TriangleLanes *t)
{
    const Lanes zero = lanes_of(0.0f), one = lanes_of(1.0f);
    FOR_LANES(r)
    {
        Lanes ax = lanes_load(&t->a[0], r), ay = lanes_load(&t->a[1], r), az = lanes_load(&t->a[2], r);
        Lanes bx = lanes_load(&t->b[0], r), by = lanes_load(&t->b[1], r), bz = lanes_load(&t->b[2], r);
        Lanes aa = ax * ax + ay * ay + az * az, bb = bx * bx + by * by + bz * bz, ab = ax * bx + ay * by + az * bz;
        Lanes nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
        Lanes square = nx * nx + ny * ny + nz * nz, cc = aa - 2.0f * ab + bb;
        unsigned thin = lanes_below(square, THIN * aa * bb);
        Lanes safe = lanes_replace(square, thin, 1.0f), good = lanes_replace(one, thin, 0.0f);
        Lanes inverse = good / safe, length = lanes_root(inverse);
        lanes_store(&t->aa, r, aa), lanes_store(&t->ab, r, ab), lanes_store(&t->bb, r, bb);
        lanes_store(&t->inverse, r, inverse);
        lanes_store(&t->normal[0], r, nx * length);
        lanes_store(&t->normal[1], r, ny * length);
        lanes_store(&t->normal[2], r, nz * length);
        lanes_store(&t->over[0], r, lanes_larger(good * safe / lanes_replace(cc, thin, 1.0f), zero));
        lanes_store(&t->over[1], r, good * safe / lanes_replace(bb, thin, 1.0f));
        lanes_store(&t->over[2], r, good * safe / lanes_replace(aa, thin, 1.0f));
    }
}

/* Squared distances of one point from triangles, from below: height and way beyond an edge. */
ALWAYS_INLINE Lanes face_distances(const TriangleLanes *t, const float p[3], int r)
{
    const Lanes zero = lanes_of(0.0f);
    Lanes x = p[0] - lanes_load(&t->corner[0], r), y = p[1] - lanes_load(&t->corner[1], r),
          z = p[2] - lanes_load(&t->corner[2], r);
    Lanes h = x * lanes_load(&t->normal[0], r) + y * lanes_load(&t->normal[1], r) + z * lanes_load(&t->normal[2], r);
    Lanes ar = x * lanes_load(&t->a[0], r) + y * lanes_load(&t->a[1], r) + z * lanes_load(&t->a[2], r);
    Lanes br = x * lanes_load(&t->b[0], r) + y * lanes_load(&t->b[1], r) + z * lanes_load(&t->b[2], r);
    Lanes ab = lanes_load(&t->ab, r), inverse = lanes_load(&t->inverse, r);
    Lanes v = (lanes_load(&t->bb, r) * ar - ab * br) * inverse, w = (lanes_load(&t->aa, r) * br - ab * ar) * inverse;
    Lanes u = lanes_smaller(1.0f - v - w, zero);
    v = lanes_smaller(v, zero), w = lanes_smaller(w, zero);
    Lanes over = lanes_larger(v * v * lanes_load(&t->over[1], r), w * w * lanes_load(&t->over[2], r));
    return h * h + lanes_larger(u * u * lanes_load(&t->over[0], r), over);
}

/* Others by the sides that they may meet. */
static void sort_sides(const ContactLanes *others, Search *search)
{
    unsigned both = items_equal(others->side, CONTACT_SIDE_A | CONTACT_SIDE_B);
    search->meets_a = both | items_equal(others->side, CONTACT_SIDE_B);
    search->meets_b = both | items_equal(others->side, CONTACT_SIDE_A);
}

static unsigned of_other_side(const Search *search, int32_t side)
{
    return (side & CONTACT_SIDE_A ? search->meets_a : 0) | (side & CONTACT_SIDE_B ? search->meets_b : 0);
}

/* Lanes of the register from r on that are not in the set. */
ALWAYS_INLINE unsigned lanes_out(unsigned set, int r)
{
    return ~set >> r & ((1u << NEAR_WIDTH) - 1u);
}

/* Squared distances of one owner: pairs that may meet lower the best one. */
ALWAYS_INLINE void take_best(Search *search, const LaneArray *square)
{
    Lanes least = lanes_load(square, 0);
    for (int r = NEAR_WIDTH; r < LANES; r += NEAR_WIDTH) least = lanes_smaller(least, lanes_load(square, r));
    if (lanes_below(least, lanes_of(search->best))) search->best = lanes_least(least);
}

static void note(ContactLook *look, int lane, unsigned found, const LaneArray *square)
{
    for (; found; found &= found - 1) {
        int other = __builtin_ctz(found);
        look->found[look->count++] = (ContactNearby){(int16_t)lane, (int16_t)other, square->at[other]};
    }
}

/* The first owner of the set, which is not empty, that is nearest to the box. */
static int nearest_of(const LaneArray *off, unsigned set)
{
    Lanes least = lanes_load(off, 0);
    for (int r = NEAR_WIDTH; r < LANES; r += NEAR_WIDTH) least = lanes_smaller(least, lanes_load(off, r));
    unsigned nearest = set & items_within(off, lanes_least(least));
    return __builtin_ctz(nearest ? nearest : set);
}

/* Those of the owners left that may find something, or something nearer. */
static unsigned worth_looking(const Search *search, unsigned left)
{
    return left & (items_within(&search->off, search->best) | items_below(&search->off, &search->limit));
}

static void finish(ContactLook *look, float square, double margin)
{
    look->margin = margin;
    look->nearest = square < FLT_MAX ? sqrt((double)square) - margin : DBL_MAX;
}

static void look_from_node(ContactLook *look, Search *search, const TriangleLanes *t, const LaneArray *point, int k)
{
    const ContactLanes *owners = look->owners, *others = look->others;
    const float p[3] = {point[0].at[k], point[1].at[k], point[2].at[k]};
    int32_t node = owners->node[0][k];
    unsigned own = items_equal(others->node[0], node) | items_equal(others->node[1], node) |
                   items_equal(others->node[2], node) | items_equal(others->node[3], node);
    unsigned meets = of_other_side(search, owners->side[k]) & ~(own | items_equal(others->body, owners->body[k]));
    LaneArray square;
    FOR_LANES(r)
    {
        lanes_store(&square, r, lanes_replace(face_distances(t, p, r), lanes_out(meets, r), FLT_MAX));
    }
    note(look, k, meets & items_within(&square, search->limit.at[k]), &square);
    take_best(search, &square);
}

static void near_faces(ContactLook *look)
{
    const double *origin = look->x + 3 * (ptrdiff_t)look->others->node[0][0];
    TriangleLanes t;
    LaneArray point[3];
    Search search = {.best = FLT_MAX};
    Lanes extent = lanes_of(0.0f);
    load_triangles(look, origin, &t);
    measure_triangles(&t);
    sort_sides(look->others, &search);
    FOR_LANES(r)
    {
        Lanes p[3];
        lanes_points(look->x, look->owners->node[0] + r, origin, p);
        for (int i = 0; i < 3; i++) {
            extent = lanes_larger(extent, lanes_absolute(p[i]));
            lanes_store(&point[i], r, p[i]);
        }
    }
    double margin = MARGIN * (double)larger(box_extent(&t.box), lanes_largest(extent));
    box_distances(&t.box, point, point, &search.off);
    for (int k = 0; k < LANES; k++) {
        double depth = look->deepest > 0.0 && look->owners->item[k] >= 0 ? look->depth[look->owners->item[k]] : 0.0;
        double reach = look->reach + depth + margin;
        search.limit.at[k] = reach > 0.0 ? (float)(reach * reach) : -1.0f;
    }
    look->count = 0;
    unsigned left = ~items_equal(look->owners->item, -1) & ALL_LANES;
    for (int k = nearest_of(&search.off, left); left; k = __builtin_ctz(left | 1u << LANES)) {
        left &= ~(1u << k);
        look_from_node(look, &search, &t, point, k);
        left = worth_looking(&search, left);
    }
    finish(look, search.best, margin);
}

static void load_edges(const ContactLook *look, const ContactLanes *lanes, const double *origin, EdgeLanes *e)
{
    Lanes lowest[3], highest[3];
    FOR_LANES(r)
    {
        Lanes p[3], q[3];
        lanes_points(look->x, lanes->node[0] + r, origin, p);
        lanes_points(look->x, lanes->node[1] + r, origin, q);
        for (int i = 0; i < 3; i++) {
            Lanes low = lanes_smaller(p[i], q[i]), high = lanes_larger(p[i], q[i]);
            lanes_store(&e->start[i], r, p[i]);
            lanes_store(&e->along[i], r, q[i] - p[i]);
            lanes_store(&e->low[i], r, low);
            lanes_store(&e->high[i], r, high);
            lowest[i] = r == 0 ? low : lanes_smaller(lowest[i], low);
            highest[i] = r == 0 ? high : lanes_larger(highest[i], high);
        }
    }
    close_box(&e->box, lowest, highest);
    FOR_LANES(r)
    {
        Lanes x = lanes_load(&e->along[0], r), y = lanes_load(&e->along[1], r), z = lanes_load(&e->along[2], r);
        Lanes square = x * x + y * y + z * z;
        unsigned none = lanes_below(square, lanes_of(0.0f));
        lanes_store(&e->square, r, square);
        lanes_store(&e->inverse, r, lanes_replace(1.0f / lanes_replace(square, none, 1.0f), none, 0.0f));
    }
}

/* Squared distance of two edges, from below, by one of them: with r from the other's start to its start, u along the
 * one, w along the other; products rr = r.r and so on. A point of the other is off the line of the one by no less, and
 * along it beyond its ends by no less. */
ALWAYS_INLINE Lanes off_the_line(Lanes rr, Lanes ru, Lanes rw, Lanes uw, Lanes uu, Lanes ww, Lanes inverse)
{
    const Lanes zero = lanes_of(0.0f), one = lanes_of(1.0f);
    Lanes qq = ww - uw * uw * inverse, q = rw - ru * uw * inverse;
    unsigned parallel = lanes_below(qq, 1e-6f * ww);
    Lanes t = lanes_replace(q / lanes_replace(qq, parallel, 1.0f), parallel, 0.5f);
    t = lanes_smaller(lanes_larger(t, zero), one);
    Lanes off = rr - ru * ru * inverse - 2.0f * t * q + t * t * qq;
    Lanes from = -ru * inverse, to = from + uw * inverse;
    Lanes beyond = lanes_larger(lanes_larger(lanes_smaller(from, to) - 1.0f, -lanes_larger(from, to)), zero);
    return lanes_larger(off, zero) + beyond * beyond * uu;
}

/* Squared distances of edge i of e from the edges f, from below. */
ALWAYS_INLINE Lanes edge_distances(const EdgeLanes *e, int i, const EdgeLanes *f, int r)
{
    float ux = e->along[0].at[i], uy = e->along[1].at[i], uz = e->along[2].at[i];
    Lanes uu = lanes_of(e->square.at[i]);
    Lanes x = e->start[0].at[i] - lanes_load(&f->start[0], r), y = e->start[1].at[i] - lanes_load(&f->start[1], r),
          z = e->start[2].at[i] - lanes_load(&f->start[2], r);
    Lanes wx = lanes_load(&f->along[0], r), wy = lanes_load(&f->along[1], r), wz = lanes_load(&f->along[2], r);
    Lanes ww = lanes_load(&f->square, r);
    Lanes rr = x * x + y * y + z * z, ru = x * ux + y * uy + z * uz, rw = x * wx + y * wy + z * wz;
    Lanes uw = ux * wx + uy * wy + uz * wz;
    Lanes one = off_the_line(rr, ru, rw, uw, uu, ww, lanes_of(e->inverse.at[i]));
    Lanes two = off_the_line(rr, -rw, -ru, uw, ww, uu, lanes_load(&f->inverse, r));
    return lanes_larger(lanes_larger(one, two) - 2e-6f * (rr + uu + ww), lanes_of(0.0f));
}

/* Within one group each pair is looked at once. */
static void look_from_edge(ContactLook *look, Search *search, const EdgeLanes *e, const EdgeLanes *f, int k)
{
    const ContactLanes *owners = look->owners, *others = look->others;
    int32_t a = owners->node[0][k], b = owners->node[1][k];
    unsigned common = items_equal(others->node[0], a) | items_equal(others->node[1], a) |
                      items_equal(others->node[0], b) | items_equal(others->node[1], b);
    common |= items_equal(others->body, owners->body[k]) | items_equal(others->shell, owners->shell[k]);
    if (owners == others) common |= (2u << k) - 1u;
    unsigned meets = of_other_side(search, owners->side[k]) & ~common;
    LaneArray square;
    FOR_LANES(r)
    {
        lanes_store(&square, r, lanes_replace(edge_distances(e, k, f, r), lanes_out(meets, r), FLT_MAX));
    }
    take_best(search, &square);
    note(look, k, meets & items_within(&square, search->limit.at[k]), &square);
}

static void near_edges(ContactLook *look)
{
    const double *origin = look->x + 3 * (ptrdiff_t)look->others->node[0][0];
    EdgeLanes own, other;
    const EdgeLanes *others = look->owners == look->others ? &own : &other;
    Search search = {.best = FLT_MAX};
    load_edges(look, look->owners, origin, &own);
    if (others == &other) load_edges(look, look->others, origin, &other);
    sort_sides(look->others, &search);
    double margin = MARGIN * (double)larger(box_extent(&others->box), box_extent(&own.box));
    double reach = look->reach + margin;
    box_distances(&others->box, own.low, own.high, &search.off);
    for (int k = 0; k < LANES; k++) search.limit.at[k] = reach > 0.0 ? (float)(reach * reach) : -1.0f;
    look->count = 0;
    unsigned left = ~items_equal(look->owners->item, -1) & ALL_LANES;
    for (int k = nearest_of(&search.off, left); left; k = __builtin_ctz(left | 1u << LANES)) {
        left &= ~(1u << k);
        look_from_edge(look, &search, &own, others, k);
        left = worth_looking(&search, left);
    }
    finish(look, search.best, margin);
}

static int pick(const float *gap, const int32_t *slot, const int32_t *item, int count, const float *limit, float more,
                int32_t *picked)
{
    int total = 0;
    for (int first = 0; first < count; first += NEAR_WIDTH) {
        int some = count - first < NEAR_WIDTH ? count - first : NEAR_WIDTH;
        unsigned set = (1u << some) - 1u;
        Lanes most = lanes_pick(limit, slot + first, set) + more;
        set &= lanes_below(lanes_from(gap + first), most);
        total += lanes_pack(item + first, set, picked + total);
    }
    return total;
}

const NearKernels BILLOW_NEAR_TABLE = {.faces = near_faces, .edges = near_edges, .pick = pick};
