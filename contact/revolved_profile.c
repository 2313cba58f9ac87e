/* Bodies of revolution by their outline. Equations (I11) and (I12) of docs/theory.md. */
#include "contact/revolved_profile.h"

#include <math.h>

#include "solver/memory.h"

void revolved_profile_free(RevolvedProfile *profile)
{
    memory_free(profile->edge);
    *profile = (RevolvedProfile){0};
}

bool revolved_profile_open(const RevolvedProfile *profile, int end)
{
    return !profile->loop && (end == 0 ? profile->edge[0].r : profile->end[0]) > 0.0;
}

/* z and r of a point, by its place in the array. */
typedef struct Outline {
    int count;
    const double *z, *r;
} Outline;

/* Twice the area of the triangle of three points. */
static double turn_of(const Outline *o, int a, int b, int c)
{
    return (o->r[b] - o->r[a]) * (o->z[c] - o->z[a]) - (o->z[b] - o->z[a]) * (o->r[c] - o->r[a]);
}

static bool in_box(const Outline *o, int a, int b, int c)
{
    return fmin(o->r[a], o->r[b]) <= o->r[c] && o->r[c] <= fmax(o->r[a], o->r[b]) &&
           fmin(o->z[a], o->z[b]) <= o->z[c] && o->z[c] <= fmax(o->z[a], o->z[b]);
}

/* Do the edges from a and from b to their next points meet? */
static bool edges_meet(const Outline *o, int a, int b)
{
    double one = turn_of(o, a, a + 1, b), two = turn_of(o, a, a + 1, b + 1), three = turn_of(o, b, b + 1, a),
           four = turn_of(o, b, b + 1, a + 1);
    if (((one > 0.0 && two < 0.0) || (one < 0.0 && two > 0.0)) &&
        ((three > 0.0 && four < 0.0) || (three < 0.0 && four > 0.0)))
        return true;
    return (one == 0.0 && in_box(o, a, a + 1, b)) || (two == 0.0 && in_box(o, a, a + 1, b + 1)) ||
           (three == 0.0 && in_box(o, b, b + 1, a)) || (four == 0.0 && in_box(o, b, b + 1, a + 1));
}

/* Does the outline turn back on itself at the point b, with the neighbours a and c? */
static bool turns_back(const Outline *o, int a, int b, int c)
{
    double along = (o->r[b] - o->r[a]) * (o->r[c] - o->r[b]) + (o->z[b] - o->z[a]) * (o->z[c] - o->z[b]);
    return turn_of(o, a, b, c) == 0.0 && along < 0.0;
}

static ProfileFault find_crossing(const Outline *o, bool loop, int *where)
{
    int edges = o->count - 1;
    for (int a = 0; a < edges; a++) {
        *where = a + 1;
        if (a + 1 < edges ? turns_back(o, a, a + 1, a + 2) : loop && turns_back(o, a, a + 1, 1)) return PROFILE_CROSSES;
        for (int b = a + 2; b < edges; b++)
            if (!(loop && a == 0 && b == edges - 1) && edges_meet(o, a, b)) return PROFILE_CROSSES;
    }
    return PROFILE_FINE;
}

/* What is wrong with the outline. */
static ProfileFault judge(const Outline *o, bool loop, int *where)
{
    double twice = 0.0, most = 0.0;
    *where = 0;
    if (o->count < 2) return PROFILE_SHORT;
    for (int i = 0; i < o->count; i++) {
        *where = i;
        if (!(o->r[i] >= 0.0)) return PROFILE_NEGATIVE;
        bool end = !loop && (i == 0 || i == o->count - 1);
        if (o->r[i] == 0.0 && (!end || (o->count == 2 && o->r[1 - i] == 0.0))) return PROFILE_ON_AXIS;
        if (i == 0) continue;
        twice += (o->r[i] + o->r[i - 1]) * (o->z[i] - o->z[i - 1]);
        most += (o->r[i] + o->r[i - 1]) * fabs(o->z[i] - o->z[i - 1]);
    }
    ProfileFault fault = find_crossing(o, loop, where);
    return fault != PROFILE_FINE || fabs(twice) > 1e-12 * most ? fault : PROFILE_FLAT;
}

/* The edges in the direction in which the body lies on their left, r to the right and z up. */
static void make_edges(const Outline *o, RevolvedProfile *profile)
{
    double twice = 0.0;
    for (int i = 1; i < o->count; i++) twice += (o->r[i] + o->r[i - 1]) * (o->z[i] - o->z[i - 1]);
    profile->edge_count = o->count - 1;
    for (int e = 0; e < profile->edge_count; e++) {
        int a = twice > 0.0 ? e : o->count - 1 - e, b = twice > 0.0 ? e + 1 : a - 1;
        double across = o->r[b] - o->r[a], up = o->z[b] - o->z[a], length = sqrt(across * across + up * up);
        profile->edge[e] = (ProfileEdge){o->r[a], o->z[a], {up / length, -across / length}, length};
        profile->end[0] = o->r[b];
        profile->end[1] = o->z[b];
    }
    for (int i = 0; i < o->count; i++)
        profile->reach = fmax(profile->reach, sqrt(o->r[i] * o->r[i] + o->z[i] * o->z[i]));
}

int revolved_profile_make(int count, const double *z, const double *r, RevolvedProfile *profile, ProfileFault *fault,
                          int *where)
{
    Outline o = {count, z, r};
    *profile = (RevolvedProfile){.loop = count > 3 && z[0] == z[count - 1] && r[0] == r[count - 1]};
    *fault = judge(&o, profile->loop, where);
    if (*fault != PROFILE_FINE) return 0;
    profile->edge = memory_alloc((size_t)count, sizeof *profile->edge);
    if (!profile->edge) return -1;
    make_edges(&o, profile);
    return 0;
}

/* The nearest point is the first (side -1) or last point of an edge. A corner belongs to two edges, on the axis to an
 * edge and its mirror image; which side of the outline is which there, the mean of both normals tells. */
static double corner_distance(const RevolvedProfile *p, int nearest, int side, double r, double z, double normal[2])
{
    const ProfileEdge *edge = &p->edge[nearest];
    int other = nearest + side, last = p->edge_count - 1;
    bool outer = other < 0 || other > last;
    if (p->loop && outer) other = side < 0 ? last : 0;
    double sum[2] = {0.0, 2.0 * edge->normal[1]}, v[2] = {r - edge->r, z - edge->z};
    if (side > 0) {
        bool end = outer && !p->loop;
        v[0] = r - (end ? p->end[0] : p->edge[other].r);
        v[1] = z - (end ? p->end[1] : p->edge[other].z);
    }
    if (!outer || p->loop) {
        sum[0] = edge->normal[0] + p->edge[other].normal[0];
        sum[1] = edge->normal[1] + p->edge[other].normal[1];
    } else if (revolved_profile_open(p, side < 0 ? 0 : 1)) {
        normal[0] = edge->normal[0];
        normal[1] = edge->normal[1];
        return INFINITY;
    }
    double way = sqrt(v[0] * v[0] + v[1] * v[1]), sign = sum[0] * v[0] + sum[1] * v[1] < 0.0 ? -1.0 : 1.0;
    const double *toward = way > 0.0 ? v : sum;
    double size = way > 0.0 ? sign * way : sqrt(sum[0] * sum[0] + sum[1] * sum[1]);
    normal[0] = toward[0] / size;
    normal[1] = toward[1] / size;
    return sign * way;
}

double revolved_profile_distance(const RevolvedProfile *profile, double r, double z, double normal[2])
{
    double least = INFINITY, height = 0.0;
    int nearest = 0, side = 0;
    for (int e = 0; e < profile->edge_count; e++) {
        const ProfileEdge *edge = &profile->edge[e];
        double across = r - edge->r, up = z - edge->z;
        double above = edge->normal[0] * across + edge->normal[1] * up;
        double along = edge->normal[0] * up - edge->normal[1] * across;
        double beyond = along < 0.0 ? along : along > edge->length ? along - edge->length : 0.0;
        double square = above * above + beyond * beyond;
        if (!(square < least)) continue;
        least = square;
        nearest = e;
        height = above;
        side = along < 0.0 ? -1 : along > edge->length ? 1 : 0;
    }
    if (side != 0) return corner_distance(profile, nearest, side, r, z, normal);
    normal[0] = profile->edge[nearest].normal[0];
    normal[1] = profile->edge[nearest].normal[1];
    return height;
}
