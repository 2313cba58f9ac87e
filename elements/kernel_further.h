/* Stress stage of the laws beyond kernel_stages.h's: fabric by curves, rubber. Included by elements/kernels.c when it
 * is compiled for these laws; takes the place of natural_stress. What a law has besides (liner, unloading, damping) is
 * a branch that all lanes take alike. */
#ifndef BILLOW_KERNEL_FURTHER_H
#define BILLOW_KERNEL_FURTHER_H

#include "elements/kernel_curve_law.h"
#include "elements/kernel_hyperelastic.h"
#include "elements/kernel_stages.h"

/* Modes beyond those of kernel_stages.h, one at a time. */
enum { MODE_CURVE = 64, MODE_MOONEY = 128, MODE_OGDEN = 256 };

/* Fabric by curves with its liner (eq. F15 to F27). */
ALWAYS_INLINE PackTensor stress_curve(const LawInput *in, const PointPlace *place, PointPack *p)
{
    const FabricLaw *law = &in->law;
    double *memory = law->has_memory ? place->memory : NULL;
    CurveResult r = curve_stress(law->curves, p->c, memory, LANES);
    PackTensor s = r.stress;
    Pack energy = r.energy;
    if (law->has_liner) {
        PackTensor e = green_strain(p->c), t = apply_moduli(&law->liner, e);
        s = add_tensors(s, t);
        energy += 0.5 * contract(t, e);
    }
    p->energy = lane_values(place->point, GEOMETRY_WEIGHT) * energy;
    p->rate = r.factor * lane_values(place->tail, GEOMETRY_RATE) +
              major_bound(s) * lane_values(place->tail, GEOMETRY_STRESS_RATE);
    return s;
}

/* Rubber (eq. H1 to H9). What holds the hourglass of a one-point quad is in GEOMETRY_RATE. */
ALWAYS_INLINE PackTensor stress_rubber(int mode, const LawInput *in, const PointPlace *place, PointPack *p)
{
    const RubberLaw *law = in->law.rubber;
    RubberResult r = mode & MODE_OGDEN ? ogden_stress(law, p->c) : mooney_stress(law, p->c);
    p->energy = lane_values(place->point, GEOMETRY_WEIGHT) * r.energy;
    p->rate = r.modulus * lane_values(place->tail, GEOMETRY_STRESS_RATE);
    if (in->hourglass) p->rate += major_value(p->c) * lane_values(place->tail, GEOMETRY_RATE);
    return r.stress;
}

/* From C to the natural stress of count packs of points. */
ALWAYS_INLINE void further_stress(int mode, bool one_point, const LawInput *in, int count, const PointPlace *place,
                                  PointPack *restrict p)
{
    for (int i = 0; i < count; i++) {
        p[i].viscous = pack_of(0.0);
        PackTensor s =
            mode & MODE_CURVE ? stress_curve(in, &place[i], &p[i]) : stress_rubber(mode, in, &place[i], &p[i]);
        if (in->has_history) /* with a memory the energy is the work of the stress */
            s = with_history(mode, one_point, in->law.has_memory, in, &place[i], s, &p[i]);
        p[i].p = natural_directions(place[i].point, s);
    }
}

#endif
