/* Closed convex surfaces of facets. Equation (I9) of docs/theory.md. */
#include "contact/convex_hull.h"

#include <ccd/ccd.h>
#include <stdlib.h>
#include <string.h>

#include "contact/contact_geometry.h"
#include "solver/memory.h"

/* A corner may lie beyond a face by this share of the size: quadrilaterals are rarely flat. */
#define DENT_SHARE 1e-3

void convex_hull_free(ConvexHull *hull)
{
    memory_free(hull->corner);
    memory_free(hull->plane);
    memory_free(hull->triangle);
    memory_free(hull->side);
    *hull = (ConvexHull){0};
}

static int compare_numbers(const void *left, const void *right)
{
    const int64_t *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

/* Place of a node in the ascending list. */
static int32_t find_node(const int64_t *node, int count, int64_t wanted)
{
    int low = 0, high = count - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (node[middle] < wanted)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Corners, each once. node: room for 4 facet_count. */
static void list_corners(int facet_count, const int32_t *facet, const double *x, int64_t *node, ConvexHull *hull)
{
    for (int i = 0; i < 4 * facet_count; i++) node[i] = facet[i];
    qsort(node, 4 * (size_t)facet_count, sizeof *node, compare_numbers);
    for (int i = 0; i < 4 * facet_count; i++)
        if (i == 0 || node[i] != node[hull->corner_count - 1]) node[hull->corner_count++] = node[i];
    for (int c = 0; c < hull->corner_count; c++)
        memcpy(hull->corner + 3 * (ptrdiff_t)c, x + 3 * (ptrdiff_t)node[c], 3 * sizeof *x);
}

/* Half the diagonal from a to b of a quadrilateral is this far from the origin, squared and times four. */
static double diagonal_height(const ConvexHull *hull, int32_t a, int32_t b)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        double both = hull->corner[3 * a + k] + hull->corner[3 * b + k];
        sum += both * both;
    }
    return sum;
}

/* Triangles by the corners' places; a quadrilateral that is not flat is cut along its outer diagonal. */
static void make_triangles(int facet_count, const int32_t *facet, const int64_t *node, ConvexHull *hull)
{
    for (int f = 0; f < facet_count; f++) {
        int32_t c[4];
        for (int k = 0; k < 4; k++) c[k] = find_node(node, hull->corner_count, facet[4 * f + k]);
        int turn = c[2] != c[3] && diagonal_height(hull, c[1], c[3]) > diagonal_height(hull, c[0], c[2]);
        for (int half = 0; half < (c[2] == c[3] ? 1 : 2); half++) {
            int32_t *t = hull->triangle + 3 * (ptrdiff_t)hull->triangle_count++;
            for (int k = 0; k < 3; k++) t[k] = c[(turn + (k == 0 ? 0 : k + half)) % 4];
        }
    }
}

/* The origin goes to the middle of the box around the corners. */
static void centre_corners(ConvexHull *hull)
{
    for (int k = 0; k < 3; k++) {
        double low = hull->corner[k], high = low;
        for (int c = 0; c < hull->corner_count; c++) {
            low = fmin(low, hull->corner[3 * c + k]);
            high = fmax(high, hull->corner[3 * c + k]);
        }
        hull->origin[k] = 0.5 * (low + high);
    }
    for (int c = 0; c < hull->corner_count; c++) {
        double *r = hull->corner + 3 * (ptrdiff_t)c;
        for (int k = 0; k < 3; k++) r[k] -= hull->origin[k];
        hull->radius = fmax(hull->radius, vector3_norm(r));
    }
}

/* Does every edge have two triangles? edge: room for 3 triangle_count. */
static bool is_closed(const ConvexHull *hull, int64_t *edge)
{
    int count = 3 * hull->triangle_count;
    for (int i = 0; i < count; i++) {
        int64_t a = hull->triangle[i], b = hull->triangle[i % 3 == 2 ? i - 2 : i + 1];
        edge[i] = a < b ? a << 32 | b : b << 32 | a;
    }
    qsort(edge, (size_t)count, sizeof *edge, compare_numbers);
    for (int i = 0; i < count; i += 2)
        if (i + 1 == count || edge[i] != edge[i + 1] || (i + 2 < count && edge[i + 2] == edge[i])) return false;
    return true;
}

/* The plane of a triangle, away from the origin; a triangle without area has none. */
static void add_plane(ConvexHull *hull, int t)
{
    const int32_t *corner = hull->triangle + 3 * (ptrdiff_t)t;
    double u[3], w[3], n[3], offset;
    vector3_subtract(hull->corner + 3 * (ptrdiff_t)corner[1], hull->corner + 3 * (ptrdiff_t)corner[0], u);
    vector3_subtract(hull->corner + 3 * (ptrdiff_t)corner[2], hull->corner + 3 * (ptrdiff_t)corner[0], w);
    vector3_cross(u, w, n);
    hull->side[t] = -1;
    if (!(vector3_normalize(n) > 1e-12 * hull->radius * hull->radius)) return;
    offset = vector3_dot(n, hull->corner + 3 * (ptrdiff_t)corner[0]);
    double sign = offset < 0.0 ? -1.0 : 1.0;
    for (int p = 0; p < hull->plane_count; p++) {
        const double *plane = hull->plane + 4 * (ptrdiff_t)p;
        if (sign * vector3_dot(plane, n) < 1.0 - 1e-14 || fabs(plane[3] - sign * offset) > 1e-9 * hull->radius)
            continue;
        hull->side[t] = p;
        return;
    }
    hull->side[t] = hull->plane_count;
    double *plane = hull->plane + 4 * (ptrdiff_t)hull->plane_count++;
    for (int k = 0; k < 3; k++) plane[k] = sign * n[k];
    plane[3] = sign * offset;
}

static HullKind judge(ConvexHull *hull)
{
    double nearest = INFINITY;
    for (int p = 0; p < hull->plane_count; p++) {
        const double *plane = hull->plane + 4 * (ptrdiff_t)p;
        nearest = fmin(nearest, plane[3]);
        for (int c = 0; c < hull->corner_count; c++)
            hull->dent = fmax(hull->dent, vector3_dot(plane, hull->corner + 3 * (ptrdiff_t)c) - plane[3]);
    }
    if (hull->dent > DENT_SHARE * hull->radius) return HULL_CONCAVE;
    return nearest > DENT_SHARE * hull->radius ? HULL_CONVEX : HULL_FLAT;
}

int convex_hull_make(int facet_count, const int32_t *facet, const double *x, ConvexHull *hull, HullKind *kind)
{
    size_t most = 2 * (size_t)facet_count + 1;
    *hull = (ConvexHull){.corner = memory_alloc(3 * 2 * most, sizeof(double)),
                         .plane = memory_alloc(4 * most, sizeof(double)),
                         .triangle = memory_alloc(3 * most, sizeof(int32_t)),
                         .side = memory_alloc(most, sizeof(int32_t))};
    int64_t *work = memory_alloc(3 * most, sizeof *work);
    int status = hull->corner && hull->plane && hull->triangle && hull->side && work ? 0 : -1;
    *kind = HULL_OPEN;
    if (!status && facet_count > 0) {
        list_corners(facet_count, facet, x, work, hull);
        centre_corners(hull);
        make_triangles(facet_count, facet, work, hull);
        if (is_closed(hull, work)) {
            for (int t = 0; t < hull->triangle_count; t++) add_plane(hull, t);
            *kind = judge(hull);
        }
    }
    memory_free(work);
    if (status) convex_hull_free(hull);
    return status;
}

/* Inside, the nearest point is on the nearest plane; outside, on one of the triangles that face the point. */
double convex_hull_distance(const ConvexHull *hull, const double r[3], double normal[3])
{
    double most = -INFINITY, least = INFINITY;
    for (int p = 0; p < hull->plane_count; p++) {
        const double *plane = hull->plane + 4 * (ptrdiff_t)p;
        double height = vector3_dot(plane, r) - plane[3];
        if (height <= most) continue;
        most = height;
        memcpy(normal, plane, 3 * sizeof *normal);
    }
    if (!(most > 0.0)) return most;
    for (int t = 0; t < hull->triangle_count; t++) {
        ClosestPoint at;
        double bound;
        if (hull->side[t] < 0) continue;
        const double *plane = hull->plane + 4 * (ptrdiff_t)hull->side[t];
        if (!(vector3_dot(plane, r) > plane[3])) continue;
        memcpy(at.corner, hull->triangle + 3 * (ptrdiff_t)t, sizeof at.corner);
        if (!closest_point(&at, r, hull->corner, least, &bound) || !(at.distance < least)) continue;
        least = at.distance;
        for (int k = 0; k < 3; k++) normal[k] = at.feature == 7 ? plane[k] : at.toward[k] / at.distance;
    }
    return least < INFINITY ? least : most;
}

static void farthest_corner(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *point)
{
    const ConvexHull *hull = object;
    double most = -INFINITY;
    int best = 0;
    for (int c = 0; c < hull->corner_count; c++) {
        double along = vector3_dot(direction->v, hull->corner + 3 * (ptrdiff_t)c);
        if (along <= most) continue;
        most = along;
        best = c;
    }
    for (int k = 0; k < 3; k++) point->v[k] = hull->origin[k] + hull->corner[3 * best + k];
}

static void middle(const void *object, ccd_vec3_t *point)
{
    memcpy(point->v, ((const ConvexHull *)object)->origin, sizeof point->v);
}

double convex_hull_overlap(const ConvexHull *a, const ConvexHull *b, double place[3])
{
    ccd_t ccd;
    ccd_real_t depth = 0.0;
    ccd_vec3_t direction, position;
    double away[3];
    vector3_subtract(a->origin, b->origin, away);
    if (vector3_norm(away) > a->radius + b->radius) return 0.0;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = farthest_corner;
    ccd.center1 = ccd.center2 = middle;
    ccd.max_iterations = 1000;
    ccd.mpr_tolerance = 1e-6 * fmin(a->radius, b->radius);
    if (ccdMPRPenetration(a, b, &ccd, &depth, &direction, &position)) return 0.0;
    memcpy(place, position.v, sizeof position.v);
    return depth > ccd.mpr_tolerance ? depth : 0.0;
}
