/* The element pass: stress, corner forces, area vectors and partial sums of whole blocks.
 *
 * The kernels are compiled once per instruction set and once more for the further laws (elements/kernels.c);
 * kernels_select picks one table at start. All tables give the same bits: only + - * / and square roots, no
 * contraction, sums in a fixed order. */
#ifndef BILLOW_KERNELS_H
#define BILLOW_KERNELS_H

#include "solver/model.h"

/* Natural coordinates of the points of a 2 x 2 quad, in the order of its corners: xi = -++- and eta = --++ times this.
 */
#define BILLOW_GAUSS 0.57735026918962576

/* Kernel constants per lane, ElementGroup.geometry. The natural gradients M = d(natural)/dX (2 x 2, row: natural
 * direction, column: material axis) come per integration point, then the values below. Surface groups have only the
 * sign. */
enum {
    GEOMETRY_M11,
    GEOMETRY_M12,
    GEOMETRY_M21,
    GEOMETRY_M22,        /* of the first point */
    GEOMETRY_WEIGHT,     /* reference area x thickness of the point [L3] */
    GEOMETRY_POINT_SIZE, /* doubles per point */
    /* after the points: */
    GEOMETRY_RATE = 0,    /* the element's part in the bound of the mesh: its exact largest squared frequency in its
                             reference state times its node share (eq. E20, E20b) [1/T2] */
    GEOMETRY_STRESS_RATE, /* likewise of the geometric stiffness: squared frequency per unit of stress [1/T2/(F/L2)] */
    GEOMETRY_SIGN,        /* +1 or -1: orientation of the area vector; 0 in padding lanes */
    GEOMETRY_PERIOD,      /* 1 / the element's own largest frequency in its reference state, for DAMP [T] */
    GEOMETRY_TAIL_SIZE,
    /* after the tail, quads that use the hourglass vector: one point, or FORM 0, 1 */
    GEOMETRY_SKEW1 = 0,
    GEOMETRY_SKEW2, /* reference hourglass vector in natural directions */
    GEOMETRY_SKEW_SIZE,
    /* and after these, one-point quads only: */
    GEOMETRY_HOURGLASS1 = GEOMETRY_SKEW_SIZE,
    GEOMETRY_HOURGLASS2, /* hourglass moduli x weight [energy/L4] */
    GEOMETRY_HOURGLASS_SIZE,
};

/* History of a block: what the work of a step is counted of, then the stresses conjugate to it in single precision:
 * they only weigh the work of one step (eq. E14), so that their rounding is lost in the ledger. Elements with one
 * point: C (11, 22, 12) of the last step and its second Piola-Kirchhoff stress. Quads with four: the products of the
 * natural gradients that all their metrics are made of, and the forces conjugate to these (eq. E14a). */
enum { HISTORY_POINT_VALUES = 3, HISTORY_QUAD_VALUES = 7 };

static inline int history_values(int points)
{
    return points == 4 ? HISTORY_QUAD_VALUES : points * HISTORY_POINT_VALUES;
}

/* Doubles per lane of the history of an element with so many points. */
static inline int history_size(int points)
{
    return history_values(points) + (history_values(points) + 1) / 2;
}

/* After that of all points: what a law of elements/kernel_further.h remembers at each point (kernel_curve_law.h). */
enum { MEMORY_POINT_SIZE = 10 };

/* Account of an element (eq. F7b), per lane: the energy that its stress may give back; the share of the stress that
 * acts.
 */
enum { ACCOUNT_HELD, ACCOUNT_SHARE, ACCOUNT_SIZE };

/* Corner sums: one row for each node of a segment (Model.row_start) [doubles]: the stress force, one unused, the area
 * vector that takes the pressure, one unused. A row fills a cache line. */
enum { ROW_SIZE = 8, ROW_AREA = 4 };

/* Sums over one chunk (BILLOW_CHUNK blocks of one group). */
typedef struct ChunkSums {
    double volume;    /* sum of sign (x - origin).S / 3 [L3] */
    double area;      /* [L2] */
    double energy;    /* internal energy, or its increment for laws with a stress-work ledger */
    double viscous;   /* increment of energy dissipated by DAMP where it is told apart (LAW_GREEN) */
    double hourglass; /* hourglass energy */
    double rate;      /* largest squared frequency [1/T2] */
    double unused[2]; /* fills a cache line, so that threads do not share one */
} ChunkSums;

typedef struct KernelInput {
    const ElementGroup *group;
    int first_block, end_block;
    const double *x;      /* current positions (.. x 3) */
    double inverse_step;  /* 1 / dt of the last step; 0 at the start: no strain rate */
    const double *origin; /* (3) of the volume */
    double *history;      /* State.history */
    double *rows;         /* corner sums, added to (row_count x ROW_SIZE); NULL: left out */
    double *lane_rate;    /* squared frequency per lane of the blocks, or NULL */
    bool restart_ledger;  /* first call: histories are filled, no work is counted */
    double *account;      /* accounts of the model's elements (padded count x ACCOUNT_SIZE, by blocks); NULL: closed */
    bool open_account;    /* the chunk's first call with accounts: they begin with the energy of the strain */
} KernelInput;

typedef void ElementKernel(const KernelInput *input, ChunkSums *sums);

typedef struct KernelTable {
    int level;               /* 2, 3 or 4: x86-64-v2 and so on */
    ElementKernel *surface;  /* LAW_SURFACE, any kind */
    ElementKernel *triangle; /* any law but those of further */
    ElementKernel *quad_full;
    ElementKernel *quad_one;
    const struct KernelTable *further; /* the same for LAW_CURVE and LAW_RUBBER; NULL in that table */
} KernelTable;

/* The table for this processor; the environment variable BILLOW_KERNELS=v2|v3|v4 asks for a lesser one. NULL if the
 * name is unknown or the processor lacks it. */
const KernelTable *kernels_select(const char *wish);

/* Adds the sums of blocks [first_block, end_block) with the right kernel. */
ElementKernel *kernels_for(const KernelTable *table, const ElementGroup *group);

#endif
