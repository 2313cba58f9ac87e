/* Dense products and factors on packs. A tile of C is summed in registers, rows in packs, the columns of B one number
 * each; every entry adds its products in the same order, whatever the width of a pack, so that all sets have the same
 * bits. */
#include "solver/dense_kernels.h"

#include <math.h>
#include <string.h>

#include "elements/pack.h"

enum {
    TILE_PACKS = BILLOW_KERNEL_LEVEL >= 4 ? 4 : 2,
    TILE_ROWS = TILE_PACKS * PACK_WIDTH,
    TILE_COLUMNS = 4,
    DEPTH = 256,      /* products that are summed before C is touched */
    BLOCK = 16,       /* columns that are factorised or solved at a time */
    ROWS_AT_ONCE = 64 /* of a solution, small enough for the first-level cache */
};

typedef double LoosePack __attribute__((vector_size(8 * PACK_WIDTH), aligned(8)));

ALWAYS_INLINE Pack load_loose(const double *from)
{
    return (Pack) * (const LoosePack *)(const void *)from;
}

ALWAYS_INLINE void store_loose(double *to, Pack value)
{
    *(LoosePack *)(void *)to = (LoosePack)value;
}

/* ---- product ---- */

/* One tile: its place in C, how it is written, and whether all of it is. */
typedef struct Tile {
    DenseOut c;
    ptrdiff_t rows, below; /* rows that exist; entry (i, j) is written if i >= j + below */
    DenseMode mode;
    bool add; /* a later block of products */
    bool whole;
} Tile;

ALWAYS_INLINE void write_whole(const Tile *tile, int packs, int columns, Pack sum[TILE_COLUMNS][TILE_PACKS])
{
    for (int j = 0; j < columns; j++)
        for (int i = 0; i < packs; i++) {
            double *to = tile->c.at + j * tile->c.ld + i * PACK_WIDTH;
            Pack value = sum[j][i];
            if (tile->mode == DENSE_SUBTRACT)
                value = load_loose(to) - value;
            else if (tile->add)
                value = load_loose(to) + value;
            store_loose(to, value);
        }
}

static void write_part(const Tile *tile, int packs, int columns, Pack sum[TILE_COLUMNS][TILE_PACKS])
{
    for (int j = 0; j < columns; j++) {
        double value[TILE_ROWS];
        for (int i = 0; i < packs; i++) store_loose(value + i * PACK_WIDTH, sum[j][i]);
        double *to = tile->c.at + j * tile->c.ld;
        for (ptrdiff_t i = j + tile->below > 0 ? j + tile->below : 0; i < tile->rows; i++) {
            if (tile->mode == DENSE_SUBTRACT)
                to[i] -= value[i];
            else
                to[i] = tile->add ? to[i] + value[i] : value[i];
        }
    }
}

ALWAYS_INLINE void sum_tile(int packs, int columns, ptrdiff_t depth, DenseIn a, DenseIn b, const Tile *tile)
{
    Pack sum[TILE_COLUMNS][TILE_PACKS];
#pragma GCC unroll 4
    for (int j = 0; j < columns; j++)
#pragma GCC unroll 4
        for (int i = 0; i < packs; i++) sum[j][i] = (Pack){0};
    for (ptrdiff_t p = 0; p < depth; p++) {
        Pack row[TILE_PACKS];
#pragma GCC unroll 4
        for (int i = 0; i < packs; i++) row[i] = load_loose(a.at + p * a.ld + i * PACK_WIDTH);
#pragma GCC unroll 4
        for (int j = 0; j < columns; j++) {
            Pack factor = pack_of(b.at[p * b.ld + j]);
#pragma GCC unroll 4
            for (int i = 0; i < packs; i++) sum[j][i] += row[i] * factor;
        }
    }
    if (tile->whole)
        write_whole(tile, packs, columns, sum);
    else
        write_part(tile, packs, columns, sum);
}

ALWAYS_INLINE void sum_columns(int packs, int columns, ptrdiff_t depth, DenseIn a, DenseIn b, const Tile *tile)
{
    if (columns == 4)
        sum_tile(packs, 4, depth, a, b, tile);
    else if (columns == 3)
        sum_tile(packs, 3, depth, a, b, tile);
    else if (columns == 2)
        sum_tile(packs, 2, depth, a, b, tile);
    else
        sum_tile(packs, 1, depth, a, b, tile);
}

static void sum_any(int packs, int columns, ptrdiff_t depth, DenseIn a, DenseIn b, const Tile *tile)
{
    if (packs == 1)
        sum_columns(1, columns, depth, a, b, tile);
    else if (packs == 2)
        sum_columns(2, columns, depth, a, b, tile);
#if BILLOW_KERNEL_LEVEL >= 4
    else if (packs == 3)
        sum_columns(3, columns, depth, a, b, tile);
    else
        sum_columns(4, columns, depth, a, b, tile);
#endif
}

/* The last rows, filled up with zeros to whole packs. */
static DenseIn pad_rows(ptrdiff_t rows, int packs, ptrdiff_t depth, DenseIn a, double *padded)
{
    ptrdiff_t height = packs * PACK_WIDTH;
    for (ptrdiff_t p = 0; p < depth; p++) {
        for (ptrdiff_t i = 0; i < rows; i++) padded[p * height + i] = a.at[p * a.ld + i];
        for (ptrdiff_t i = rows; i < height; i++) padded[p * height + i] = 0.0;
    }
    return (DenseIn){padded, height};
}

/* Rows i to i + rows of C, one block of products. */
static void multiply_rows(ptrdiff_t i, ptrdiff_t rows, ptrdiff_t n, ptrdiff_t depth, DenseIn a, DenseIn b, DenseOut c,
                          DenseMode mode, bool add, bool lower)
{
    double padded[TILE_ROWS * DEPTH];
    int packs = (int)((rows + PACK_WIDTH - 1) / PACK_WIDTH);
    bool partial = rows < packs * PACK_WIDTH;
    if (partial) a = pad_rows(rows, packs, depth, a, padded);
    for (ptrdiff_t j = 0; j < n && !(lower && j >= i + rows); j += TILE_COLUMNS) {
        int columns = n - j < TILE_COLUMNS ? (int)(n - j) : TILE_COLUMNS;
        Tile tile = {.c = {c.at + i + j * c.ld, c.ld},
                     .rows = rows,
                     .below = lower ? j - i : -TILE_COLUMNS,
                     .mode = mode,
                     .add = add,
                     .whole = !partial && !(lower && j + columns - 1 > i)};
        sum_any(packs, columns, depth, a, (DenseIn){b.at + j, b.ld}, &tile);
    }
}

static void multiply(ptrdiff_t m, ptrdiff_t n, ptrdiff_t k, DenseIn a, DenseIn b, DenseOut c, DenseMode mode,
                     bool lower)
{
    for (ptrdiff_t p = 0; p == 0 || p < k; p += DEPTH) {
        ptrdiff_t depth = k - p < DEPTH ? k - p : DEPTH;
        for (ptrdiff_t i = 0; i < m; i += TILE_ROWS) {
            ptrdiff_t rows = m - i < TILE_ROWS ? m - i : TILE_ROWS;
            multiply_rows(i, rows, n, depth, (DenseIn){a.at + p * a.ld + i, a.ld}, (DenseIn){b.at + p * b.ld, b.ld}, c,
                          mode, p > 0, lower);
        }
    }
}

/* ---- factor and solutions ---- */

/* Rows of X L^T = B, few columns. */
static void solve_rows(ptrdiff_t rows, ptrdiff_t n, DenseIn l, DenseOut b)
{
    for (ptrdiff_t j = 0; j < n; j++) {
        double *restrict x = b.at + j * b.ld;
        for (ptrdiff_t p = 0; p < j; p++) {
            const double *restrict known = b.at + p * b.ld;
            double factor = l.at[p * l.ld + j];
            for (ptrdiff_t i = 0; i < rows; i++) x[i] -= known[i] * factor;
        }
        double inverse = 1.0 / l.at[j * l.ld + j];
        for (ptrdiff_t i = 0; i < rows; i++) x[i] *= inverse;
    }
}

static void solve_block(ptrdiff_t m, ptrdiff_t n, DenseIn l, DenseOut b)
{
    for (ptrdiff_t i = 0; i < m; i += ROWS_AT_ONCE)
        solve_rows(m - i < ROWS_AT_ONCE ? m - i : ROWS_AT_ONCE, n, l, (DenseOut){b.at + i, b.ld});
}

static void solve_right(ptrdiff_t m, ptrdiff_t n, DenseIn l, DenseOut b)
{
    for (ptrdiff_t j = 0; j < n; j += BLOCK) {
        ptrdiff_t width = n - j < BLOCK ? n - j : BLOCK;
        DenseOut here = {b.at + j * b.ld, b.ld};
        if (j > 0) multiply(m, width, j, (DenseIn){b.at, b.ld}, (DenseIn){l.at + j, l.ld}, here, DENSE_SUBTRACT, false);
        solve_block(m, width, (DenseIn){l.at + j + j * l.ld, l.ld}, here);
    }
}

static ptrdiff_t factor_block(ptrdiff_t n, DenseOut a)
{
    for (ptrdiff_t j = 0; j < n; j++) {
        double *restrict column = a.at + j * a.ld;
        for (ptrdiff_t p = 0; p < j; p++) {
            const double *restrict known = a.at + p * a.ld;
            double factor = known[j];
            for (ptrdiff_t i = j; i < n; i++) column[i] -= known[i] * factor;
        }
        if (!(column[j] > 0.0)) return j + 1;
        double root = sqrt(column[j]), inverse = 1.0 / root;
        column[j] = root;
        for (ptrdiff_t i = j + 1; i < n; i++) column[i] *= inverse;
    }
    return 0;
}

static ptrdiff_t factor(ptrdiff_t n, DenseOut a)
{
    for (ptrdiff_t j = 0; j < n; j += BLOCK) {
        ptrdiff_t width = n - j < BLOCK ? n - j : BLOCK;
        DenseOut here = {a.at + j + j * a.ld, a.ld};
        DenseIn left = {a.at + j, a.ld};
        if (j > 0) multiply(n - j, width, j, left, left, here, DENSE_SUBTRACT, true);
        ptrdiff_t failed = factor_block(width, here);
        if (failed) return j + failed;
        solve_block(n - j - width, width, (DenseIn){here.at, here.ld}, (DenseOut){here.at + width, here.ld});
    }
    return 0;
}

/* ---- one right side ---- */

static void subtract_column(ptrdiff_t m, double factor, const double *restrict a, double *restrict y)
{
    for (ptrdiff_t i = 0; i < m; i++) y[i] -= a[i] * factor;
}

/* Eight partial sums and a tree, in every set alike. */
static double product(ptrdiff_t m, const double *a, const double *x)
{
    double sum[8] = {0};
    ptrdiff_t i = 0;
    for (; i + 8 <= m; i += 8)
        for (int l = 0; l < 8; l++) sum[l] += a[i + l] * x[i + l];
    for (int l = 0; i < m; i++, l++) sum[l] += a[i] * x[i];
    return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

static void solve_forward(ptrdiff_t n, DenseIn l, double *x)
{
    for (ptrdiff_t j = 0; j < n; j++) {
        const double *column = l.at + j * l.ld;
        x[j] /= column[j];
        subtract_column(n - j - 1, x[j], column + j + 1, x + j + 1);
    }
}

static void solve_backward(ptrdiff_t n, DenseIn l, double *x)
{
    for (ptrdiff_t j = n - 1; j >= 0; j--) {
        const double *column = l.at + j * l.ld;
        x[j] = (x[j] - product(n - j - 1, column + j + 1, x + j + 1)) / column[j];
    }
}

static void subtract_times(ptrdiff_t m, ptrdiff_t n, DenseIn a, const double *x, double *y)
{
    for (ptrdiff_t j = 0; j < n; j++) subtract_column(m, x[j], a.at + j * a.ld, y);
}

static void subtract_transposed(ptrdiff_t m, ptrdiff_t n, DenseIn a, const double *x, double *y)
{
    for (ptrdiff_t j = 0; j < n; j++) y[j] -= product(m, a.at + j * a.ld, x);
}

const DenseKernels BILLOW_DENSE_TABLE = {
    .multiply = multiply,
    .factor = factor,
    .solve_right = solve_right,
    .solve_forward = solve_forward,
    .solve_backward = solve_backward,
    .subtract_times = subtract_times,
    .subtract_transposed = subtract_transposed,
};
