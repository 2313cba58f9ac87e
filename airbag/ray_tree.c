/* Tree of boxes over facets. */
#include "airbag/ray_tree.h"

#include <math.h>
#include <stddef.h>

#include "solver/memory.h"
#include "solver/vector3.h"

enum { LEAF_FACETS = 4 };
static const double WORN_OUT = 2.0; /* growth of the boxes' surface at which the tree is built anew */

int ray_tree_create(RayTree *tree, int facet_count, const int32_t *node)
{
    size_t count = (size_t)facet_count + 1;
    *tree = (RayTree){.facet_count = facet_count, .node = node};
    tree->order = memory_alloc(count, sizeof *tree->order);
    tree->box = memory_alloc(2 * count, sizeof *tree->box);
    tree->hint = memory_alloc(count, sizeof *tree->hint);
    tree->middle = memory_alloc(3 * count, sizeof *tree->middle);
    return tree->order && tree->box && tree->hint && tree->middle ? 0 : -1;
}

void ray_tree_free(RayTree *tree)
{
    memory_free(tree->order);
    memory_free(tree->box);
    memory_free(tree->hint);
    memory_free(tree->middle);
    *tree = (RayTree){0};
}

/* Facets of order[first .. end) by their place along an axis, ties by number. */
static bool before(const RayTree *tree, int axis, int32_t a, int32_t b)
{
    double x = tree->middle[3 * (ptrdiff_t)a + axis], y = tree->middle[3 * (ptrdiff_t)b + axis];
    return x != y ? x < y : a < b;
}

/* Puts the middle-th facet of the range in its place, smaller ones before it (Hoare's selection). */
static void select_median(RayTree *tree, int axis, int first, int end, int middle)
{
    int low = first, high = end - 1;
    while (low < high) {
        int32_t pivot = tree->order[low + (high - low) / 2];
        int i = low, j = high;
        while (i <= j) {
            while (before(tree, axis, tree->order[i], pivot)) i++;
            while (before(tree, axis, pivot, tree->order[j])) j--;
            if (i > j) break;
            int32_t swap = tree->order[i];
            tree->order[i++] = tree->order[j];
            tree->order[j--] = swap;
        }
        if (middle <= j) {
            high = j;
        } else if (middle >= i) {
            low = i;
        } else {
            return;
        }
    }
}

static int longest_axis(const RayTree *tree, int first, int end)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int i = first; i < end; i++)
        for (int k = 0; k < 3; k++) {
            double x = tree->middle[3 * (ptrdiff_t)tree->order[i] + k];
            low[k] = x < low[k] ? x : low[k];
            high[k] = x > high[k] ? x : high[k];
        }
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    return axis;
}

/* Depth is the logarithm of the count: halves. */
static void build_range(RayTree *tree, int first, int end)
{
    RayBox *box = &tree->box[tree->box_count++];
    *box = (RayBox){.facets = 8 * first + (end - first)};
    if (end - first > LEAF_FACETS) {
        int middle = first + (end - first) / 2;
        select_median(tree, longest_axis(tree, first, end), first, end, middle);
        box->facets = 0;
        build_range(tree, first, middle);
        build_range(tree, middle, end);
    }
    box->next = tree->box_count;
}

static int first_facet(const RayBox *box)
{
    return box->facets / 8;
}

static int end_facet(const RayBox *box)
{
    return box->facets / 8 + box->facets % 8;
}

static bool is_empty(const RayBox *box)
{
    return box->low[0] > box->high[0];
}

static double surface_of(const RayBox *box)
{
    if (is_empty(box)) return 0.0;
    double a = (double)box->high[0] - (double)box->low[0], b = (double)box->high[1] - (double)box->low[1],
           c = (double)box->high[2] - (double)box->low[2];
    return a * b + b * c + c * a;
}

/* Whether the outer side of a triangle of the facet is seen from one of the points. */
static bool may_block(const RayTree *tree, int facet, const double *x)
{
    if (!tree->side) return true;
    const int32_t *node = tree->node + 4 * (ptrdiff_t)facet;
    const double *a = x + 3 * (ptrdiff_t)node[0];
    double edge[3][3], normal[3], away[3];
    for (int k = 0; k < 3; k++) vector3_subtract(x + 3 * (ptrdiff_t)node[k + 1], a, edge[k]);
    for (int t = 0; t < 2 && (t == 0 || node[3] != node[2]); t++) {
        vector3_cross(edge[t], edge[t + 1], normal);
        for (int i = 0; i < tree->from_count; i++) {
            vector3_subtract(a, tree->from[i], away);
            if (tree->side[facet] * vector3_dot(away, normal) < 0.0) return true;
        }
    }
    return false;
}

/* The box of a leaf; a float's rounding error is below 6e-8 of the value. */
static void fit_leaf(RayTree *tree, RayBox *box, const double *x)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int f = first_facet(box); f < end_facet(box); f++) {
        if (!may_block(tree, tree->order[f], x)) continue;
        for (int c = 0; c < 4; c++) {
            const double *p = x + 3 * (ptrdiff_t)tree->node[4 * (ptrdiff_t)tree->order[f] + c];
            for (int k = 0; k < 3; k++) {
                low[k] = p[k] < low[k] ? p[k] : low[k];
                high[k] = p[k] > high[k] ? p[k] : high[k];
            }
        }
    }
    for (int k = 0; k < 3; k++) {
        box->low[k] = low[k] > high[k] ? INFINITY : (float)(low[k] - 2e-7 * fabs(low[k]));
        box->high[k] = low[k] > high[k] ? -INFINITY : (float)(high[k] + 2e-7 * fabs(high[k]));
    }
}

void ray_tree_fit_leaves(RayTree *tree, const double *x, int part, int parts)
{
    int first = (int)((int64_t)tree->box_count * part / parts),
        end = (int)((int64_t)tree->box_count * (part + 1) / parts);
    for (int i = first; i < end; i++)
        if (tree->box[i].facets != 0) fit_leaf(tree, &tree->box[i], x);
}

/* Inner boxes from the last to the first, children before parents; returns the surface of all boxes. */
static double fit_inner(RayTree *tree)
{
    double sum = 0.0;
    for (int i = tree->box_count - 1; i >= 0; i--) {
        RayBox *box = &tree->box[i];
        if (box->facets == 0) {
            const RayBox *a = box + 1, *b = &tree->box[a->next];
            for (int k = 0; k < 3; k++) {
                box->low[k] = a->low[k] < b->low[k] ? a->low[k] : b->low[k];
                box->high[k] = a->high[k] > b->high[k] ? a->high[k] : b->high[k];
            }
        }
        sum += surface_of(box);
    }
    return sum;
}

static double fit(RayTree *tree, const double *x)
{
    ray_tree_fit_leaves(tree, x, 0, 1);
    return fit_inner(tree);
}

void ray_tree_build(RayTree *tree, const double *x)
{
    tree->box_count = 0;
    if (tree->facet_count == 0) return;
    for (int f = 0; f < tree->facet_count; f++) {
        tree->order[f] = f;
        for (int k = 0; k < 3; k++) {
            double sum = 0.0;
            for (int c = 0; c < 4; c++) sum += x[3 * (ptrdiff_t)tree->node[4 * (ptrdiff_t)f + c] + k];
            tree->middle[3 * (ptrdiff_t)f + k] = 0.25 * sum;
        }
    }
    build_range(tree, 0, tree->facet_count);
    const int8_t *side = tree->side;
    tree->side = NULL;
    tree->built_size = fit(tree, x);
    tree->side = side;
    if (side) fit(tree, x);
}

void ray_tree_sides(RayTree *tree, const int8_t *side, const double from[3], const double to[3])
{
    tree->side = side;
    tree->from_count = 1;
    for (int k = 0; k < 3; k++) {
        if (from[k] != to[k]) tree->from_count = 2;
        tree->from[0][k] = from[k];
        tree->from[1][k] = to[k];
    }
}

void ray_tree_finish(RayTree *tree, const double *x)
{
    if (tree->box_count == 0 || fit_inner(tree) > WORN_OUT * tree->built_size) ray_tree_build(tree, x);
}

void ray_tree_refit(RayTree *tree, const double *x)
{
    ray_tree_fit_leaves(tree, x, 0, 1);
    ray_tree_finish(tree, x);
}

typedef struct Ray {
    double origin[3], direction[3], inverse[3]; /* to the target at parameter 1 */
    double limit;
} Ray;

static bool hits_box(const Ray *ray, const RayBox *box)
{
    double enter = 0.0, leave = ray->limit;
    if (is_empty(box)) return false;
    for (int k = 0; k < 3; k++) {
        double a = ((double)box->low[k] - ray->origin[k]) * ray->inverse[k];
        double b = ((double)box->high[k] - ray->origin[k]) * ray->inverse[k];
        double near = a < b ? a : b, far = a < b ? b : a;
        /* a ray within a face's plane has 0 times infinity: not a number leaves the bounds as they are */
        enter = near > enter ? near : enter;
        leave = far < leave ? far : leave;
    }
    return enter <= leave * (1.0 + 1e-12) + 1e-300;
}

/* Moeller and Trumbore 1997; side 0: both sides, +1 or -1: only against the normal a b c times it. */
static bool hits_triangle(const Ray *ray, int side, const double *a, const double *b, const double *c)
{
    double u[3], v[3], p[3], t[3], q[3];
    vector3_subtract(b, a, u);
    vector3_subtract(c, a, v);
    vector3_cross(ray->direction, v, p);
    double determinant = vector3_dot(u, p);
    if (determinant == 0.0 || side * determinant < 0.0) return false;
    double inverse = 1.0 / determinant;
    vector3_subtract(ray->origin, a, t);
    double first = vector3_dot(t, p) * inverse;
    if (!(first >= 0.0 && first <= 1.0)) return false;
    vector3_cross(t, u, q);
    double second = vector3_dot(ray->direction, q) * inverse;
    if (!(second >= 0.0 && first + second <= 1.0)) return false;
    double place = vector3_dot(v, q) * inverse;
    return place > 1e-9 && place < ray->limit;
}

static bool hits_facet(const RayTree *tree, const double *x, const Ray *ray, int facet)
{
    const int32_t *node = tree->node + 4 * (ptrdiff_t)facet;
    const double *a = x + 3 * (ptrdiff_t)node[0], *b = x + 3 * (ptrdiff_t)node[1], *c = x + 3 * (ptrdiff_t)node[2];
    int side = tree->side ? tree->side[facet] : 0;
    if (tree->side && side == 0) return false;
    if (hits_triangle(ray, side, a, b, c)) return true;
    return node[3] != node[2] && hits_triangle(ray, side, a, c, x + 3 * (ptrdiff_t)node[3]);
}

static bool search(RayTree *tree, const double *x, const Ray *ray, int skip)
{
    for (int i = 0; i < tree->box_count;) {
        const RayBox *box = &tree->box[i];
        if (!hits_box(ray, box)) {
            i = box->next;
            continue;
        }
        for (int f = first_facet(box); f < end_facet(box); f++) {
            if (tree->order[f] == skip || !hits_facet(tree, x, ray, tree->order[f])) continue;
            if (skip >= 0) tree->hint[skip] = tree->order[f] + 1;
            return true;
        }
        i++;
    }
    return false;
}

/* What hid a facet before hides it most often still. */
bool ray_tree_blocked(RayTree *tree, const double *x, const double a[3], const double b[3], int skip, double margin)
{
    Ray ray;
    for (int k = 0; k < 3; k++) {
        ray.origin[k] = a[k];
        ray.direction[k] = b[k] - a[k];
        ray.inverse[k] = 1.0 / ray.direction[k];
    }
    double length = vector3_norm(ray.direction);
    if (!(length > margin)) return false;
    ray.limit = 1.0 - margin / length;
    if (skip >= 0 && tree->hint[skip] > 0 && hits_facet(tree, x, &ray, tree->hint[skip] - 1)) return true;
    return search(tree, x, &ray, skip);
}
