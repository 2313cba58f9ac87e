/* Point functions of the fabric laws given by curves: FORM 4, 14, -14, 24 (docs/theory.md, Fabric, curves). On packs of
 * points, without branches between lanes. */
#ifndef BILLOW_KERNEL_CURVE_LAW_H
#define BILLOW_KERNEL_CURVE_LAW_H

#include "elements/kernel_law.h"
#include "elements/law_curve.h"

/* What a point remembers. Per direction: largest strain, strain and stress where reloading began; then the largest
 * energy of (eq. F24). */
enum {
    CURVE_LARGEST,
    CURVE_RELOAD_STRAIN,
    CURVE_RELOAD_STRESS,
    CURVE_DIRECTION_SIZE,
    CURVE_ENERGY = CURVE_DIRECTIONS * CURVE_DIRECTION_SIZE,
    CURVE_MEMORY_SIZE /* MEMORY_POINT_SIZE of elements/kernels.h */
};

/* The piece of a curve in which each lane is. */
typedef struct CurvePiece {
    Pack x, y, slope, area;
} CurvePiece;

ALWAYS_INLINE CurvePiece choose_piece(const LawCurve *curve, const double *key, Pack at)
{
    CurvePiece p = {pack_of(curve->x[0]), pack_of(curve->y[0]), pack_of(curve->slope[0]), pack_of(curve->area[0])};
    for (int i = 1; i < curve->count; i++) {
        Pack past = at - key[i];
        p.x = pack_where_positive(past, pack_of(curve->x[i]), p.x);
        p.y = pack_where_positive(past, pack_of(curve->y[i]), p.y);
        p.slope = pack_where_positive(past, pack_of(curve->slope[i]), p.slope);
        p.area = pack_where_positive(past, pack_of(curve->area[i]), p.area);
    }
    return p;
}

/* Stress and its integral from zero strain. */
typedef struct CurveValue {
    Pack stress, area;
} CurveValue;

ALWAYS_INLINE CurveValue curve_at(const LawCurve *curve, Pack strain)
{
    CurvePiece p = choose_piece(curve, curve->x, strain);
    Pack way = strain - p.x;
    CurveValue v = {p.y + p.slope * way, p.area + (p.y + 0.5 * p.slope * way) * way};
    return v;
}

/* Strain and stress of the loading curve at a given area under it, area >= 0 (eq. F21). */
ALWAYS_INLINE void curve_at_area(const LawCurve *curve, Pack area, Pack *strain, Pack *stress)
{
    CurvePiece p = choose_piece(curve, curve->area, area);
    Pack more = pack_larger(area - p.area, pack_of(0.0));
    *stress = pack_root(p.y * p.y + 2.0 * p.slope * more);
    *strain = p.x + 2.0 * more / (p.y + *stress + BILLOW_TINY);
}

/* Stress on the way back from the largest strain, at a strain between 0 and that (eq. F21). */
ALWAYS_INLINE Pack unloading_stress(const CurveLaw *law, int direction, CurveValue load, CurveValue largest)
{
    Pack share = load.area / (largest.area + BILLOW_TINY), strain, stress;
    curve_at_area(&law->load[direction], share * law->meet_area[direction], &strain, &stress);
    CurveValue unload = curve_at(&law->unload[direction], strain);
    return load.stress * (unload.stress / (stress + BILLOW_TINY));
}

/* A direction with an unloading curve: remembers, and returns the stress (eq. F20 to F22). strain: not negative where
 * it matters; negative ones keep the loading curve. h: its history. */
ALWAYS_INLINE Pack hysteresis_stress(const CurveLaw *law, int direction, Pack strain, CurveValue load, double *h,
                                     ptrdiff_t stride)
{
    Pack before = pack_load(h + CURVE_LARGEST * stride), from = pack_load(h + CURVE_RELOAD_STRAIN * stride),
         held = pack_load(h + CURVE_RELOAD_STRESS * stride);
    Pack most = pack_larger(strain, before), back = most - strain, positive = pack_larger(strain, pack_of(0.0));
    CurveValue largest = curve_at(&law->load[direction], most);
    Pack stress = unloading_stress(law, direction, load, largest);
    if (law->reload > 0.0) {
        Pack share = (strain - from) / (most - from + BILLOW_TINY);
        Pack line = held + (largest.stress - held) * share;
        Pack above = pack_larger(line - stress, pack_of(0.0)) * law->reload;
        stress += pack_where_positive(strain - from, above, pack_of(0.0));
    }
    stress = pack_where_positive(back, pack_where_positive(strain, stress, load.stress), load.stress);
    /* reloading starts anew from the lowest strain since the largest */
    Pack lower = from - positive, fresh = pack_where_positive(back, lower, pack_of(1.0));
    pack_store(h + CURVE_LARGEST * stride, most);
    pack_store(h + CURVE_RELOAD_STRAIN * stride, pack_where_positive(fresh, positive, from));
    pack_store(h + CURVE_RELOAD_STRESS * stride,
               pack_where_positive(fresh, pack_where_positive(strain, stress, pack_of(0.0)), held));
    return stress;
}

/* Which share of the stress of the curves is left at the energy w W_m (eq. F24). h: the largest energy so far. */
ALWAYS_INLINE Pack softened_share(double q, Pack energy, double *h)
{
    Pack most = pack_larger(energy, pack_load(h));
    Pack w = (energy + BILLOW_TINY) / (most + BILLOW_TINY);
    pack_store(h, most);
    return w / (w + q * (1.0 - w));
}

typedef struct CurveResult {
    PackTensor stress; /* second Piola-Kirchhoff */
    Pack energy;       /* of the loading curves, per reference volume */
    Pack factor;       /* of the reference frequency squared in the stretched state (eq. F26, F27) */
} CurveResult;

/* c: right Cauchy-Green tensor; history: behind the ledger's, NULL where the law has none; stride between values. */
ALWAYS_INLINE CurveResult curve_stress(const CurveLaw *law, PackTensor c, double *history, ptrdiff_t stride)
{
    CurveResult result;
    const Pack least = pack_of(BILLOW_LEAST_SQUARED_STRETCH),
               sign = pack_where_positive(c.a12, pack_of(1.0), pack_of(-1.0));
    Pack wide = major_value(c), by1 = pack_of(1.0), by2 = pack_of(1.0), strain[CURVE_DIRECTIONS],
         stress[CURVE_DIRECTIONS];
    if (law->engineering) {
        Pack l1 = pack_root(pack_larger(c.a11, least)), l2 = pack_root(pack_larger(c.a22, least));
        strain[CURVE_WARP] = l1 - 1.0;
        strain[CURVE_WEFT] = l2 - 1.0;
        by1 = 1.0 / l1;
        by2 = 1.0 / l2;
        Pack narrow = pack_larger(pack_larger(by1, by2), pack_of(1.0));
        result.factor = pack_larger(pack_smaller(wide * (narrow * narrow), 2.0 + wide), pack_of(1.0));
    } else {
        strain[CURVE_WARP] = 0.5 * (c.a11 - 1.0);
        strain[CURVE_WEFT] = 0.5 * (c.a22 - 1.0);
        result.factor = wide;
    }
    strain[CURVE_SHEAR] = pack_absolute(c.a12);
    result.energy = pack_of(0.0);
    for (int i = 0; i < CURVE_DIRECTIONS; i++) {
        CurveValue load = curve_at(&law->load[i], strain[i]);
        stress[i] = load.stress;
        result.energy += load.area;
        if (history && law->unload[i].count > 0)
            stress[i] = hysteresis_stress(law, i, strain[i], load, history + i * CURVE_DIRECTION_SIZE * stride, stride);
    }
    Pack share = pack_of(1.0);
    if (history && law->softening > 0.0)
        share = softened_share(law->softening, result.energy, history + CURVE_ENERGY * stride);
    result.stress.a11 = share * (stress[CURVE_WARP] * by1);
    result.stress.a22 = share * (stress[CURVE_WEFT] * by2);
    result.stress.a12 = share * (sign * stress[CURVE_SHEAR]);
    return result;
}

#endif
