/* Triangles that go through each other: boxes in a uniform grid, then edges against triangles by signed volumes. */
#include "contact/mesh_crossing.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "solver/memory.h"
#include "solver/vector3.h"

enum { GRID_CELLS_PER_FACET = 2, GRID_LARGEST = 1 << 26 };

/* A signed volume below this share of its largest term is taken for zero: rounding leaves about 1e-16 of it. */
#define FLAT 1e-13

typedef struct Grid {
    double low[3], inverse; /* origin; 1 / cell size */
    int cells[3];
    int32_t *start; /* first entry of each cell (product of cells + 1) */
    int32_t *entry; /* facets, ascending in each cell */
} Grid;

typedef struct Search {
    int facet_count;
    const int32_t *facet;
    const double *x;
    const unsigned char *wanted;
    double *box; /* (facet_count x 6): low, high */
    Grid grid;
    MeshCrossings *found;
} Search;

static const double *place_of(const Search *search, int node)
{
    return search->x + 3 * (ptrdiff_t)node;
}

static void find_boxes(Search *search, double low[3], double high[3])
{
    for (int f = 0; f < search->facet_count; f++) {
        double *box = search->box + 6 * (ptrdiff_t)f;
        for (int c = 0; c < 4; c++) {
            const double *x = place_of(search, search->facet[4 * (ptrdiff_t)f + c]);
            for (int k = 0; k < 3; k++) {
                if (c == 0 || x[k] < box[k]) box[k] = x[k];
                if (c == 0 || x[k] > box[3 + k]) box[3 + k] = x[k];
            }
        }
        for (int k = 0; k < 3; k++) {
            if (f == 0 || box[k] < low[k]) low[k] = box[k];
            if (f == 0 || box[3 + k] > high[k]) high[k] = box[3 + k];
        }
    }
}

/* Cells of the mean size of a facet, made larger until there are few enough of them. */
static void size_grid(Search *search, const double low[3], const double high[3])
{
    Grid *grid = &search->grid;
    double size = 0.0, largest = 0.0;
    for (int f = 0; f < search->facet_count; f++) {
        const double *box = search->box + 6 * (ptrdiff_t)f;
        size += fmax(fmax(box[3] - box[0], box[4] - box[1]), box[5] - box[2]) / search->facet_count;
    }
    for (int k = 0; k < 3; k++) largest = fmax(largest, high[k] - low[k]);
    if (!(size > 1e-6 * largest)) size = 1e-6 * largest;
    if (!(size > 0.0)) size = 1.0;
    double limit = 1000.0 + (double)GRID_CELLS_PER_FACET * search->facet_count;
    if (limit > GRID_LARGEST) limit = GRID_LARGEST;
    double product;
    do {
        product = 1.0;
        for (int k = 0; k < 3; k++) product *= floor((high[k] - low[k]) / size) + 1.0;
        if (product > limit) size *= 1.2;
    } while (product > limit);
    grid->inverse = 1.0 / size;
    for (int k = 0; k < 3; k++) {
        grid->low[k] = low[k];
        grid->cells[k] = (int)floor((high[k] - low[k]) / size) + 1;
    }
}

static int cell_of(const Grid *grid, int k, double x)
{
    const int i = (int)((x - grid->low[k]) * grid->inverse);
    return i < 0 ? 0 : i >= grid->cells[k] ? grid->cells[k] - 1 : i;
}

/* Counts (entry NULL) or enters facets in their cells; start then holds counts, or the place of each cell's next entry.
 */
static void visit_cells(const Search *search, int32_t *start, int32_t *entry)
{
    const Grid *grid = &search->grid;
    for (int f = 0; f < search->facet_count; f++) {
        const double *box = search->box + 6 * (ptrdiff_t)f;
        int first[3], last[3];
        for (int k = 0; k < 3; k++) {
            first[k] = cell_of(grid, k, box[k]);
            last[k] = cell_of(grid, k, box[3 + k]);
        }
        for (int i = first[0]; i <= last[0]; i++)
            for (int j = first[1]; j <= last[1]; j++)
                for (int k = first[2]; k <= last[2]; k++) {
                    const ptrdiff_t cell = ((ptrdiff_t)i * grid->cells[1] + j) * grid->cells[2] + k;
                    if (entry)
                        entry[start[cell]++] = f;
                    else
                        start[cell + 1]++;
                }
    }
}

static int fill_grid(Search *search)
{
    Grid *grid = &search->grid;
    const size_t count = (size_t)grid->cells[0] * (size_t)grid->cells[1] * (size_t)grid->cells[2];
    grid->start = memory_alloc(count + 2, sizeof *grid->start);
    if (!grid->start) return -1;
    /* one place further on, so that entering leaves the starts where they belong */
    visit_cells(search, grid->start + 1, NULL);
    for (size_t i = 0; i <= count; i++) grid->start[i + 1] += grid->start[i];
    grid->entry = memory_alloc((size_t)grid->start[count + 1] + 1, sizeof *grid->entry);
    if (!grid->entry) return -1;
    visit_cells(search, grid->start + 1, grid->entry);
    return 0;
}

/* Sign of (b - a) x (c - a) . (d - a), 0 where rounding could have made it; *volume receives the value. */
static int side_of(const double *a, const double *b, const double *c, const double *d, double *volume)
{
    double u[3], v[3], w[3], n[3];
    vector3_subtract(b, a, u);
    vector3_subtract(c, a, v);
    vector3_subtract(d, a, w);
    vector3_cross(u, v, n);
    *volume = vector3_dot(n, w);
    const double scale = vector3_norm(u) * vector3_norm(v) * vector3_norm(w);
    return *volume > FLAT * scale ? 1 : *volume < -FLAT * scale ? -1 : 0;
}

/* The edge p-q passes through the triangle abc; depth is then the shorter part of it. */
static bool edge_passes(const double *p, const double *q, const double *const t[3], double *depth, double place[3])
{
    double before, after, rest;
    const int first = side_of(t[0], t[1], t[2], p, &before), second = side_of(t[0], t[1], t[2], q, &after);
    if (first * second >= 0) return false;
    const int one = side_of(p, q, t[0], t[1], &rest);
    if (one == 0 || side_of(p, q, t[1], t[2], &rest) != one || side_of(p, q, t[2], t[0], &rest) != one) return false;
    double way[3];
    vector3_subtract(q, p, way);
    const double share = before / (before - after);
    *depth = fmin(share, 1.0 - share) * vector3_norm(way);
    for (int k = 0; k < 3; k++) place[k] = p[k] + share * way[k];
    return true;
}

/* Edges of facet a against the triangles of facet b. */
static bool edges_pass(const Search *search, int a, int b, double *depth, double place[3])
{
    const int32_t *edges = search->facet + 4 * (ptrdiff_t)a, *other = search->facet + 4 * (ptrdiff_t)b;
    bool passes = false;
    for (int half = 0; half < (other[3] == other[2] ? 1 : 2); half++) {
        const double *t[3] = {place_of(search, other[0]), place_of(search, other[1 + half]),
                              place_of(search, other[2 + half])};
        /* the sides, and the diagonal of a quadrilateral, which may be warped */
        for (int c = 0; c < 5; c++) {
            const int32_t n = c < 4 ? edges[c] : edges[0], m = c < 4 ? edges[(c + 1) % 4] : edges[2];
            if (n == m || (c == 4 && edges[3] == edges[2])) continue;
            double way, where[3];
            if (!edge_passes(place_of(search, n), place_of(search, m), t, &way, where)) continue;
            if (!passes || way > *depth) {
                *depth = way;
                for (int k = 0; k < 3; k++) place[k] = where[k];
            }
            passes = true;
        }
    }
    return passes;
}

static bool share_node(const int32_t *a, const int32_t *b)
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            if (a[i] == b[j]) return true;
    return false;
}

static void look_at_pair(Search *search, int a, int b)
{
    MeshCrossings *found = search->found;
    if (search->wanted && !search->wanted[a] && !search->wanted[b]) return;
    if (share_node(search->facet + 4 * (ptrdiff_t)a, search->facet + 4 * (ptrdiff_t)b)) return;
    double depth[2], place[2][3];
    const bool one = edges_pass(search, a, b, &depth[0], place[0]);
    const bool other = edges_pass(search, b, a, &depth[1], place[1]);
    if (!one && !other) return;
    const int deeper = other && (!one || depth[1] > depth[0]);
    found->count++;
    if (found->facet[0] >= 0 && depth[deeper] <= found->depth) return;
    found->facet[0] = a;
    found->facet[1] = b;
    found->depth = depth[deeper];
    for (int k = 0; k < 3; k++) found->place[k] = place[deeper][k];
}

/* True if the boxes overlap and this cell is the first that both are in, so that each pair is looked at once. */
static bool meet_here(const Search *search, int a, int b, const int cell[3])
{
    const double *one = search->box + 6 * (ptrdiff_t)a, *other = search->box + 6 * (ptrdiff_t)b;
    for (int k = 0; k < 3; k++) {
        const double low = fmax(one[k], other[k]);
        if (low > fmin(one[3 + k], other[3 + k])) return false;
        if (cell_of(&search->grid, k, low) != cell[k]) return false;
    }
    return true;
}

static void look_at_cells(Search *search)
{
    const Grid *grid = &search->grid;
    ptrdiff_t index = 0;
    int cell[3];
    for (cell[0] = 0; cell[0] < grid->cells[0]; cell[0]++)
        for (cell[1] = 0; cell[1] < grid->cells[1]; cell[1]++)
            for (cell[2] = 0; cell[2] < grid->cells[2]; cell[2]++, index++)
                for (int32_t i = grid->start[index]; i < grid->start[index + 1]; i++)
                    for (int32_t j = i + 1; j < grid->start[index + 1]; j++)
                        if (meet_here(search, grid->entry[i], grid->entry[j], cell))
                            look_at_pair(search, grid->entry[i], grid->entry[j]);
}

int mesh_find_crossings(int facet_count, const int32_t *facet, const double *x, const unsigned char *wanted,
                        MeshCrossings *crossings)
{
    *crossings = (MeshCrossings){.facet = {-1, -1}};
    if (facet_count == 0) return 0;
    Search search = {.facet_count = facet_count, .facet = facet, .x = x, .wanted = wanted, .found = crossings};
    search.box = memory_alloc((size_t)facet_count, 6 * sizeof *search.box);
    int status = -1;
    if (search.box) {
        double low[3] = {0}, high[3] = {0};
        find_boxes(&search, low, high);
        size_grid(&search, low, high);
        status = fill_grid(&search);
    }
    if (status == 0) look_at_cells(&search);
    memory_free(search.box);
    memory_free(search.grid.start);
    memory_free(search.grid.entry);
    return status;
}
