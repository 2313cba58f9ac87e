/* Compiled once per instruction set, with BILLOW_MEET_TABLE naming its table. The same operations in the same order as
 * contact/contact_geometry.h has them, so that the bits are the same. */
#include "contact/meet_kernels.h"

#include <math.h>
#include <stddef.h>

#include "contact/contact_geometry.h"
#include "contact/pack_lanes.h"

ALWAYS_INLINE void pack3_store(double to[3][MEET_LANES], int r, Pack3 value)
{
    for (int k = 0; k < 3; k++) pack_store(to[k] + r, value.at[k]);
}

/* Sum of weight v of four nodes. */
ALWAYS_INLINE Pack3 sum_speeds(const Pack weight[4], const Pack3 v[4])
{
    Pack3 sum;
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        sum.at[k] = pack_of(0.0);
#pragma GCC unroll 4
        for (int i = 0; i < 4; i++) sum.at[k] += weight[i] * v[i].at[k];
    }
    return sum;
}

ALWAYS_INLINE Pack place_on_edge(Pack s)
{
    Pack up = mask_choose(mask_less(pack_of(1.0 - ON_EDGE), s), pack_of(1.0), s);
    return mask_choose(mask_less(s, pack_of(ON_EDGE)), pack_of(0.0), up);
}

/* Closest points on edges, the best so far. */
typedef struct EdgePoint {
    Pack best, weight[3], feature;
} EdgePoint;

/* Takes a place on an edge where it is nearer, from corner i to corner j of three. */
ALWAYS_INLINE void take_edge(EdgePoint *f, PackMask beyond, Pack s, Pack square, int i, int j)
{
    PackMask take = beyond & mask_less(square, f->best);
    Pack zero = pack_of(0.0), one = pack_of(1.0), weight[3] = {zero, zero, zero};
    weight[i] = 1.0 - s;
    weight[j] = s;
    PackBits first = (PackBits)mask_choose(mask_less(s, one), (Pack)((PackBits){0} + (1u << i)), zero);
    PackBits second = (PackBits)mask_choose(mask_less(zero, s), (Pack)((PackBits){0} + (1u << j)), zero);
    f->best = mask_choose(take, square, f->best);
    for (int k = 0; k < 3; k++) f->weight[k] = mask_choose(take, weight[k], f->weight[k]);
    f->feature = mask_choose(take, (Pack)(first | second), f->feature);
}

/* Squared distance of r from u a + v b. */
ALWAYS_INLINE Pack square_from(Pack3 a, Pack3 b, Pack3 r, Pack u, Pack v)
{
    Pack sum = pack_of(0.0);
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        Pack d = r.at[k] - u * a.at[k] - v * b.at[k];
        sum += d * d;
    }
    return sum;
}

/* PACK_WIDTH lanes from lane r on. */
ALWAYS_INLINE void faces_of_pack(const MeetStep *step, MeetFaces *f, int r)
{
    Pack3 at = nodes_load(step->x, f->nodes.node[0] + r), corner = nodes_load(step->x, f->nodes.node[1] + r);
    Pack3 a = pack3_subtract(nodes_load(step->x, f->nodes.node[2] + r), corner);
    Pack3 b = pack3_subtract(nodes_load(step->x, f->nodes.node[3] + r), corner), p = pack3_subtract(at, corner);
    Pack3 n = pack3_cross(a, b), v[4];
    Pack square = pack3_dot(n, n), length = 1.0 / pack_root(square), inverse = length * length;
    Pack height = pack3_dot(n, p) * length, most = pack_of(0.0), thickness = pack_load(f->thickness + r);
    for (int k = 0; k < 4; k++) v[k] = nodes_load(step->v, f->nodes.node[k] + r);
    for (int k = 1; k < 4; k++) {
        Pack3 u = pack3_subtract(v[k], v[0]);
        most = pack_larger(pack3_dot(u, u), most);
    }
    Pack reach = thickness + pack_ahead(pack_root(most) * step->longer, thickness) + pack_load(f->depth + r) +
                 pack_load(f->remembered + r);
    PackMask near = mask_less(pack_of(0.0), square) & ~mask_less(reach, pack_absolute(height));

    Pack aa = pack3_dot(a, a), ab = pack3_dot(a, b), bb = pack3_dot(b, b), ar = pack3_dot(a, p), br = pack3_dot(b, p);
    Pack edge = pack_of(ON_EDGE), zero = pack_of(0.0);
    EdgePoint to = {.best = pack_of(INFINITY), .feature = (Pack)((PackBits){0} + 7u)};
    to.weight[1] = (bb * ar - ab * br) * inverse;
    to.weight[2] = (aa * br - ab * ar) * inverse;
    to.weight[0] = 1.0 - to.weight[1] - to.weight[2];
    PackMask inside[3];
    for (int k = 0; k < 3; k++) inside[k] = mask_less(edge, to.weight[k]);
    Pack s = place_on_edge((br - ar + aa - ab) / (aa - 2.0 * ab + bb));
    take_edge(&to, ~inside[0], s, square_from(a, b, p, 1.0 - s, s), 1, 2);
    s = place_on_edge(br / bb);
    take_edge(&to, ~inside[1], s, square_from(a, b, p, zero, s), 0, 2);
    s = place_on_edge(ar / aa);
    take_edge(&to, ~inside[2], s, square_from(a, b, p, s, zero), 0, 1);

    Pack3 toward, normal;
    Pack distance = zero;
    for (int k = 0; k < 3; k++) {
        normal.at[k] = n.at[k] * length;
        toward.at[k] = p.at[k] - to.weight[1] * a.at[k] - to.weight[2] * b.at[k];
        distance += toward.at[k] * toward.at[k];
    }
    distance = mask_choose(inside[0] & inside[1] & inside[2], pack_absolute(height), pack_root(distance));
    near &= ~mask_less(reach, distance);
    /* too far for its own velocity: a new pair that cannot touch in this step */
    Pack weight[4] = {pack_of(1.0), -to.weight[0], -to.weight[1], -to.weight[2]}, beyond = distance - thickness;
    Pack3 speed = sum_speeds(weight, v);
    Pack ahead = pack_ahead(step->longer * pack_root(pack3_dot(speed, speed)), thickness) * (1.0 + 1e-9);
    PackMask apart = mask_less(zero, beyond) & mask_less(ahead, beyond);

    for (int k = 0; k < 3; k++) pack_store(f->weight[k] + r, to.weight[k]);
    pack3_store(f->normal, r, normal);
    pack3_store(f->toward, r, toward);
    pack3_store(f->speed, r, speed);
    pack_store(f->height + r, height);
    pack_store(f->distance + r, distance);
    *(PackBits *)(void *)(f->feature + r) = (PackBits)to.feature;
    f->near |= mask_lanes(near) << r;
    f->touch |= mask_lanes(~apart) << r;
}

static void faces(const MeetStep *step, MeetFaces *block, int blocks)
{
    for (MeetFaces *f = block; f < block + blocks; f++) {
        f->near = f->touch = 0;
        for (int r = 0; r < MEET_LANES; r += PACK_WIDTH) faces_of_pack(step, f, r);
    }
}

/* Both edges, and from the second's first end to the first's. */
typedef struct EdgePair {
    Pack3 u, w, r;
    Pack uu, ww, uw, ur, wr;
} EdgePair;

ALWAYS_INLINE EdgePair pair_of(const MeetStep *step, const MeetNodes *nodes, int r)
{
    Pack3 first = nodes_load(step->x, nodes->node[0] + r), second = nodes_load(step->x, nodes->node[2] + r);
    EdgePair p = {.u = pack3_subtract(nodes_load(step->x, nodes->node[1] + r), first),
                  .w = pack3_subtract(nodes_load(step->x, nodes->node[3] + r), second),
                  .r = pack3_subtract(first, second)};
    p.uu = pack3_dot(p.u, p.u), p.ww = pack3_dot(p.w, p.w), p.uw = pack3_dot(p.u, p.w);
    p.ur = pack3_dot(p.u, p.r), p.wr = pack3_dot(p.w, p.r);
    return p;
}

static unsigned may_cross(const MeetStep *step, const MeetNodes *nodes)
{
    unsigned set = 0;
    for (int r = 0; r < MEET_LANES; r += PACK_WIDTH) {
        EdgePair p = pair_of(step, nodes, r);
        Pack least = 1e-9 * p.uu * p.ww, most = p.uu * p.ww - p.uw * p.uw + least;
        Pack s = p.uw * p.wr - p.ww * p.ur, t = p.uu * p.wr - p.uw * p.ur;
        PackMask by = mask_less(s, -least) | mask_less(t, -least) | mask_less(most, s) | mask_less(most, t);
        set |= mask_lanes(~by) << r;
    }
    return set;
}

/* By how much a place is beyond the ends of its edge; and the place within. */
ALWAYS_INLINE Pack over_ends(Pack s)
{
    Pack zero = pack_of(0.0), one = pack_of(1.0);
    return mask_choose(mask_less(s, zero), -s, mask_choose(mask_less(one, s), s - 1.0, zero));
}

ALWAYS_INLINE Pack within_ends(Pack s)
{
    Pack zero = pack_of(0.0), one = pack_of(1.0);
    return mask_choose(mask_less(s, zero), zero, mask_choose(mask_less(one, s), one, s));
}

ALWAYS_INLINE void edges_of_pack(const MeetStep *step, MeetEdges *f, int r)
{
    EdgePair p = pair_of(step, &f->nodes, r);
    Pack3 v[4], n = pack3_cross(p.u, p.w), normal;
    Pack most = pack_of(0.0), thickness = pack_load(f->thickness + r), slack = pack_load(f->slack + r);
    for (int k = 0; k < 4; k++) v[k] = nodes_load(step->v, f->nodes.node[k] + r);
    for (int i = 0; i < 2; i++)
        for (int k = 2; k < 4; k++) {
            Pack3 u = pack3_subtract(v[i], v[k]);
            most = pack_larger(pack3_dot(u, u), most);
        }
    Pack reach = thickness + pack_ahead(pack_root(most) * step->longer, thickness) + pack_load(f->remembered + r);
    Pack square = pack3_dot(n, n), height = pack3_dot(n, p.r), root = pack_root(square);
    PackMask cross = mask_less(PARALLEL * p.uu * p.ww, square) & ~mask_less(reach * root, pack_absolute(height));
    Pack inverse = 1.0 / square, length = 1.0 / root;
    Pack s = (p.uw * p.wr - p.ww * p.ur) * inverse, t = (p.uu * p.wr - p.uw * p.ur) * inverse;
    cross &= ~(mask_less(slack, over_ends(s)) | mask_less(slack, over_ends(t)));
    s = within_ends(s);
    t = within_ends(t);
    Pack weight[4] = {1.0 - s, s, t - 1.0, -t};
    for (int k = 0; k < 3; k++) normal.at[k] = n.at[k] * length;
    for (int k = 0; k < 4; k++) pack_store(f->weight[k] + r, weight[k]);
    pack3_store(f->normal, r, normal);
    pack3_store(f->speed, r, sum_speeds(weight, v));
    pack_store(f->height + r, height * length);
    f->cross |= mask_lanes(cross) << r;
}

static void edges(const MeetStep *step, MeetEdges *block, int blocks)
{
    for (MeetEdges *f = block; f < block + blocks; f++) {
        f->cross = 0;
        for (int r = 0; r < MEET_LANES; r += PACK_WIDTH) edges_of_pack(step, f, r);
    }
}

const MeetKernels BILLOW_MEET_TABLE = {.faces = faces, .may_cross = may_cross, .edges = edges};
